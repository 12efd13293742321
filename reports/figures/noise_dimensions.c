// SPDX-License-Identifier: MIT
//
// noise-dimensions: value and gradient noise in one to four dimensions: what the number of
// dimensions does to the graph, the spectrum along a line, and the variance.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"
#include "spectra/histogram.h"
#include "spectra/psd.h"

enum { SIGNALS = 8 };
static const char *const texts[SIGNALS] = {"vnoise:dims=1", "vnoise:dims=2", "vnoise",
                                           "vnoise:dims=4", "gnoise:dims=1", "gnoise:dims=2",
                                           "gnoise",        "gnoise:dims=4"};

static void draw_graphs(bl_run *run, const bl_gallery *gallery) {
    static const bl_gallery_line lines[] = {
        {"line", "along x", {0.381966, 0.618034, 0.236068}, BL_INK_MEASURED, BL_STROKE_LINE}};
    const bl_gallery_graphs graphs = {
        .title = "What does a line through noise of 1 to 4 dimensions look like?",
        .alternative =
            "Eight graphs of value over x, value noise above and gradient noise below, in 1 to 4 "
            "dimensions: the more dimensions, the smaller the values.",
        .lines = lines,
        .line_count = 1,
        .length = 20,
        .steps = 640,
        .y = {.label = "value"},
        .x_label = "x, lattice cells",
        .columns = 4,
        .aspect = 0.6};
    bl_gallery_draw_graphs(run, gallery, &graphs);
}

static void draw_spectra(bl_run *run, const bl_gallery *gallery) {
    bl_psd_settings settings = bl_run_psd_settings(run, 1);
    settings.averages = bl_run_count(run, 192, 2048, 32768);
    const bl_gallery_spectra spectra =
        bl_gallery_measure_spectra(run, gallery, &settings, "along a line");
    const bl_gallery_spectrum_plot plot = {
        .name = "line",
        .title = "Where in frequency does the power lie along a line, in 1 to 4 dimensions?",
        .alternative =
            "Eight power spectra with their 95 % bands and closed forms. Value noise has one "
            "spectrum along a line whatever its dimensions; gradient noise gains power at low "
            "frequencies with every dimension.",
        .highest = 3,
        .lowest_db = -80,
        .highest_db = 10,
        .tick = 1,
        .tick_db = 20,
        .x_label = "frequency, cycles per lattice cell"};
    bl_gallery_draw_spectra(run, gallery, &spectra, &plot);
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_estimate off = bl_psd_share_off(spectra.psd[i], 0, 0.3);
        bl_make_claim(
            run, "bandlimit",
            "The share of the variance below 0.3 is that of the closed form: measured minus exact.",
            gallery->label[i], "of the variance", -0.02, 0.02, off, "averages");
    }
}

static void claim_variances(bl_run *run, const bl_gallery *gallery) {
    bl_histogram_settings settings =
        bl_run_histogram_settings(run, bl_run_count(run, 1 << 18, 1 << 21, 1 << 25));
    double dims[SIGNALS], variance[SIGNALS], lower[SIGNALS], upper[SIGNALS], exact[SIGNALS];
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_histogram *h = bl_run_histogram(run, gallery->signal[i], &settings);
        dims[i] = gallery->signal[i]->dimensions;
        exact[i] = gallery->signal[i]->facts.variance;
        variance[i] = h->variance.value;
        lower[i] = h->variance.lower;
        upper[i] = h->variance.upper;
        bl_estimate ratio = h->variance;
        ratio.value /= exact[i];
        ratio.lower /= exact[i];
        ratio.upper /= exact[i];
        bl_make_claim(run, "bandlimit", "The variance is the one stated: measured over exact.",
                      gallery->label[i], "", 0.97, 1.03, ratio, "batches");
    }
    const bl_column columns[] = {{.name = "signal", .words = gallery->label},
                                 {"dimensions", dims, NULL},
                                 {"variance", variance, NULL},
                                 {"variance_lower", lower, NULL},
                                 {"variance_upper", upper, NULL},
                                 {"variance_exact", exact, NULL}};
    bl_run_csv(run, "variances", "variance by dimensions, with 95 % intervals", columns, 6,
               gallery->count);
}

static void run_figure(bl_run *run) {
    const bl_gallery gallery = bl_gallery_open(run, texts, SIGNALS);
    draw_graphs(run, &gallery);
    draw_spectra(run, &gallery);
    claim_variances(run, &gallery);
}

BL_FIGURE_DESCRIPTOR(noise_dimensions) = {
    .name = "noise-dimensions",
    .title = "Noise in one to four dimensions",
    .question = "What does the number of dimensions do to a noise?",
    .paper = "peachey2003, note 13",
    .shows =
        "Value and gradient noise in 1, 2, 3 and 4 dimensions: graphs along a line, and the power "
        "spectra along that line with their closed forms.",
    .run = run_figure};
