// SPDX-License-Identifier: MIT
//
// least-method: the mean of two points, a quarter of a pixel left and right of the middle.
#include <math.h>

#include "aliasing/method.h"

static void sample(const void *parameters, const bl_scene *scene, const double *x, const double *y,
                   size_t count, double *rgb) {
    (void)parameters;
    for (size_t i = 0; i < count; i++) {
        const double at_x[2] = {x[i] - 0.25, x[i] + 0.25}, at_y[2] = {y[i], y[i]};
        double two[6];
        bl_scene_points(scene, at_x, at_y, 2, two);
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = 0.5 * (two[c] + two[3 + c]);
    }
}

static double samples(const void *parameters) {
    (void)parameters;
    return 2;
}

static double response(const void *parameters, double fx, double fy) {
    (void)parameters, (void)fy;
    return cos(0.5 * M_PI * fx);
}

static const bl_parameter parameters[] = {{0}};

BL_METHOD_DESCRIPTOR(least_method) = {.name = "least-method",
                                      .title = "two points",
                                      .summary = "The mean of two points of the pixel.",
                                      .paper = "bandlimit",
                                      .parameters = parameters,
                                      .sample = sample,
                                      .samples = samples,
                                      .response = response};
