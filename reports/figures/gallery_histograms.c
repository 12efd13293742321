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

// The numbers of each histogram, a row a signal.
enum {
    MEAN,
    MEAN_LOW,
    MEAN_HIGH,
    VARIANCE,
    VARIANCE_LOW,
    VARIANCE_HIGH,
    SKEWNESS,
    KURTOSIS,
    MINIMUM,
    MAXIMUM,
    BOUND_LOW,
    BOUND_HIGH,
    NUMBERS
};
static const char *const number_names[NUMBERS] = {
    "mean",     "mean_lower", "mean_upper", "variance", "variance_lower", "variance_upper",
    "skewness", "kurtosis",   "minimum",    "maximum",  "bound_lower",    "bound_upper"};

static void fill_numbers(const bl_signal *signal, const bl_histogram *h, double *table, size_t rows,
                         size_t row) {
    const double numbers[NUMBERS] = {h->mean.value,
                                     h->mean.lower,
                                     h->mean.upper,
                                     h->variance.value,
                                     h->variance.lower,
                                     h->variance.upper,
                                     bl_moments_skewness(&h->moments),
                                     bl_moments_kurtosis(&h->moments),
                                     h->minimum,
                                     h->maximum,
                                     signal->facts.lower,
                                     signal->facts.upper};
    for (size_t k = 0; k < NUMBERS; k++)
        table[k * rows + row] = numbers[k];
}

static void write_table(bl_run *run, const bl_gallery *gallery, const double *table) {
    bl_column columns[1 + NUMBERS];
    columns[0] = (bl_column){.name = "signal", .words = gallery->label};
    for (size_t k = 0; k < NUMBERS; k++)
        columns[k + 1] = (bl_column){number_names[k], table + k * gallery->count, NULL};
    bl_run_csv(run, "histograms", "moments and range of the values, with the bounds stated",
               columns, 1 + NUMBERS, gallery->count);
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
    double highest = 0, *table = bl_run_memory(run, NUMBERS * gallery->count, sizeof *table);
    int *varies = bl_run_memory(run, gallery->count, sizeof *varies);
    for (size_t i = 0; i < gallery->count; i++) {
        bl_run_step(run, bl_run_text(run, "histogram of %s", gallery->key[i]));
        const bl_histogram *h = bl_run_histogram(run, gallery->signal[i], &settings);
        fill_numbers(gallery->signal[i], h, table, gallery->count, i);
        varies[i] = h->minimum < h->maximum;
        if (varies[i])
            write_histogram(run, gallery, i, h, &highest);
        else
            bl_run_setting(run, bl_run_text(run, "no histogram of %s", gallery->label[i]),
                           bl_run_text(run, "it is constant: %.9g", h->minimum));
    }
    write_table(run, gallery, table);
    plot_histograms(run, gallery, varies, title, alternative, highest);
}
