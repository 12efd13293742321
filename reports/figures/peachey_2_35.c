// SPDX-License-Identifier: MIT
//
// peachey-2.35: graphs of six noises along two lines, one on an edge of the lattice and one at a
// random place, and what the text says about the values at the lattice points and between them.
// Its claims stand in six_values.c.
#include <stdlib.h>

#include "core/random.h"
#include "reports/figures/six_values.h"

enum { CELLS = 20, PER_CELL = 32, POINTS = CELLS * PER_CELL + 1 };

// --- the graphs ---------------------------------------------------------------------------------

typedef struct graphs {
    double x[POINTS];
    double random[BL_SIX][POINTS], edge[BL_SIX][POINTS];
} graphs;

static void draw_line(const bl_signal *signal, double y, double z, double out[POINTS]) {
    float row[POINTS];
    const double start[BL_AXES] = {0, y, z, 0}, step[BL_AXES] = {1.0 / PER_CELL, 0, 0, 0};
    bl_signal_row(signal, start, step, POINTS, row);
    for (int i = 0; i < POINTS; i++)
        out[i] = (double)row[i];
}

static bl_status write_graphs(bl_run *run, const graphs *g, bl_message *message) {
    bl_column columns[1 + 2 * BL_SIX] = {{.name = "x_cells", .values = g->x}};
    for (int i = 0; i < BL_SIX; i++) {
        columns[1 + 2 * i] =
            (bl_column){bl_run_text(run, "%s_random", bl_six_names[i]), g->random[i], NULL};
        columns[2 + 2 * i] =
            (bl_column){bl_run_text(run, "%s_edge", bl_six_names[i]), g->edge[i], NULL};
    }
    return bl_run_csv(run, "graphs",
                      "values along a line at a random place and along a lattice edge", columns,
                      1 + 2 * BL_SIX, POINTS, message);
}

static bl_status plot_graphs(bl_run *run, bl_message *message) {
    bl_series series[BL_SIX][2];
    bl_panel panels[BL_SIX];
    for (int i = 0; i < BL_SIX; i++) {
        series[i][0] = (bl_series){BL_STROKE_THIN,
                                   BL_INK_FOURTH,
                                   "graphs.csv",
                                   "x_cells",
                                   bl_run_text(run, "%s_edge", bl_six_names[i]),
                                   NULL,
                                   "on a lattice edge",
                                   0};
        series[i][1] = (bl_series){BL_STROKE_LINE,
                                   BL_INK_MEASURED,
                                   "graphs.csv",
                                   "x_cells",
                                   bl_run_text(run, "%s_random", bl_six_names[i]),
                                   NULL,
                                   "at a random place",
                                   0};
        panels[i] = (bl_panel){bl_six_names[i], series[i], 2, NULL};
    }
    const bl_limit zero = {0, 0, NULL};
    const bl_plot plot = {.title = "What do the six noises look like along a line?",
                          .x = {"x, lattice cells", 0, CELLS, 5},
                          .y = {"value", -1.6, 1.6, 0.5},
                          .panels = panels,
                          .panel_count = BL_SIX,
                          .columns = 2,
                          .aspect = 0.42,
                          .limits = &zero,
                          .limit_count = 1};
    return bl_run_plot(run, "graphs", &plot,
                       "Six graphs of value over x for 20 cells, each along a lattice edge and "
                       "at a random place. On the edge gnoise returns to zero at every whole x; "
                       "the other lines do not.",
                       message);
}

static bl_status make_graphs(bl_run *run, const bl_six *six, bl_message *message) {
    graphs *g = malloc(sizeof *g);
    if (!g)
        return bl_report(message, BL_DEVICE, "out of memory");
    bl_random random = bl_random_seed(bl_run_settings(run)->seed, 235);
    double y = bl_random_unit(&random), z = bl_random_unit(&random);
    bl_run_setting(run, "line at a random place",
                   bl_run_text(run, "y = %.6f, z = %.6f, x from 0 to %d", y, z, CELLS));
    bl_run_setting(run, "line on a lattice edge", bl_run_text(run, "y = z = 0, the same x"));
    bl_run_setting(run, "samples", bl_run_text(run, "%d a cell", PER_CELL));
    for (int i = 0; i < POINTS; i++)
        g->x[i] = (double)i / PER_CELL;
    for (int i = 0; i < BL_SIX; i++) {
        draw_line(six->signal[i], y, z, g->random[i]);
        draw_line(six->signal[i], 0, 0, g->edge[i]);
    }
    bl_status status = write_graphs(run, g, message);
    free(g);
    return status == BL_OK ? plot_graphs(run, message) : status;
}

static bl_status run_figure(bl_run *run, bl_message *message) {
    bl_six six;
    bl_status status = bl_six_open(run, &six, message);
    if (status != BL_OK)
        return status;
    status = make_graphs(run, &six, message);
    if (status == BL_OK)
        status = bl_six_values_claim(run, &six, message);
    bl_six_close(&six);
    return status;
}

BL_FIGURE_DESCRIPTOR(peachey_2_35) = {
    .name = "peachey-2.35",
    .title = "Graphs of six noises",
    .question = "What do the six noises look like along a line?",
    .paper = "peachey2003, fig. 2.35",
    .shows =
        "Each panel is the graph of one noise over 20 lattice cells. The blue line runs "
        "parallel to the x axis at a random place between the lattice points; the orange one "
        "runs along an edge of the lattice, where gradient noise is pinned to zero at every "
        "whole x. Whether a pattern of the lattice is seen depends on which of the two lines "
        "is taken.",
    .run = run_figure};
