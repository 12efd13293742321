// SPDX-License-Identifier: MIT
//
// The 95 % bands of a spectrum against the closed form, by region of frequency, for every noise
// of the registry that has one: lines, slices and a volume.
//
// Error rates: the bins of one measurement succeed or fail together, so the share of its bins
// inside of their bands is one value; measurements of different seeds are independent. Their mean
// must not lie outside of the allowed range by more than 3.9 standard errors, found from the same
// values, but never below the binomial error of as many independent bins: a right program fails at
// one of the ends with a probability near 1e-4, at one of all some 80 with less than 1 in 100. The
// allowed range is 90 to 98.5 % for a region of one noise, and 92.5 to 97.5 % over all noises. All
// seeds are fixed, so a run repeats.
#include "tests/temporary.h"
#include "tests/test.h"

#include "noises/noise.h"
#include "spectra/psd.h"
#include "tests/test_signals.h"

// Thirds of the way to Nyquist; of a line, the bins at multiples of half a cycle, which are their
// own mirrors, are looked at alone.
enum { LOW, MIDDLE, HIGH, HALF_CYCLES, REGIONS };
static const char *const region_names[REGIONS] = {"low", "middle", "high", "half cycles"};

typedef struct shares {
    double n, sum, square; // of the shares of the measurements
    double bins;           // in all of them
} shares;

static void add_share(shares *into, double share, double bins) {
    into->n++;
    into->bins += bins;
    into->sum += share;
    into->square += share * share;
}

static int region_of(const bl_psd *psd, size_t bin) {
    double f = psd->frequency[bin], nyquist = 0.5 * psd->settings.rate;
    if (psd->settings.dims == 1 && bin > 0 && fabs(2 * f - round(2 * f)) < 1e-9)
        return HALF_CYCLES;
    return f < nyquist / 3 ? LOW : f < nyquist * 2 / 3 ? MIDDLE : HIGH;
}

// Bins 80 dB below the peak are left out: the rounding of float samples is there, and at 0 the
// error of the mean that was removed, which are no part of the closed forms.
static void add_measurement(const bl_psd *psd, const double *truth, shares regions[REGIONS]) {
    double inside[REGIONS] = {0}, bins[REGIONS] = {0}, peak = 0;
    for (size_t bin = 0; bin < psd->count; bin++)
        peak = fmax(peak, truth[bin]);
    for (size_t bin = 0; bin + 1 < psd->count; bin++) {
        if (truth[bin] < 1e-8 * peak)
            continue;
        int region = region_of(psd, bin);
        inside[region] += psd->lower[bin] <= truth[bin] && truth[bin] <= psd->upper[bin];
        bins[region]++;
    }
    for (int r = 0; r < REGIONS; r++)
        if (bins[r] > 0)
            add_share(&regions[r], inside[r] / bins[r], bins[r]);
}

static void check_regions(const shares regions[REGIONS], const char *name, unsigned dims,
                          double low, double high) {
    for (int r = 0; r < REGIONS; r++) {
        double n = regions[r].n, mean = regions[r].sum / n;
        if (n == 0)
            continue;
        double error = sqrt(fmax(0, regions[r].square / n - mean * mean) / (n - 1));
        // Few bins may all succeed; the error cannot be below that of as many independent ones.
        error = fmax(error, sqrt(0.95 * 0.05 / regions[r].bins));
        if (getenv("BL_TEST_VERBOSE"))
            printf("%-8s %u-D %-12s %.1f %% +- %.1f %%\n", name, dims, region_names[r], 100 * mean,
                   100 * error);
        if (!(mean >= low - 3.9 * error && mean <= high + 3.9 * error))
            fail_msg("95 %% bands of %s in %u-D cover %.1f %% (+- %.1f %%) of the bins, %s", name,
                     dims, 100 * mean, 100 * error, region_names[r]);
    }
}

static bl_psd_settings small_settings(unsigned dims) {
    static const size_t sizes[] = {0, 512, 128, 32}, averages[] = {0, 128, 16, 8};
    bl_psd_settings settings = bl_psd_default_settings(dims);
    settings.size = sizes[dims];
    settings.averages = averages[dims];
    settings.threads = 1;
    return settings;
}

static void cover(const bl_signal *signal, unsigned dims, const double *truth, shares *regions) {
    bl_message message = {""};
    size_t repeats = bl_test_scaled(dims == 3 ? 40 : 24, 12);
    for (size_t r = 0; r < repeats; r++) {
        bl_psd_settings settings = small_settings(dims);
        settings.seed = 1 + r;
        bl_psd psd;
        if (bl_psd_measure(signal, &settings, &psd, &message) != BL_OK)
            fail_msg("%s", message.text);
        add_measurement(&psd, truth ? truth : psd.theory, regions);
        bl_psd_free(&psd);
    }
}

static void cover_noises(unsigned dims) {
    shares all[REGIONS] = {{0}};
    for (size_t i = 0; i < bl_noise_count(); i++) {
        const char *name = bl_noise_at(i, BL_ISA_BEST)->name;
        bl_signal *signal = NULL;
        shares regions[REGIONS] = {{0}};
        assert_int_equal(bl_noise_open(name, BL_ISA_BEST, &signal, NULL), BL_OK);
        if (bl_signal_has_closed_form(signal) && dims <= signal->dimensions) {
            cover(signal, dims, NULL, regions);
            check_regions(regions, name, dims, 0.9, 0.985);
        }
        bl_signal_free(signal);
        for (int r = 0; r < REGIONS; r++) {
            all[r].n += regions[r].n;
            all[r].sum += regions[r].sum;
            all[r].square += regions[r].square;
            all[r].bins += regions[r].bins;
        }
    }
    check_regions(all, "noises", dims, 0.925, 0.975);
}

