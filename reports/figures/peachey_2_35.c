// SPDX-License-Identifier: MIT
//
// peachey-2.35: graphs of six noises along two lines, one on an edge of the lattice and one at a
// random place, and what the text says about the values at the lattice points and between them.
// Its claims stand in six_values.c.
#include "reports/figures/six_values.h"

enum { CELLS = 20, PER_CELL = 32 };

static void make_graphs(bl_run *run, const bl_gallery *six) {
    bl_random random = bl_run_random(run, 235);
    double y = bl_random_unit(&random), z = bl_random_unit(&random);
    bl_run_setting(run, "line at a random place",
                   bl_run_text(run, "y = %.6f, z = %.6f, x from 0 to %d", y, z, CELLS));
    bl_run_setting(run, "line on a lattice edge", bl_run_text(run, "y = z = 0, the same x"));
    bl_run_setting(run, "samples", bl_run_text(run, "%d a cell", PER_CELL));
    const bl_gallery_line lines[] = {
        {"edge", "on a lattice edge", {0, 0, 0}, BL_INK_FOURTH, BL_STROKE_THIN},
        {"random", "at a random place", {y, z, 0}, BL_INK_MEASURED, BL_STROKE_LINE}};
    const bl_gallery_graphs graphs = {
        .alternative =
            "Six graphs of value over x for 20 cells, each along a lattice edge and at a random "
            "place. On the edge gnoise returns to zero at every whole x; the other lines do not.",
        .lines = lines,
        .line_count = 2,
        .length = CELLS,
        .steps = CELLS * PER_CELL,
        .y = {.label = "value", .from = -1.6, .to = 1.6, .tick = 0.5},
        .x_label = "x, lattice cells",
        .columns = 2,
        .aspect = 0.42};
    bl_gallery_draw_graphs(run, six, &graphs);
}

static void run_figure(bl_run *run) {
    const bl_gallery six = bl_six_open(run);
    make_graphs(run, &six);
    bl_six_values_claim(run, &six);
}

BL_FIGURE_DESCRIPTOR(peachey_2_35) = {
    .name = "peachey-2.35",
    .title = "Graphs of six noises",
    .question = "What do the six noises look like along a line?",
    .paper = "peachey2003, fig. 2.35",
    .shows =
        "Each panel is the graph of one noise over 20 lattice cells. The blue line runs parallel "
        "to the x axis at a random place between the lattice points; the orange one runs along an "
        "edge of the lattice, where gradient noise is pinned to zero at every whole x. Whether a "
        "pattern of the lattice is seen depends on which of the two lines is taken.",
    .run = run_figure};
