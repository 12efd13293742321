// SPDX-License-Identifier: MIT
//
// least: the mean of two points, a quarter of a pixel left and right of the middle.
#include <math.h>

#include "aliasing/method.h"

static void sample(const void *parameters, const bl_scene *scene, double x, double y,
                   double rgb[3]) {
    double other[3];
    (void)parameters;
    bl_scene_point(scene, x - 0.25, y, rgb);
    bl_scene_point(scene, x + 0.25, y, other);
    for (int c = 0; c < 3; c++)
        rgb[c] = 0.5 * (rgb[c] + other[c]);
}

static double samples(const void *parameters) {
    (void)parameters;
    return 2;
}

static double response(const void *parameters, double fx, double fy) {
    (void)parameters, (void)fy;
    return cos(0.5 * M_PI * fx);
}

static const bl_parameter parameters[] = {{.key = NULL}};

BL_METHOD_DESCRIPTOR(least_method) = {.name = "least",
                                      .title = "two points",
                                      .summary = "The mean of two points of the pixel.",
                                      .paper = "bandlimit",
                                      .parameters = parameters,
                                      .sample = sample,
                                      .samples = samples,
                                      .response = response};
