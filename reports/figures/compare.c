// SPDX-License-Identifier: MIT
//
// The figures of the verb `compare`: the gallery of the text for the user's own signals. They claim
// nothing; `check --claims` and `score` tell whether a signal keeps what it states.
#include "reports/compare.h"

#include <math.h>

#include "reports/figures/gallery.h"

static bl_gallery open_gallery(bl_run *run) {
    const bl_reproduce_settings *settings = bl_run_settings(run);
    return bl_gallery_open(run, settings->signals, settings->signal_count);
}

// The length that is drawn: 20 units, or the whole of the smallest signal with a grid.
static double length_of(const bl_gallery *gallery, double wanted) {
    double length = wanted;
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_extent *extent = &gallery->signal[i]->extent;
        for (unsigned a = 0; a < 2; a++)
            if (extent->size[a] > 1)
                length = fmin(length, (double)(extent->size[a] - 1) * extent->spacing[a]);
    }
    return length;
}

// Samples over that length: enough for a smooth curve, and at the pixels of a grid.
static size_t steps_of(const bl_gallery *gallery, double length, size_t wanted) {
    double spacing = length / (double)wanted;
    for (size_t i = 0; i < gallery->count; i++)
        if (gallery->signal[i]->extent.size[0])
            spacing = fmin(spacing, gallery->signal[i]->extent.spacing[0]);
    double steps = round(length / spacing);
    return steps < 4096 ? (size_t)steps : 4096;
}

// --- what is not resolved -----------------------------------------------------------------------

// Warns of a signal that is finer than what a figure shows it by; `command` would show it.
static void warn_of(bl_run *run, const char *label, double rate, const bl_resolution *found,
                    const char *command) {
    if (!(found->times > 1))
        return;
    const char *remedy = isfinite(found->rate) ? bl_run_text(run, "%s would do", command)
                                               : "no rate that was tried would do";
    bl_run_warn(run,
                bl_run_text(run,
                            "%.4g samples a unit do not resolve '%s': %.2g of its variance or "
                            "more lies beyond what they show and folds back; %s (%.2g allowed)",
                            rate, label, found->beyond, remedy, found->allowed));
}

// Graphs and pictures, from the origin along the first one or two axes. The picture that would do
// has the usual 512 pixels.
static void warn_of_pictures(bl_run *run, const bl_gallery *gallery, const double origin[BL_AXES],
                             double length, size_t steps, unsigned sides) {
    const bl_resolution_settings settings = {.allowed = BL_RESOLUTION_PICTURE,
                                             .samples = 0x1p16,
                                             .threads = bl_run_settings(run)->threads};
    const double spacing = length / (double)steps;
    bl_region region = {{0}, {{0}}};
    for (int a = 0; a < BL_AXES; a++)
        region.origin[a] = origin[a];
    for (unsigned d = 0; d < sides; d++)
        region.side[d][d] = length;
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_signal *signal = gallery->signal[i];
        if (sides > 1 && bl_run_filtered(run, signal, spacing) != signal)
            continue; // its slice is filtered
        bl_resolution worst = {.times = 0};
        for (unsigned d = 0; d < sides; d++) {
            double step[BL_AXES] = {0};
            step[d] = spacing;
            bl_resolution found = bl_resolution_measure(signal, &region, step, &settings);
            worst = found.times > worst.times ? found : worst;
        }
        warn_of(run, gallery->label[i], 1 / spacing, &worst,
                bl_run_text(run, "`bandlimit render '%s' --scale %.4g -o FILE`", signal->text,
                            512 / worst.rate));
    }
}

static void warn_of_spectra(bl_run *run, const bl_gallery *gallery,
                            const bl_gallery_spectra *spectra) {
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_psd *psd = spectra->psd[i];
        if (!psd)
            continue;
        const bl_signal *signal = gallery->signal[i];
        const bl_resolution found =
            bl_psd_resolution(signal, &psd->settings, BL_RESOLUTION_SPECTRUM);
        warn_of(run, gallery->label[i], psd->settings.rate, &found,
                bl_run_text(run, "`bandlimit spectrum '%s' --dims %u --rate %.9g`", signal->text,
                            psd->settings.dims, found.rate));
    }
}

// --- along a line -------------------------------------------------------------------------------

