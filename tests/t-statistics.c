// SPDX-License-Identifier: MIT
//
// Distributions against GSL, intervals against simulation.
#include "tests/test.h"

#include <gsl/gsl_cdf.h>

#include "core/random.h"
#include "core/statistics.h"

static const double probabilities[] = {1e-12, 1e-6, 0.001, 0.025, 0.3, 0.5, 0.7, 0.975, 1 - 1e-6};
enum { PROBABILITIES = sizeof probabilities / sizeof *probabilities };

static void test_normal_quantiles_agree_with_gsl(void **state) {
    (void)state;
    for (int i = 0; i < PROBABILITIES; i++) {
        double expected = gsl_cdf_ugaussian_Pinv(probabilities[i]);
        assert_near(bl_normal_quantile(probabilities[i]), expected, 1e-9 * (1 + fabs(expected)));
        assert_near(bl_normal_cdf(bl_normal_quantile(probabilities[i])), probabilities[i],
                    1e-14 + 1e-13 * probabilities[i]);
    }
    assert_true(isinf(bl_normal_quantile(0)) && isinf(bl_normal_quantile(1)));
    assert_true(isnan(bl_normal_quantile(-0.1)) && isnan(bl_normal_quantile(NAN)));
}

// GSL's distribution at our quantile must give the probability back: its own inverses do not
// converge at the ends.
static double allowed(double p) {
    return 1e-13 + 1e-9 * (p < 0.5 ? p : 1 - p);
}

static void test_chi_square_quantiles_are_undone_by_gsl(void **state) {
    (void)state;
    const double nus[] = {0.7, 1, 2, 5.5, 30, 512, 4096, 1e5};
    for (size_t n = 0; n < sizeof nus / sizeof *nus; n++)
        for (int i = 0; i < PROBABILITIES; i++) {
            double p = probabilities[i], quantile = bl_chi_square_quantile(p, nus[n]);
            assert_near(gsl_cdf_chisq_P(quantile, nus[n]), p, allowed(p));
        }
    assert_true(isnan(bl_chi_square_quantile(0.5, 0)) && isnan(bl_chi_square_cdf(NAN, 1)));
    assert_true(bl_chi_square_quantile(0, 3) == 0 && isinf(bl_chi_square_quantile(1, 3)));
}

static void test_student_quantiles_are_undone_by_gsl(void **state) {
    (void)state;
    const double nus[] = {1, 2, 7, 15, 255, 1e4};
    for (size_t n = 0; n < sizeof nus / sizeof *nus; n++)
        for (int i = 0; i < PROBABILITIES; i++) {
            double p = probabilities[i], quantile = bl_student_quantile(p, nus[n]);
            assert_near(gsl_cdf_tdist_P(quantile, nus[n]), p, allowed(p));
        }
}

static void test_moments_do_not_depend_on_how_they_are_merged(void **state) {
    (void)state;
    bl_random random = bl_random_seed(3, 1);
    bl_moments whole = {0}, parts[7] = {{0}}, merged = {0};
    enum { COUNT = 5000 };
    double values[COUNT], sum[5] = {0};
    for (int i = 0; i < COUNT; i++) {
        values[i] =
            100 + bl_random_normal(&random) + (i % 5 == 0 ? 4 * bl_random_unit(&random) : 0);
        bl_moments_add(&whole, values[i]);
        bl_moments_add(&parts[i % 7], values[i]);
        sum[1] += values[i] / COUNT;
    }
    for (int p = 0; p < 7; p++)
        bl_moments_merge(&merged, &parts[p]);
    for (int i = 0; i < COUNT; i++)
        for (int k = 2; k < 5; k++)
            sum[k] += pow(values[i] - sum[1], k) / COUNT;
    const bl_moments *both[] = {&whole, &merged};
    for (int b = 0; b < 2; b++) {
        assert_near(both[b]->mean, sum[1], 1e-11);
        assert_near(bl_moments_variance(both[b]), sum[2] * COUNT / (COUNT - 1), 1e-10);
        assert_near(bl_moments_skewness(both[b]), sum[3] / pow(sum[2], 1.5), 1e-9);
        assert_near(bl_moments_kurtosis(both[b]), sum[4] / (sum[2] * sum[2]), 1e-9);
    }
}

