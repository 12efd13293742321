// SPDX-License-Identifier: MIT
//
// Distributions of signals whose distribution is known.
//
// Error rate of the coverage tests: 1e-4 each (3.9 standard deviations of the binomial). Means and
// variances have Student's intervals over blocks, which cover 95 %. Quantiles have less to hold:
// the number of independent samples is found from the blocks and never above n, so that independent
// samples get at least the exact interval, and in half of the cases a wider one, up to (95 + 100)/2
// = 97.5 %; where it is below n, 63 degrees of freedom stand behind it: P(|t63| < 1.96) = 94.5 %.
#include "tests/test.h"

#include "core/hash.h"
#include "core/statistics.h"
#include "spectra/histogram.h"
#include "tests/sources.h"
#include "tests/test_signals.h"

static bl_histogram measure(const bl_signal *signal, const bl_histogram_settings *settings) {
    bl_histogram histogram;
    bl_message message = {""};
    if (bl_histogram_measure(signal, settings, &histogram, &message) != BL_OK)
        fail_msg("%s", message.text);
    return histogram;
}

static void test_white_noise_is_standard_normal(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1);
    bl_histogram_settings settings = bl_histogram_default_settings();
    settings.samples = 300001; // no multiple of anything
    bl_histogram h = measure(white, &settings);
    assert_true(h.count == 300001 && h.outside == 0);
    assert_near(h.mean.value, 0, 5 / sqrt(300001));
    assert_near(h.variance.value, 1, 5 * sqrt(2.0 / 300001));
    assert_near(bl_moments_skewness(&h.moments), 0, 5 * sqrt(6.0 / 300001));
    assert_near(bl_moments_kurtosis(&h.moments), 3, 5 * sqrt(24.0 / 300001));
    size_t sum = 0;
    for (size_t bin = 0; bin < h.settings.bins; bin++) {
        double p = bl_normal_cdf(h.edges[bin + 1]) - bl_normal_cdf(h.edges[bin]);
        assert_near((double)h.counts[bin], 300001 * p, 6 * sqrt(300001 * p) + 3);
        sum += h.counts[bin];
    }
    assert_true(sum == h.count);
    for (int q = 0; q < BL_QUANTILES; q++) {
        double p = h.quantile_p[q], x = bl_normal_quantile(p);
        double density = exp(-0.5 * x * x) / sqrt(2 * M_PI);
        double sigma = sqrt(p * (1 - p) / 300001) / density;
        assert_near(h.quantile[q].value, x, 5 * sigma);
        assert_true(h.quantile[q].lower <= h.quantile[q].value);
        assert_true(h.quantile[q].upper >= h.quantile[q].value);
        assert_near((h.quantile[q].upper - h.quantile[q].lower) / (2 * 1.96 * sigma), 1, 0.4);
    }
    assert_true(h.edges[0] == h.minimum && h.edges[h.settings.bins] == h.maximum);
    bl_histogram_free(&h);
    bl_signal_free(white);
}

// Block b of a signal off a grid is the signal with the seed bl_stream(seed, 2b + 1): there the
// extremes stand where they say, in the one block that has them.
static void expect_at(const bl_signal *signal, const bl_histogram *h, const double at[BL_AXES],
                      double expected) {
    int found = 0;
    const double *const places[BL_AXES] = {&at[0], &at[1], &at[2], &at[3]};
    for (uint64_t block = 0; block < 3; block++) {
        bl_signal *fresh = bl_signal_reseed(signal, bl_stream(h->settings.seed, 2 * block + 1));
        float value;
        bl_signal_points(fresh, places, 1, &value);
        found += (double)value == expected;
        bl_signal_free(fresh);
    }
    assert_int_equal(found, 1);
}

