// SPDX-License-Identifier: MIT
//
// The spectra of the signals of a gallery: measured, written and drawn, with their closed forms.
#include <math.h>

#include "reports/figures/gallery.h"

static const double lowest_db = -200; // an empty bin, far below what is drawn

// The samples are floats: what varies at all varies by more than the rounding of a mean in double.
static int is_constant(const bl_psd *psd) {
    return !(psd->variance.value > 1e-24 * psd->mean * psd->mean);
}

bl_gallery_spectra bl_gallery_measure_spectra(bl_run *run, const bl_gallery *gallery,
                                              const bl_psd_settings *settings, const char *what) {
    const bl_psd **psd = bl_run_memory(run, gallery->count, sizeof *psd);
    for (size_t i = 0; i < gallery->count; i++) {
        bl_message why = {""};
        bl_run_step(run, bl_run_text(run, "%s %s", gallery->key[i], what));
        psd[i] = bl_run_fitting_psd(run, gallery->signal[i], settings, &why);
        if (psd[i] && is_constant(psd[i])) {
            psd[i] = NULL;
            bl_report(&why, BL_MISMATCH, "it is constant, and has no power to show");
        }
        if (!psd[i])
            bl_run_setting(run, bl_run_text(run, "no spectrum %s of %s", what, gallery->label[i]),
                           why.text);
    }
    return (bl_gallery_spectra){psd, gallery->count};
}

static double db_of(double density, double reference) {
    return density > 0 ? fmax(10 * log10(density / reference), lowest_db) : lowest_db;
}

// One file a signal, because the frequencies of signals with grids differ.
static void write_spectrum(bl_run *run, const bl_gallery *gallery, size_t index, const bl_psd *psd,
                           const char *name) {
    enum { MEASURED, LOWER, UPPER, THEORY, ANISOTROPY, FLOOR, KINDS };
    static const char *const names[KINDS] = {"power_db",  "lower_db",      "upper_db",
                                             "theory_db", "anisotropy_db", "anisotropy_floor_db"};
    double *values = bl_run_memory(run, KINDS * psd->count, sizeof *values);
    bl_column columns[1 + KINDS] = {{"frequency_cycles_per_unit", psd->frequency, NULL}};
    size_t used = 1;
    for (size_t b = 0; b < psd->count; b++) {
        const double densities[] = {psd->psd[b], psd->lower[b], psd->upper[b],
                                    psd->theory ? psd->theory[b] : NAN};
        double by_radius = psd->measure[b] / psd->width[b];
        for (int k = MEASURED; k <= THEORY; k++)
            values[(size_t)k * psd->count + b] =
                isnan(densities[k]) ? NAN : db_of(densities[k] * by_radius, psd->variance.value);
        if (psd->anisotropy_db) {
            values[ANISOTROPY * psd->count + b] = psd->anisotropy_db[b];
            values[FLOOR * psd->count + b] = psd->anisotropy_floor_db[b];
        }
    }
    for (size_t k = 0; k < KINDS; k++)
        if (k < THEORY || (k == THEORY && psd->theory) || (k > THEORY && psd->anisotropy_db))
            columns[used++] = (bl_column){names[k], values + k * psd->count, NULL};
    bl_run_csv(run, bl_run_text(run, "spectrum-%s-%s", name, gallery->key[index]),
               bl_run_text(run,
                           "power by frequency of %s, dB of the total variance per cycle per unit",
                           gallery->signal[index]->text),
               columns, used, psd->count);
}

// The series of one panel; the bin of frequency 0 is not drawn: the mean is removed there.
static bl_series series_of(bl_run *run, const bl_gallery *gallery, size_t index,
                           const bl_gallery_spectrum_plot *plot, bl_stroke stroke, bl_ink ink,
                           const char *column, const char *upper, const char *label) {
    return (bl_series){.stroke = stroke,
                       .ink = ink,
                       .file =
                           bl_run_text(run, "spectrum-%s-%s.csv", plot->name, gallery->key[index]),
                       .x = "frequency_cycles_per_unit",
                       .y = column,
                       .upper = upper,
                       .label = label,
                       .skip = 1};
}

