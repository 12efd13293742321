// SPDX-License-Identifier: MIT
//
// Every noise with every setting at the extremes: coordinates from 1e-30 to 1e18, cell boundaries,
// denormals, negative zero, NaN, infinity. The double references of value and gradient noise are
// held to MPFR with 300 bits, which knows no extremes between 1e-30 and 1e18.
#include "tests/test.h"

#include <mpfr.h>

#include "core/random.h"
#include "noises/lattice/lattice.h"
#include "tests/float_error.h"
#include "tests/texts.h"

enum { DECADES = 49, PLACES = 32, BITS = 300 }; // 1e-30 to 1e18

// A place of the size 10^decade, with a component of it on a cell boundary in every second one.
static void choose_place(bl_random *random, int decade, int index, double at[BL_AXES]) {
    double scale = pow(10, decade);
    for (int a = 0; a < BL_AXES; a++) {
        double size = scale * (1 + 3 * bl_random_unit(random));
        at[a] = bl_random_unit(random) < 0.5 ? -size : size;
        if (index % 2 && a == index / 2 % 4 && scale >= 1)
            at[a] = floor(at[a]);
    }
}

static double largest(const double at[BL_AXES]) {
    return fmax(fmax(fabs(at[0]), fabs(at[1])), fmax(fabs(at[2]), fabs(at[3])));
}

static void test_floats_keep_their_tolerance_from_1e_minus_30_to_1e18(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    for (size_t n = 0; n < list->count; n++) {
        bl_random random = bl_random_seed(31, bl_test_stream(list->text[n]));
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        double tolerance = bl_test_float_error(signal);
        double domain = bl_signal_domain(signal);
        for (int d = 0; d < DECADES; d++) {
            double at[PLACES][BL_AXES], column[BL_AXES][PLACES];
            float out[PLACES];
            for (int i = 0; i < PLACES; i++) {
                choose_place(&random, d - 30, i, at[i]);
                for (int a = 0; a < BL_AXES; a++)
                    column[a][i] = at[i][a];
            }
            bl_signal_points(signal, BL_COLUMNS(column), PLACES, out);
            for (int i = 0; i < PLACES; i++) {
                double expected = bl_signal_value(signal, at[i]);
                if (largest(at[i]) < domain && !(fabs((double)out[i] - expected) <= tolerance))
                    fail_msg("%s at (%.17g, %.17g, %.17g, %.17g): %.9g, reference %.9g",
                             list->text[n], at[i][0], at[i][1], at[i][2], at[i][3], (double)out[i],
                             expected);
            }
        }
        bl_signal_free(signal);
    }
}

// --- the places where arithmetic breaks ---------------------------------------------------------

// The value of one point by each of the three paths.
static void by_all_paths(const bl_signal *signal, const double at[BL_AXES], double out[3]) {
    const double step[BL_AXES] = {0};
    float row, point;
    bl_signal_row(signal, at, step, 1, &row);
    bl_signal_points(signal, (const double *const[]){&at[0], &at[1], &at[2], &at[3]}, 1, &point);
    out[0] = bl_signal_value(signal, at);
    out[1] = (double)row;
    out[2] = (double)point;
}

static void test_negative_zero_is_zero(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    for (size_t n = 0; n < list->count; n++) {
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        for (unsigned axis = 0; axis < signal->dimensions; axis++) {
            double plus[BL_AXES] = {0.3, 0.7, 1.1, 2.9}, minus[BL_AXES], a[3], b[3];
            plus[axis] = 0.0;
            memcpy(minus, plus, sizeof minus);
            minus[axis] = -0.0;
            by_all_paths(signal, plus, a);
            by_all_paths(signal, minus, b);
            for (int path = 0; path < 3; path++)
                if (a[path] != b[path])
                    fail_msg("%s: %g at 0 and %g at -0 along %c", list->text[n], a[path], b[path],
                             "xyzw"[axis]);
        }
        bl_signal_free(signal);
    }
}

// Fails unless all noises give at these places, along each axis, numbers within their domain, or
// else nothing but NaN.
static void expect_at(const double *places, size_t count, int numbers) {
    const bl_texts *list = bl_test_texts();
    for (size_t n = 0; n < list->count; n++) {
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        for (unsigned axis = 0; axis < signal->dimensions; axis++)
            for (size_t i = 0; i < count; i++) {
                double at[BL_AXES] = {0.3, 0.7, 1.1, 2.9}, value[3];
                at[axis] = places[i];
                by_all_paths(signal, at, value);
                if (numbers && !(fabs(places[i]) < bl_signal_domain(signal)))
                    continue;
                for (int path = 0; path < 3; path++)
                    if (numbers ? !isfinite(value[path]) : !isnan(value[path]))
                        fail_msg("%s: %g at %c = %.17g", list->text[n], value[path], "xyzw"[axis],
                                 places[i]);
            }
        bl_signal_free(signal);
    }
}

static void test_denormals_and_the_ends_of_integers_give_numbers(void **state) {
    (void)state;
    static const double places[] = {5e-324,
                                    -5e-324,
                                    2.2250738585072009e-308,
                                    -2.2250738585072009e-308,
                                    1e-300,
                                    0x1p-149,
                                    1 - 0x1p-53,
                                    -0x1p-54,
                                    0x1p31 - 0.5,
                                    -0x1p31 - 0.5,
                                    0x1p32 + 0.5,
                                    0x1p52 + 1,
                                    0x1p53,
                                    -0x1p53 - 2,
                                    0x1p61,
                                    -0x1p61,
                                    0x1.fffffffffffffp61,
                                    -0x1.fffffffffffffp61};
    expect_at(places, sizeof places / sizeof *places, 1);
}