static void test_bands_of_lines_cover_the_closed_forms(void **state) {
    (void)state;
    cover_noises(1);
}

static void test_bands_of_slices_cover_the_closed_forms(void **state) {
    (void)state;
    cover_noises(2);
}

static void test_bands_of_a_volume_cover_the_closed_forms(void **state) {
    (void)state;
    cover_noises(3);
}

// What widens the bands of lattice noises must leave those of white noise alone.
static void test_bands_of_white_noise_are_not_too_wide(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1);
    for (unsigned dims = 1; dims <= 3; dims++) {
        shares regions[REGIONS] = {{0}};
        bl_psd_settings settings = small_settings(dims);
        static const double rates[] = {0, 16, 8, 4};
        double truth[257];
        for (size_t bin = 0; bin < settings.size / 2 + 1; bin++)
            truth[bin] = (dims == 1 && bin > 0 ? 2 : 1) * pow(rates[dims], -(double)dims);
        cover(white, dims, truth, regions);
        check_regions(regions, "white", dims, 0.935, 0.97);
    }
    bl_signal_free(white);
}

// Rows of white noise, all alike: they are one, for the bins, for the variance, and for a limit.
static void test_rows_that_are_all_alike_count_as_one(void **state) {
    (void)state;
    double inside = 0, bins = 0, variances = 0, repeats = (double)bl_test_scaled(60, 40);
    for (size_t r = 0; r < (size_t)repeats; r++) {
        bl_signal *image = bl_test_streaky_image(r, 128, 128, 128);
        bl_psd_settings settings = bl_psd_default_settings(1);
        bl_psd psd;
        assert_int_equal(bl_psd_measure(image, &settings, &psd, NULL), BL_OK);
        assert_true(psd.settings.averages == 128);
        assert_near(psd.alike, 1, 1e-9);
        assert_near(psd.correlation, 128, 1e-6);
        for (size_t bin = 4; bin + 4 < psd.count; bin++, bins++) {
            assert_near(psd.dof[bin], 2, 0.01);
            inside += psd.lower[bin] <= 2 && 2 <= psd.upper[bin];
        }
        variances += psd.variance.lower <= 1 && 1 <= psd.variance.upper;
        bl_band_limit limit = {.from = 0, .to = 0.25, .limit_db = 10 * log10(0.5)};
        bl_psd_band_limit(&psd, &limit);
        assert_true(limit.upper_db - limit.lower_db > 1);
        assert_true(limit.verdict != BL_VERDICT_INCONCLUSIVE || limit.needed_averages == 0);
        bl_psd_free(&psd);
        bl_signal_free(image);
    }
    // some 15 independent bins a row; 3.9 standard deviations of the binomial
    assert_near(inside / bins, 0.95, 3.9 * sqrt(0.95 * 0.05 / (15 * repeats)));
    assert_near(variances / repeats, 0.965, 3.9 * sqrt(0.95 * 0.05 / repeats));
}

static void test_the_variance_has_positive_limits_that_cover_it(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(3);
    for (size_t averages = 1; averages <= 8; averages *= 2) {
        double inside = 0, repeats = (double)bl_test_scaled(400, 200);
        for (size_t r = 0; r < (size_t)repeats; r++) {
            bl_psd_settings settings = bl_psd_default_settings(1);
            settings.window = BL_WINDOW_RECTANGLE;
            settings.size = 32;
            settings.averages = averages;
            settings.seed = r;
            settings.threads = 1;
            bl_psd psd;
            assert_int_equal(bl_psd_measure(white, &settings, &psd, NULL), BL_OK);
            assert_true(psd.variance.lower > 0 && psd.variance.upper > psd.variance.lower);
            double sum = 0; // a line has no corners
            for (size_t bin = 0; bin < psd.count; bin++)
                sum += psd.psd[bin] * psd.measure[bin];
            assert_near(psd.windowed_variance, sum, 1e-12);
            assert_near(psd.windowed_variance, psd.variance.value, 1e-9); // of this window
            inside += psd.variance.lower <= 1 && 1 <= psd.variance.upper;
            bl_psd_free(&psd);
        }
        // The removed mean takes 1/(32 K) of the variance: a fraction of a standard deviation.
        assert_near(inside / repeats, 0.95, 3.9 * sqrt(0.95 * 0.05 / repeats) + 0.01);
    }
    bl_signal_free(white);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bands_of_lines_cover_the_closed_forms),
        cmocka_unit_test(test_bands_of_slices_cover_the_closed_forms),
        cmocka_unit_test(test_bands_of_a_volume_cover_the_closed_forms),
        cmocka_unit_test(test_bands_of_white_noise_are_not_too_wide),
        cmocka_unit_test(test_rows_that_are_all_alike_count_as_one),
        cmocka_unit_test(test_the_variance_has_positive_limits_that_cover_it),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, bl_temporary_no_wisdom, NULL);
}
