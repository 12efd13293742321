// SPDX-License-Identifier: MIT
//
// Graphs: lines over one x in one panel or several, and the data file that they are drawn from.
#ifndef BL_REPORTS_FIGURES_GRAPH_H
#define BL_REPORTS_FIGURES_GRAPH_H

#include "reports/run.h"

typedef struct bl_line {
    const char *column;   // of the data file, with the unit
    const double *values; // one for each x; NaN: none
    const char *label;    // in the legend; NULL: not in it
    bl_ink ink;
    bl_stroke stroke;
} bl_line;

typedef struct bl_graph {
    const char *name;   // of the data file and of the plot
    const char *what;   // at the head of the data file
    const char *x_name; // of its first column, with the unit
    const double *x;
    size_t points;
    const bl_line *lines; // of the panels, one after the other; each panel has as many
    size_t line_count;
    const char *const *panels; // their titles; NULL: one panel without a title
    size_t panel_count;
    bl_plot plot; // its title, axes, columns, aspect and limits
    const char *alternative;
} bl_graph;

// Writes NAME.csv and the plot NAME.
void bl_graph_draw(bl_run *run, const bl_graph *graph);

#endif
