// SPDX-License-Identifier: MIT
//
// checkerboard: squares of two shades of grey by the parity of row and column.
//
//   x(s, t) = (1 + q(s) q(t)) / 2,  q = 1 in even squares and -1 in odd ones
//   colour = mix(dark, light, x),  dark = 0.05, light = 0.9
//
// Parameters
//   size     of a square, units; default 1
//   filter   none
//            exact  the box average: q(s) and q(t) are independent, so the average of their product
//                   is the product of their averages
//            fade   the point's colour goes over to the mean between half the Nyquist limit of the
//                   pattern's fundamental, 1/(2 size), and the limit
//            mean   the mean colour for every width above 0
//   width, component   see textures/texture.h
//
// Bound: between dark and light. Mean: half way. Variance of the raw form: (light - dark)^2 / 4.
// Period: two squares along both axes. NaN and infinite places give NaN.
//
// Source: peachey2003, p. 39.
#include "textures/texture.h"

#include <math.h>

#include "filters/pulse_train.h"
#include "filters/octave_fade.h"
#include "textures/sampling.h"

typedef struct checkerboard_parameters {
    double size;
    bl_seeing seeing;
} checkerboard_parameters;

enum { NONE, EXACT, FADE, MEAN };
static const char *const filter_words[] = {"none", "exact", "fade", "mean", NULL};
static const bl_colour dark = {{0.05, 0.05, 0.05}}, light = {{0.9, 0.9, 0.9}};

static double share_of_light(const checkerboard_parameters *p, const double at[BL_AXES],
                             const bl_footprint *footprint) {
    double product = 1;
    for (int a = 0; a < 2; a++) {
        double period = 2 * p->size,
               w = p->seeing.filter == EXACT ? footprint->width[a] / period : 0;
        product *= 2 * bl_pulse_train_average(&bl_filter_box, 0, 0.5, at[a] / period, w) - 1;
    }
    if (p->seeing.filter == FADE)
        product *= bl_octave_kept(0.5 / p->size, BL_CLAMP_FADE, bl_footprint_widest(footprint, 2));
    return 0.5 + 0.5 * product;
}

static bl_colour see(const checkerboard_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    int all = bl_footprint_is_whole(footprint, 2) ||
              (p->seeing.filter == MEAN && bl_footprint_widest(footprint, 2) > 0);
    return bl_colour_mix(dark, light, all ? 0.5 : share_of_light(p, at, footprint));
}

BL_TEXTURE_ABILITIES(checkerboard_parameters, 2)

static void describe(const void *block, bl_facts *facts) {
    const checkerboard_parameters *p = block;
    const bl_colour ends[] = {dark, light};
    int point = p->seeing.width == 0 || p->seeing.filter == NONE;
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between two colours");
    bl_texture_mean(facts, p->seeing.component, bl_colour_mix(dark, light, 0.5));
    if (point)
        facts->variance = 0.25 * 0.85 * 0.85;
    facts->continuity = point || p->seeing.filter == FADE ? -1 : p->seeing.filter == MEAN ? 99 : 0;
    facts->period[0] = facts->period[1] = 2 * p->size;
}

static const bl_parameter parameters[] = {
    {"size", BL_REAL, offsetof(checkerboard_parameters, size), "1", "units", .minimum = 1e-6,
     .maximum = 1e6, .help = "of a square"},
    BL_SEEING_PARAMETERS(checkerboard_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(checkerboard) = {
    .name = "checkerboard",
    .title = "checkerboard",
    .summary = "Squares of two shades of grey by the parity of row and column.",
    .formula = "mix(dark, light, (1 + q(s) q(t)) / 2)",
    .paper = "peachey2003, p. 39",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(checkerboard_parameters),
    .describe = describe,
    .picture = {.scale = 8},
    .functions = {BL_TEXTURE_FUNCTIONS}};
