// SPDX-License-Identifier: MIT
//
// Spectra of signals whose spectrum is known: powers, coverage of the confidence bands, grids,
// equal bits for any threads, and refusals.
//
// Error rates: each coverage test fails a right program with probability 1e-4 (3.9 standard
// deviations of the binomial); all seeds are fixed, so a run repeats.
//
// What is allowed beyond them is the clamp of the shared variance c at 0. For one average c is 0
// and the bands cover 95 % exactly. For more, c is found from the ratios of the averages, which for
// a gamma law do not depend on their mean (Lukacs 1955): where the found c is below 0, in half of
// the measurements, the clamp makes the bands exact; in the other half they are wider, and cover
// at most everything. So the truth is between 95 % and (95 + 100)/2 = 97.5 %. Rings are the widest:
// the c of 33 bins is as uncertain as the variance of the outermost (7000 bins: 96.1 %).
#include "tests/temporary.h"
#include "tests/test.h"

#include <gsl/gsl_cdf.h>

#include "core/fft.h"
#include "spectra/psd.h"
#include "spectra/psd_parts.h"
#include "tests/test_signals.h"

static bl_psd measure(const bl_signal *signal, const bl_psd_settings *settings) {
    bl_psd psd;
    bl_message message = {""};
    if (bl_psd_measure(signal, settings, &psd, &message) != BL_OK)
        fail_msg("%s", message.text);
    return psd;
}

static bl_psd_settings small_settings(unsigned dims) {
    bl_psd_settings settings = bl_psd_default_settings(dims);
    settings.size = dims == 1 ? 256 : dims == 2 ? 64 : 16;
    settings.averages = 8;
    settings.threads = 1; // these are small
    return settings;
}

static double total_power(const bl_psd *psd) {
    double sum = 0;
    for (size_t i = 0; i < psd->settings.averages * (psd->count + 1); i++)
        sum += psd->profiles[i] / (double)psd->settings.averages;
    return sum;
}

// --- powers ---

// What a window makes of the power of a cosine of `cycles` whole turns a sample: w^2 cos^2 has the
// mean 1/2 sum(w^2) (1 + share cos(a phase)), where share is |sum w^2 e^(4 pi i f n)| / sum w^2. Of
// a cosine of several axes the sums multiply. The mean that is taken off is the cosine's own, at
// most its amplitude times the same sum without a window, and brings a cross term and a square.
static double sum_of_turns(bl_window window, size_t size, int squared, double turns) {
    double w[256], re = 0, im = 0, all = 0;
    bl_window_fill(window, size, w);
    for (size_t n = 0; n < size; n++) {
        double weight = squared ? w[n] * w[n] : 1;
        re += weight * cos(2 * M_PI * turns * (double)n);
        im += weight * sin(2 * M_PI * turns * (double)n);
        all += weight;
    }
    return hypot(re, im) / all;
}

// A cosine has all of its power within the main lobe around its frequency, whatever the seed.
static void test_a_cosine_has_its_power_at_its_frequency(void **state) {
    (void)state;
    const double frequency[3] = {1.3, 0.7, 0.4};
    const double radius[4] = {0, 1.3, hypot(1.3, 0.7), sqrt(1.69 + 0.49 + 0.16)};
    bl_signal *signal = bl_test_cosine(0, 2, frequency);
    for (uint64_t seed = 0; seed < 12; seed++)
        for (unsigned dims = 1; dims <= 3; dims++) {
            bl_psd_settings settings = small_settings(dims);
            settings.rate = 8;
            settings.seed += seed;
            bl_psd psd = measure(signal, &settings);
            double near = 0, total = 0, share = 1, mean = 1, once = 1,
                   reach = (bl_window_half_lobe(settings.window) * sqrt(dims) + 1) * psd.width[0];
            for (unsigned a = 0; a < dims; a++) {
                double turns = frequency[a] / settings.rate;
                share *= sum_of_turns(settings.window, settings.size, 1, 2 * turns);
                once *= sum_of_turns(settings.window, settings.size, 1, turns);
                mean *= sum_of_turns(settings.window, settings.size, 0, turns);
            }
            for (size_t bin = 0; bin < psd.count; bin++) {
                double power = psd.psd[bin] * psd.measure[bin];
                total += power;
                near += fabs(psd.frequency[bin] - radius[dims]) <= reach ? power : 0;
            }
            // Side lobes below -92 dB, of 256 bins at most; the mean, of a power 2 mean^2 at most.
            assert_near(near / total, 1, 1e-6 + 2 * mean * mean);
            // amplitude^2/2, and what the window adds at the worst of phases; 1e-6: float rows.
            assert_near(total / 2, 1, share + 2 * (2 * mean * once + mean * mean) + 1e-6);
            assert_near(psd.variance_theory, 2, 0);
            bl_psd_free(&psd);
        }
    bl_signal_free(signal);
}

