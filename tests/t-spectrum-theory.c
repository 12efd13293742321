// SPDX-License-Identifier: MIT
//
// Measured spectra against closed forms, for every registry noise that states one and every choice
// of its parameters: lines along x, y and obliquely, a slice, a volume.
//
// The statistic. Every average is a fresh seed at a fresh random place. Its profile is summed into
// BANDS bands and the corners; the K sums of a band are independent and equally distributed,
// whatever the dependence between bins, so their mean is compared with the expectation (theory seen
// through the window) by Johnson's t, Student's t with the skewness of band powers taken out
// (Johnson 1978). The smallest p-value times the number of bands (Bonferroni) is the p-value of a
// spectrum. A chi-square over bins would misfire: the bins of one line share the variance of its
// place in the cell.
//
// Null: p below alpha with probability at most alpha. The suite runs about 150 spectra and fails at
// p < 1e-6 each, 1.5e-4 in all. That the statistic keeps its level is itself tested, and that it
// has power: theory scaled by 6 %, or the theory of a neighbouring kernel, must be refused.
#include "tests/test.h"

#include <gsl/gsl_cdf.h>

#include "noises/noise.h"
#include "spectra/psd.h"
#include "spectra/theory.h"
#include "tests/texts.h"

enum { BANDS = 12, NAME_MOST = 128 };

// --- the statistic -------------------------------------------------------------------------------

// Two-sided p-value of the mean of n values against its expectation.
static double johnson_p(const double *x, size_t n, double expected) {
    double mean = 0, m2 = 0, m3 = 0, count = (double)n;
    for (size_t i = 0; i < n; i++)
        mean += x[i] / count;
    for (size_t i = 0; i < n; i++) {
        double d = x[i] - mean;
        m2 += d * d / (count - 1);
        m3 += d * d * d / count;
    }
    double d = mean - expected;
    double corrected = d + m3 / (6 * m2 * count) + m3 / (3 * m2 * m2) * d * d;
    double t = corrected / sqrt(m2 / count);
    return 2 * gsl_cdf_tdist_Q(fabs(t), count - 1);
}

// Bands of equal width up to the Nyquist frequency. A band with less than 1e-9 of the variance may
// be the rounding of float samples and is not compared; nor one within the window's main lobe at 0
// that has less than 20 times the square of the error of the mean that was removed, all of which
// stands there: it matters to noises that have no power at low frequencies.
static size_t band_of(const bl_psd *psd, size_t bin) {
    return bin * BANDS / psd->count;
}

static int is_compared(const bl_psd *psd, double mean, size_t band, double expected, double all) {
    double removed = isnan(mean) ? 0 : (psd->mean - mean) * (psd->mean - mean);
    int at_zero = band <= band_of(psd, 4);
    return expected >= 1e-9 * all && !(at_zero && expected < 20 * removed);
}

// The p-value of a measured spectrum of a signal of that mean, with theory[] times `scale` as the
// expectation.
static double spectrum_p(const bl_psd *psd, double signal_mean, const double *theory,
                         double corners, double scale) {
    size_t averages = psd->settings.averages;
    double *powers = malloc(averages * sizeof *powers), smallest = 1, all = corners;
    size_t compared = 0;
    for (size_t i = 0; i < psd->count; i++)
        all += theory[i] * psd->measure[i];
    for (size_t band = 0; band <= BANDS; band++) { // the last are the corners
        double expected = band == BANDS ? corners : 0;
        for (size_t i = 0; band < BANDS && i < psd->count; i++)
            expected += band_of(psd, i) == band ? theory[i] * psd->measure[i] : 0;
        if (!is_compared(psd, signal_mean, band, expected, all))
            continue;
        for (size_t k = 0; k < averages; k++) {
            const double *profile = psd->profiles + k * (psd->count + 1);
            powers[k] = band == BANDS ? profile[psd->count] : 0;
            for (size_t i = 0; band < BANDS && i < psd->count; i++)
                powers[k] += band_of(psd, i) == band ? profile[i] : 0;
        }
        smallest = fmin(smallest, johnson_p(powers, averages, scale * expected));
        compared++;
    }
    free(powers);
    return fmin(1, (double)compared * smallest);
}

static bl_psd measure(const bl_signal *signal, const bl_psd_settings *settings) {
    bl_psd psd;
    bl_message message = {""};
    if (bl_psd_measure(signal, settings, &psd, &message) != BL_OK)
        fail_msg("%s: %s", signal->text, message.text);
    assert_non_null(psd.theory);
    return psd;
}

static double own_p(const bl_psd *psd, double mean, double scale) {
    return spectrum_p(psd, mean, psd->theory, psd->theory_corners ? *psd->theory_corners : 0,
                      scale);
}

static bl_psd_settings line_settings(const double axis[3], size_t averages, uint64_t seed) {
    bl_psd_settings settings = bl_psd_default_settings(1);
    settings.rate = 6;
    settings.size = 192;
    settings.averages = averages;
    settings.seed = seed;
    settings.threads = 1; // small pieces of work: waking threads would cost more than it saves
    memcpy(settings.axis, axis, sizeof settings.axis);
    return settings;
}

