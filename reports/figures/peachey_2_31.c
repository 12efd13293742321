// SPDX-License-Identifier: MIT
//
// peachey-2.31: the brick texture with too few samples; its joints seem to vary in width.
#include <math.h>

#include "reports/figures/brick_wall.h"
#include "reports/figures/estimates.h"

static void draw_widths(bl_run *run, const double *place, const double *width) {
    const bl_line line = {"width_mortars", width, "point sampled", BL_INK_MEASURED,
                          BL_STROKE_POINTS};
    bl_wall_draw_widths(run, "level joints of the wall, point sampled", place, &line, 1,
                        "Dots for twenty joints: some at 0, as if there were no mortar, the others "
                        "at one and a half.");
}

// A joint of 0.64 pixels holds the centre of one pixel, which is drawn whole, or of none.
static double distance_from_choice(const double *width) {
    const double pixel = 2.0 / BL_WALL_PIXELS / 0.01; // in thicknesses of the mortar
    double worst = 0;
    for (int k = 0; k < BL_WALL_JOINTS; k++)
        worst = fmax(worst, fmin(fabs(width[k]), fabs(width[k] - pixel)));
    return worst;
}

static void run_figure(bl_run *run) {
    double place[BL_WALL_JOINTS], width[BL_WALL_JOINTS];
    const bl_wall wall = bl_wall_open(run);
    bl_wall_draw(run, &wall, "point", "brick", "What does a brick wall look like aliased?",
                 "Two pictures of a brick wall with joints that are missing in places and a whole "
                 "pixel wide in others, in perspective with false patterns.");
    bl_wall_widths(run, &wall, "point", place, width);
    draw_widths(run, place, width);
    bl_make_claim(run, "peachey2003, Methods of Antialiasing Procedural Textures, fig. 2.31",
                  "With few samples the width of the joints appears to vary in different parts of "
                  "the image: its standard deviation.",
                  "20 level joints along the wall, one sample a pixel", "thicknesses of the mortar",
                  0.1, 10, bl_observed(bl_wall_spread(width), BL_WALL_JOINTS), "joints");
    bl_make_claim(run, "bandlimit",
                  "A joint of 0.64 pixels is drawn a whole pixel wide or not at all: the largest "
                  "distance from the nearer of both.",
                  "the same joints", "thicknesses of the mortar", 0, 1e-9,
                  bl_observed(distance_from_choice(width), BL_WALL_JOINTS), "joints");
}

BL_FIGURE_DESCRIPTOR(peachey_2_31) = {
    .name = "peachey-2.31",
    .title = "The brick texture aliased",
    .question = "What do too few samples do to a brick wall?",
    .paper = "peachey2003, fig. 2.31",
    .shows =
        "A wall of bricks with one sample a pixel, straight ahead and in perspective, and the "
        "widths of its level joints as they are seen along the wall.",
    .run = run_figure};