static void test_bins_and_corners_hold_all_of_the_variance(void **state) {
    (void)state;
    const size_t sizes[] = {8, 9, 31, 64, 97};
    bl_signal *signal = bl_test_white(5);
    for (unsigned dims = 1; dims <= 3; dims++)
        for (size_t i = 0; i < (dims == 3 ? 3u : 5u); i++)
            for (int window = 0; window < BL_WINDOW_COUNT; window++) {
                bl_psd_settings settings = small_settings(dims);
                settings.size = sizes[i];
                settings.window = (bl_window)window;
                settings.averages = 3;
                bl_psd psd = measure(signal, &settings);
                assert_true(psd.count == sizes[i] / 2 + 1);
                assert_true(psd.parseval_residual < (dims == 1 ? 1e-13 : 2e-6));
                double sum = 0, corners = 0, cells = 0;
                for (size_t bin = 0; bin < psd.count; bin++) {
                    sum += psd.psd[bin] * psd.measure[bin];
                    cells += psd.measure[bin];
                }
                for (size_t k = 0; k < 3; k++)
                    corners += psd.profiles[k * (psd.count + 1) + psd.count] / 3;
                assert_near((sum + corners) / total_power(&psd), 1, 1e-12);
                // Measures fill the spectrum; a line's, one bin too many for DC and Nyquist.
                assert_true(cells <= pow(settings.rate ? settings.rate : psd.settings.rate, dims));
                assert_near(sum + corners, psd.variance.value, 6 / sqrt((double)sizes[i]));
                bl_psd_free(&psd);
            }
    bl_signal_free(signal);
}

static void test_a_constant_has_no_power_at_all(void **state) {
    (void)state;
    bl_signal *signal = bl_test_constant(0.1);
    for (unsigned dims = 1; dims <= 3; dims++) {
        bl_psd_settings settings = small_settings(dims);
        bl_psd psd = measure(signal, &settings);
        assert_near(psd.mean, (double)0.1f, 0);
        for (size_t bin = 0; bin < psd.count; bin++)
            assert_true(psd.psd[bin] == 0 && psd.lower[bin] == 0);
        assert_true(psd.parseval_residual == 0 && psd.variance.value == 0);
        bl_psd_free(&psd);
    }
    bl_signal_free(signal);
}

