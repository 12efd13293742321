// SPDX-License-Identifier: MIT
#include "reports/figures/brick_wall.h"

#include <math.h>

#include "aliasing/scene.h"
#include "textures/texture.h"

enum { ENLARGED = 4, SIDE = ENLARGED * BL_WALL_PIXELS };

// A brick and its mortar, as the text has them, and a wall of 2 units: 64 pixels a unit.
static const char brick_text[] = "brick:brick_width=0.25,brick_height=0.08,mortar=0.01";
static const double mortar = 0.01, row_height = 0.09, row_width = 0.26;

bl_wall bl_wall_open(bl_run *run) {
    const bl_wall wall = {.brick = bl_run_signal(run, brick_text),
                          .flat = bl_run_view(run, "flat:scale=2", BL_WALL_PIXELS, BL_WALL_PIXELS),
                          .perspective =
                              bl_run_view(run, "plane:height=0.5,fov=60,pitch=30,rotate=10",
                                          BL_WALL_PIXELS, BL_WALL_PIXELS)};
    bl_run_setting(run, "texture", brick_text);
    bl_run_setting(run, "views", "flat:scale=2 and plane:height=0.5,pitch=30,rotate=10");
    bl_run_setting(run, "image",
                   bl_run_text(run, "%d x %d pixels", BL_WALL_PIXELS, BL_WALL_PIXELS));
    return wall;
}

// The image of a method, 3 values a pixel of BL_WALL_PIXELS^2.
static const double *take_image(bl_run *run, const bl_wall *wall, const bl_view *view,
                                const char *text) {
    double *rgb = bl_run_memory(run, 3 * (size_t)BL_WALL_PIXELS * BL_WALL_PIXELS, sizeof *rgb);
    const bl_method *method = bl_run_method(run, text, wall->brick);
    bl_scene scene;
    double seen;
    bl_run_must(run, bl_scene_make(wall->brick, view, 1, &scene, &seen, bl_run_message(run)));
    scene.signal = method->signal;
    bl_scene_image(&(bl_scene_method){&scene, method->kind, method->parameters}, 1, rgb);
    return rgb;
}

static const char *write_image(bl_run *run, const bl_wall *wall, const bl_view *view,
                               const char *method, const char *name) {
    const double *rgb = take_image(run, wall, view, method);
    float *values = bl_run_memory(run, (size_t)SIDE * SIDE, sizeof *values);
    for (size_t j = 0; j < SIDE; j++)
        for (size_t i = 0; i < SIDE; i++)
            values[j * SIDE + i] = (float)bl_colour_component(
                &rgb[3 * (j / ENLARGED * BL_WALL_PIXELS + i / ENLARGED)], 0);
    const bl_attribute attributes[] = {{"bandlimit:signal", wall->brick->text},
                                       {"bandlimit:view", view->text},
                                       {"bandlimit:filter", method}};
    const bl_image image = {.width = SIDE,
                            .height = SIDE,
                            .values = values,
                            .black = 0.2,
                            .white = 0.52,
                            .attributes = attributes,
                            .attribute_count = 3};
    return bl_run_image(run, name, &image);
}

void bl_wall_draw(bl_run *run, const bl_wall *wall, const char *method, const char *name,
                  const char *title, const char *alternative) {
    const char *flat =
        write_image(run, wall, wall->flat, method, bl_run_text(run, "%s-flat", name));
    const char *plane =
        write_image(run, wall, wall->perspective, method, bl_run_text(run, "%s-plane", name));
    const bl_panel panels[] = {{"straight ahead", NULL, 0, flat},
                               {"in perspective", NULL, 0, plane}};
    const bl_plot plot = {.title = title,
                          .x = {"pixels", 0, BL_WALL_PIXELS, 32, 0},
                          .y = {"pixels", BL_WALL_PIXELS, 0, 32, 0},
                          .panels = panels,
                          .panel_count = 2,
                          .columns = 2,
                          .aspect = 1,
                          .black = 0.2,
                          .white = 0.52,
                          .pixel = 1.0 / ENLARGED,
                          .scale_label = "luminance"};
    bl_run_plot(run, name, &plot, alternative);
}

// The pixel column nearest to a quarter of a brick: in rows that are shifted by a half it is at
// three quarters, so that it meets no upright joint.
static size_t column_through_bricks(const bl_wall *wall) {
    size_t best = 0;
    double least = INFINITY;
    for (size_t i = BL_WALL_PIXELS / 2; i < BL_WALL_PIXELS; i++) {
        bl_sight sight;
        bl_view_see(wall->flat, (double)i + 0.5, 0.5, &sight);
        double s = sight.at[0] / row_width, off = fabs(s - floor(s) - 0.25);
        if (off < least) {
            least = off;
            best = i;
        }
    }
    return best;
}

void bl_wall_widths(bl_run *run, const bl_wall *wall, const char *method,
                    double place[BL_WALL_JOINTS], double width[BL_WALL_JOINTS]) {
    const double *rgb = take_image(run, wall, wall->flat, method);
    const double bricks = 0.2126 * 0.5 + 0.7152 * 0.15 + 0.0722 * 0.14, joints = 0.5;
    const double pixel = 2.0 / BL_WALL_PIXELS;
    const size_t column = column_through_bricks(wall);
    for (int k = 0; k < BL_WALL_JOINTS; k++) {
        place[k] = row_height * (k - BL_WALL_JOINTS / 2);
        width[k] = 0;
    }
    for (size_t j = 0; j < BL_WALL_PIXELS; j++) {
        bl_sight sight;
        bl_view_see(wall->flat, (double)column + 0.5, (double)j + 0.5, &sight);
        double luminance = bl_colour_component(&rgb[3 * (j * BL_WALL_PIXELS + column)], 0);
        double k = nearbyint(sight.at[1] / row_height) + BL_WALL_JOINTS / 2;
        if (k >= 0 && k < BL_WALL_JOINTS) // the joint that the pixel stands nearest to
            width[(size_t)k] += (luminance - bricks) / (joints - bricks) * pixel / mortar;
    }
}

double bl_wall_spread(const double width[BL_WALL_JOINTS]) {
    bl_moments moments = {0};
    for (int k = 0; k < BL_WALL_JOINTS; k++)
        bl_moments_add(&moments, width[k]);
    return sqrt(bl_moments_variance(&moments));
}

void bl_wall_draw_widths(bl_run *run, const char *what, const double place[BL_WALL_JOINTS],
                         const bl_line *lines, size_t count, const char *alternative) {
    static const char *const title = "level joints, from the bottom up";
    static const bl_limit mortar_itself = {0, 1, "the mortar"};
    bl_graph_draw(run, &(bl_graph){.name = "widths",
                                   .what = what,
                                   .x_name = "height_units",
                                   .x = place,
                                   .points = BL_WALL_JOINTS,
                                   .lines = lines,
                                   .line_count = count,
                                   .panels = &title,
                                   .panel_count = 1,
                                   .plot = {.title = "How wide do the joints look?",
                                            .x = {"height of the joint, units", -1, 1, 0.25, 0},
                                            .y = {"width, thicknesses of the mortar", -0.2, 2, 0.5},
                                            .aspect = 0.4,
                                            .limits = &mortar_itself,
                                            .limit_count = 1},
                                   .alternative = alternative});
}
