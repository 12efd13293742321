// SPDX-License-Identifier: MIT
//
// clamping-leak: what the clamping of octaves leaves above the Nyquist frequency, of a sum of sine
// waves and of a sum of gradient noises, what it takes below, and how it pops.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

static const char section[] = "peachey2003, Clamping";

// Samples 0.08 apart: the octaves 1, 2 and 4 stay whole, and 8 and more are above 6.25.
#define WIDTH "0.08"
#define NYQUIST 6.25

enum { PLAIN, HARD, FADED, WAYS, SUMS = 2 };
static const char *const texts[SUMS * WAYS] = {"sinesum",
                                               "sinesum:filter=clamp,width=" WIDTH,
                                               "sinesum:filter=fade,width=" WIDTH,
                                               "fractalsum:max=64",
                                               "fractalsum:max=64,clamp=hard,width=" WIDTH,
                                               "fractalsum:max=64,clamp=fade,width=" WIDTH};
static const char *const labels[SUMS * WAYS] = {"sine waves",          "sine waves, hard cutoff",
                                                "sine waves, faded",   "gradient noises",
                                                "noises, hard cutoff", "noises, faded"};
static const char *const ways[WAYS] = {"not clamped", "hard cutoff", "faded"};

static bl_psd_settings settings_of(const bl_run *run) {
    bl_psd_settings s = bl_run_psd_settings(run, 1);
    s.rate = 256;
    s.size = 8192;
    s.averages = bl_run_count(run, 64, 512, 8192);
    return s;
}

// --- above and below the Nyquist frequency ------------------------------------------------------

// The power in a band, in units of the variance of the sum that is not clamped.
static bl_estimate power_of(const bl_gallery_spectra *spectra, int sum, int way, double from,
                            double to) {
    const bl_psd *psd = spectra->psd[WAYS * sum + way], *plain = spectra->psd[WAYS * sum];
    const bl_estimate share = bl_psd_share(psd, from, to);
    double scale = psd->variance.value / plain->variance.value;
    return bl_scaled(share, scale);
}

static void claim_leak(bl_run *run, const bl_gallery_spectra *spectra, int way) {
    bl_estimate leak[SUMS], whole = {1, 1, 1, 0.95, 1};
    for (int sum = 0; sum < SUMS; sum++)
        leak[sum] = power_of(spectra, sum, way, NYQUIST, INFINITY);
    // The window leaks -92 dB, and the nearest wave of the sum lies 70 bins below the limit.
    bl_make_claim(run, section,
                  "Clamping works very well for sine waves: the power of a sum of them that is "
                  "left above the Nyquist frequency of the samples.",
                  ways[way], "dB of the variance", -INFINITY, -80,
                  bl_observed(10 * log10(fmax(leak[0].value, 1e-30)), leak[0].samples), "averages");
    bl_make_claim(
        run, section,
        "With a primitive that has a richer spectrum the low-pass filtering is imperfect: the "
        "power of a sum of gradient noises that is left above the Nyquist frequency.",
        ways[way], "dB of the variance", -60, 0, bl_ratio_db(leak[1], whole), "averages");
}

static void claim_loss(bl_run *run, const bl_gallery_spectra *spectra, int way) {
    // The fade lowers the highest octave that stays, of the sines too: only noises are asked of it.
    for (int sum = way == FADED; sum < SUMS; sum++) {
        bl_estimate kept = power_of(spectra, sum, way, 0, NYQUIST);
        bl_estimate all = power_of(spectra, sum, PLAIN, 0, NYQUIST);
        // Octaves of noise are independent, so what is taken is the variance below Nyquist of those
        // that are removed; it is small, and both spectra have the same seeds and places.
        double lost = 1 - kept.value / all.value;
        bl_make_claim(run, section,
                      sum ? "Clamped components contain low frequencies, which are removed along "
                            "with the high ones: the power lost below the Nyquist frequency."
                          : "A sine wave has no lower frequencies to lose: the power that the hard "
                            "cutoff takes below the Nyquist frequency.",
                      bl_run_text(run, "%s, %s", labels[WAYS * sum], ways[way]),
                      "of the power there", sum ? 0.001 : -1e-9, sum ? 1 : 1e-9,
                      bl_observed(lost, kept.samples), "averages");
    }
}

