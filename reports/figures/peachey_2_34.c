// SPDX-License-Identifier: MIT
//
// peachey-2.34: the brick texture box filtered by its integral, against the aliased one of 2.31.
#include <math.h>

#include "reports/figures/brick_wall.h"
#include "reports/figures/estimates.h"

static const char *const methods[] = {"point", "integral"};
enum { POINT, INTEGRAL, METHODS };

static void draw_widths(bl_run *run, const double *place, double width[METHODS][BL_WALL_JOINTS]) {
    const bl_line lines[METHODS] = {
        {"point_mortars", width[POINT], "point sampled", BL_INK_THEORY, BL_STROKE_POINTS},
        {"integral_mortars", width[INTEGRAL], "box filtered", BL_INK_MEASURED, BL_STROKE_POINTS}};
    bl_wall_draw_widths(run, "level joints of the wall", place, lines, METHODS,
                        "Dots for twenty joints. Point sampled, they jump between 0 and one and a "
                        "half; box filtered, all lie at 1.");
}

static const bl_alias_result *measure(bl_run *run, const bl_wall *wall, const bl_view *view) {
    const bl_alias_settings settings =
        bl_run_alias_settings(run, bl_run_pick(run, 3, 4, 32), bl_run_pick(run, 32, 64, 1024));
    return bl_run_alias(run, wall->brick, view, methods, METHODS, &settings);
}

// What is left of the alias, in dB of the aliased.
static void claim_alias(bl_run *run, const char *reading, const bl_alias_result *result) {
    bl_make_claim(run, "peachey2003, Example: Antialiased Brick Texture",
                  "The filter takes the alias away: its energy over that of point sampling.",
                  reading, "dB", -INFINITY, -6,
                  bl_ratio_db(result->rows[INTEGRAL].alias, result->rows[POINT].alias),
                  "random shifts of the pixels");
}

static void measure_both(bl_run *run, const bl_wall *wall) {
    const bl_alias_result *results[] = {measure(run, wall, wall->flat),
                                        measure(run, wall, wall->perspective)};
    enum { ROWS = 2 * METHODS };
    const char *view[ROWS], *filter[ROWS];
    double alias[ROWS], blur[ROWS], mse[ROWS];
    for (int i = 0; i < ROWS; i++) {
        const bl_alias_row *row = &results[i / METHODS]->rows[i % METHODS];
        view[i] = i < METHODS ? "flat" : "plane";
        filter[i] = methods[i % METHODS];
        alias[i] = row->alias.value;
        blur[i] = row->blur.value;
        mse[i] = row->mse.value;
    }
    const bl_column columns[] = {{"view", NULL, view},
                                 {"filter", NULL, filter},
                                 {"alias", alias, NULL},
                                 {"blur", blur, NULL},
                                 {"mse", mse, NULL}};
    bl_run_csv(run, "energies", "squares of the luminance", columns, 5, ROWS);
    claim_alias(run, "the wall straight ahead", results[0]);
    claim_alias(run, "the wall in perspective", results[1]);
}

static void run_figure(bl_run *run) {
    double place[BL_WALL_JOINTS], width[METHODS][BL_WALL_JOINTS];
    const bl_wall wall = bl_wall_open(run);
    bl_wall_draw(run, &wall, methods[INTEGRAL], "brick",
                 "What does a brick wall look like box filtered?",
                 "Two pictures of a brick wall with faint, even joints, which fade into an even "
                 "grey in the distance.");
    for (int m = 0; m < METHODS; m++)
        bl_wall_widths(run, &wall, methods[m], place, width[m]);
    draw_widths(run, place, width);
    measure_both(run, &wall);
    double worst = 0;
    for (int k = 0; k < BL_WALL_JOINTS; k++)
        worst = fmax(worst, fabs(width[INTEGRAL][k] - 1));
    bl_make_claim(
        run, "peachey2003, Example: Antialiased Brick Texture, fig. 2.34",
        "The widths of the joints are more consistent: their standard deviation over that of the "
        "aliased wall.",
        "20 level joints along the wall", "", 0, 0.5,
        bl_observed(bl_wall_spread(width[INTEGRAL]) / bl_wall_spread(width[POINT]), BL_WALL_JOINTS),
        "joints");
    bl_make_claim(run, "bandlimit",
                  "A box that is a pixel wide shares a joint among pixels without loss: the "
                  "largest difference of its width from that of the mortar.",
                  "the same joints", "thicknesses of the mortar", 0, 1e-9,
                  bl_observed(worst, BL_WALL_JOINTS), "joints");
}

BL_FIGURE_DESCRIPTOR(peachey_2_34) = {
    .name = "peachey-2.34",
    .title = "The brick texture box filtered",
    .question = "What does the integral of a brick save?",
    .paper = "peachey2003, fig. 2.34",
    .shows =
        "The wall of figure 2.31 with the brick's own integral over a pixel, the widths of its "
        "joints in both, and the energy of the alias before and after.",
    .run = run_figure};