static void test_extremes_of_noises_stand_where_they_say(void **state) {
    (void)state;
    static const char *const names[] = {"gnoise", "vnoise", "vcnoise", "scnoise"};
    for (int i = 0; i < 5; i++) {
        bl_signal *signal = i == 4 ? bl_test_white(1) : bl_test_open_source(names[i]);
        bl_histogram_settings settings = bl_histogram_default_settings();
        settings.samples = 3 * 4096; // three blocks
        bl_histogram h = measure(signal, &settings);
        expect_at(signal, &h, h.minimum_at, h.minimum);
        expect_at(signal, &h, h.maximum_at, h.maximum);
        bl_histogram_free(&h);
        bl_signal_free(signal);
    }
}

static void cover(const bl_signal *signal, size_t samples, double trials) {
    const double least = signal ? 0.95 : 0.945, most = 0.975;
    double mean = 0, variance = 0, median = 0, tail = 0;
    for (uint64_t r = 0; r < (uint64_t)trials; r++) {
        bl_signal *image = signal ? NULL : bl_test_streaky_image(r, 96, 96, 3);
        bl_histogram_settings settings = bl_histogram_default_settings();
        settings.samples = samples;
        settings.seed = r;
        settings.threads = 1;
        bl_histogram h = measure(signal ? signal : image, &settings);
        mean += h.mean.lower <= 0 && 0 <= h.mean.upper;
        variance += h.variance.lower <= 1 && 1 <= h.variance.upper;
        median += h.quantile[4].lower <= 0 && 0 <= h.quantile[4].upper;
        double x = bl_normal_quantile(h.quantile_p[7]);
        tail += h.quantile[7].lower <= x && x <= h.quantile[7].upper;
        bl_histogram_free(&h);
        bl_signal_free(image);
    }
    double reach = 3.9 * sqrt(0.05 * 0.95 / trials);
    if (getenv("BL_TEST_VERBOSE"))
        printf("mean %.4f, variance %.4f, median %.4f, tail %.4f, reach %.4f\n", mean / trials,
               variance / trials, median / trials, tail / trials, reach);
    assert_near(mean / trials, 0.95, reach);
    assert_near(variance / trials, 0.95, reach);
    assert_true(median / trials > least - reach && median / trials < most + reach);
    assert_true(tail / trials > least - reach && tail / trials < most + reach);
}

// Independent samples, and pixels that repeat along a column.
static void test_intervals_cover_95_per_cent(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1);
    cover(white, 16 * 4096, (double)bl_test_scaled(200, 20));
    cover(NULL, 0, (double)bl_test_scaled(600, 100));
    bl_signal_free(white);
}

static void test_a_cosine_stays_in_its_range(void **state) {
    (void)state;
    bl_signal *cosine = bl_test_cosine(1, 2, (const double[3]){0.37, 0.11, 0.73});
    bl_histogram_settings settings = bl_histogram_default_settings();
    settings.samples = 200000;
    bl_histogram h = measure(cosine, &settings);
    assert_near(h.minimum, -1, 1e-6);
    assert_near(h.maximum, 3, 1e-6);
    assert_near(h.mean.value, 1, 0.02);
    assert_near(h.variance.value, 2, 0.02);
    assert_near(h.quantile[4].value, 1, 0.05);
    settings.from = 1;
    settings.to = 10;
    settings.bins = 7;
    bl_histogram half = measure(cosine, &settings);
    assert_near((double)half.outside / 200000, 0.5, 0.01);
    assert_true(half.edges[0] == 1 && half.edges[7] == 10 && half.counts[6] == 0);
    bl_histogram_free(&h);
    bl_histogram_free(&half);
    bl_signal_free(cosine);
}

static void test_a_grid_gives_each_of_its_samples_once(void **state) {
    (void)state;
    const size_t sizes[][2] = {{1, 1}, {1, 50}, {37, 1}, {5, 3}, {64, 64}, {101, 67}, {50, 0}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        size_t width = sizes[i][0], height = sizes[i][1], rows = height ? height : 1;
        bl_signal *image = bl_test_white_image(i, width, height, 0.25);
        bl_histogram_settings settings = bl_histogram_default_settings();
        bl_histogram h = measure(image, &settings);
        double sum = 0, least = INFINITY, most = -INFINITY;
        for (size_t y = 0; y < rows; y++)
            for (size_t x = 0; x < width; x++) {
                double at[BL_AXES] = {0.25 * (double)x, 0.25 * (double)y};
                double value = (double)(float)bl_signal_value(image, at);
                sum += value;
                least = fmin(least, value);
                most = fmax(most, value);
            }
        assert_true(h.count == width * rows);
        assert_near(h.mean.value, sum / (double)h.count, 1e-12);
        assert_true(h.minimum == least && h.maximum == most);
        assert_true((double)(float)bl_signal_value(image, h.minimum_at) == least);
        assert_true((double)(float)bl_signal_value(image, h.maximum_at) == most);
        bl_histogram_free(&h);
        bl_signal_free(image);
    }
}

