// SPDX-License-Identifier: MIT
//
// The covariance of Gardner's sum against its lines, one by one: every wave of the Jacobi-Anger
// expansion at its exact frequency, a pair of whole numbers; waves that coincide add up before they
// are squared. And that it is not stated where more of them coincide.
#include "tests/test.h"

#include "core/random.h"
#include "tests/texts.h"

enum { MOST = 96 };

typedef __int128 whole;

typedef struct line {
    whole x, y;
    double real, imaginary;
    unsigned term;
} line;

typedef struct lines {
    line *at;
    size_t count;
    whole across[8], up[8]; // u_i and v_i as whole multiples of 10^-10 and 10^-17
} lines;

static int by_frequency(const void *a, const void *b) {
    const line *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return p->y < q->y ? -1 : p->y > q->y;
}

// u_i = 0.023 1.9 2.0 ...: one digit more each time; v_i = 0.021 2.2 2.12 ...: two.
static void fill_frequencies(lines *in) {
    in->across[0] = 23 * (whole)10000000;
    in->up[0] = 21 * (whole)100000000000000;
    for (int i = 0; i < 7; i++) {
        in->across[i + 1] = in->across[i] * (19 + i) / 10;
        in->up[i + 1] = in->up[i] * (220 - 8 * i) / 100;
    }
}

// The wave of index n of exp(i p (z cos V)), p = -1, 1, halved: cos of a phase is two of them.
static void wave(int p, int n, double z, double constant, double *real, double *imaginary) {
    double size = jn(n, z) / 2, angle = p * (n * M_PI_2 + constant);
    *real = size * cos(angle);
    *imaginary = size * sin(angle);
}

static void add_term(lines *in, unsigned i, double square) {
    double u = (double)in->across[i] * 1e-10, v = (double)in->up[i] * 1e-17;
    double alpha = i ? 2 * M_PI * u * 0.9 * M_PI_2 : 0, beta = i ? 2 * M_PI * v * 1.1 * M_PI_2 : 0;
    double first = i ? 0 : 2 * M_PI * u * 0.9, second = i ? 0 : 2 * M_PI * v * 0.7;
    for (int p = -1; p <= 1; p++)
        for (int n = p && i ? -MOST : 0; n <= (p && i ? MOST : 0); n++) {
            double a = 0.5, a_imaginary = 0;
            if (p)
                wave(p, n, alpha, first, &a, &a_imaginary);
            if (hypot(a, a_imaginary) < 1e-9)
                continue;
            for (int q = -1; q <= 1; q++)
                for (int m = q && i ? -MOST : 0; m <= (q && i ? MOST : 0); m++) {
                    double b = 0.5, b_imaginary = 0;
                    if (q)
                        wave(q, m, beta, second, &b, &b_imaginary);
                    if (hypot(b, b_imaginary) < 1e-9)
                        continue;
                    in->at[in->count++] =
                        (line){.x = p * in->across[i] + (i ? m * in->across[i - 1] : 0),
                               .y = q * in->up[i] + (i ? n * in->up[i - 1] : 0),
                               .real = square * (a * b - a_imaginary * b_imaginary),
                               .imaginary = square * (a * b_imaginary + a_imaginary * b),
                               .term = i};
                }
        }
}

// All lines of `count` terms, those that coincide made one; counts the ones of different terms.
static size_t make_lines(unsigned count, lines *in) {
    size_t mixed = 0, kept = 0;
    double square = 0.09;
    *in = (lines){.at = malloc(sizeof *in->at << 20)};
    assert_non_null(in->at);
    fill_frequencies(in);
    for (unsigned i = 0; i < count; i++, square *= 0.707 * 0.707)
        add_term(in, i, square);
    assert_true(in->count < (size_t)1 << 20);
    qsort(in->at, in->count, sizeof *in->at, by_frequency);
    for (size_t i = 0; i < in->count; i++) {
        line *last = in->at + kept - 1;
        if (kept == 0 || by_frequency(last, &in->at[i]) != 0) {
            in->at[kept++] = in->at[i];
            continue;
        }
        int is_mean = last->x == 0 && last->y == 0;
        mixed += last->term != in->at[i].term && !is_mean;
        last->real += in->at[i].real;
        last->imaginary += in->at[i].imaginary;
    }
    in->count = kept;
    return mixed;
}

// Lags of 500 units are 2000 turns of the fastest wave; lines below 1e-9 are left out.
static void test_the_covariance_is_the_sum_of_the_lines(void **state) {
    (void)state;
    bl_random random = bl_random_seed(41, 0);
    for (unsigned count = 1; count <= 7; count++) {
        lines all;
        char text[32];
        snprintf(text, sizeof text, "gardner:terms=%u", count);
        bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
        assert_true(bl_signal_has_closed_form(signal) && !bl_signal_has_density(signal));
        assert_int_equal(make_lines(count, &all), 0);
        for (int trial = 0; trial < 8; trial++) {
            double lag[BL_AXES] = {0}, sum = 0;
            for (int a = 0; a < 2; a++)
                lag[a] = trial ? (trial < 4 ? 10 : 500) * (2 * bl_random_unit(&random) - 1) : 0;
            for (size_t i = 0; i < all.count; i++) {
                const line *at = &all.at[i];
                double turns = (double)at->x * 1e-10 * lag[0] + (double)at->y * 1e-17 * lag[1];
                if (at->x != 0 || at->y != 0)
                    sum += (at->real * at->real + at->imaginary * at->imaginary) *
                           cos(2 * M_PI * turns);
            }
            assert_near(signal->functions->covariance(signal->parameters, lag), sum,
                        1e-10 * signal->facts.variance);
        }
        free(all.at);
        bl_signal_free(signal);
    }
}

// With the eighth term waves of different terms coincide. What is clamped away may bring it back.
static void test_it_is_stated_for_seven_terms(void **state) {
    (void)state;
    lines all;
    assert_true(make_lines(8, &all) > 0);
    free(all.at);
    bl_signal *signal = bl_test_open("gardner:terms=8", BL_ISA_BEST);
    assert_false(bl_signal_has_closed_form(signal));
    assert_true(isnan(signal->facts.variance));
    bl_signal_free(signal);
    signal = bl_test_open("gardner:terms=8,width=1", BL_ISA_BEST);
    assert_true(bl_signal_has_closed_form(signal) && signal->facts.variance > 0);
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_covariance_is_the_sum_of_the_lines),
        cmocka_unit_test(test_it_is_stated_for_seven_terms),
    };
    return bl_run_tests(tests);
}
