// SPDX-License-Identifier: MIT
//
// noise-zoo: every noise of the registry as the surveys of the field print them: a slice, the
// radial power spectrum and the anisotropy of its rings.
#include <math.h>

#include "reports/figures/all_noises.h"
#include "reports/figures/estimates.h"
#include "spectra/psd.h"

enum { CELLS = 16, PIXELS = 192 };

static bl_psd_settings slice_settings(const bl_run *run) {
    bl_psd_settings settings = bl_run_psd_settings(run, 2);
    settings.rate = 8;
    settings.size = bl_run_count(run, 128, 256, 512);
    settings.averages = bl_run_count(run, 4, 32, 512);
    return settings;
}

// A noise whose closed form is known keeps to it: the share of its variance below the limit.
static void claim_shares(bl_run *run, const bl_gallery *gallery,
                         const bl_gallery_spectra *spectra) {
    for (size_t i = 0; i < gallery->count; i++) {
        if (!spectra->psd[i])
            continue;
        const bl_estimate off = bl_psd_share_off(spectra->psd[i], 0, 1);
        if (isnan(off.value))
            continue;
        bl_make_claim(run, "bandlimit",
                      "The share of the variance below frequency 1 in a slice is that of the "
                      "closed form: measured minus exact.",
                      gallery->label[i], "of the variance", -0.05, 0.05, off, "averages");
    }
}

static void run_figure(bl_run *run) {
    static const bl_gallery_slices slices = {
        .name = "slice",
        .title = "What do all the noises look like?",
        .alternative =
            "A grey slice of 16 by 16 units of every noise, each from 2.5 standard deviations "
            "below its mean, black, to 2.5 above it, white.",
        .origin = {0, 0, 0.381966, 0.618034},
        .length = CELLS,
        .pixels = PIXELS,
        .deviations = 2.5,
        .unit = "units"};
    const bl_gallery gallery = bl_all_noises_open(run);
    bl_gallery_draw_slices(run, &gallery, &slices);
    bl_psd_settings settings = slice_settings(run);
    bl_run_setting(run, "slice spectra",
                   bl_run_text(run, "%zu averages of %zu x %zu samples, %g a unit",
                               settings.averages, settings.size, settings.size, settings.rate));
    bl_gallery_spectrum_plot plot = {
        .name = "slice",
        .title = "Where in frequency does the power of all the noises lie, by radius?",
        .alternative =
            "The radial power spectrum of a slice of every noise, with its band and, where there "
            "is one, the closed form.",
        .highest = 3,
        .lowest_db = -80,
        .highest_db = 20,
        .tick = 1,
        .tick_db = 20,
        .x_label = "radial frequency, cycles per unit"};
    const bl_gallery_spectra spectra =
        bl_gallery_measure_spectra(run, &gallery, &settings, "in a slice");
    bl_gallery_draw_spectra(run, &gallery, &spectra, &plot);
    plot.title = "How much do the spectra of all the noises prefer directions?";
    plot.alternative =
        "The anisotropy of the rings of every slice spectrum; the dashed level is what a noise "
        "without preferred directions reads.";
    plot.lowest_db = -25;
    plot.highest_db = 25;
    plot.tick_db = 10;
    bl_gallery_draw_anisotropy(run, &gallery, &spectra, &plot);
    claim_shares(run, &gallery, &spectra);
}

BL_FIGURE_DESCRIPTOR(noise_zoo) = {
    .name = "noise-zoo",
    .title = "Every noise",
    .question = "What do all the noises look like, and where in frequency does their power lie?",
    .paper = "bandlimit, after the surveys of the field",
    .shows =
        "Every noise with its default settings: a slice, the radial power spectrum of slices at "
        "random places with its closed form where there is one, and the anisotropy of its rings "
        "(Ulichney 1987). A noise of one dimension has no slice spectrum.",
    .run = run_figure};
