// SPDX-License-Identifier: MIT
//
// The distributions of the values of the signals of a gallery.
#include <math.h>

#include "reports/figures/gallery.h"
#include "spectra/histogram.h"

enum { BINS = 96 };

// The densities over the values, and over the values less the mean in standard deviations, in which
// all signals share one scale. Returns the largest of the latter in *highest.
static void write_histogram(bl_run *run, const bl_gallery *gallery, size_t index,
                            const bl_histogram *h, double *highest) {
    double centre[BINS], density[BINS], deviations[BINS], standard[BINS], normal[BINS];
    double deviation = sqrt(h->variance.value);
    for (size_t b = 0; b < h->settings.bins; b++) {
        double width = h->edges[b + 1] - h->edges[b];
        centre[b] = (h->edges[b] + h->edges[b + 1]) / 2;
        density[b] = (double)h->counts[b] / ((double)h->count * width);
        deviations[b] = deviation > 0 ? (centre[b] - h->mean.value) / deviation : NAN;
        standard[b] = deviation > 0 ? density[b] * deviation : NAN;
        normal[b] = exp(-deviations[b] * deviations[b] / 2) / sqrt(2 * M_PI);
        *highest = fmax(*highest, standard[b]);
    }
    const bl_column columns[] = {{"value", centre, NULL},
                                 {"density_per_unit_of_value", density, NULL},
                                 {"deviations", deviations, NULL},
                                 {"density_per_deviation", standard, NULL},
                                 {"normal_density_per_deviation", normal, NULL}};
    bl_run_csv(run, bl_run_text(run, "histogram-%s", gallery->key[index]),
               bl_run_text(run, "distribution of the values of %s", gallery->signal[index]->text),
               columns, 5, h->settings.bins);
}

// The numbers of a histogram.
typedef struct numbers {
    const char *signal;
    bl_estimate mean, variance;
    double skewness, kurtosis, minimum, maximum, bound_lower, bound_upper;
} numbers;

#define AT(kind, member) NULL, BL_CELL_##kind, .offset = offsetof(numbers, member)
static const bl_field fields[] = {
    {"signal", AT(WORD, signal)},           {"mean", AT(ESTIMATE, mean)},
    {"variance", AT(ESTIMATE, variance)},   {"skewness", AT(REAL, skewness)},
    {"kurtosis", AT(REAL, kurtosis)},       {"minimum", AT(REAL, minimum)},
    {"maximum", AT(REAL, maximum)},         {"bound_lower", AT(REAL, bound_lower)},
    {"bound_upper", AT(REAL, bound_upper)}, {0}};
#undef AT

static numbers numbers_of(const bl_signal *signal, const char *label, const bl_histogram *h) {
    return (numbers){label,
                     h->mean,
                     h->variance,
                     bl_moments_skewness(&h->moments),
                     bl_moments_kurtosis(&h->moments),
                     h->minimum,
                     h->maximum,
                     signal->facts.lower,
                     signal->facts.upper};
}

// Draws those whose values vary.
static void plot_histograms(bl_run *run, const bl_gallery *gallery, const int *varies,
                            const char *title, const char *alternative, double highest) {
    size_t count = 0;
    bl_series *series = bl_run_memory(run, 2 * gallery->count, sizeof *series);
    bl_panel *panels = bl_run_memory(run, gallery->count, sizeof *panels);
    for (size_t i = 0; i < gallery->count; i++) {
        if (!varies[i])
            continue;
        const char *file = bl_run_text(run, "histogram-%s.csv", gallery->key[i]);
        series[2 * i] = (bl_series){BL_STROKE_DASHED,
                                    BL_INK_THEORY,
                                    file,
                                    "deviations",
                                    "normal_density_per_deviation",
                                    NULL,
                                    "normal",
                                    0};
        series[2 * i + 1] = (bl_series){
            BL_STROKE_LINE, BL_INK_MEASURED, file, "deviations", "density_per_deviation",
            NULL,           "measured",      0};
        panels[count++] = (bl_panel){gallery->label[i], series + 2 * i, 2, NULL};
    }
    const bl_plot plot = {
        .title = title,
        .x = {.label = "value less the mean, standard deviations", .from = -4, .to = 4, .tick = 2},
        .y = {.label = "probability density, per standard deviation",
              .to = fmax(0.5, 1.05 * highest),
              .tick = highest < 1 ? 0.2 : 0},
        .panels = panels,
        .panel_count = count,
        .columns = bl_gallery_columns(count),
        .aspect = 0.7};
    if (count)
        bl_run_plot(run, "histograms", &plot, alternative);
}

void bl_gallery_draw_histograms(bl_run *run, const bl_gallery *gallery, size_t samples,
                                const char *title, const char *alternative) {
    bl_histogram_settings settings = bl_run_histogram_settings(run, samples);
    settings.bins = BINS;
    bl_run_setting(run, "samples of the histograms",
                   bl_run_text(run, "%zu places, %d bins", samples, BINS));
    double highest = 0;
    numbers *rows = bl_run_memory(run, gallery->count, sizeof *rows);
    int *varies = bl_run_memory(run, gallery->count, sizeof *varies);
    for (size_t i = 0; i < gallery->count; i++) {
        bl_run_step(run, bl_run_text(run, "histogram of %s", gallery->key[i]));
        const bl_histogram *h = bl_run_histogram(run, gallery->signal[i], &settings);
        rows[i] = numbers_of(gallery->signal[i], gallery->label[i], h);
        varies[i] = h->minimum < h->maximum;
        if (varies[i])
            write_histogram(run, gallery, i, h, &highest);
        else
            bl_run_setting(run, bl_run_text(run, "no histogram of %s", gallery->label[i]),
                           bl_run_text(run, "it is constant: %.9g", h->minimum));
    }
    const bl_table table = {fields, rows, gallery->count, sizeof *rows, .level = 0.95};
    bl_run_table(run, "histograms", "moments and range of the values, with the bounds stated",
                 &table);
    plot_histograms(run, gallery, varies, title, alternative, highest);
}
