// SPDX-License-Identifier: MIT
//
// Windows against their definitions, and their closed-form correlations against plain sums.
#include "tests/test.h"

#include "spectra/window.h"

static const size_t sizes[] = {8, 9, 11, 13, 64, 101, 2048};
enum { SIZES = sizeof sizes / sizeof *sizes };

static void test_windows_are_periodic_and_symmetric(void **state) {
    (void)state;
    double w[2048];
    for (int window = 0; window < BL_WINDOW_COUNT; window++)
        for (size_t s = 0; s < SIZES; s++) {
            bl_window_fill((bl_window)window, sizes[s], w);
            for (size_t n = 1; n < sizes[s]; n++)
                assert_true(w[n] == w[sizes[s] - n] && w[n] > -1e-15 && w[n] <= 1 + 1e-15);
        }
    bl_window_fill(BL_WINDOW_BLACKMAN_HARRIS, 2048, w);
    assert_near(w[0], 0.00006, 1e-12); // Harris 1978: the pedestal
    assert_near(w[1024], 1, 1e-12);
    assert_near(w[512], 0.35875 - 0.14128, 1e-12);
    bl_window_fill(BL_WINDOW_HANN, 8, w);
    assert_near(w[0], 0, 1e-16);
    assert_near(w[2], 0.5, 1e-15);
}

// The equivalent noise bandwidths of Harris 1978, table 1.
static void test_noise_bandwidths_are_those_of_harris(void **state) {
    (void)state;
    const double expected[BL_WINDOW_COUNT] = {2.0044, 1.5, 1.0};
    double w[2048];
    for (int window = 0; window < BL_WINDOW_COUNT; window++) {
        double sum = 0, square = 0;
        bl_window_fill((bl_window)window, 2048, w);
        for (int n = 0; n < 2048; n++) {
            sum += w[n];
            square += w[n] * w[n];
        }
        assert_near(2048 * square / (sum * sum), expected[window], 5e-4);
    }
}

// Between bins, with the transform written out: below -92 dB outside of the main lobe.
static void test_blackman_harris_side_lobes_stay_below_92_db(void **state) {
    (void)state;
    enum { N = 256 };
    double w[N], sum = 0, highest = 0;
    bl_window_fill(BL_WINDOW_BLACKMAN_HARRIS, N, w);
    for (int n = 0; n < N; n++)
        sum += w[n];
    for (double f = bl_window_half_lobe(BL_WINDOW_BLACKMAN_HARRIS); f < N / 2; f += 0.1) {
        double re = 0, im = 0;
        for (int n = 0; n < N; n++) {
            re += w[n] * cos(2 * M_PI * f * n / N);
            im += w[n] * sin(2 * M_PI * f * n / N);
        }
        highest = fmax(highest, (re * re + im * im) / (sum * sum));
    }
    assert_less(10 * log10(highest), -91.9);
}

static void test_correlation_between_bins_is_the_plain_sum(void **state) {
    (void)state;
    double w[2048];
    for (int window = 0; window < BL_WINDOW_COUNT; window++)
        for (size_t s = 0; s < SIZES; s++)
            for (size_t offset = 0; offset < 9; offset++) {
                double re = 0, im = 0, sum = 0;
                bl_window_fill((bl_window)window, sizes[s], w);
                for (size_t n = 0; n < sizes[s]; n++) {
                    double phase = 2 * M_PI * (double)(n * offset) / (double)sizes[s];
                    re += w[n] * w[n] * cos(phase);
                    im += w[n] * w[n] * sin(phase);
                    sum += w[n] * w[n];
                }
                assert_near(bl_window_correlation((bl_window)window, sizes[s], offset),
                            (re * re + im * im) / (sum * sum), 1e-12);
            }
}

// Hann at half overlap: (1/6)^2 (Welch 1967); a rectangle's is the square of its overlap.
static void test_overlap_is_that_of_welch(void **state) {
    (void)state;
    assert_near(bl_window_overlap(BL_WINDOW_HANN, 1024, 512), 1.0 / 36, 1e-12);
    assert_near(bl_window_overlap(BL_WINDOW_RECTANGLE, 1024, 256), 0.5625, 1e-12);
    assert_near(bl_window_overlap(BL_WINDOW_BLACKMAN_HARRIS, 64, 0), 1, 1e-12);
    assert_near(bl_window_overlap(BL_WINDOW_BLACKMAN_HARRIS, 64, 64), 0, 0);
}

static void test_names_are_read_back_and_typos_are_answered(void **state) {
    (void)state;
    bl_message message;
    bl_window window;
    for (int i = 0; i < BL_WINDOW_COUNT; i++) {
        assert_int_equal(bl_window_read(bl_window_name((bl_window)i), &window, &message), BL_OK);
        assert_int_equal(window, i);
    }
    assert_int_equal(bl_window_read("han", &window, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "did you mean 'hann'"));
    assert_string_equal(bl_window_name(BL_WINDOW_COUNT), "unknown");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_windows_are_periodic_and_symmetric),
        cmocka_unit_test(test_noise_bandwidths_are_those_of_harris),
        cmocka_unit_test(test_blackman_harris_side_lobes_stay_below_92_db),
        cmocka_unit_test(test_correlation_between_bins_is_the_plain_sum),
        cmocka_unit_test(test_overlap_is_that_of_welch),
        cmocka_unit_test(test_names_are_read_back_and_typos_are_answered),
    };
    return bl_run_tests(tests);
}
