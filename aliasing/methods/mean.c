// SPDX-License-Identifier: MIT
//
// mean: a point sample that fades to the mean of the signal where samples stand too far apart.
//
//   t = top * width, the cycles of the highest frequency in a sample
//   colour = mean + (point - mean) clamp((to - t) / (to - from), 0, 1)
//
// With the default ends it is the fade of a last octave (noises/octaves/octaves.h): whole up to
// half the Nyquist limit, gone from the limit on. The width is the largest of all axes of the
// signal.
//
// Parameters
//   top       the highest frequency, cycles per unit; 0: where the signal's stated band ends, or
//             one per unit if it states none
//   from, to  where the fade begins and ends, cycles per sample
//   width     the estimator (filters/sample_width.h)
//
// Source: peachey2003, Alternative Antialiasing Methods (the fade), and Norton, Rockwood and
// Skolmoski 1982.
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "aliasing/method.h"

typedef struct mean_parameters {
    double top, from, to;
    uint32_t width;
} mean_parameters;

static double widest(const mean_parameters *p, const bl_scene *scene, const bl_sight *sight) {
    double most = 0;
    for (unsigned a = 0; a < scene->signal->dimensions && a < BL_AXES; a++)
        most = fmax(most, bl_sample_width((bl_width_estimator)p->width, sight->across[a],
                                          sight->down[a], sight->distance, 1));
    return most;
}

static double kept(const mean_parameters *p, const bl_scene *scene, const bl_sight *sight) {
    double band = scene->signal->facts.band_to;
    double top = p->top > 0 ? p->top : band > 0 && isfinite(band) ? band : 1;
    double t = top * widest(p, scene, sight);
    if (!(p->to > p->from))
        return t < p->to; // the fade has no length
    return fmin(fmax((p->to - t) / (p->to - p->from), 0), 1);
}

static void sample(const void *block, const bl_scene *scene, double x, double y, double rgb[3]) {
    static const double none[BL_AXES] = {0};
    bl_sight sight;
    if (!bl_view_see(scene->view, x, y, &sight)) {
        memcpy(rgb, scene->background, 3 * sizeof *rgb);
        return;
    }
    double share = kept(block, scene, &sight);
    memcpy(rgb, scene->mean, 3 * sizeof *rgb);
    if (share == 0)
        return; // what is not shown need not be computed
    double colour[3];
    bl_signal_colour(scene->signal, sight.at, none, colour);
    for (int c = 0; c < 3; c++)
        rgb[c] += share * (colour[c] - rgb[c]);
}

static double samples(const void *parameters) {
    (void)parameters;
    return 1;
}

static const bl_parameter parameters[] = {
    {.key = "top",
     .kind = BL_REAL,
     .offset = offsetof(mean_parameters, top),
     .maximum = 1e12,
     .fallback = "0",
     .unit = "cycles per unit",
     .help = "the highest frequency; 0: of the signal's band"},
    {.key = "from",
     .kind = BL_REAL,
     .offset = offsetof(mean_parameters, from),
     .maximum = 1e12,
     .fallback = "0.25",
     .unit = "cycles per sample",
     .help = "where the fade begins"},
    {.key = "to",
     .kind = BL_REAL,
     .offset = offsetof(mean_parameters, to),
     .maximum = 1e12,
     .fallback = "0.5",
     .unit = "cycles per sample",
     .help = "where it ends"},
    {.key = "width",
     .kind = BL_CHOICE,
     .offset = offsetof(mean_parameters, width),
     .choices = bl_width_estimator_words,
     .fallback = "maximum",
     .unit = "",
     .help = "how it is estimated from the derivatives"},
    {.key = NULL}};

BL_METHOD_DESCRIPTOR(mean) = {.name = "mean",
                              .title = "fade to the mean",
                              .summary = "A point sample that fades to the mean with the width.",
                              .paper = "peachey2003, Alternative Antialiasing Methods",
                              .parameters = parameters,
                              .parameters_size = sizeof(mean_parameters),
                              .sample = sample,
                              .samples = samples};