// --- pops ---------------------------------------------------------------------------------------

// The largest change of the value at random places when the sample width passes 1/16 = 1/(2 f) of
// the octave f = 8, where that octave comes or goes.
static double pop_of(const bl_run *run, const bl_signal *signal) {
    bl_random random = bl_run_random(run, 77);
    double largest = 0;
    for (int i = 0; i < 4096; i++) {
        double at[BL_AXES], wide[BL_AXES], narrow[BL_AXES];
        for (int a = 0; a < BL_AXES; a++) {
            at[a] = 64 * bl_random_unit(&random);
            wide[a] = 0.0625 * (1 + 1e-9);
            narrow[a] = 0.0625 * (1 - 1e-9);
        }
        double change =
            bl_signal_filtered(signal, at, wide) - bl_signal_filtered(signal, at, narrow);
        largest = fmax(largest, fabs(change));
    }
    return largest;
}

static void claim_pops(bl_run *run) {
    static const char *const popping[] = {"sinesum:filter=clamp", "fractalsum:max=64,clamp=hard",
                                          "sinesum:filter=fade", "fractalsum:max=64,clamp=fade"};
    const bl_gallery gallery = bl_gallery_open(run, popping, 4);
    for (size_t i = 0; i < 4; i++) {
        double pop = pop_of(run, gallery.signal[i]);
        if (i < 2)
            bl_make_claim(run, section,
                          "A hard cutoff pops: the largest change of the value when the width "
                          "passes half the wave of an octave.",
                          popping[i], "value", 0.01, 1, bl_observed(pop, 4096), "places");
        else
            bl_make_claim(run, section,
                          "Fading the component as the Nyquist frequency approaches avoids pops: "
                          "the largest change of the value there.",
                          popping[i], "value", 0, 1e-6, bl_observed(pop, 4096), "places");
    }
}

// --- the figure ---------------------------------------------------------------------------------

static bl_gallery_spectra draw(bl_run *run, const bl_gallery *gallery) {
    bl_psd_settings settings = settings_of(run);
    bl_run_setting(run, "clamping",
                   "to samples " WIDTH " apart, whose Nyquist frequency is 6.25 cycles per unit");
    bl_run_setting(run, "spectra along a line at a random place",
                   bl_run_text(run, "%zu averages of %zu samples, %g a unit", settings.averages,
                               settings.size, settings.rate));
    const bl_gallery_spectra spectra =
        bl_gallery_measure_spectra(run, gallery, &settings, "along a line");
    const bl_gallery_spectrum_plot plot = {
        .name = "line",
        .title = "What does clamping leave above the Nyquist frequency?",
        .alternative =
            "Power spectra on logarithmic frequency. The sum of sine waves has one line an octave "
            "and, if clamped, none above the limit. The octaves of gradient noise overlap: if "
            "clamped, they leave a slope that runs on beyond the limit.",
        .lowest = 0.25,
        .highest = 128,
        .lowest_db = -120,
        .highest_db = 10,
        .tick_db = 20,
        .logarithmic = 1,
        .limit = NYQUIST,
        .limit_label = "Nyquist of width " WIDTH,
        .x_label = "frequency, cycles per unit"};
    bl_gallery_draw_spectra(run, gallery, &spectra, &plot);
    return spectra;
}

static void run_figure(bl_run *run) {
    bl_gallery gallery = bl_gallery_open(run, texts, SUMS * WAYS);
    gallery.label = labels;
    const bl_gallery_spectra spectra = draw(run, &gallery);
    for (int way = HARD; way < WAYS; way++) {
        claim_leak(run, &spectra, way);
        claim_loss(run, &spectra, way);
    }
    claim_pops(run);
}

BL_FIGURE_DESCRIPTOR(clamping_leak) = {
    .name = "clamping-leak",
    .title = "Clamping a sum of sine waves and a sum of noises",
    .question =
        "What does clamping leave above the Nyquist frequency, and what does it take below?",
    .paper = "peachey2003, Clamping",
    .shows =
        "The power along a line of two sums of octaves whose amplitudes fall as 1/f: of sine "
        "waves, which have one frequency each, and of gradient noises, which do not. Each is shown "
        "whole, and clamped for samples 0.08 apart: octaves too fine for these are removed at "
        "once, or faded.",
    .run = run_figure};
