// SPDX-License-Identifier: MIT
//
// own: the signal filters itself, for the width that the derivatives of the view give.
//
//   width_a = scale * estimator(da/dx, da/dy) along each axis a of the signal
//
// Every word of a texture's key `filter`, and of the key `clamp` of a sum of octaves, names this
// method with that word; `own` takes the word that the signal's text has.
//
// Parameters
//   width   the estimator (filters/sample_width.h)
//   scale   a factor on it
//   k       of the estimator `distance`: units a unit of distance
//
// Source: peachey2003, Analytic Prefiltering.
#include <stddef.h>

#include "aliasing/method.h"

typedef struct own_parameters {
    uint32_t width;
    double scale, k;
} own_parameters;

static void sample(const void *block, const bl_scene *scene, const double *x, const double *y,
                   size_t count, double *rgb) {
    const own_parameters *p = block;
    const bl_width_rule rule = {(bl_width_estimator)p->width, p->scale, p->k};
    bl_scene_filtered(scene, &rule, x, y, count, rgb);
}

static double samples(const void *parameters) {
    (void)parameters;
    return 1;
}

static const bl_parameter parameters[] = {
    {"width", BL_CHOICE, offsetof(own_parameters, width), "sum", "",
     .choices = bl_width_estimator_words, .help = "how it is estimated from the derivatives"},
    {"scale", BL_REAL, offsetof(own_parameters, scale), "1", "", .maximum = 1e6,
     .help = "a factor on the width"},
    {"k", BL_REAL, offsetof(own_parameters, k), "0.01", "units a unit of distance", .maximum = 1e12,
     .help = "of width=distance"},
    {0}};

BL_METHOD_DESCRIPTOR(own) = {.name = "own",
                             .title = "the signal's own filter",
                             .summary = "The signal filters itself for the width of a sample.",
                             .paper = "peachey2003, Analytic Prefiltering",
                             .parameters = parameters,
                             .parameters_size = sizeof(own_parameters),
                             .sample = sample,
                             .samples = samples};
