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

// Up to BL_BATCH pixels. What is not shown need not be computed.
static void sample_batch(const mean_parameters *p, const bl_scene *scene, const double *x,
                         const double *y, size_t count, double *rgb) {
    bl_gathered shown = {.count = 0};
    double share[BL_BATCH], colour[3 * BL_BATCH];
    for (size_t i = 0; i < count; i++) {
        bl_sight sight;
        int sees = bl_view_see(scene->view, x[i], y[i], &sight);
        memcpy(rgb + 3 * i, sees ? scene->mean : scene->background, 3 * sizeof *rgb);
        share[i] = sees ? kept(p, scene, &sight) : 0;
        if (share[i] != 0)
            bl_gather(&shown, i, sight.at);
    }
    const bl_samples samples = bl_gathered_samples(&shown, &bl_footprint_point, 0);
    bl_signal_colours(scene->signal, &samples, colour);
    for (size_t k = 0; k < shown.count; k++)
        for (size_t c = 0; c < 3; c++) {
            double *out = &rgb[3 * shown.of[k] + c];
            *out += share[shown.of[k]] * (colour[3 * k + c] - *out);
        }
}

static void sample(const void *block, const bl_scene *scene, const double *x, const double *y,
                   size_t count, double *rgb) {
    for (size_t done = 0; done < count; done += BL_BATCH) {
        size_t here = count - done < BL_BATCH ? count - done : BL_BATCH;
        sample_batch(block, scene, x + done, y + done, here, rgb + 3 * done);
    }
}

static double samples(const void *parameters) {
    (void)parameters;
    return 1;
}

static const bl_parameter parameters[] = {
    {"top", BL_REAL, offsetof(mean_parameters, top), "0", "cycles per unit", .maximum = 1e12,
     .help = "the highest frequency; 0: of the signal's band"},
    {"from", BL_REAL, offsetof(mean_parameters, from), "0.25", "cycles per sample", .maximum = 1e12,
     .help = "where the fade begins"},
    {"to", BL_REAL, offsetof(mean_parameters, to), "0.5", "cycles per sample", .maximum = 1e12,
     .help = "where it ends"},
    {"width", BL_CHOICE, offsetof(mean_parameters, width), "maximum", "",
     .choices = bl_width_estimator_words, .help = "how it is estimated from the derivatives"},
    {0}};

BL_METHOD_DESCRIPTOR(mean) = {.name = "mean",
                              .title = "fade to the mean",
                              .summary = "A point sample that fades to the mean with the width.",
                              .paper = "peachey2003, Alternative Antialiasing Methods",
                              .parameters = parameters,
                              .parameters_size = sizeof(mean_parameters),
                              .sample = sample,
                              .samples = samples};
