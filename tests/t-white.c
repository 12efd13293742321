// SPDX-License-Identifier: MIT
//
// What the walkers do not hold of white noise: that it is white however it is sampled (moments,
// neighbours in place and in bits, a flat spectrum), that it is flat in its cells, and the two
// sides of the closed form of cell=h.
//
// Error rates: each statistical test fails a true noise with probability 1e-6, all its comparisons
// together; the seeds are fixed.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "tests/texts.h"

#define ERROR_RATE 1e-6

// Sums of values, of squares and of products with neighbours, in standard errors: of independent
// values uniform in (-1, 1) these have the variances 1/3, 4/45 and 1/9.
static void test_samples_at_any_spacing_are_uncorrelated(void **state) {
    (void)state;
    enum { COUNT = 1 << 16 };
    static const double spacings[] = {1, 0.1, 0x1p-20, 1e-12, 1e9};
    enum { SPACINGS = sizeof spacings / sizeof *spacings, COMPARED = 8 };
    static float here[COUNT], aside[COUNT], other_seed[COUNT];
    double limit = -bl_normal_quantile(ERROR_RATE / (2 * SPACINGS * COMPARED));
    bl_signal *signal = bl_test_open("white:seed=1", BL_ISA_BEST),
              *other = bl_test_open("white:seed=2", BL_ISA_BEST);
    for (int n = 0; n < SPACINGS; n++) {
        const double s = spacings[n], start[BL_AXES] = {1, 2, 3, 0}, step[BL_AXES] = {s};
        const double next[BL_AXES] = {1, 2 + s, 3, 0};
        double sums[COMPARED] = {0};
        static const double variances[COMPARED] = {1.0 / 3,  1.0 / 9, 1.0 / 9, 1.0 / 9,
                                                   4.0 / 45, 1.0 / 9, 1.0 / 9, 1.0 / 9};
        bl_signal_row(signal, start, step, COUNT, here);
        bl_signal_row(signal, next, step, COUNT, aside);
        bl_signal_row(other, start, step, COUNT, other_seed);
        for (size_t i = 0; i < COUNT; i++) {
            double v = here[i];
            sums[0] += v;
            sums[1] += v * here[(i + 1) % COUNT];
            sums[2] += v * here[(i + 2) % COUNT];
            sums[3] += v * here[(i + 64) % COUNT];
            sums[4] += v * v - 1.0 / 3;
            sums[5] += v * aside[i];
            sums[6] += v * aside[(i + 1) % COUNT];
            sums[7] += v * other_seed[i];
        }
        for (int k = 0; k < COMPARED; k++)
            if (!(fabs(sums[k]) < limit * sqrt(variances[k] * COUNT)))
                fail_msg("spacing %g, sum %d: %g standard errors", s, k,
                         sums[k] / sqrt(variances[k] * COUNT));
    }
    bl_signal_free(signal);
    bl_signal_free(other);
}

// Each bit of a coordinate, the sign too, makes another number; the product with the number before
// is as that of independent ones.
static void test_every_bit_of_a_coordinate_counts(void **state) {
    (void)state;
    enum { TRIALS = 512, TOP = 62 }; // of the exponent: it would make a NaN
    double limit = -bl_normal_quantile(ERROR_RATE / (2 * 4 * 64));
    bl_signal *signal = bl_test_open("white:dims=4", BL_ISA_BEST);
    bl_random random = bl_random_seed(1, 0);
    for (int axis = 0; axis < BL_AXES; axis++)
        for (int bit = 0; bit < 64; bit++) {
            double sum = 0;
            if (bit == TOP)
                continue;
            for (int trial = 0; trial < TRIALS; trial++) {
                double at[BL_AXES], before;
                uint64_t bits;
                for (int a = 0; a < BL_AXES; a++)
                    at[a] = 1 + bl_random_unit(&random);
                before = bl_signal_value(signal, at);
                memcpy(&bits, &at[axis], sizeof bits);
                bits ^= UINT64_C(1) << bit;
                memcpy(&at[axis], &bits, sizeof bits);
                double after = bl_signal_value(signal, at);
                assert_true(isfinite(after));
                sum += before * after;
            }
            if (!(fabs(sum) < limit * sqrt(TRIALS / 9.0)))
                fail_msg("axis %d, bit %d: correlation %g", axis, bit, 3 * sum / TRIALS);
        }
    bl_signal_free(signal);
}

static void test_zero_has_one_value(void **state) {
    (void)state;
    static const char *const texts[] = {"white", "white:dims=1", "white:cell=0.5"};
    for (int t = 0; t < 3; t++) {
        bl_signal *signal = bl_test_open(texts[t], BL_ISA_BEST);
        double plus = bl_signal_value(signal, (const double[BL_AXES]){0, 0.5, 0});
        double minus = bl_signal_value(signal, (const double[BL_AXES]){-0.0, 0.5, -0.0});
        assert_near(minus, plus, 0);
        float row[2];
        bl_signal_row(signal, (const double[BL_AXES]){-0.0, 0.5, -0.0}, (const double[BL_AXES]){0},
                      2, row);
        assert_near(row[0], plus, 0);
        assert_near(row[1], plus, 0);
        bl_signal_free(signal);
    }
}

