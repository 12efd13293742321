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

static void plot_graphs(bl_run *run, const bl_gallery *gallery, const bl_gallery_graphs *graphs,
                        bl_axis y) {
    size_t lines = graphs->line_count;
    bl_series *series = bl_run_memory(run, gallery->count * lines, sizeof *series);
    bl_panel *panels = bl_run_memory(run, gallery->count, sizeof *panels);
    for (size_t i = 0; i < gallery->count; i++) {
        for (size_t k = 0; k < lines; k++)
            series[i * lines + k] =
                (bl_series){.stroke = graphs->lines[k].stroke,
                            .ink = graphs->lines[k].ink,
                            .file = "graphs.csv",
                            .x = "x",
                            .y = bl_run_text(run, "%s_%s", gallery->key[i], graphs->lines[k].name),
                            .label = graphs->lines[k].label};
        panels[i] = (bl_panel){gallery->label[i], series + i * lines, lines, NULL};
    }
    const bl_limit zero = {0, 0, NULL};
    const bl_plot plot = {.title = graphs->title,
                          .x = {graphs->x_label, 0, graphs->length, graphs->length / 4},
                          .y = y,
                          .panels = panels,
                          .panel_count = gallery->count,
                          .columns = graphs->columns ? graphs->columns
                                                     : bl_gallery_columns(gallery->count),
                          .aspect = graphs->aspect,
                          .limits = &zero,
                          .limit_count = 1};
    bl_run_plot(run, "graphs", &plot, graphs->alternative);
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
    size_t points = graphs->steps + 1, lines = graphs->line_count * gallery->count;
    double *values = bl_run_memory(run, (lines + 1) * points, sizeof *values), *x = values;
    float *row = bl_run_memory(run, points, sizeof *row);
    bl_column *columns = bl_run_memory(run, lines + 1, sizeof *columns);
    for (size_t i = 0; i < points; i++)
        x[i] = graphs->length * (double)i / (double)graphs->steps;
    columns[0] = (bl_column){"x", x, NULL};
    for (size_t n = 0; n < lines; n++) {
        size_t i = n / graphs->line_count;
        const bl_gallery_line *line = &graphs->lines[n % graphs->line_count];
        draw_line(gallery->signal[i], graphs, line, row, x + (n + 1) * points);
        columns[n + 1] = (bl_column){bl_run_text(run, "%s_%s", gallery->key[i], line->name),
                                     x + (n + 1) * points, NULL};
    }
    bl_run_csv(run, "graphs", "values along lines parallel to the x axis", columns, lines + 1,
               points);
    plot_graphs(run, gallery, graphs, axis_of_values(&graphs->y, x + points, lines * points));
}
