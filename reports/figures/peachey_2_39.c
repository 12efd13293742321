// SPDX-License-Identifier: MIT
//
// peachey-2.39: the power spectra of fractalsum and turbulence, the exponent of their decline, and
// what clamping the octaves to a sample width does to them.
//
// The text: amplitudes of 1/f make the power spectrum fall as 1/f^2. Octave k has the variance
// 4^-k, so the power of an octave falls as f^-2; but an octave is as wide as its frequency, so the
// density along a line falls as f^-3, by radius in a slice as f^-3 too (density in the plane:
// f^-4).
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"
#include "spectra/psd.h"

static const char section[] = "peachey2003, Spectral Synthesis";

enum { LOWEST = 1, HIGHEST = 64, RATE = 256 };

// --- the spectra --------------------------------------------------------------------------------

static bl_psd_settings line_settings(const bl_run *run, double averages) {
    bl_psd_settings s = bl_run_psd_settings(run, 1);
    s.rate = RATE;
    s.size = 8192;
    s.averages = (size_t)averages;
    return s;
}

// --- the exponent -------------------------------------------------------------------------------

// The slope of log power over log frequency by least squares over equal steps of log frequency,
// from f = 2 to 32: whole octaves, so that their ripple cancels, in the midst of the sum's own, so
// that the lowest and the highest do not bend it.
static double slope_of(const bl_psd *psd, int per_octave) {
    double x[20], y[20]; // four octaves, by quarters
    const double factor = pow(2, per_octave ? 1 : 0.25);
    size_t bins = 0;
    for (double from = 2; from < 31.9; from *= factor, bins++) {
        double width = per_octave ? 1 : from * (factor - 1);
        x[bins] = log2(from);
        y[bins] = log2(bl_psd_share(psd, from, from * factor).value / width);
    }
    return bl_slope(x, y, bins);
}

enum { FITS = 12 }; // spectra of independent seeds and places, each with its own fit

static void fit(bl_run *run, const bl_signal *signal, bl_estimate slopes[2]) {
    double values[2][FITS];
    bl_psd_settings settings = line_settings(run, bl_run_pick(run, 16, 128, 2048));
    settings.rate = 2 * RATE;
    settings.size = 16384;
    for (int i = 0; i < FITS; i++) {
        settings.seed = bl_run_settings(run)->seed + 1000 + (uint64_t)i;
        const bl_psd *psd = bl_run_psd(run, signal, &settings);
        for (int k = 0; k < 2; k++)
            values[k][i] = slope_of(psd, k);
    }
    for (int k = 0; k < 2; k++)
        slopes[k] = bl_mean_estimate(values[k], FITS, 0.95);
}

static void claim_fits(bl_run *run, const bl_gallery *gallery) {
    static const char sentence[] =
        "Amplitudes that fall as 1/f make the power spectrum fall as 1/f^2: the exponent fitted "
        "from 2 to 32 cycles per unit.";
    static const char *const of[] = {"density along a line", "power of each octave"};
    bl_estimate slopes[2][2];
    for (size_t i = 0; i < gallery->count; i++) {
        bl_run_step(run, "fitting the exponent");
        fit(run, gallery->signal[i], slopes[i]);
    }
    for (size_t n = 0; n < 4; n++)
        bl_make_claim(run, section, sentence,
                      bl_run_text(run, "%s, %s", gallery->label[n % 2], of[n / 2]), "", -2.2, -1.8,
                      slopes[n % 2][n / 2], "fits");
    bl_make_claim(run, "bandlimit",
                  "The octaves of a fractal sum have the variance f^-2 on a width f, so the "
                  "density along a line falls as f^-3: the exponent fitted.",
                  bl_run_text(run, "%s, %s", gallery->label[0], of[0]), "", -3.15, -2.85,
                  slopes[0][0], "fits");
}

// Eleven octaves, of which four are fitted.
static void claim_slopes(bl_run *run) {
    static const char *const wide[] = {"fractalsum:min=1/4,max=512", "turbulence:min=1/4,max=512"};
    const bl_gallery gallery = bl_gallery_open(run, wide, 2);
    claim_fits(run, &gallery);
}

// --- clamping -----------------------------------------------------------------------------------

enum { PLAIN, HARD, FADED, WAYS };
static const char *const way_words[WAYS] = {"not clamped", "hard cutoff", "faded"};
static const char *const way_settings[WAYS] = {"", ",clamp=hard,width=0.08",
                                               ",clamp=fade,width=0.08"};
#define NYQUIST 6.25 // of samples 0.08 apart