// What a panel of the plot shows.
typedef enum drawing { POWER, ANISOTROPY_OF_RINGS } drawing;

static size_t fill_panel(bl_run *run, const bl_gallery *gallery, size_t index, const bl_psd *psd,
                         const bl_gallery_spectrum_plot *plot, drawing what, bl_series series[3]) {
    if (what == ANISOTROPY_OF_RINGS) {
        series[0] = series_of(run, gallery, index, plot, BL_STROKE_DASHED, BL_INK_THEORY,
                              "anisotropy_floor_db", NULL, "an isotropic signal");
        series[1] = series_of(run, gallery, index, plot, BL_STROKE_THIN, BL_INK_MEASURED,
                              "anisotropy_db", NULL, "measured");
        return 2;
    }
    series[0] = series_of(run, gallery, index, plot, BL_STROKE_BAND, BL_INK_MEASURED, "lower_db",
                          "upper_db", "95 % band");
    series[1] = series_of(run, gallery, index, plot, BL_STROKE_THIN, BL_INK_MEASURED, "power_db",
                          NULL, "measured");
    series[2] = series_of(run, gallery, index, plot, BL_STROKE_DASHED, BL_INK_THEORY, "theory_db",
                          NULL, "closed form");
    return psd->theory ? 3 : 2;
}

// Draws the panels of all that were measured.
static void draw(bl_run *run, const bl_gallery *gallery, const bl_gallery_spectra *spectra,
                 const bl_gallery_spectrum_plot *wanted, drawing what) {
    bl_series *series = bl_run_memory(run, 3 * gallery->count, sizeof *series);
    bl_panel *panels = bl_run_memory(run, gallery->count, sizeof *panels);
    size_t count = 0;
    for (size_t i = 0; i < gallery->count; i++) {
        if (!spectra->psd[i])
            continue;
        size_t lines = fill_panel(run, gallery, i, spectra->psd[i], wanted, what, series + 3 * i);
        panels[count++] = (bl_panel){gallery->label[i], series + 3 * i, lines, NULL};
    }
    const bl_limit band_end = {1, wanted->limit > 0 ? wanted->limit : 1,
                               wanted->limit > 0 ? wanted->limit_label : "band limit 1"};
    const bl_plot plot = {.title = wanted->title,
                          .x = {.label = wanted->x_label,
                                .from = wanted->lowest,
                                .to = wanted->highest,
                                .tick = wanted->tick,
                                .logarithmic = wanted->logarithmic},
                          .y = {what == POWER ? "power density, dB re (variance / (cycle per unit))"
                                              : "anisotropy, dB",
                                wanted->lowest_db, wanted->highest_db, wanted->tick_db, 0},
                          .panels = panels,
                          .panel_count = count,
                          .columns = bl_gallery_columns(count),
                          .aspect = 0.8,
                          .limits = &band_end,
                          .limit_count = wanted->highest > band_end.at};
    if (count)
        bl_run_plot(
            run, bl_run_text(run, "%s-%s", what == POWER ? "spectra" : "anisotropy", wanted->name),
            &plot, wanted->alternative);
}

void bl_gallery_draw_spectra(bl_run *run, const bl_gallery *gallery,
                             const bl_gallery_spectra *spectra,
                             const bl_gallery_spectrum_plot *plot) {
    for (size_t i = 0; i < gallery->count; i++)
        if (spectra->psd[i])
            write_spectrum(run, gallery, i, spectra->psd[i], plot->name);
    draw(run, gallery, spectra, plot, POWER);
}

void bl_gallery_draw_anisotropy(bl_run *run, const bl_gallery *gallery,
                                const bl_gallery_spectra *spectra,
                                const bl_gallery_spectrum_plot *plot) {
    draw(run, gallery, spectra, plot, ANISOTROPY_OF_RINGS);
}
