// SPDX-License-Identifier: MIT
//
// One measured curve for each signal of a gallery.
#include <stdlib.h>

#include "reports/figures/gallery.h"

static bl_status write_columns(bl_run *run, const bl_gallery *gallery,
                               const bl_gallery_curves *curves, bl_message *message) {
    bl_column *columns = malloc((gallery->count + 1) * sizeof *columns);
    if (!columns)
        return bl_report(message, BL_DEVICE, "out of memory");
    columns[0] = (bl_column){curves->x_name, curves->x, NULL};
    for (size_t i = 0; i < gallery->count; i++)
        columns[i + 1] = (bl_column){gallery->key[i], curves->values + i * curves->points, NULL};
    bl_status status = bl_run_csv(run, curves->name, curves->what, columns, gallery->count + 1,
                                  curves->points, message);
    free(columns);
    return status;
}

static bl_status plot_columns(bl_run *run, const bl_gallery *gallery,
                              const bl_gallery_curves *curves, bl_message *message) {
    bl_series *series = calloc(gallery->count, sizeof *series);
    bl_panel *panels = calloc(gallery->count, sizeof *panels);
    bl_status status = series && panels ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    for (size_t i = 0; i < gallery->count && status == BL_OK; i++) {
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
    if (status == BL_OK)
        status = bl_run_plot(run, curves->name, &plot, curves->alternative, message);
    free(series);
    free(panels);
    return status;
}

bl_status bl_gallery_draw_curves(bl_run *run, const bl_gallery *gallery,
                                 const bl_gallery_curves *curves, bl_message *message) {
    bl_status status = write_columns(run, gallery, curves, message);
    return status == BL_OK ? plot_columns(run, gallery, curves, message) : status;
}
