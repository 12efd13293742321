// SPDX-License-Identifier: MIT
//
// peachey-2.17: a ball that reflects the sky.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

// What a ball of nearly the picture's size reflects towards a viewer at y = -infinity: z is up.
static int reflect(double x, double y, double at[BL_AXES]) {
    double s = x / 0.95, t = y / 0.95, depth = 1 - s * s - t * t;
    if (depth < 0)
        return 0;
    double n[3] = {s, -sqrt(depth), t}, towards = -n[1]; // n . v, v = (0, -1, 0)
    at[0] = 2 * n[0] * towards;
    at[1] = 2 * n[1] * towards + 1;
    at[2] = 2 * n[2] * towards;
    return 1;
}

static double look(const bl_signal *signal, double altitude, double width, double rgb[3]) {
    double z = 2 * altitude - 1;
    const double at[BL_AXES] = {sqrt(fmax(1 - z * z, 0)), 0, z};
    bl_signal_colour(signal, at, (const double[BL_AXES]){0, 0, width}, rgb);
    return bl_signal_filtered(signal, at, (const double[BL_AXES]){0, 0, width});
}

static void claim_all(bl_run *run, const bl_signal *signal) {
    enum { STEPS = 4096 };
    double palest = 0, lightest = -1, rise = -INFINITY, before = INFINITY, rgb[3];
    size_t dark = 0;
    for (int i = 0; i <= STEPS; i++) {
        double altitude = (double)i / STEPS, light = look(signal, altitude, 0, rgb);
        if (light > lightest) {
            lightest = light;
            palest = altitude;
        }
        dark += rgb[2] <= 0 && altitude < 0.5;
        if (altitude >= 0.5) {
            rise = fmax(rise, light - before);
            before = light;
        }
    }
    bl_make_claim(run, "peachey2003, Splines and Mappings",
                  "The colours go from brown earth below to pale bluish white at the horizon: the "
                  "altitude of the lightest colour; the horizon is 0.5.",
                  "the lightest of 4097 altitudes", "of the altitudes", 0.49, 0.51,
                  bl_exactly(palest, STEPS + 1), "altitudes");
    bl_make_claim(run, "peachey2003, Splines and Mappings",
                  "From the horizon up the sky gets deeper: the largest rise of light from one "
                  "altitude to the next.",
                  "luminance, 2049 altitudes from the horizon up", "of luminance", -INFINITY, 0,
                  bl_observed(rise, STEPS / 2), "altitudes");
    bl_make_claim(run, "bandlimit",
                  "A Catmull-Rom spline undershoots: blue must be cut off at 0 where brown earth "
                  "meets the pale horizon. The share of all altitudes.",
                  "blue cut at 0, below the horizon", "of the altitudes", 0.001, 0.2,
                  bl_exactly((double)dark / (STEPS + 1), STEPS + 1), "altitudes");
}

static void run_figure(bl_run *run) {
    const bl_shown shown[] = {
        {.key = "ball", .title = "reflected sky", .text = "metallic", .see = reflect}};
    const bl_pictures pictures = {.name = "reflection",
                                  .title = "What does a polished ball reflect?",
                                  .alternative =
                                      "A ball: brown below, white along a line below its middle, "
                                      "and blue above, darkest at the top of what it reflects.",
                                  .shown = shown,
                                  .count = 1,
                                  .samples = 3,
                                  .pixels = (unsigned)bl_run_pick(run, 192, 384, 1024),
                                  .unit = "of the picture"};
    bl_signal *signal = bl_run_signal(run, "metallic");
    bl_pictures_draw(run, &pictures);
    claim_all(run, signal);
}

BL_FIGURE_DESCRIPTOR(peachey_2_17) = {
    .name = "peachey-2.17",
    .title = "A spline-based reflection",
    .question = "What does a map from altitude to colour make of a ball?",
    .paper = "peachey2003, fig. 2.17",
    .shows =
        "A ball seen from afar that reflects a sky: the altitude of the reflected direction is "
        "looked up in a spline of brown, white and blues.",
    .run = run_figure};
