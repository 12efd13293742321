// SPDX-License-Identifier: MIT
//
// Sums of terms: covariance against the transform of the density, shares, and the facts.
#include "tests/test.h"

#include "tests/term_signals.h"

// R(lag) against the numeric 3-D transform of the density, on a grid of spacing 1/9 out to 4.5:
// the sum over a grid repeats R every 9 units, beyond its reach. The density is even in z.
static void test_covariance_is_the_transform_of_the_density(void **state) {
    (void)state;
    enum { HALF = 28 };
    const double lags[3][BL_AXES] = {{0, 0, 0}, {0.3, 0.7, -0.2}, {1.1, -0.4, 1.9}};
    for (int which = 0; which < SIGNALS; which++) {
        bl_signal *signal = make_signal(which);
        const bl_terms *terms = signal->parameters;
        double sum[3] = {0}, step = 1.0 / 9;
        for (int i = -HALF; i <= HALF; i++)
            for (int j = -HALF; j <= HALF; j++)
                for (int k = 0; k <= HALF; k++) {
                    double f[BL_AXES] = {i * step, j * step, k * step};
                    double p = bl_terms_density(terms, f) * (k ? 2 : 1) * step * step * step;
                    for (int l = 0; l < 3; l++)
                        sum[l] += p * cos(2 * M_PI * (f[0] * lags[l][0] + f[1] * lags[l][1])) *
                                  cos(2 * M_PI * f[2] * lags[l][2]);
                }
        double variance = bl_terms_variance(terms);
        for (int l = 0; l < 3; l++) {
            double covariance = bl_terms_covariance(terms, lags[l]);
            assert_near(sum[l] / variance, covariance / variance, 1e-3);
        }
        bl_signal_free(signal);
    }
}

static void test_the_share_above_zero_is_all_and_falls(void **state) {
    (void)state;
    for (int which = 0; which < SIGNALS; which++) {
        bl_signal *signal = make_signal(which);
        const bl_terms *terms = signal->parameters;
        assert_near(bl_terms_share_above(terms, 0), 1, 1e-15);
        double last = 1;
        for (double f = 0.1; f < 8; f += 0.1) {
            double share = bl_terms_share_above(terms, f);
            assert_true(share <= last + 1e-15 && share > 0);
            last = share;
        }
        bl_signal_free(signal);
    }
}

// What is stated follows the settings: all of it where the closed form holds, else only the mean.
static void test_facts_are_stated_only_where_they_hold(void **state) {
    (void)state;
    bl_terms terms = {0};
    bl_terms_add_value(&terms, BL_VALUE_VARIANCE(1 << 20), BL_KERNEL_LINEAR);
    bl_facts facts = bl_facts_unknown();
    bl_terms_describe(&terms, 0, &(bl_lattice_settings){0}, &facts);
    assert_true(facts.mean == 0 && isnan(facts.variance) && isnan(facts.leak_db));
    bl_terms_describe(&terms, 1, &(bl_lattice_settings){0}, &facts);
    assert_near(facts.variance, pow(2.0 / 3, 3) / 3, 1e-12); // rho(0) = 2/3
    double share = 10 * log10(bl_terms_share_above(&terms, 1));
    assert_true(facts.leak_db >= share && facts.leak_db < share + 0.0101);
    assert_near(facts.covariance_reach, 2, 0);
}

static void test_scaled_terms_add_squares(void **state) {
    (void)state;
    bl_terms value = {0}, sum = {0};
    bl_terms_add_value(&value, 0.25, BL_KERNEL_SMOOTH);
    bl_terms_add_scaled(&sum, &value, 3);
    bl_terms_add_scaled(&sum, &value, -4);
    assert_near(bl_terms_variance(&sum), 25 * bl_terms_variance(&value), 1e-14);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_covariance_is_the_transform_of_the_density),
        cmocka_unit_test(test_the_share_above_zero_is_all_and_falls),
        cmocka_unit_test(test_facts_are_stated_only_where_they_hold),
        cmocka_unit_test(test_scaled_terms_add_squares),
    };
    return bl_run_tests(tests);
}
