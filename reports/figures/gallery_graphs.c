// SPDX-License-Identifier: MIT
//
// Graphs of the signals of a gallery along lines parallel to the x axis.
#include <math.h>

#include "reports/figures/gallery.h"

// The samples of one line, NaN where the signal has none: an image ends.
static void draw_line(const bl_signal *signal, const bl_gallery_graphs *graphs,
                      const bl_gallery_line *line, float *row, double *out) {
    const double start[BL_AXES] = {0, line->across[0], line->across[1], line->across[2]};
    const double step[BL_AXES] = {graphs->length / (double)graphs->steps, 0, 0, 0};
    bl_signal_row(signal, start, step, graphs->steps + 1, row);
    for (size_t i = 0; i <= graphs->steps; i++)
        out[i] = (double)row[i];
}

// A constant, or nothing finite at all, gets an axis with numbers, too.
static bl_axis axis_of_values(const bl_axis *wanted, const double *values, size_t count) {
    bl_axis axis = *wanted;
    double lowest = INFINITY, highest = -INFINITY;
    if (axis.from != axis.to)
        return axis;
    for (size_t i = 0; i < count; i++) {
        lowest = fmin(lowest, values[i]);
        highest = fmax(highest, values[i]);
    }
    if (!(lowest <= highest))
        lowest = highest = 0;
    double margin = highest > lowest ? 0.05 * (highest - lowest) : fmax(1, fabs(highest));
    axis.from = lowest - margin;
    axis.to = highest + margin;
    return axis;
}

void bl_gallery_draw_graphs(bl_run *run, const bl_gallery *gallery,
                            const bl_gallery_graphs *graphs) {
    size_t points = graphs->steps + 1, count = graphs->line_count * gallery->count;
    double *x = bl_run_memory(run, points, sizeof *x);
    double *values = bl_run_memory(run, count * points, sizeof *values);
    float *row = bl_run_memory(run, points, sizeof *row);
    bl_line *lines = bl_run_memory(run, count, sizeof *lines);
    for (size_t i = 0; i < points; i++)
        x[i] = graphs->length * (double)i / (double)graphs->steps;
    for (size_t n = 0; n < count; n++) {
        size_t i = n / graphs->line_count;
        const bl_gallery_line *line = &graphs->lines[n % graphs->line_count];
        draw_line(gallery->signal[i], graphs, line, row, values + n * points);
        lines[n] = (bl_line){bl_run_text(run, "%s_%s", gallery->key[i], line->name),
                             values + n * points, line->label, line->ink, line->stroke};
    }
    const bl_limit zero = {0, 0, NULL};
    bl_graph_draw(
        run, &(bl_graph){.name = "graphs",
                         .what = "values along lines parallel to the x axis",
                         .x_name = "x",
                         .x = x,
                         .points = points,
                         .lines = lines,
                         .line_count = count,
                         .panels = gallery->label,
                         .panel_count = gallery->count,
                         .plot = {.title = graphs->title,
                                  .x = {graphs->x_label, 0, graphs->length, graphs->length / 4},
                                  .y = axis_of_values(&graphs->y, values, count * points),
                                  .columns = graphs->columns ? graphs->columns
                                                             : bl_gallery_columns(gallery->count),
                                  .aspect = graphs->aspect,
                                  .limits = &zero,
                                  .limit_count = 1},
                         .alternative = graphs->alternative});
}
