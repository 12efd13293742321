// SPDX-License-Identifier: MIT
//
// One measured curve for each signal of a gallery.

#include "reports/figures/gallery.h"

static void write_columns(bl_run *run, const bl_gallery *gallery, const bl_gallery_curves *curves) {
    bl_column *columns = bl_run_memory(run, gallery->count + 1, sizeof *columns);
    columns[0] = (bl_column){curves->x_name, curves->x, NULL};
    for (size_t i = 0; i < gallery->count; i++)
        columns[i + 1] = (bl_column){gallery->key[i], curves->values + i * curves->points, NULL};
    bl_run_csv(run, curves->name, curves->what, columns, gallery->count + 1, curves->points);
}

static void plot_columns(bl_run *run, const bl_gallery *gallery, const bl_gallery_curves *curves) {
    bl_series *series = bl_run_memory(run, gallery->count, sizeof *series);
    bl_panel *panels = bl_run_memory(run, gallery->count, sizeof *panels);
    for (size_t i = 0; i < gallery->count; i++) {
        series[i] = (bl_series){.stroke = curves->stroke,
                                .ink = BL_INK_MEASURED,
                                .file = bl_run_text(run, "%s.csv", curves->name),
                                .x = curves->x_name,
                                .y = gallery->key[i],
                                .label = curves->label};
        panels[i] = (bl_panel){gallery->label[i], &series[i], 1, NULL};
    }
    const bl_plot plot = {.title = curves->title,
                          .x = curves->x_axis,
                          .y = curves->y_axis,
                          .panels = panels,
                          .panel_count = gallery->count,
                          .columns = bl_gallery_columns(gallery->count),
                          .aspect = curves->aspect,
                          .limits = curves->limit,
                          .limit_count = curves->limit ? 1 : 0};
    bl_run_plot(run, curves->name, &plot, curves->alternative);
}

void bl_gallery_draw_curves(bl_run *run, const bl_gallery *gallery,
                            const bl_gallery_curves *curves) {
    write_columns(run, gallery, curves);
    plot_columns(run, gallery, curves);
}
