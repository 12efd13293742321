// SPDX-License-Identifier: MIT
//
// One measured curve for each signal of a gallery.
#include "reports/figures/gallery.h"

void bl_gallery_draw_curves(bl_run *run, const bl_gallery *gallery, const double *values,
                            bl_stroke stroke, const char *label, const bl_graph *wanted) {
    bl_line *lines = bl_run_memory(run, gallery->count, sizeof *lines);
    for (size_t i = 0; i < gallery->count; i++)
        lines[i] =
            (bl_line){gallery->key[i], values + i * wanted->points, label, BL_INK_MEASURED, stroke};
    bl_graph graph = *wanted;
    graph.lines = lines;
    graph.line_count = graph.panel_count = gallery->count;
    graph.panels = gallery->label;
    graph.plot.columns = bl_gallery_columns(gallery->count);
    bl_graph_draw(run, &graph);
}