static void test_threads_do_not_change_a_bit(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1);
    bl_histogram_settings settings = bl_histogram_default_settings();
    settings.samples = 50000;
    settings.threads = 1;
    bl_histogram one = measure(white, &settings);
    settings.threads = 5;
    bl_histogram many = measure(white, &settings);
    assert_memory_equal(&one.moments, &many.moments, sizeof one.moments);
    assert_memory_equal(one.counts, many.counts, one.settings.bins * sizeof *one.counts);
    assert_memory_equal(one.quantile, many.quantile, sizeof one.quantile);
    assert_memory_equal(one.maximum_at, many.maximum_at, sizeof one.maximum_at);
    bl_histogram_free(&one);
    bl_histogram_free(&many);
    bl_signal_free(white);
}

static void test_a_constant_is_one_bin(void **state) {
    (void)state;
    bl_signal *constant = bl_test_constant(2);
    bl_histogram_settings settings = bl_histogram_default_settings();
    settings.samples = 100;
    bl_histogram h = measure(constant, &settings);
    assert_true(h.edges[0] < 2 && h.edges[64] > 2 && h.counts[32] == 100);
    assert_true(h.variance.value == 0 && h.quantile[0].value == 2 && h.quantile[8].upper == 2);
    bl_histogram_free(&h);
    bl_signal_free(constant);
}

static void refuse(const bl_signal *signal, bl_histogram_settings settings, bl_status expected,
                   const char *word) {
    bl_histogram h;
    bl_message message = {""};
    bl_status status = bl_histogram_measure(signal, &settings, &h, &message);
    if (status != expected || !strstr(message.text, word))
        fail_msg("status %d, message '%s'", status, message.text);
}

static void test_what_cannot_be_counted_is_refused(void **state) {
    (void)state;
    const bl_histogram_settings good = bl_histogram_default_settings();
    bl_histogram_settings settings = good;
    bl_signal *white = bl_test_white(1), *broken = bl_test_broken();
    refuse(broken, good, BL_MISMATCH, "nan at (");
    settings.samples = 0;
    refuse(white, settings, BL_USAGE, "no samples");
    settings.samples = SIZE_MAX / 2;
    refuse(white, settings, BL_MISMATCH, "bytes");
    settings = good;
    settings.bins = SIZE_MAX / 2;
    refuse(white, settings, BL_MISMATCH, "bytes");
    settings = good;
    settings.from = 2;
    settings.to = 1;
    refuse(white, settings, BL_USAGE, "range");
    settings.to = NAN;
    refuse(white, settings, BL_USAGE, "range");
    settings = good;
    settings.level = 1;
    refuse(white, settings, BL_USAGE, "level");
    settings = good;
    settings.missed = 1;
    refuse(white, settings, BL_USAGE, "miss");
    bl_signal_free(white);
    bl_signal_free(broken);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_white_noise_is_standard_normal),
        cmocka_unit_test(test_extremes_of_noises_stand_where_they_say),
        cmocka_unit_test(test_intervals_cover_95_per_cent),
        cmocka_unit_test(test_a_cosine_stays_in_its_range),
        cmocka_unit_test(test_a_grid_gives_each_of_its_samples_once),
        cmocka_unit_test(test_threads_do_not_change_a_bit),
        cmocka_unit_test(test_a_constant_is_one_bin),
        cmocka_unit_test(test_what_cannot_be_counted_is_refused),
    };
    return bl_run_tests(tests);
}
