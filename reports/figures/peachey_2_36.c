// SPDX-License-Identifier: MIT
//
// peachey-2.36: slices of six noises on one scale of grey, through a random place and on a plane of
// the lattice, and how much of the lattice is seen in them.
// The measures of the grid pattern and their claims stand in six_patterns.c.
#include "reports/figures/six_patterns.h"

enum { CELLS = 16, PER_CELL = 16 };

static void make_slices(bl_run *run, const bl_gallery *six) {
    bl_random random = bl_run_random(run, 236);
    double z = 0.25 + 0.5 * bl_random_unit(&random); // well between two planes
    bl_run_setting(run, "slice at a random place", bl_run_text(run, "z = %.6f", z));
    bl_run_setting(run, "slice on a lattice plane", "z = 0");
    bl_run_setting(run, "image",
                   bl_run_text(run,
                               "%d x %d cells, %d pixels a cell, x to the right, y downwards; grey "
                               "from -1 (black) to 1 (white), beyond them clipped, in PNG",
                               CELLS, CELLS, PER_CELL));
    bl_gallery_slices slices = {
        .name = "random",
        .title = "What do slices between the lattice planes look like?",
        .alternative =
            "Six grey slices of 16 by 16 cells at a random height between two planes of the "
            "lattice. Values beyond -1 and 1 are clipped to black and white.",
        .origin = {0, 0, z, 0},
        .length = CELLS,
        .pixels = CELLS * PER_CELL,
        .black = -1,
        .white = 1,
        .unit = "lattice cells"};
    bl_gallery_draw_slices(run, six, &slices);
    slices.name = "lattice";
    slices.title = "What do slices on a lattice plane look like?";
    slices.alternative =
        "The same six noises on a plane of the lattice, where the zeros of gradient noise form a "
        "grid. Values beyond -1 and 1 are clipped to black and white.";
    slices.origin[2] = 0;
    bl_gallery_draw_slices(run, six, &slices);
}

static void run_figure(bl_run *run) {
    const bl_gallery six = bl_six_open(run);
    make_slices(run, &six);
    bl_six_patterns_claim(run, &six);
}

static const bl_term terms[] = {
    {"lattice contrast",
     "the relative variance, over the places within a cell, of the variance of the noise at that "
     "place. A number without a unit, from 0 for a noise that looks the same at every place of the "
     "cell upwards; 1 means that the variance swings by 100 % of its mean. An estimate may fall "
     "slightly below 0"},
    {"ring anisotropy",
     "how unevenly the power of a slice is spread over the directions on a ring of one radial "
     "frequency: the variance over the ring, over the square of its mean, in dB (Ulichney 1987), "
     "above the level that a noise without preferred directions reads; the mean over the rings "
     "from 0.2 to 1.2 cycles per cell. 0 dB is no preference"},
    {0}};

BL_FIGURE_DESCRIPTOR(peachey_2_36) = {
    .name = "peachey-2.36",
    .title = "Slices of six noises",
    .question = "What do the six noises look like in a slice, and how much of the lattice shows?",
    .paper = "peachey2003, fig. 2.36",
    .terms = terms,
    .shows =
        "Slices of 16 by 16 cells, all on the same scale of grey: first at a random height between "
        "two planes of the lattice, then on a plane, where the regular zeros of gradient noise "
        "show. The claims put two numbers to the grid pattern: how much the variance depends on "
        "the place in the cell, and how much the spectrum prefers directions.",
    .run = run_figure};
