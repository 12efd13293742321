// SPDX-License-Identifier: MIT
//
// Autocovariances against the sum written out and against closed forms.
#include "tests/temporary.h"
#include "tests/test.h"

#include "spectra/autocorrelation.h"
#include "tests/test_signals.h"

static bl_autocorrelation measure(const bl_signal *signal, const bl_psd_settings *settings,
                                  double reach) {
    bl_autocorrelation a;
    bl_message message = {""};
    if (bl_autocorrelation_measure(signal, settings, reach, &a, &message) != BL_OK)
        fail_msg("%s", message.text);
    return a;
}

// One line of an image, all pairs by hand, for even, odd and prime lengths.
static void test_it_is_the_sum_over_all_pairs(void **state) {
    (void)state;
    const size_t sizes[] = {8, 9, 31, 64, 100};
    for (size_t i = 0; i < 5; i++) {
        size_t n = sizes[i];
        bl_signal *image = bl_test_white_image(i, n, 0, 0.5);
        bl_psd_settings settings = bl_psd_default_settings(1);
        settings.size = n;
        bl_autocorrelation a = measure(image, &settings, 0);
        assert_true(a.count == n / 2 + 1 && a.settings.averages == 1);
        double x[100], mean = 0;
        for (size_t j = 0; j < n; j++) {
            x[j] = (double)(float)bl_signal_value(image, (double[BL_AXES]){0.5 * (double)j});
            mean += x[j] / (double)n;
        }
        assert_near(a.mean, mean, 1e-12);
        for (size_t m = 0; m < a.count; m++) {
            double sum = 0;
            for (size_t j = 0; j + m < n; j++)
                sum += (x[j] - mean) * (x[j + m] - mean);
            assert_near(a.covariance[m].value, sum / (double)(n - m), 1e-12);
            assert_near(a.lag[m], 0.5 * (double)m, 0);
        }
        bl_autocorrelation_free(&a);
        bl_signal_free(image);
    }
}

// The hat's cubic B-spline within five standard errors at every lag (81 correlated ones: fails a
// right program less than once in 10^4 seeds).
static void test_the_closed_form_is_met(void **state) {
    (void)state;
    bl_signal *hat = bl_test_hat(1);
    bl_psd_settings settings = bl_psd_default_settings(1);
    settings.size = 512;
    settings.averages = 200;
    bl_autocorrelation a = measure(hat, &settings, 5);
    assert_true(a.count == 81 && a.theory != NULL);
    for (size_t m = 0; m < a.count; m++) {
        double error = (a.covariance[m].upper - a.covariance[m].value) / 1.97; // Student, 199
        assert_true(error > 0 && error < 0.05);
        assert_near(a.covariance[m].value, a.theory[m], 5 * error);
    }
    assert_near(a.theory[0], 2.0 / 3, 1e-15);
    assert_near(a.theory[16], 1.0 / 6, 1e-15);
    assert_near(a.theory[40], 0, 0);
    settings.place = BL_PLACE_LATTICE;
    bl_autocorrelation edge = measure(hat, &settings, 5);
    assert_null(edge.theory);
    bl_autocorrelation_free(&a);
    bl_autocorrelation_free(&edge);
    bl_signal_free(hat);
}

static void test_threads_do_not_change_a_bit(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(3);
    bl_psd_settings settings = bl_psd_default_settings(1);
    settings.averages = 17;
    settings.threads = 1;
    bl_autocorrelation one = measure(white, &settings, 0);
    settings.threads = 4;
    bl_autocorrelation many = measure(white, &settings, 0);
    assert_memory_equal(one.covariance, many.covariance, one.count * sizeof *one.covariance);
    bl_autocorrelation_free(&one);
    bl_autocorrelation_free(&many);
    bl_signal_free(white);
}

static void test_a_constant_and_a_broken_signal(void **state) {
    (void)state;
    bl_signal *constant = bl_test_constant(0.1), *broken = bl_test_broken();
    bl_psd_settings settings = bl_psd_default_settings(1);
    settings.size = 64;
    bl_autocorrelation a = measure(constant, &settings, 0);
    for (size_t m = 0; m < a.count; m++)
        assert_true(a.covariance[m].value == 0);
    bl_autocorrelation_free(&a);
    bl_message message;
    assert_int_equal(bl_autocorrelation_measure(broken, &settings, 0, &a, &message), BL_MISMATCH);
    assert_int_equal(bl_autocorrelation_measure(constant, &settings, NAN, &a, &message), BL_USAGE);
    assert_int_equal(bl_autocorrelation_measure(constant, &settings, -1, &a, &message), BL_USAGE);
    settings.size = (size_t)1 << 50;
    assert_int_equal(bl_autocorrelation_measure(constant, &settings, 0, &a, &message), BL_MISMATCH);
    bl_signal_free(constant);
    bl_signal_free(broken);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_it_is_the_sum_over_all_pairs),
        cmocka_unit_test(test_the_closed_form_is_met),
        cmocka_unit_test(test_threads_do_not_change_a_bit),
        cmocka_unit_test(test_a_constant_and_a_broken_signal),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, bl_temporary_no_wisdom, NULL);
}
