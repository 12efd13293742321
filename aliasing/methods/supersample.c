// SPDX-License-Identifier: MIT
//
// supersample: n x n samples a pixel, weighted by a reconstruction kernel.
//
//   colour = sum_i k(x_i) k(y_i) c(x_i, y_i) / sum_i k(x_i) k(y_i)
//
// with places over the support of the kernel, n along each axis of each pixel of it: a box takes
// n^2, a kernel that reaches two pixels to both sides 16 n^2. (A renderer shares them among
// neighbouring pixels; here each pixel has its own.) A kernel without an end is cut three pixels
// from the middle.
//
// Parameters
//   n        samples a pixel along each axis
//   pattern  where they stand (aliasing/patterns.h); all but regular ones differ from pixel to
//            pixel
//   pixel    the kernel (`bandlimit list filters`)
//
// Source: peachey2003, Alternative Antialiasing Methods; Cook 1986.
#include <math.h>
#include <stddef.h>

#include "aliasing/method.h"
#include "aliasing/patterns.h"
#include "filters/filter.h"

enum { REACH_MOST = 3 };

typedef struct supersample_parameters {
    uint32_t n, pattern, pixel;
} supersample_parameters;

static double reach_of(const bl_filter *filter) {
    return fmin(filter->support, REACH_MOST);
}

static uint32_t side_of(const supersample_parameters *p) {
    return (uint32_t)ceil(2 * reach_of(bl_filter_at(p->pixel)) * p->n);
}

static void sample_pixel(const supersample_parameters *p, const bl_scene *scene, double x, double y,
                         double rgb[3]) {
    const bl_filter *filter = bl_filter_at(p->pixel);
    const uint32_t side = side_of(p);
    const double reach = reach_of(filter);
    const uint64_t key = bl_pattern_key(scene->seed, x, y);
    const int box = filter->support == 0.5; // constant, whatever its two ends are
    double sum[3] = {0, 0, 0}, weights = 0;
    double at_x[BL_BATCH], at_y[BL_BATCH], weight[BL_BATCH], colour[3 * BL_BATCH];
    for (uint32_t done = 0, here; done < side * side; done += here) {
        here = side * side - done < BL_BATCH ? side * side - done : BL_BATCH;
        for (uint32_t i = 0; i < here; i++) {
            double place[2];
            bl_pattern_place((bl_pattern)p->pattern, side, done + i, key, place);
            double right = reach * (2 * place[0] - 1), down = reach * (2 * place[1] - 1);
            weight[i] = box ? 1 : filter->kernel(right) * filter->kernel(down);
            at_x[i] = x + right;
            at_y[i] = y + down;
        }
        bl_scene_points(scene, at_x, at_y, here, colour);
        for (uint32_t i = 0; i < here; i++) {
            for (uint32_t c = 0; c < 3; c++)
                sum[c] += weight[i] * colour[3 * i + c];
            weights += weight[i];
        }
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = sum[c] / weights;
}

static void sample(const void *block, const bl_scene *scene, const double *x, const double *y,
                   size_t count, double *rgb) {
    for (size_t i = 0; i < count; i++)
        sample_pixel(block, scene, x[i], y[i], rgb + 3 * i);
}

static double samples(const void *block) {
    double side = side_of(block);
    return side * side;
}

// Along one axis, of regular places; the product of two is that of the grid.
static double axis_response(const supersample_parameters *p, double frequency) {
    const bl_filter *filter = bl_filter_at(p->pixel);
    const uint32_t side = side_of(p);
    double sum = 0, weights = 0;
    for (uint32_t i = 0; i < side; i++) {
        double t = reach_of(filter) * (2 * (i + 0.5) / side - 1), weight = filter->kernel(t);
        sum += weight * cos(2 * M_PI * frequency * t);
        weights += weight;
    }
    return sum / weights;
}

static double response(const void *block, double fx, double fy) {
    const supersample_parameters *p = block;
    if (p->pattern != BL_PATTERN_REGULAR)
        return NAN;
    return axis_response(p, fx) * axis_response(p, fy);
}

static const bl_parameter parameters[] = {
    {"n", BL_INTEGER, offsetof(supersample_parameters, n), "4", "", .minimum = 1, .maximum = 64,
     .help = "samples a pixel along each axis"},
    {"pattern", BL_CHOICE, offsetof(supersample_parameters, pattern), "regular", "",
     .choices = bl_pattern_words, .help = "where they stand"},
    {"pixel", BL_CHOICE, offsetof(supersample_parameters, pixel), "box", "",
     .choices = bl_filter_words, .help = "the kernel that weights them"},
    {0}};

BL_METHOD_DESCRIPTOR(supersample) = {.name = "supersample",
                                     .title = "supersampling",
                                     .summary = "n x n samples a pixel, weighted by a kernel.",
                                     .paper = "peachey2003, Alternative Antialiasing Methods",
                                     .parameters = parameters,
                                     .parameters_size = sizeof(supersample_parameters),
                                     .sample = sample,
                                     .samples = samples,
                                     .response = response};