static void run_lines(bl_run *run) {
    static const bl_gallery_line lines[] = {
        {"edge", "on a lattice edge, y = z = 0", {0, 0, 0}, BL_INK_FOURTH, BL_STROKE_THIN},
        {"between",
         "between the lattice planes",
         {0.381966, 0.618034, 0.236068},
         BL_INK_MEASURED,
         BL_STROKE_LINE}};
    const bl_gallery gallery = open_gallery(run);
    double length = length_of(&gallery, 20);
    const bl_gallery_graphs graphs = {
        .alternative =
            "Graphs of the value over x, one panel a signal: along the x axis, and along a "
            "parallel between the planes of the lattice.",
        .lines = lines,
        .line_count = 2,
        .length = length,
        .steps = steps_of(&gallery, length, 640),
        .y = {.label = "value"},
        .x_label = "x, units",
        .columns = gallery.count > 1 ? 2 : 1,
        .aspect = 0.42};
    bl_gallery_draw_graphs(run, &gallery, &graphs);
    warn_of_pictures(run, &gallery, (const double[]){0, 0.381966, 0.618034, 0.236068}, length,
                     graphs.steps, 1);
}

static const bl_figure lines_figure = {
    .name = "compare-line",
    .title = "Graphs along a line",
    .question = "What do the signals look like along a line?",
    .paper = "peachey2003, fig. 2.35",
    .shows =
        "Each panel is the graph of one signal along two parallels to the x axis: the axis itself, "
        "which is an edge of the lattice of a lattice noise, and a line between the planes of the "
        "lattice. All share one scale.",
    .run = run_lines};

// --- in a slice ---------------------------------------------------------------------------------

static void run_slices(bl_run *run) {
    const bl_gallery gallery = open_gallery(run);
    double length = length_of(&gallery, 16);
    bl_gallery_slices slices = {
        .name = "between",
        .title = "What do the signals look like in a slice between the lattice planes?",
        .alternative =
            "Grey slices parallel to the xy plane, one panel a signal, on one scale of grey from "
            "the lowest to the highest value of all.",
        .origin = {0, 0, 0.381966, 0.618034},
        .length = length,
        .pixels = steps_of(&gallery, length, 256),
        .unit = "units"};
    bl_gallery_draw_slices(run, &gallery, &slices);
    slices.name = "plane";
    slices.title = "What do the signals look like on a lattice plane?";
    slices.origin[2] = slices.origin[3] = 0;
    bl_gallery_draw_slices(run, &gallery, &slices);
    warn_of_pictures(run, &gallery, slices.origin, length, slices.pixels, 2);
}

static const bl_figure slices_figure = {
    .name = "compare-slice",
    .title = "Slices",
    .question = "What do the signals look like in a slice?",
    .paper = "peachey2003, fig. 2.36",
    .shows =
        "Each panel is a slice parallel to the xy plane, first between two planes of the lattice, "
        "then on one, where the regular zeros of a gradient noise show. All share one scale of "
        "grey, from the lowest to the highest value.",
    .run = run_slices};

// --- the power spectrum -------------------------------------------------------------------------

typedef struct shares {
    const char *signal;
    bl_estimate low, middle, high, beyond;
} shares;

#define AT(member) NULL, BL_CELL_ESTIMATE, .offset = offsetof(shares, member)
static const bl_field share_fields[] = {
    {"signal", NULL, BL_CELL_WORD, .offset = offsetof(shares, signal)},
    {"below_0.3", AT(low)},
    {"in_0.3_0.7", AT(middle)},
    {"in_0.7_1", AT(high)},
    {"above_1", AT(beyond)},
    {0}};
#undef AT

static void write_shares(bl_run *run, const bl_gallery *gallery,
                         const bl_gallery_spectra *spectra) {
    static const bl_estimate none = {NAN, NAN, NAN, NAN, 0};
    shares *rows = bl_run_memory(run, gallery->count, sizeof *rows);
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_psd *psd = spectra->psd[i];
        rows[i] = (shares){gallery->label[i], psd ? bl_psd_share(psd, 0, 0.3) : none,
                           psd ? bl_psd_share(psd, 0.3, 0.7) : none,
                           psd ? bl_psd_share(psd, 0.7, 1) : none,
                           psd ? bl_psd_share(psd, 1, INFINITY) : none};
    }
    const bl_table table = {share_fields, rows, gallery->count, sizeof *rows, .level = 0.95};
    bl_run_table(run, "shares", "shares of the variance along a line, by band", &table);
}

