// SPDX-License-Identifier: MIT
//
// peachey-2.34: the brick texture box filtered by its integral, against the aliased one of 2.31.
#include <math.h>

#include "reports/figures/brick_wall.h"
#include "reports/figures/estimates.h"

static const char *const methods[] = {"point", "integral"};
enum { POINT, INTEGRAL, METHODS };

static bl_status draw_widths(bl_run *run, const double *place,
                             double width[METHODS][BL_WALL_JOINTS], bl_message *message) {
    const bl_wall_row rows[METHODS] = {
        {"point_mortars", "point sampled", width[POINT], BL_INK_THEORY},
        {"integral_mortars", "box filtered", width[INTEGRAL], BL_INK_MEASURED}};
    return bl_wall_draw_widths(run, "level joints of the wall", place, rows, METHODS,
                               "Dots of twenty joints: point sampled they jump between 0 and one "
                               "and a half, box filtered all lie at 1.",
                               message);
}

static bl_status measure(bl_run *run, const bl_wall *wall, const bl_view *view,
                         bl_alias_result *result, bl_message *message) {
    bl_alias_settings settings = bl_alias_default_settings();
    settings.replicates = (unsigned)bl_run_pick(run, 3, 4, 32);
    settings.finest = (unsigned)bl_run_pick(run, 4, 16, 16);
    settings.most_samples = (uint32_t)bl_run_pick(run, 32, 64, 1024);
    settings.frames = 0;
    settings.rounds = 0;
    settings.seed = bl_run_settings(run)->seed;
    settings.threads = bl_run_settings(run)->threads;
    return bl_alias_measure(wall->brick, view, methods, METHODS, &settings, result, message);
}

// What is left of the alias, in dB of the aliased.
static void claim_alias(bl_run *run, const char *reading, const bl_alias_result *result) {
    bl_make_claim(run, "peachey2003, Example: Antialiased Brick Texture",
                  "The filter takes the alias away: its energy over that of point sampling.",
                  reading, "dB", -INFINITY, -6,
                  bl_ratio_db(result->rows[INTEGRAL].alias, result->rows[POINT].alias),
                  "random shifts of the pixels");
}

static bl_status measure_both(bl_run *run, const bl_wall *wall, bl_message *message) {
    bl_alias_result flat, plane;
    bl_status status = measure(run, wall, &wall->flat, &flat, message);
    if (status != BL_OK)
        return status;
    status = measure(run, wall, &wall->perspective, &plane, message);
    if (status == BL_OK) {
        double alias[] = {flat.rows[POINT].alias.value, flat.rows[INTEGRAL].alias.value,
                          plane.rows[POINT].alias.value, plane.rows[INTEGRAL].alias.value};
        double blur[] = {flat.rows[POINT].blur.value, flat.rows[INTEGRAL].blur.value,
                         plane.rows[POINT].blur.value, plane.rows[INTEGRAL].blur.value};
        double mse[] = {flat.rows[POINT].mse.value, flat.rows[INTEGRAL].mse.value,
                        plane.rows[POINT].mse.value, plane.rows[INTEGRAL].mse.value};
        const char *const view[] = {"flat", "flat", "plane", "plane"};
        const char *const filter[] = {"point", "integral", "point", "integral"};
        const bl_column columns[] = {{"view", NULL, view},
                                     {"filter", NULL, filter},
                                     {"alias", alias, NULL},
                                     {"blur", blur, NULL},
                                     {"mse", mse, NULL}};
        status = bl_run_csv(run, "energies", "squares of the luminance", columns, 5, 4, message);
        claim_alias(run, "the wall straight ahead", &flat);
        claim_alias(run, "the wall in perspective", &plane);
        bl_alias_free(&plane);
    }
    bl_alias_free(&flat);
    return status;
}

static bl_status run_figure(bl_run *run, bl_message *message) {
    double place[BL_WALL_JOINTS], width[METHODS][BL_WALL_JOINTS];
    bl_wall wall;
    bl_status status = bl_wall_open(run, &wall, message);
    if (status != BL_OK)
        return status;
    status = bl_wall_draw(
        run, &wall, methods[INTEGRAL], "brick", "What does a brick wall look like box filtered?",
        "Two pictures of a brick wall with faint, even joints, which fade into an "
        "even grey in the distance.",
        message);
    for (int m = 0; m < METHODS && status == BL_OK; m++)
        status = bl_wall_widths(&wall, methods[m], place, width[m], message);
    if (status == BL_OK)
        status = draw_widths(run, place, width, message);
    if (status == BL_OK)
        status = measure_both(run, &wall, message);
    bl_wall_close(&wall);
    if (status != BL_OK)
        return status;
    double worst = 0;
    for (int k = 0; k < BL_WALL_JOINTS; k++)
        worst = fmax(worst, fabs(width[INTEGRAL][k] - 1));
    bl_make_claim(
        run, "peachey2003, Example: Antialiased Brick Texture, fig. 2.34",
        "The widths of the joints are more consistent: their standard deviation over "
        "that of the aliased wall.",
        "20 level joints along the wall", "", 0, 0.5,
        bl_observed(bl_wall_spread(width[INTEGRAL]) / bl_wall_spread(width[POINT]), BL_WALL_JOINTS),
        "joints");
    bl_make_claim(run, "bandlimit",
                  "A box that is a pixel wide shares a joint among pixels without loss: the "
                  "largest difference of its width from that of the mortar.",
                  "the same joints", "thicknesses of the mortar", 0, 1e-9,
                  bl_observed(worst, BL_WALL_JOINTS), "joints");
    return BL_OK;
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