// The share of intervals that hold the truth, over repeats, must be the level: a binomial count
// beyond 6 standard deviations would be a chance of 2e-9.
static void test_intervals_cover_the_truth_at_their_level(void **state) {
    (void)state;
    enum { SAMPLES = 30 };
    size_t repeats = bl_test_scaled(20000, 2000), mean_hits = 0, ratio_hits = 0;
    bl_random random = bl_random_seed(5, 5);
    for (size_t r = 0; r < repeats; r++) {
        double a[SAMPLES], b[SAMPLES];
        for (int i = 0; i < SAMPLES; i++) {
            b[i] = 10 + bl_random_normal(&random);
            a[i] = 0.3 * b[i] + 0.5 * bl_random_normal(&random);
        }
        bl_estimate mean = bl_mean_estimate(b, SAMPLES, 0.95);
        bl_estimate ratio = bl_ratio_estimate(a, b, SAMPLES, 0.95);
        mean_hits += mean.lower <= 10 && 10 <= mean.upper;
        ratio_hits += ratio.lower <= 0.3 && 0.3 <= ratio.upper;
    }
    double limit = 6 * sqrt(0.95 * 0.05 / (double)repeats);
    assert_near((double)mean_hits / (double)repeats, 0.95, limit);
    // The ratio is exact only to first order; 0.005 allows for the second.
    assert_near((double)ratio_hits / (double)repeats, 0.95, limit + 0.005);
}

// 1e-20 has no level that is a double below 1. The t-distribution gives the probability back.
static void test_an_interval_may_miss_less_than_a_level_can_say(void **state) {
    (void)state;
    enum { MOST = 25 }; // beyond 30 degrees of freedom GSL takes an approximation
    static const double all_missed[] = {0.05, 1e-9, 1e-15, 1e-20, 1e-60};
    double a[MOST], b[MOST];
    bl_random random = bl_random_seed(5, 6);
    for (int i = 0; i < MOST; i++) {
        a[i] = 3 + bl_random_normal(&random);
        b[i] = 1; // so that the ratio is the mean
    }
    for (size_t n = 5; n <= MOST; n += 20)
        for (size_t i = 0; i < sizeof all_missed / sizeof *all_missed; i++) {
            double missed = all_missed[i], mean = 0, square = 0;
            for (size_t k = 0; k < n; k++)
                mean += a[k] / (double)n;
            for (size_t k = 0; k < n; k++)
                square += (a[k] - mean) * (a[k] - mean) / (double)(n - 1);
            double error = sqrt(square / (double)n);
            const bl_estimate both[] = {bl_mean_estimate_missing(a, n, missed),
                                        bl_ratio_estimate_missing(a, b, n, missed)};
            for (int e = 0; e < 2; e++) {
                double t = (both[e].upper - both[e].value) / error;
                assert_near(2 * gsl_cdf_tdist_Q(t, (double)n - 1) / missed, 1, 1e-8);
                assert_near(both[e].value - both[e].lower, t * error, 1e-12 * t);
            }
        }
    // The two ways to say it agree.
    bl_estimate level = bl_mean_estimate(a, MOST, 0.95),
                missing = bl_mean_estimate_missing(a, MOST, 0.05);
    assert_near(level.upper, missing.upper, 1e-12);
    assert_true(level.level == 0.95);
}

static void test_one_value_has_no_interval(void **state) {
    (void)state;
    double one = 4;
    bl_estimate estimate = bl_mean_estimate(&one, 1, 0.95);
    assert_true(estimate.value == 4 && isnan(estimate.lower) && isnan(estimate.upper));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_normal_quantiles_agree_with_gsl),
        cmocka_unit_test(test_chi_square_quantiles_are_undone_by_gsl),
        cmocka_unit_test(test_student_quantiles_are_undone_by_gsl),
        cmocka_unit_test(test_moments_do_not_depend_on_how_they_are_merged),
        cmocka_unit_test(test_intervals_cover_the_truth_at_their_level),
        cmocka_unit_test(test_an_interval_may_miss_less_than_a_level_can_say),
        cmocka_unit_test(test_one_value_has_no_interval),
    };
    return bl_run_tests(tests);
}