static void test_what_is_no_place_gives_nan(void **state) {
    (void)state;
    static const double places[] = {NAN, -NAN, INFINITY, -INFINITY, 0x1p62, -0x1p63, 1e300};
    expect_at(places, sizeof places / sizeof *places, 0);
}

// --- against MPFR -------------------------------------------------------------------------------

// The kernels of MPFR_NOISES as functions of the distance, by their textbook formulas.
static void catmull_rom(mpfr_t out, const mpfr_t distance) {
    mpfr_t d;
    mpfr_init2(d, BITS);
    mpfr_abs(d, distance, MPFR_RNDN);
    const double *c = mpfr_cmp_ui(d, 1) < 0   ? (const double[]){1.5, -2.5, 0, 1}
                      : mpfr_cmp_ui(d, 2) < 0 ? (const double[]){-0.5, 2.5, -4, 2}
                                              : (const double[]){0, 0, 0, 0};
    mpfr_set_d(out, c[0], MPFR_RNDN);
    for (int i = 1; i < 4; i++) {
        mpfr_mul(out, out, d, MPFR_RNDN);
        mpfr_add_d(out, out, c[i], MPFR_RNDN);
    }
    mpfr_clear(d);
}

// 1 - fade(|d|) with the cubic fade.
static void cubic_weight(mpfr_t out, const mpfr_t distance) {
    mpfr_t d, part;
    mpfr_inits2(BITS, d, part, (mpfr_ptr)NULL);
    mpfr_abs(d, distance, MPFR_RNDN);
    mpfr_set_ui(out, 0, MPFR_RNDN);
    if (mpfr_cmp_ui(d, 1) < 0) {
        mpfr_mul_si(part, d, -2, MPFR_RNDN);
        mpfr_add_ui(part, part, 3, MPFR_RNDN);
        mpfr_mul(part, part, d, MPFR_RNDN);
        mpfr_mul(part, part, d, MPFR_RNDN);
        mpfr_ui_sub(out, 1, part, MPFR_RNDN);
    }
    mpfr_clears(d, part, (mpfr_ptr)NULL);
}

// The sum over the 4 x 4 x 4 lattice points around a place, whose distances are exact.
static double mpfr_noise(const bl_lattice *lattice, const double at[BL_AXES], int gradients) {
    mpfr_t sum, product, weight, distance[3];
    double cell[3], g[3] = {0};
    mpfr_inits2(BITS, sum, product, weight, distance[0], distance[1], distance[2], (mpfr_ptr)NULL);
    mpfr_set_ui(sum, 0, MPFR_RNDN);
    for (int i = 0; i < 64; i++) {
        uint64_t visited[3];
        for (int a = 0; a < 3; a++) {
            int offset = (i >> 2 * a & 3) - 1;
            cell[a] = floor(at[a]);
            visited[a] = (uint64_t)(int64_t)cell[a] + (uint64_t)(int64_t)offset;
            mpfr_set_d(distance[a], at[a], MPFR_RNDN);
            mpfr_sub_d(distance[a], distance[a], cell[a], MPFR_RNDN);
            mpfr_sub_si(distance[a], distance[a], offset, MPFR_RNDN);
        }
        uint32_t word = bl_lattice_word(lattice, visited, 0);
        bl_lattice_gradient(BL_GRADIENTS_SPHERE, word, g);
        mpfr_set_d(product, gradients ? 0 : (double)bl_lattice_value(word) * BL_LATTICE_UNIT,
                   MPFR_RNDN);
        for (int a = 0; a < 3 && gradients; a++) {
            mpfr_mul_d(weight, distance[a], g[a], MPFR_RNDN);
            mpfr_add(product, product, weight, MPFR_RNDN);
        }
        for (int a = 0; a < 3; a++) {
            (gradients ? cubic_weight : catmull_rom)(weight, distance[a]);
            mpfr_mul(product, product, weight, MPFR_RNDN);
        }
        mpfr_add(sum, sum, product, MPFR_RNDN);
    }
    double result = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clears(sum, product, weight, distance[0], distance[1], distance[2], (mpfr_ptr)NULL);
    return result;
}

static void test_the_references_are_exact_to_rounding(void **state) {
    (void)state;
    bl_random random = bl_random_seed(32, 0);
    bl_lattice lattice = bl_lattice_of(5, BL_LATTICE_HASH);
    for (int gradients = 0; gradients < 2; gradients++) {
        bl_signal *signal =
            bl_test_open(gradients ? "gnoise:seed=5" : "vnoise:seed=5", BL_ISA_BEST);
        for (int d = 0; d < DECADES; d++)
            for (int i = 0; i < 8; i++) {
                double at[BL_AXES];
                choose_place(&random, d - 30, i, at);
                double expected = mpfr_noise(&lattice, at, gradients);
                // 64 terms of size 1 with a few roundings each, and the fraction's: 2^-53 near 1,
                // where a place of -1e-20 is rounded to the end of its cell, times a slope of 4.
                assert_near(bl_signal_value(signal, at), expected, 64 * 0x1p-52);
            }
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_floats_keep_their_tolerance_from_1e_minus_30_to_1e18),
        cmocka_unit_test(test_negative_zero_is_zero),
        cmocka_unit_test(test_denormals_and_the_ends_of_integers_give_numbers),
        cmocka_unit_test(test_what_is_no_place_gives_nan),
        cmocka_unit_test(test_the_references_are_exact_to_rounding),
    };
    return bl_run_tests(tests);
}