static void run_line_spectra(bl_run *run, const bl_gallery *gallery) {
    bl_psd_settings settings = bl_run_psd_settings(run, 1);
    settings.averages = bl_run_count(run, 192, 1024, 16384);
    const bl_gallery_spectra spectra =
        bl_gallery_measure_spectra(run, gallery, &settings, "along a line");
    const bl_gallery_spectrum_plot plot = {
        .name = "line",
        .title = "Where in frequency does the power lie, along a line?",
        .alternative =
            "Power spectra along a line at a random place, one panel a signal, each with its 95 % "
            "band and, where there is one, the closed form.",
        .highest = 3,
        .lowest_db = -80,
        .highest_db = 10,
        .tick = 0.5,
        .tick_db = 20,
        .x_label = "frequency, cycles per unit"};
    bl_gallery_draw_spectra(run, gallery, &spectra, &plot);
    write_shares(run, gallery, &spectra);
    warn_of_spectra(run, gallery, &spectra);
}

static void run_slice_spectra(bl_run *run, const bl_gallery *gallery) {
    bl_psd_settings settings = bl_run_psd_settings(run, 2);
    settings.size = bl_run_count(run, 128, 256, 512);
    settings.averages = bl_run_count(run, 8, 64, 512);
    const bl_gallery_spectra spectra =
        bl_gallery_measure_spectra(run, gallery, &settings, "in a slice");
    bl_gallery_spectrum_plot plot = {
        .name = "slice",
        .title = "Where in frequency does the power lie, in a slice, by radius?",
        .alternative = "Radial power spectra of slices at random places, one panel a signal.",
        .highest = 3,
        .lowest_db = -80,
        .highest_db = 10,
        .tick = 0.5,
        .tick_db = 20,
        .x_label = "radial frequency, cycles per unit"};
    bl_gallery_draw_spectra(run, gallery, &spectra, &plot);
    plot.title = "How much does the spectrum of a slice prefer directions?";
    plot.alternative =
        "The anisotropy of the rings of the slice spectrum, one panel a signal; the dashed level "
        "is what a signal without preferred directions reads.";
    plot.lowest_db = -25;
    plot.highest_db = 20;
    plot.tick_db = 5;
    bl_gallery_draw_anisotropy(run, gallery, &spectra, &plot);
    warn_of_spectra(run, gallery, &spectra);
}

static void run_spectra(bl_run *run) {
    const bl_gallery gallery = open_gallery(run);
    run_line_spectra(run, &gallery);
    run_slice_spectra(run, &gallery);
}

static const bl_figure spectra_figure = {
    .name = "compare-spectrum",
    .title = "Power spectra",
    .question = "Where in frequency does the power of the signals lie?",
    .paper = "peachey2003, fig. 2.37",
    .shows =
        "Each panel is the power spectrum of one signal: along a line at a random place, with its "
        "95 % band and the closed form where there is one; by radius in a slice; and the "
        "anisotropy of the rings of that slice. shares.csv holds the shares of the variance below "
        "0.3, in 0.3 to 0.7, in 0.7 to 1 and above 1 cycle per unit.",
    .run = run_spectra};

// --- the histogram ------------------------------------------------------------------------------

static void run_histograms(bl_run *run) {
    const bl_gallery gallery = open_gallery(run);
    bl_gallery_draw_histograms(run, &gallery, bl_run_count(run, 1 << 16, 1 << 20, 1 << 24),
                               "How are the values of the signals distributed?",
                               "Densities of the values, one panel a signal, in standard "
                               "deviations from the mean, over the normal density.");
}

static const bl_figure histograms_figure = {
    .name = "compare-histogram",
    .title = "Histograms",
    .question = "How are the values of the signals distributed?",
    .paper = "peachey2003, the paragraph before Spectral Synthesis",
    .shows =
        "Each panel is the density of the values of one signal over random places, with the normal "
        "density, dashed. histograms.csv holds the moments and the range, and the bounds that the "
        "signals state.",
    .run = run_histograms};

const bl_figure *const bl_comparisons[BL_COMPARISONS] = {&lines_figure, &slices_figure,
                                                         &spectra_figure, &histograms_figure};