// The distribution over 64 equal intervals, by chi-square.
static void test_the_distribution_is_uniform(void **state) {
    (void)state;
    enum { COUNT = 1 << 16, BINS = 64 };
    static float out[COUNT];
    double found[BINS] = {0}, square = 0;
    bl_signal *signal = bl_test_open("white:seed=9,dims=2", BL_ISA_BEST);
    bl_signal_row(signal, (const double[BL_AXES]){0.5, 0.5}, (const double[BL_AXES]){0.25, 0.5},
                  COUNT, out);
    for (size_t i = 0; i < COUNT; i++)
        found[(int)((out[i] + 1) * (BINS / 2))]++;
    for (int b = 0; b < BINS; b++)
        square += (found[b] - COUNT / BINS) * (found[b] - COUNT / BINS) / (COUNT / BINS);
    assert_less(square, bl_chi_square_quantile(1 - ERROR_RATE, BINS - 1));
    bl_signal_free(signal);
}

// Odd multiples of 2^-20 in (-1, 1) have the mean square (1 - 2^-40)/3; the first zero of the
// spectrum of a cell of side h stands at 1/h.
static void test_variance_and_band_are_stated(void **state) {
    (void)state;
    static const double cells[] = {0, 0.125, 1, 3};
    for (int n = 0; n < 4; n++) {
        char text[32];
        snprintf(text, sizeof text, "white:cell=%g", cells[n]);
        bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
        assert_near(signal->facts.variance, (1 - 0x1p-40) / 3, 1e-15);
        if (n > 0) {
            assert_near(signal->facts.band_to, 1 / cells[n], 1e-15);
            const double zero[BL_AXES] = {signal->facts.band_to};
            assert_near(signal->functions->density(signal->parameters, zero), 0, 1e-30);
        }
        bl_signal_free(signal);
    }
}

static void test_a_cell_has_one_value_and_its_neighbour_another(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open("white:cell=0.25", BL_ISA_BEST);
    bl_random random = bl_random_seed(2, 0);
    for (int trial = 0; trial < 200; trial++) {
        double corner[BL_AXES] = {0}, inside[BL_AXES] = {0}, beyond[BL_AXES];
        for (int a = 0; a < 3; a++) {
            corner[a] = floor(200 * bl_random_unit(&random) - 100) * 0.25;
            inside[a] = corner[a] + 0.25 * bl_random_unit(&random);
        }
        memcpy(beyond, corner, sizeof beyond);
        beyond[trial % 3] = nextafter(corner[trial % 3], -INFINITY);
        double value = bl_signal_value(signal, corner);
        assert_near(bl_signal_value(signal, inside), value, 0);
        assert_true(bl_signal_value(signal, beyond) != value);
    }
    bl_signal_free(signal);
}

// The covariance is the transform of the density; in one dimension, by a sum over frequencies.
static void test_the_two_sides_of_the_closed_form_agree(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open("white:cell=0.5,dims=1", BL_ISA_BEST);
    const bl_signal_functions *functions = signal->functions;
    for (double lag = 0; lag < 0.7; lag += 0.1) {
        double sum = 0;
        const double df = 1 / 8.0; // lags are told apart up to 8
        for (int k = -80000; k <= 80000; k++) {
            double f = k * df;
            sum += df * cos(2 * M_PI * f * lag) *
                   functions->density(signal->parameters, (const double[BL_AXES]){f});
        }
        double expected = functions->covariance(signal->parameters, (const double[BL_AXES]){lag});
        // sinc^2 leaves 1/(pi^2 h F) of the variance beyond F = 10^4.
        assert_near(sum, expected, 1e-5);
    }
    bl_signal_free(signal);
}

static void test_cells_too_small_are_refused(void **state) {
    (void)state;
    bl_signal *signal = NULL;
    bl_message message = {""};
    assert_int_equal(bl_noise_open("white:cell=1e-13", BL_ISA_BEST, &signal, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "cell"));
    assert_null(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samples_at_any_spacing_are_uncorrelated),
        cmocka_unit_test(test_every_bit_of_a_coordinate_counts),
        cmocka_unit_test(test_zero_has_one_value),
        cmocka_unit_test(test_the_distribution_is_uniform),
        cmocka_unit_test(test_variance_and_band_are_stated),
        cmocka_unit_test(test_a_cell_has_one_value_and_its_neighbour_another),
        cmocka_unit_test(test_the_two_sides_of_the_closed_form_agree),
        cmocka_unit_test(test_cells_too_small_are_refused),
    };
    return bl_run_tests(tests);
}
