// SPDX-License-Identifier: MIT
//
// point: one sample in the middle of the pixel. No blur at all, and all of the alias.
//
// Source: peachey2003, Signal Processing.
#include "aliasing/method.h"

static void sample(const void *parameters, const bl_scene *scene, const double *x, const double *y,
                   size_t count, double *rgb) {
    (void)parameters;
    bl_scene_points(scene, x, y, count, rgb);
}

static double samples(const void *parameters) {
    (void)parameters;
    return 1;
}

static double response(const void *parameters, double fx, double fy) {
    (void)parameters, (void)fx, (void)fy;
    return 1;
}

static const bl_parameter parameters[] = {{0}};

BL_METHOD_DESCRIPTOR(point) = {.name = "point",
                               .title = "point sampling",
                               .summary = "One sample in the middle of the pixel.",
                               .paper = "peachey2003, Signal Processing",
                               .parameters = parameters,
                               .sample = sample,
                               .samples = samples,
                               .response = response};