static const double along_x[3] = {1, 0, 0}, along_y[3] = {0, 1, 0}, along_z[3] = {0, 0, 1};
static const double oblique[3] = {1, 1, 1}, diagonal[3] = {1, 1, 0};

// --- level and power -----------------------------------------------------------------------------

// At alpha = 5 %, R independent repeats refuse a true theory at most as often as a binomial count
// of level 1e-6 allows. The same repeats show that p-values are not hopelessly large: at least a
// fifth of the nominal count is refused (Bonferroni is conservative for dependent bands).
static void test_the_statistic_keeps_its_level(void **state) {
    (void)state;
    const char *names[] = {"gnoise", "vnoise"};
    for (size_t n = 0; n < 2; n++) {
        if (!bl_noise_find(names[n], BL_ISA_BEST))
            continue;
        bl_signal *signal = bl_test_open(names[n], BL_ISA_BEST);
        if (!bl_signal_has_closed_form(signal)) {
            bl_signal_free(signal);
            continue;
        }
        unsigned repeats = (unsigned)bl_test_scaled(400, 100), refused = 0;
        for (unsigned r = 0; r < repeats; r++) {
            bl_psd_settings settings = line_settings(along_x, 200, 1000 + r);
            bl_psd psd = measure(signal, &settings);
            refused += own_p(&psd, signal->facts.mean, 1) < 0.05;
            bl_psd_free(&psd);
        }
        printf("# %s: %u of %u true theories refused at 5 %%\n", names[n], refused, repeats);
        assert_true(gsl_cdf_binomial_Q(refused - (refused > 0), 0.05, repeats) > 1e-6);
        assert_true(refused >= repeats / 100);
        bl_signal_free(signal);
    }
}

static void test_a_wrong_theory_is_refused(void **state) {
    (void)state;
    const char *pairs[][2] = {{"vnoise:interp=smooth", "vnoise:interp=linear"},
                              {"gnoise:fade=cubic", "gnoise:fade=quintic"},
                              {"vnoise", "vcnoise"}};
    for (size_t i = 0; i < 3; i++) {
        bl_signal *signals[2] = {NULL, NULL};
        bl_psd psds[2];
        bl_psd_settings settings = line_settings(along_x, 5000, 77 + i);
        int here = 1;
        for (int j = 0; j < 2; j++) {
            here = here && bl_noise_open(pairs[i][j], BL_ISA_BEST, &signals[j], NULL) == BL_OK &&
                   bl_signal_has_closed_form(signals[j]);
            if (here)
                psds[j] = measure(signals[j], &settings);
        }
        for (int j = 0; here && j < 2; j++) {
            double mean = signals[j]->facts.mean;
            assert_true(own_p(&psds[j], mean, 1) > 1e-6);
            assert_true(own_p(&psds[j], mean, 1.06) < 1e-6);
            assert_true(own_p(&psds[j], mean, 1 / 1.06) < 1e-6);
            assert_true(spectrum_p(&psds[j], mean, psds[1 - j].theory, 0, 1) < 1e-6);
        }
        for (int j = 0; j < 2; j++) {
            if (here)
                bl_psd_free(&psds[j]);
            bl_signal_free(signals[j]);
        }
    }
}

// --- every noise ---------------------------------------------------------------------------------

static void check_spectrum(const bl_signal *signal, const bl_psd_settings *settings,
                           const char *view) {
    bl_psd psd = measure(signal, settings);
    double p = own_p(&psd, signal->facts.mean, 1);
    if (p < 1e-6)
        fail_msg("%s, %s: measured and closed form disagree, p = %.2g", signal->text, view, p);
    bl_psd_free(&psd);
}

static void check_noise(const char *text) {
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    if (bl_signal_has_closed_form(signal)) {
        // Of fewer dimensions what there is of them: of one the line along x, of two all but the
        // volume, with the oblique line in the plane.
        const unsigned dimensions = signal->dimensions;
        size_t lines = bl_test_scaled(600, 100);
        const double *axes[3] = {along_x, along_y, dimensions == 2 ? diagonal : oblique};
        const char *views[3] = {"line along x", "line along y", "oblique line"};
        for (int i = 0; i < (dimensions == 1 ? 1 : 3); i++) {
            bl_psd_settings settings = line_settings(axes[i], lines, 5 + (uint64_t)i);
            check_spectrum(signal, &settings, views[i]);
        }
        bl_psd_settings slice = bl_psd_default_settings(2);
        slice.rate = 4;
        slice.size = 48;
        slice.averages = bl_test_scaled(60, 30);
        slice.seed = 8;
        slice.threads = 1;
        memcpy(slice.axis, along_z, sizeof along_z);
        if (dimensions > 1)
            check_spectrum(signal, &slice, "slice z = const");
        bl_psd_settings volume = bl_psd_default_settings(3);
        volume.rate = 3;
        volume.size = 16;
        volume.averages = bl_test_scaled(40, 30);
        volume.seed = 9;
        volume.threads = 1;
        if (dimensions > 2)
            check_spectrum(signal, &volume, "volume");
    }
    bl_signal_free(signal);
}

