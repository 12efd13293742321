// SPDX-License-Identifier: MIT
//
// sinesum: the text's sum of sine waves, from which clamping is explained.
//
//   v(s) = sum over f = min, 2 min, 4 min, ... < max of  sin(2 pi f s) / f
//   grey = 1/2 + v / (2 sum of 1/f)
//
// Parameters
//   min, max   cycles per unit, 1e-6 to 1e6; defaults 1 and 64: six waves
//   filter   none
//            clamp, fade  waves beyond the Nyquist limit of the width are removed, at once or from
//                         half the limit on. As in noises/octaves/octaves.h, the text's fade fades
//                         its last wave at any width if max is no more than twice its frequency
//            exact        the box average: each wave times sin(pi f w) / (pi f w)
//   width, component   see textures/texture.h
//
// Bound: 0 and 1. Mean: 1/2. Variance: the sum of 1/(2 f^2) over 4 times the square of the sum of
// 1/f. Band: from min to the highest frequency, nothing outside. Period: 1/min. All derivatives.
// NaN and infinite places give NaN. Phases are reduced to half a turn before the sine is taken, so
// that places up to 2^52 / max keep their digits.
//
// Source: peachey2003, section Clamping.
#include "textures/texture.h"

#include <math.h>

#include "noises/octaves/octaves.h"
#include "textures/sampling.h"

typedef struct sine_sum_parameters {
    double least, most;
    bl_seeing seeing;
} sine_sum_parameters;

enum { NONE, CLAMP, FADE, EXACT }; // the first three as bl_octave_clamp
static const char *const filter_words[] = {"none", "clamp", "fade", "exact", NULL};

static double kept_of(const sine_sum_parameters *p, double frequency, double width) {
    return p->seeing.filter == EXACT
               ? bl_filter_box.response(frequency * width)
               : bl_octave_kept(frequency, (bl_octave_clamp)p->seeing.filter, width);
}

static double sum_of_waves(const sine_sum_parameters *p, double s, double width) {
    const bl_octaves_plan plan = bl_octaves_plan_between(p->least, p->most);
    double sum = 0, all = 0;
    for (unsigned i = 0; i < plan.count; i++) {
        double turns = remainder(plan.frequency[i] * s, 1);
        sum += plan.amplitude[i] * kept_of(p, plan.frequency[i], width) * sin(2 * M_PI * turns);
        all += plan.amplitude[i];
    }
    return all > 0 ? sum / all : 0;
}

static bl_colour see(const sine_sum_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    double width = footprint->width[0];
    double grey = isinf(width) ? 0.5 : 0.5 + 0.5 * sum_of_waves(p, at[0], width);
    return (bl_colour){{grey, grey, grey}};
}

BL_TEXTURE_ABILITIES(sine_sum_parameters, 1)

static bl_status validate(const void *block, bl_message *message) {
    const sine_sum_parameters *p = block;
    if (bl_octaves_plan_between(p->least, p->most).count == 0)
        return bl_report(message, BL_USAGE, "min=%g and max=%g leave no wave; max must be larger",
                         p->least, p->most);
    return BL_OK;
}

static void describe(const void *block, bl_facts *facts) {
    const sine_sum_parameters *p = block;
    const bl_octaves_plan plan = bl_octaves_plan_between(p->least, p->most);
    const bl_colour ends[] = {{{0, 0, 0}}, {{1, 1, 1}}};
    double all = 0, squares = 0;
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "the amplitudes add up to 1/2");
    for (unsigned i = 0; i < plan.count; i++) {
        double a = plan.amplitude[i] * kept_of(p, plan.frequency[i], p->seeing.width);
        all += plan.amplitude[i];
        squares += a * a;
    }
    facts->mean = 0.5;
    facts->variance = squares / (8 * all * all);
    facts->continuity = 99;
    facts->period[0] = 1 / p->least;
}

// clang-format off
#define FREQUENCY(field, name, usual, what)                                                        \
    {name, BL_REAL, offsetof(sine_sum_parameters, field), usual, "cycles per unit",                \
     .minimum = 1e-6, .maximum = 1e6, .help = what}
// clang-format on
static const bl_parameter parameters[] = {FREQUENCY(least, "min", "1", "the lowest frequency"),
                                          FREQUENCY(most, "max", "64", "all frequencies are below"),
                                          BL_SEEING_PARAMETERS(sine_sum_parameters, filter_words),
                                          {0}};

BL_TEXTURE_DESCRIPTOR(sine_sum) = {.name = "sinesum",
                                   .title = "sum of sine waves",
                                   .summary = "Sine waves, each twice as fine and half as strong.",
                                   .formula = "1/2 + (sum_f sin(2 pi f s) / f) / (2 sum_f 1/f)",
                                   .paper = "peachey2003, Clamping",
                                   .dimensions = 1,
                                   .parameters = parameters,
                                   .parameters_size = sizeof(sine_sum_parameters),
                                   .validate = validate,
                                   .describe = describe,
                                   .picture = {.scale = 2},
                                   .functions = {BL_TEXTURE_FUNCTIONS}};
