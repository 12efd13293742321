// SPDX-License-Identifier: MIT
//
// A wall of bricks seen with few samples: what figures 2.31 (aliased) and 2.34 (filtered) of
// peachey2003 share. The mortar is 0.64 pixels thick.
#ifndef BL_REPORTS_FIGURES_BRICK_WALL_H
#define BL_REPORTS_FIGURES_BRICK_WALL_H

#include "reports/figures/graph.h"
#include "reports/measure.h"

enum { BL_WALL_PIXELS = 128, BL_WALL_JOINTS = 20 };

typedef struct bl_wall {
    const bl_signal *brick;
    const bl_view *flat, *perspective;
} bl_wall;

// Notes the signal and the views as settings.
bl_wall bl_wall_open(bl_run *run);

// Writes NAME-flat and NAME-plane, enlarged four times, as the method gives them, and the plot NAME
// of both.
void bl_wall_draw(bl_run *run, const bl_wall *wall, const char *method, const char *name,
                  const char *title, const char *alternative);

// The widths of BL_WALL_JOINTS level joints of the flat wall from its middle upwards, in
// thicknesses of the mortar: the share of mortar in the pixels about each, summed along a column
// that runs through bricks alone. `place` is the height of the joint, units.
void bl_wall_widths(bl_run *run, const bl_wall *wall, const char *method,
                    double place[BL_WALL_JOINTS], double width[BL_WALL_JOINTS]);

// Writes widths.csv, which `what` describes, and the plot "widths" of lines of BL_WALL_JOINTS.
void bl_wall_draw_widths(bl_run *run, const char *what, const double place[BL_WALL_JOINTS],
                         const bl_line *lines, size_t count, const char *alternative);

// The standard deviation of the widths.
double bl_wall_spread(const double width[BL_WALL_JOINTS]);

#endif