// The defaults, and each choice of each parameter alone.
static void test_every_noise_has_the_spectrum_it_states(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        const bl_noise *noise = bl_noise_at(i, BL_ISA_BEST);
        check_noise(noise->name);
        for (const bl_parameter *p = noise->parameters; p->key; p++)
            for (size_t c = 0; p->kind == BL_CHOICE && p->choices[c]; c++) {
                char text[NAME_MOST];
                if (strchr(p->choices[c], ':') || strcmp(p->choices[c], p->fallback) == 0)
                    continue;
                snprintf(text, sizeof text, "%s:%s=%s", noise->name, p->key, p->choices[c]);
                check_noise(text);
            }
    }
}

// Settings that meet: both fades and gradients, weights of either sign, few and many impulses.
static void test_settings_together_have_the_spectrum_they_state(void **state) {
    (void)state;
    static const char *const texts[] = {"gnoise:fade=quintic,gradients=edges",
                                        "vgnoise:value=0.3,gradient=-1.5,interp=bspline3",
                                        "vgnoise:value=0,gradient=1,fade=linear",
                                        "scnoise:impulses=1",
                                        "scnoise:impulses=10",
                                        "simplex:dims=2",
                                        "simplex:dims=4",
                                        "white:cell=1",
                                        "white:cell=2/5,dims=4",
                                        "vnoise:dims=1",
                                        "vnoise:dims=2",
                                        "vnoise:dims=4",
                                        "vnoise:dims=4,interp=bspline2",
                                        "gnoise:dims=1",
                                        "gnoise:dims=2",
                                        "gnoise:dims=4",
                                        "gnoise:dims=2,gradients=edges",
                                        "gnoise:dims=4,gradients=edges",
                                        "gnoise:dims=4,gradients=rejection,fade=quintic",
                                        "scnoise:kernel=gaussian,count=poisson,impulses=1",
                                        "spot:dims=3,shape=disc,radius=0.7",
                                        "spot:dims=3,shape=square,angle=20",
                                        "fbm:rotate=random,basis=simplex,octaves=3",
                                        "fbm:basis=fourier,octaves=2",
                                        "gardner:terms=7",
                                        "fourier:dims=1",
                                        "fourier:dims=3,amplitudes=gaussian",
                                        "fourier:spectrum=power,beta=1,interp=catmull-rom",
                                        "wavelet:dims=2",
                                        "midpoint:dims=1,hurst=0.2",
                                        "additions:dims=1,lacunarity=4,interp=linear",
                                        "spot:stretch=3,angle=30,shape=ring,count=fixed",
                                        "gabor:kind=anisotropic,phase=zero,orientation=30"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_noise(texts[i]);
}

// The variance that a noise states is that of its samples at random places.
static void test_the_mean_and_the_variance_are_as_stated(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        bl_signal *signal = bl_test_open(bl_noise_at(i, BL_ISA_BEST)->name, BL_ISA_BEST);
        if (bl_signal_has_closed_form(signal)) {
            bl_psd_settings settings = line_settings(signal->dimensions > 2 ? oblique : along_x,
                                                     bl_test_scaled(400, 100), 31);
            settings.level = 1 - 1e-6;
            settings.window = BL_WINDOW_RECTANGLE;
            bl_psd psd = measure(signal, &settings);
            assert_true(psd.variance.lower <= signal->facts.variance &&
                        signal->facts.variance <= psd.variance.upper);
            bl_psd_free(&psd);
        }
        bl_signal_free(signal);
    }
}

// The leak that a noise states is the share of its line spectrum outside of its band, rounded up to
// the next hundredth of a dB.
static void test_the_leak_is_as_stated(void **state) {
    (void)state;
    static const char *const more[] = {"simplex:dims=2", "simplex:dims=4", "white:cell=1",
                                       "wiener:covariance=sinc", "wiener:width=2"};
    double directions[3][BL_AXES] = {{1, 0, 0, 0}};
    size_t count = bl_noise_count();
    for (size_t i = 0; i < count + sizeof more / sizeof *more; i++) {
        bl_signal *signal = bl_test_open(
            i < count ? bl_noise_at(i, BL_ISA_BEST)->name : more[i - count], BL_ISA_BEST);
        const bl_facts *facts = &signal->facts;
        if (bl_signal_has_density(signal) && !isnan(facts->leak_db)) {
            double share = bl_theory_band(signal, 1, directions, facts->band_from, facts->band_to);
            double leak = 10 * log10(1 - share);
            if (!(leak <= facts->leak_db && facts->leak_db < leak + 0.0101))
                fail_msg("%s: states a leak of %g dB, has %g dB", signal->text, facts->leak_db,
                         leak);
        }
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_statistic_keeps_its_level),
        cmocka_unit_test(test_a_wrong_theory_is_refused),
        cmocka_unit_test(test_every_noise_has_the_spectrum_it_states),
        cmocka_unit_test(test_settings_together_have_the_spectrum_they_state),
        cmocka_unit_test(test_the_mean_and_the_variance_are_as_stated),
        cmocka_unit_test(test_the_leak_is_as_stated),
    };
    return bl_run_tests(tests);
}
