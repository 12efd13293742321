// SPDX-License-Identifier: MIT
//
// peachey-2.25: bricks with grooves, and how their shading looks from afar.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

// The mean light of a band of the groove around one brick: red over the brick's own red.
static double light_of(const bl_signal *bump, const bl_signal *flat, double s, double t) {
    double rgb[3], base[3];
    const double at[BL_AXES] = {s, t}, point[BL_AXES] = {0};
    bl_signal_colour(bump, at, point, rgb);
    bl_signal_colour(flat, at, point, base);
    return rgb[0] / base[0];
}

// Over the middle half of a joint's quarter: from its deepest line up to the brick.
static double light_across(const bl_signal *bump, const bl_signal *flat, int vertical, double from,
                           double to) {
    enum { STEPS = 200 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double across = from + (to - from) * (i + 0.5) / STEPS;
        sum += vertical ? light_of(bump, flat, across, 0.045) : light_of(bump, flat, 0.13, across);
    }
    return sum / STEPS;
}

static void claim_all(bl_run *run, const bl_signal *bump, const bl_signal *slope,
                      const bl_signal *flat) {
    double level = light_of(bump, flat, 0.13, 0.045);
    // The first brick's groove: its left and upper sides rise to the right and downwards, so that
    // they look to the left and up; the light comes from the upper left.
    double left = light_across(bump, flat, 1, 0, 0.005);
    double right = light_across(bump, flat, 1, 0.255, 0.26);
    double bottom = light_across(bump, flat, 0, 0.085, 0.09);
    double top = light_across(bump, flat, 0, 0, 0.005);
    bl_make_claim(run, "peachey2003, Bump-Mapped Brick",
                  "Bent normals look like grooves: the side of a brick that faces the light is "
                  "lighter than the one that faces away, left against right.",
                  "light on the slopes, light from the upper left", "of full light", 0.05, 1,
                  bl_exactly(left - right, 400), "places");
    bl_make_claim(run, "peachey2003, Bump-Mapped Brick", "The same, upper against lower side.",
                  "light on the slopes", "of full light", 0.05, 1, bl_exactly(top - bottom, 400),
                  "places");
    bl_make_claim(run, "bandlimit",
                  "Light is not linear in the slope: together, the four slopes around a brick are "
                  "darker than the flat wall.",
                  "mean of the four slopes minus the flat wall", "of full light", -INFINITY, 0,
                  bl_exactly((left + right + top + bottom) / 4 - level, 800), "places");
    const double at[BL_AXES] = {0.1, 0.2}, far[BL_AXES] = {50, 50};
    const double all[BL_AXES] = {INFINITY, INFINITY, INFINITY, INFINITY};
    double mean = bl_signal_filtered(bump, at, all), averaged = bl_signal_filtered(slope, at, far);
    bl_make_claim(run, "peachey2003, Determining the Sampling Rate",
                  "Averaging the height over the pixel is not enough for bumps: from afar averaged "
                  "slopes are flat, and the wall gets too light, by this part of its light.",
                  "filter=slope at 50 units, over the mean", "of the mean", 0.001, 1,
                  bl_exactly(averaged / mean - 1, 65536), "places");
}

static void run_figure(bl_run *run) {
    const bl_signal *bump = bl_run_signal(run, "bumpbrick"), *flat = bl_run_signal(run, "brick");
    const bl_signal *slope = bl_run_signal(run, "bumpbrick:filter=slope");
    const bl_shown shown[] = {
        {.key = "bumps", .title = "bumpbrick", .signal = bump},
        {.key = "flat", .title = "brick, without bumps", .signal = flat},
        {"slope", "averaged slopes, few pixels", .signal = slope, .pixels = 48, .filtered = 1}};
    const bl_pictures pictures = {
        .name = "grooves",
        .alternative =
            "Bricks with mortar in grooves that are light on one side and dark on the other; the "
            "same without grooves; and with 48 by 48 pixels.",
        .shown = shown,
        .count = 3,
        .columns = 3,
        .at = {0.35, 0.2},
        .scale = 0.36,
        .samples = 3,
        .pixels = 48 * (unsigned)bl_run_pick(run, 4, 8, 20),
        .unit = "pictures of 0.36 units"};
    bl_pictures_draw(run, &pictures);
    claim_all(run, bump, slope, flat);
}

BL_FIGURE_DESCRIPTOR(peachey_2_25) = {
    .name = "peachey-2.25",
    .title = "The bump-mapped brick texture",
    .question = "What does a bent normal add to bricks?",
    .paper = "peachey2003, fig. 2.25",
    .shows =
        "A wall whose mortar lies in grooves, 0.003 units deep, lit from one side; the wall "
        "without grooves; and the grooved wall at few pixels, with its slopes averaged over each.",
    .run = run_figure};