// A large mean must not drown the spectrum.
static void test_the_mean_is_removed_first(void **state) {
    (void)state;
    const double frequency[3] = {2, 1, 0};
    bl_signal *signal = bl_test_cosine(1000, 1, frequency);
    bl_psd_settings settings = small_settings(2);
    bl_psd psd = measure(signal, &settings);
    assert_near(psd.mean, 1000, 0.01);
    assert_near(total_power(&psd), 0.5, 0.01);
    assert_less(psd.psd[0] * psd.measure[0], 1e-6);
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

// --- coverage ---

typedef struct coverage {
    double inside, trials;
} coverage;

// Every fourth bin, which the window leaves independent, past the lobe of the removed mean and
// before Nyquist, where a line has half the density.
static void count_coverage(const bl_psd *psd, double truth, coverage *covered) {
    for (size_t bin = 4; bin + 1 < psd->count; bin += 4) {
        covered->inside += psd->lower[bin] <= truth && truth <= psd->upper[bin];
        covered->trials++;
    }
}

// `most`: the upper end of what a right program covers; see the head of the file.
static void check_coverage(const coverage *covered, double level, double most) {
    double sigma = sqrt(level * (1 - level) / covered->trials);
    double share = covered->inside / covered->trials;
    if (getenv("BL_TEST_VERBOSE"))
        printf("coverage %.4f of %.0f, sigma %.4f\n", share, covered->trials, sigma);
    if (!(share >= level - 3.9 * sigma && share <= most + 3.9 * sigma))
        fail_msg("%.1f %% bands cover %.2f %% of %.0f bins (sigma %.2f %%)", 100 * level,
                 100 * share, covered->trials, 100 * sigma);
}

static void cover(unsigned dims, size_t averages, size_t repeats, bl_window window) {
    coverage covered = {0, 0};
    bl_signal *signal = bl_test_white(1);
    for (size_t r = 0; r < repeats; r++) {
        bl_psd_settings settings = small_settings(dims);
        settings.averages = averages;
        settings.seed = 100 + r;
        settings.window = window;
        bl_psd psd = measure(signal, &settings);
        double rate = psd.settings.rate;
        count_coverage(&psd, dims == 1 ? 2 / rate : pow(rate, -(double)dims), &covered);
        bl_psd_free(&psd);
    }
    check_coverage(&covered, 0.95, averages == 1 ? 0.95 : 0.975);
    bl_signal_free(signal);
}

static void test_bands_of_lines_cover_95_per_cent(void **state) {
    (void)state;
    cover(1, 1, bl_test_scaled(100, 10), BL_WINDOW_BLACKMAN_HARRIS);
    cover(1, 2, bl_test_scaled(100, 10), BL_WINDOW_HANN);
    cover(1, 32, bl_test_scaled(60, 6), BL_WINDOW_BLACKMAN_HARRIS);
}

static void test_bands_of_rings_cover_95_per_cent(void **state) {
    (void)state;
    cover(2, 1, bl_test_scaled(200, 20), BL_WINDOW_BLACKMAN_HARRIS);
    cover(2, 8, bl_test_scaled(60, 10), BL_WINDOW_BLACKMAN_HARRIS);
    cover(2, 4, bl_test_scaled(500, 10), BL_WINDOW_RECTANGLE);
}

static void test_bands_of_shells_cover_95_per_cent(void **state) {
    (void)state;
    cover(3, 4, bl_test_scaled(200, 20), BL_WINDOW_HANN);
}

// A lattice noise against its closed form. All bins whose frequencies differ by a whole number, or
// add to one, hold the same lattice numbers: only those below 1/2 are counted, and away from 1/2,
// where a bin is its own mirror and spreads twice as much.
static void test_the_closed_form_lies_within_the_bands(void **state) {
    (void)state;
    coverage covered = {0, 0};
    bl_signal *signal = bl_test_hat(1);
    for (size_t r = 0; r < bl_test_scaled(60, 20); r++) {
        bl_psd_settings settings = bl_psd_default_settings(1);
        settings.size = 512;
        settings.threads = 1;
        settings.rate = 4;
        settings.averages = 16;
        settings.seed = r;
        bl_psd psd = measure(signal, &settings);
        double theory = *psd.theory_corners;
        for (size_t bin = 0; bin < psd.count; bin++)
            theory += psd.theory[bin] * psd.measure[bin];
        assert_near(theory, 2.0 / 3, 1e-9);
        for (size_t bin = 4; psd.frequency[bin] < 0.45; bin += 4) {
            covered.inside +=
                psd.lower[bin] <= psd.theory[bin] && psd.theory[bin] <= psd.upper[bin];
            covered.trials++;
        }
        bl_psd_free(&psd);
    }
    check_coverage(&covered, 0.95, 0.975);
    bl_psd_settings settings = small_settings(1);
    settings.place = BL_PLACE_LATTICE;
    bl_psd edge = measure(signal, &settings);
    assert_true(edge.theory == NULL && isnan(edge.variance_theory));
    bl_psd_free(&edge);
    bl_signal_free(signal);
}

static void cover_image(unsigned dims, size_t size, bl_window window) {
    coverage covered = {0, 0};
    for (size_t r = 0; r < bl_test_scaled(60, 8); r++) {
        bl_signal *image = bl_test_white_image(r, 192, 128, 0.5);
        bl_psd_settings settings = bl_psd_default_settings(dims);
        settings.size = size;
        settings.window = window;
        settings.threads = 1;
        bl_psd psd = measure(image, &settings);
        count_coverage(&psd, dims == 1 ? 1.0 : 0.25, &covered);
        bl_psd_free(&psd);
        bl_signal_free(image);
    }
    check_coverage(&covered, 0.95, 0.975);
}

static void test_bands_of_overlapped_segments_cover_95_per_cent(void **state) {
    (void)state;
    cover_image(1, 64, BL_WINDOW_HANN);
    cover_image(1, 64, BL_WINDOW_BLACKMAN_HARRIS);
    cover_image(2, 64, BL_WINDOW_HANN);
    cover_image(2, 64, BL_WINDOW_RECTANGLE); // half of each neighbour is the same samples
}

// The bins of an average share a gain of 0.5 or 1.5: power 0.25 or 2.25, mean 1.25, c = 0.64. If a
// share p of K = 32 averages is the strong one, the found c is 2.56 p (1-p) / (0.2 + 1.6 p)^2,
// whose slope at p = 1/2 is -2.048; p has the standard deviation 1/(2 sqrt K), so the inflation 1 +
// 2c one of 0.36, and of curvature a mean higher by 2 * 3.9 / (8 K) = 0.03, as much as the ratio of
// sums over K averages loses (a relative 1/K).
//
// The bins of one measurement succeed or fail together: the trials are the measurements. The bands
// rest on a variance of 31 degrees of freedom, so cover between P(|t31| < 1.96) and 95 %.
static void test_shared_variance_widens_the_bands(void **state) {
    (void)state;
    bl_signal *signal = bl_test_flicker(0.5);
    for (unsigned dims = 1; dims <= 2; dims++) {
        coverage covered = {0, 0};
        double inflation = 0;
        size_t trials = bl_test_scaled(100, 30);
        for (size_t r = 0; r < trials; r++) {
            bl_psd_settings settings = small_settings(dims);
            settings.averages = 32;
            settings.seed = r;
            bl_psd psd = measure(signal, &settings);
            double truth = 1.25 * (dims == 1 ? 2 / psd.settings.rate : pow(psd.settings.rate, -2));
            inflation += psd.inflation / (double)trials;
            count_coverage(&psd, truth, &covered);
            bl_psd_free(&psd);
        }
        if (dims == 1)
            assert_near(inflation, 1 + 2 * 0.64, 3.9 * 0.36 / sqrt((double)trials) + 0.04);
        const double least = 2 * gsl_cdf_tdist_P(1.96, 31) - 1;
        const double sigma = sqrt(0.95 * 0.05 / (double)trials);
        if (getenv("BL_TEST_VERBOSE"))
            printf("inflation %.4f, coverage %.4f\n", inflation, covered.inside / covered.trials);
        assert_true(covered.inside / covered.trials > least - 3.9 * sigma);
        assert_true(covered.inside / covered.trials < 0.95 + 3.9 * sigma);
    }
    bl_signal_free(signal);
}

// Rows that repeat are one row: the bands must know. Eight alike count as one, so the correlation
// is
// 8. It is found as the largest of the ratios at spans of 8, 16 and 32 rows; the last rests on 7
// degrees of freedom a bin, in 61 bins of which the window (broadening 2) leaves 30 independent: a
// relative standard deviation of sqrt(2/7/30) = 0.1. The largest only widens the bands.
static void test_alike_rows_do_not_count_twice(void **state) {
    (void)state;
    coverage covered = {0, 0};
    for (size_t r = 0; r < bl_test_scaled(60, 20); r++) {
        bl_signal *image = bl_test_streaky_image(r, 128, 256, 8);
        bl_psd_settings settings = bl_psd_default_settings(1);
        settings.size = 128;
        settings.threads = 1;
        bl_psd psd = measure(image, &settings);
        assert_true(psd.settings.averages == 256);
        assert_near(psd.correlation, 8, 8 * 3.9 * 0.1);
        count_coverage(&psd, 2, &covered);
        bl_psd_free(&psd);
        bl_signal_free(image);
    }
    check_coverage(&covered, 0.95, 1);
}

// Wilson and Hilferty against the exact distribution.
static void test_fast_quantiles_agree_with_gsl(void **state) {
    (void)state;
    for (double dof = 190; dof < 1e6; dof *= 1.7)
        for (int tail = 0; tail < 2; tail++) {
            double p = tail ? 0.995 : 0.005, ratio = bl_chi_square_ratio(p, dof);
            assert_near(gsl_cdf_chisq_P(ratio * dof, dof), p, 1.2e-5);
        }
}

// --- anisotropy ---

// White noise is isotropic: -10 log10 K on average over the rings of many cells.
static void test_anisotropy_of_white_noise_reads_its_floor(void **state) {
    (void)state;
    bl_signal *signal = bl_test_white(9);
    bl_psd_settings settings = small_settings(2);
    settings.size = 256;
    bl_psd psd = measure(signal, &settings);
    double sum = 0, rings = 0;
    for (size_t bin = 20; bin < psd.count; bin++) {
        sum += psd.anisotropy_db[bin];
        rings++;
    }
    assert_near(psd.anisotropy_floor_db[30], -10 * log10(8), 1e-12);
    assert_near(sum / rings, -10 * log10(8), 0.25);
    assert_true(isnan(psd.anisotropy_db[0]));
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

static void test_the_plane_has_the_cosine_where_it_belongs(void **state) {
    (void)state;
    const double frequency[3] = {1, -2, 0}; // cycles per unit; 64 samples at 8: cells of 1/8
    bl_signal *signal = bl_test_cosine(0, 1, frequency);
    bl_psd_settings settings = small_settings(2);
    bl_psd psd = measure(signal, &settings);
    size_t highest = 0;
    for (size_t i = 0; i < 64 * psd.count; i++)
        highest = psd.plane[i] > psd.plane[highest] ? i : highest;
    assert_true(highest % psd.count == 8 && highest / psd.count == 64 - 16);
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

// --- equal bits ---

static void same_bits(const bl_psd *a, const bl_psd *b) {
    size_t bytes = a->count * sizeof(double);
    assert_true(a->count == b->count && a->settings.averages == b->settings.averages);
    assert_memory_equal(a->psd, b->psd, bytes);
    assert_memory_equal(a->lower, b->lower, bytes);
    assert_memory_equal(a->profiles, b->profiles,
                        a->settings.averages * (a->count + 1) * sizeof(double));
    assert_true(a->mean == b->mean && a->inflation == b->inflation);
    assert_true(a->parseval_residual == b->parseval_residual);
    if (a->anisotropy_db)
        assert_memory_equal(a->anisotropy_db + 2, b->anisotropy_db + 2, bytes - 16);
    if (a->plane)
        assert_memory_equal(a->plane, b->plane, a->settings.size * bytes);
}

static void test_bits_do_not_depend_on_threads(void **state) {
    (void)state;
    bl_signal *signal = bl_test_white(2);
    for (unsigned dims = 1; dims <= 3; dims++)
        for (size_t averages = 1; averages <= 5; averages += 4) {
            bl_psd_settings settings = small_settings(dims);
            settings.size = dims == 1 ? 16384 : dims == 2 ? 150 : 27;
            settings.averages = averages;
            settings.threads = 1;
            bl_psd one = measure(signal, &settings);
            for (int threads = 2; threads <= 7; threads += 5) {
                settings.threads = threads;
                bl_psd many = measure(signal, &settings);
                same_bits(&one, &many);
                bl_psd_free(&many);
            }
            bl_psd_free(&one);
        }
    bl_signal_free(signal);
}

static void fill_buffer(float *samples, size_t size, uint64_t seed) {
    bl_signal *image = bl_test_white_image(seed, size, size, 1);
    for (size_t y = 0; y < size; y++)
        bl_signal_row(image, (const double[BL_AXES]){0, (double)y}, (const double[BL_AXES]){1},
                      size, samples + y * bl_psd_pitch(size));
    bl_signal_free(image);
}

static void test_a_buffer_gives_what_a_measurement_gives(void **state) {
    (void)state;
    const size_t sizes[] = {8, 33, 96};
    for (size_t i = 0; i < 3; i++) {
        size_t size = sizes[i];
        bl_signal *image = bl_test_white_image(4, size, size, 1);
        bl_psd_settings settings = bl_psd_default_settings(2);
        settings.averages = 1;
        settings.size = size;
        bl_psd expected = measure(image, &settings), psd;
        settings.rate = 1;
        float *samples = bl_fft_buffer(size * bl_psd_pitch(size) * sizeof *samples);
        for (int threads = 1; threads <= 3; threads += 2) {
            settings.threads = threads;
            fill_buffer(samples, size, 4);
            assert_int_equal(bl_psd_of_buffer(samples, &settings, &psd, NULL), BL_OK);
            for (size_t bin = 0; bin < psd.count; bin++) {
                assert_near(psd.psd[bin], expected.psd[bin], 1e-5 * expected.psd[bin] + 1e-9);
                assert_near(psd.dof[bin], expected.dof[bin], 1e-9);
                if (bin > 2)
                    assert_near(psd.anisotropy_db[bin], expected.anisotropy_db[bin], 1e-4);
            }
            assert_near(psd.variance.value, expected.variance.value, 1e-9);
            assert_near(psd.mean, expected.mean, 1e-9);
            assert_true(psd.variance.lower < 1 && psd.variance.upper > 1);
            bl_psd_free(&psd);
        }
        samples[5] = NAN;
        assert_int_equal(bl_psd_of_buffer(samples, &settings, &psd, NULL), BL_MISMATCH);
        assert_int_equal(bl_psd_of_buffer(samples + 1, &settings, &psd, NULL), BL_USAGE);
        free(samples);
        bl_psd_free(&expected);
        bl_signal_free(image);
    }
}

// Both compilations of the loops, on odd counts too, must agree with the plain sums.
static void test_loops_agree_with_plain_sums(void **state) {
    (void)state;
    const bl_loops *loops = bl_psd_loops();
    float row[37], window[37], out[37];
    double sum, square, plain = 0, plain_square = 0, weighted = 0;
    for (int i = 0; i < 37; i++) {
        row[i] = (float)(i * i % 17) - 3.25f;
        window[i] = 1.0f / (float)(i + 1);
        plain += (double)row[i];
        plain_square += (double)row[i] * (double)row[i];
    }
    loops->sum_row(row, 37, &sum, &square);
    assert_near(sum, plain, 1e-12);
    assert_near(square, plain_square, 1e-10);
    double result = loops->weight_row(row, window, 37, 0.5f, 2.0f, out);
    for (int i = 0; i < 37; i++) {
        assert_near((double)out[i], (double)((row[i] - 0.5f) * (window[i] * 2)), 0);
        weighted += (double)out[i] * (double)out[i];
    }
    assert_near(result, weighted, 1e-10);
}

// --- grids ---

static void test_images_of_any_size_work_or_say_what_they_need(void **state) {
    (void)state;
    const size_t sizes[][2] = {{8, 8},    {9, 9},   {31, 17},  {97, 101}, {640, 8},
                               {12, 700}, {64, 64}, {127, 64}, {7, 64},   {64, 7},
                               {1, 50},   {50, 1},  {1, 1},    {300, 200}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        size_t width = sizes[i][0], height = sizes[i][1];
        bl_signal *image = bl_test_white_image(i, width, height, 0.25);
        for (int axis = 0; axis < 3; axis++) {
            bl_psd_settings settings = bl_psd_default_settings(axis < 2 ? 1 : 2);
            if (axis < 2) {
                settings.axis[0] = axis == 0;
                settings.axis[1] = axis == 1;
            }
            bl_psd psd;
            bl_message message = {""};
            size_t needed = axis == 0        ? width
                            : axis == 1      ? height
                            : width < height ? width
                                             : height;
            bl_status status = bl_psd_measure(image, &settings, &psd, &message);
            if (needed < 8) {
                assert_int_equal(status, BL_MISMATCH);
                assert_non_null(strstr(message.text, "8 or more"));
                continue;
            }
            assert_int_equal(status, BL_OK);
            assert_true(psd.settings.size <= needed && psd.settings.size % 2 == 0);
            assert_near(psd.settings.rate, 4, 1e-12);
            assert_true(psd.settings.averages >= 1);
            bl_psd_free(&psd);
        }
        bl_signal_free(image);
    }
}

// Every average of a grid starts on a grid point and ends inside.
static void test_tiles_stay_on_the_grid(void **state) {
    (void)state;
    bl_signal *image = bl_test_white_image(1, 201, 77, 0.125);
    for (unsigned dims = 1; dims <= 2; dims++)
        for (size_t averages = 0; averages < 12; averages++) {
            bl_psd_settings settings = bl_psd_default_settings(dims);
            settings.size = 30;
            settings.averages = averages;
            bl_sampler sampler;
            assert_int_equal(bl_sampler_open(image, &settings, &sampler, NULL), BL_OK);
            assert_true(averages == 0 || sampler.settings.averages <= averages);
            size_t last[2] = {0, 0};
            for (size_t k = 0; k < sampler.settings.averages; k++) {
                double start[BL_AXES];
                bl_sampler_start(&sampler, k, start);
                for (int a = 0; a < 2; a++) {
                    double index = start[a] / 0.125;
                    size_t length = a == 0 || dims == 2 ? 30 : 1;
                    assert_true(index == floor(index) && index >= 0);
                    assert_true((size_t)index + length <= image->extent.size[a]);
                    last[a] = (size_t)index > last[a] ? (size_t)index : last[a];
                }
            }
            if (averages == 0) // they span the grid
                assert_true(last[0] + 30 > 190 && (dims == 1 || last[1] + 30 > 70));
        }
    bl_signal_free(image);
}

static void refuse(const bl_signal *signal, const bl_psd_settings *settings, bl_status expected,
                   const char *word) {
    bl_psd psd;
    bl_message message = {""};
    bl_status status = bl_psd_measure(signal, settings, &psd, &message);
    if (status != expected || !strstr(message.text, word))
        fail_msg("status %d, message '%s', expected %d and '%s'", status, message.text, expected,
                 word);
}

static void test_what_does_not_fit_a_grid_is_refused(void **state) {
    (void)state;
    bl_signal *image = bl_test_white_image(1, 64, 32, 0.5);
    bl_psd_settings settings = bl_psd_default_settings(1);
    settings.rate = 3;
    refuse(image, &settings, BL_MISMATCH, "2 samples per unit");
    settings = bl_psd_default_settings(1);
    settings.axis[1] = 1;
    refuse(image, &settings, BL_MISMATCH, "along one of its axes");
    settings = bl_psd_default_settings(2);
    settings.size = 33;
    refuse(image, &settings, BL_MISMATCH, "at most 32");
    settings = bl_psd_default_settings(2);
    settings.axis[0] = 1;
    settings.axis[2] = 0;
    refuse(image, &settings, BL_MISMATCH, "grid");
    settings = bl_psd_default_settings(3);
    refuse(image, &settings, BL_MISMATCH, "2 dimensions");
    image->extent.spacing[1] = 0.25;
    settings = bl_psd_default_settings(2);
    refuse(image, &settings, BL_MISMATCH, "different spacings");
    bl_signal_free(image);
}

// --- refusals ---

static void test_settings_out_of_range_are_refused(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1);
    const bl_psd_settings good = small_settings(1);
    bl_psd_settings settings = good;
    for (size_t size = 1; size < 8; size++) {
        settings.size = size;
        refuse(white, &settings, BL_USAGE, "8 or more");
    }
    const double rates[] = {NAN, -1, INFINITY};
    for (int i = 0; i < 3; i++) {
        settings = good;
        settings.rate = rates[i];
        refuse(white, &settings, BL_USAGE, "rate");
        settings = good;
        settings.axis[0] = i == 1 ? 0 : rates[i];
        refuse(white, &settings, BL_USAGE, "direction");
        settings = good;
        settings.level = rates[i];
        refuse(white, &settings, BL_USAGE, "level");
    }
    settings = good;
    settings.dims = 4;
    refuse(white, &settings, BL_USAGE, "dimensions");
    settings.dims = 0;
    refuse(white, &settings, BL_USAGE, "dimensions");
    settings = good;
    settings.threads = -1;
    refuse(white, &settings, BL_USAGE, "threads");
    settings = good;
    settings.size = (size_t)1 << 40;
    refuse(white, &settings, BL_MISMATCH, "bytes");
    settings = good;
    settings.averages = SIZE_MAX;
    refuse(white, &settings, BL_MISMATCH, "bytes");
    settings = small_settings(3);
    settings.size = 100000;
    refuse(white, &settings, BL_MISMATCH, "bytes");
    settings = small_settings(3);
    settings.place = BL_PLACE_LATTICE;
    refuse(white, &settings, BL_USAGE, "volume");
    bl_signal_free(white);
}

static void test_values_that_are_not_finite_are_named_with_their_place(void **state) {
    (void)state;
    bl_signal *broken = bl_test_broken();
    for (unsigned dims = 1; dims <= 3; dims++) {
        bl_psd_settings settings = small_settings(dims);
        refuse(broken, &settings, BL_MISMATCH, "nan at (");
    }
    bl_signal_free(broken);
}

static void test_lattice_places_stand_on_the_lattice(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1);
    for (unsigned dims = 1; dims <= 2; dims++) {
        bl_psd_settings settings = small_settings(dims);
        settings.place = BL_PLACE_LATTICE;
        bl_sampler sampler;
        assert_int_equal(bl_sampler_open(white, &settings, &sampler, NULL), BL_OK);
        int fractions = 0;
        for (size_t k = 0; k < settings.averages; k++) {
            double start[BL_AXES];
            bl_sampler_start(&sampler, k, start);
            fractions += start[0] != floor(start[0]);
            if (dims == 1)
                assert_true(start[1] == floor(start[1]));
            assert_true(start[2] == floor(start[2]) && start[3] == floor(start[3]));
        }
        assert_true(fractions == (int)settings.averages);
    }
    bl_signal_free(white);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_cosine_has_its_power_at_its_frequency),
        cmocka_unit_test(test_bins_and_corners_hold_all_of_the_variance),
        cmocka_unit_test(test_a_constant_has_no_power_at_all),
        cmocka_unit_test(test_the_mean_is_removed_first),
        cmocka_unit_test(test_the_closed_form_lies_within_the_bands),
        cmocka_unit_test(test_bands_of_lines_cover_95_per_cent),
        cmocka_unit_test(test_bands_of_rings_cover_95_per_cent),
        cmocka_unit_test(test_bands_of_shells_cover_95_per_cent),
        cmocka_unit_test(test_bands_of_overlapped_segments_cover_95_per_cent),
        cmocka_unit_test(test_shared_variance_widens_the_bands),
        cmocka_unit_test(test_alike_rows_do_not_count_twice),
        cmocka_unit_test(test_fast_quantiles_agree_with_gsl),
        cmocka_unit_test(test_anisotropy_of_white_noise_reads_its_floor),
        cmocka_unit_test(test_the_plane_has_the_cosine_where_it_belongs),
        cmocka_unit_test(test_bits_do_not_depend_on_threads),
        cmocka_unit_test(test_a_buffer_gives_what_a_measurement_gives),
        cmocka_unit_test(test_loops_agree_with_plain_sums),
        cmocka_unit_test(test_images_of_any_size_work_or_say_what_they_need),
        cmocka_unit_test(test_tiles_stay_on_the_grid),
        cmocka_unit_test(test_what_does_not_fit_a_grid_is_refused),
        cmocka_unit_test(test_settings_out_of_range_are_refused),
        cmocka_unit_test(test_values_that_are_not_finite_are_named_with_their_place),
        cmocka_unit_test(test_lattice_places_stand_on_the_lattice),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, bl_temporary_no_wisdom, NULL);
}