static void claim_clamping(bl_run *run) {
    static const char *const names[] = {"fractalsum", "turbulence"};
    bl_psd_settings line = line_settings(run, bl_run_pick(run, 64, 512, 8192));
    bl_run_setting(run, "clamping",
                   "to samples 0.08 apart, whose Nyquist frequency is 6.25 cycles per unit");
    for (int n = 0; n < 2; n++) {
        bl_estimate share[WAYS], mean[WAYS];
        for (int w = 0; w < WAYS; w++) {
            bl_run_step(run, bl_run_text(run, "clamping %s", names[n]));
            const bl_signal *signal =
                bl_run_seeded_signal(run, bl_run_text(run, "%s:min=%d,max=%d%s", names[n], LOWEST,
                                                      HIGHEST, way_settings[w]));
            const bl_psd *psd = bl_run_psd(run, signal, &line);
            share[w] = bl_psd_share(psd, NYQUIST, INFINITY);
            mean[w] = bl_observed(psd->mean / sqrt(psd->variance.value), psd->variance.samples);
        }
        for (int w = HARD; w < WAYS; w++)
            bl_make_claim(run, section,
                          "Clamping the octaves to the sample width prevents aliasing: the share "
                          "of the variance above Nyquist, over that without clamping.",
                          bl_run_text(run, "%s, %s", names[n], way_words[w]), "dB", -INFINITY, -10,
                          bl_ratio_db(share[w], share[PLAIN]), "averages");
        for (int w = HARD; w < WAYS && n == 1; w++)
            bl_make_claim(run, "bandlimit",
                          "Octaves that are clamped away leave their mean behind: the mean of "
                          "turbulence against that without clamping, in standard deviations.",
                          bl_run_text(run, "turbulence, %s", way_words[w]), "", -0.1, 0.1,
                          bl_observed(mean[w].value - mean[PLAIN].value, mean[w].samples),
                          "averages");
    }
}

// --- the figure ---------------------------------------------------------------------------------

static void draw(bl_run *run, const bl_gallery *gallery) {
    bl_psd_settings settings = line_settings(run, bl_run_pick(run, 64, 1024, 16384));
    bl_run_setting(
        run, "spectra along a line at a random place",
        bl_run_text(
            run, "%zu averages of %zu samples, %g a unit; a fresh place and a fresh seed for each",
            settings.averages, settings.size, settings.rate));
    const bl_gallery_spectra spectra =
        bl_gallery_measure_spectra(run, gallery, &settings, "along a line");
    const bl_gallery_spectrum_plot plot = {
        .name = "line",
        .title = "How fast does the power of the two sums decline?",
        .alternative =
            "Power spectra along a line on logarithmic frequency: straight declines from the "
            "lowest octave to the highest, then a fall. Turbulence falls no faster above its "
            "highest octave, because its creases have no band limit, and has lines at the lattice "
            "frequencies of its octaves, because the mean size of gradient noise depends on the "
            "place in the cell.",
        .lowest = 0.25,
        .highest = RATE / 2,
        .lowest_db = -120,
        .highest_db = 10,
        .tick_db = 20,
        .logarithmic = 1,
        .limit = NYQUIST,
        .limit_label = "Nyquist of width 0.08",
        .x_label = "frequency, cycles per unit"};
    bl_gallery_draw_spectra(run, gallery, &spectra, &plot);
}

static void run_figure(bl_run *run) {
    static const char *const texts[] = {"fractalsum:min=1,max=64",
                                        "turbulence:min=1,max=64",
                                        "fractalsum:max=64,clamp=hard,width=0.08",
                                        "turbulence:max=64,clamp=hard,width=0.08",
                                        "fractalsum:max=64,clamp=fade,width=0.08",
                                        "turbulence:max=64,clamp=fade,width=0.08"};
    static const char *const labels[] = {"fractalsum",
                                         "turbulence",
                                         "fractalsum, hard cutoff",
                                         "turbulence, hard cutoff",
                                         "fractalsum, faded",
                                         "turbulence, faded"};
    bl_gallery gallery = bl_gallery_open(run, texts, 6);
    gallery.label = labels;
    draw(run, &gallery);
    claim_slopes(run);
    claim_clamping(run);
}

static const bl_term terms[] = {
    {"exponent",
     "the slope of the logarithm of the power over the logarithm of the frequency, by least "
     "squares over quarter octaves (of the density) or whole ones (of the power of each octave)"},
    {"clamping",
     "leaving out the octaves that lie above half the sampling rate: at once (hard), or with a "
     "weight that fades to 0 over the last octave"},
    {0}};

BL_FIGURE_DESCRIPTOR(peachey_2_39) = {
    .name = "peachey-2.39",
    .title = "Power spectra of fractalsum and turbulence",
    .question = "How fast does the power of a sum of octaves decline, and what does clamping do?",
    .paper = "peachey2003, fig. 2.39",
    .terms = terms,
    .shows =
        "The power along a line at a random place, on logarithmic axes, of the two sums as the "
        "text draws them, and clamped to samples 0.08 apart, whose Nyquist frequency is 6.25.",
    .run = run_figure};
