// SPDX-License-Identifier: MIT
//
// Slices of the signals of a gallery, parallel to the xy plane, on one scale of grey.
#include <math.h>

#include "core/grid.h"
#include "core/statistics.h"
#include "reports/figures/gallery.h"

static void fill_slice(bl_run *run, const bl_signal *signal, const bl_gallery_slices *slices,
                       float *out) {
    double pixel = slices->length / (double)slices->pixels;
    bl_grid grid = {.right = {pixel, 0, 0, 0},
                    .down = {0, pixel, 0, 0},
                    .width = slices->pixels,
                    .height = slices->pixels};
    for (int a = 0; a < BL_AXES; a++)
        grid.origin[a] = slices->origin[a];
    bl_grid_fill(bl_run_filtered(run, signal, pixel), &grid, bl_run_settings(run)->threads, out);
}

static void span_deviations(const float *values, size_t count, double deviations, double *black,
                            double *white) {
    bl_moments moments = {.n = 0};
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            bl_moments_add(&moments, (double)values[i]);
    double half = deviations * sqrt(bl_moments_variance(&moments));
    *black = moments.mean - (half > 0 ? half : 1);
    *white = moments.mean + (half > 0 ? half : 1);
}

static const char *write_slice(bl_run *run, const bl_gallery *gallery, size_t index,
                               const bl_gallery_slices *slices, const float *values) {
    double black = slices->black, white = slices->white;
    if (slices->deviations > 0)
        span_deviations(values, slices->pixels * slices->pixels, slices->deviations, &black,
                        &white);
    const bl_attribute signal = {"bandlimit:signal", gallery->signal[index]->text};
    const bl_image image = {.width = slices->pixels,
                            .height = slices->pixels,
                            .values = values,
                            .spacing = slices->length / (double)slices->pixels,
                            .black = black,
                            .white = white,
                            .attributes = &signal,
                            .attribute_count = 1};
    return bl_run_image(run, bl_run_text(run, "%s-%s", gallery->key[index], slices->name), &image);
}

static void plot_slices(bl_run *run, const bl_gallery *gallery, const bl_gallery_slices *slices,
                        const float *values) {
    bl_panel *panels = bl_run_memory(run, gallery->count, sizeof *panels);
    for (size_t i = 0; i < gallery->count; i++) {
        panels[i].title = gallery->label[i];
        panels[i].image =
            write_slice(run, gallery, i, slices, values + i * slices->pixels * slices->pixels);
    }
    const char *unit = slices->unit;
    const bl_plot plot = {
        .title = slices->title,
        .x = {bl_run_text(run, "x, %s", unit), 0, slices->length, slices->length / 4},
        .y = {bl_run_text(run, "y, %s", unit), slices->length, 0, slices->length / 4},
        .panels = panels,
        .panel_count = gallery->count,
        .columns = bl_gallery_columns(gallery->count),
        .aspect = 1,
        .black = slices->black,
        .white = slices->white,
        .pixel = slices->length / (double)slices->pixels,
        .scale_label = slices->deviations > 0 ? "deviations" : "value"};
    bl_run_plot(run, bl_run_text(run, "slices-%s", slices->name), &plot, slices->alternative);
}

// The finite range of all values, or one that is not empty.
static void find_range(const float *values, size_t count, double *black, double *white) {
    *black = INFINITY;
    *white = -INFINITY;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i])) {
            *black = fmin(*black, (double)values[i]);
            *white = fmax(*white, (double)values[i]);
        }
    if (!(*black < *white)) {
        *black = isfinite(*black) ? *black - 1 : 0;
        *white = *black + 2;
    }
}

void bl_gallery_draw_slices(bl_run *run, const bl_gallery *gallery,
                            const bl_gallery_slices *wanted) {
    bl_gallery_slices slices = *wanted;
    size_t pixels = slices.pixels * slices.pixels;
    float *values = bl_run_memory(run, gallery->count * pixels, sizeof *values);
    bl_run_step(run, "slices");
    for (size_t i = 0; i < gallery->count; i++)
        fill_slice(run, gallery->signal[i], &slices, values + i * pixels);
    if (slices.deviations > 0) {
        slices.black = -slices.deviations;
        slices.white = slices.deviations;
    }
    if (slices.black == slices.white)
        find_range(values, gallery->count * pixels, &slices.black, &slices.white);
    plot_slices(run, gallery, &slices, values);
}
