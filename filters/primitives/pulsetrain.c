// SPDX-License-Identifier: MIT
//
// pulsetrain: a pulse in every period, the pattern that bricks and stripes are made of.
//
//   pulsetrain(x) = pulse(frac(x / period)), 1 from `low` up to `high` of each period, else 0
//   filtered: see filters/pulse_train.h
//
// Parameters
//   low, high               parts of the period; beyond 0..1 they are clipped, as no fraction is
//                           there. Reversed they make pulses of -1, equal ones make 0
//   period                  any finite number but 0; a negative one mirrors the train, as
//                           x / period falls
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// x modulo the period is exact at any distance (C's fmod is). Bound: 0 and 1 (or -1 and 0); none
// for filters with negative lobes. Infinite width: the mean, high - low. NaN and infinite x give
// NaN. Source: peachey2003, p. 32 and 68.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/pulse_train.h"

#include <math.h>

typedef struct pulsetrain_parameters {
    double low, high, period;
    bl_averaging averaging;
} pulsetrain_parameters;

static double clip(double edge) {
    return edge < 0 ? 0 : edge > 1 ? 1 : edge;
}

static double average(const pulsetrain_parameters *p, const bl_filter *filter, double x,
                      double width) {
    double low = clip(p->low), high = clip(p->high);
    double u = bl_periods(x, p->period), w = width / fabs(p->period);
    if (isinf(width) && !isnan(x))
        return high - low;
    return low <= high ? bl_pulse_train_average(filter, low, high, u, w)
                       : -bl_pulse_train_average(filter, high, low, u, w);
}

BL_PRIMITIVE_ABILITIES(pulsetrain_parameters)

static bl_status validate(const void *block, bl_message *message) {
    const pulsetrain_parameters *p = block;
    if (p->period == 0)
        return bl_report(message, BL_USAGE, "period=0: there is nothing that could repeat");
    return bl_check_averaging(bl_filter_at(p->averaging.filter), p->averaging.width,
                              fabs(p->period), message);
}

static void describe(const void *block, bl_facts *facts) {
    const pulsetrain_parameters *p = block;
    double low = clip(p->low), high = clip(p->high), share = fabs(high - low);
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = low > high ? -1 : 0;
        facts->upper = low < high ? 1 : 0;
        facts->bound_proof = "it has two values, and a nowhere negative kernel averages them";
    }
    facts->mean = high - low;
    if (p->averaging.width == 0)
        facts->variance = share * (1 - share);
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, fabs(p->period));
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(pulsetrain_parameters, low, "0.4", "where each pulse begins, in periods"),
    BL_PRIMITIVE_REAL(pulsetrain_parameters, high, "0.6", "where each pulse ends, in periods"),
    BL_PRIMITIVE_REAL(pulsetrain_parameters, period, "1", "after which it repeats"),
    BL_AVERAGING_PARAMETERS(pulsetrain_parameters),
    {.key = NULL}};

BL_PRIMITIVE_DESCRIPTOR(pulsetrain) = {.name = "pulsetrain",
                                       .title = "periodic pulse",
                                       .summary = "A pulse in every period.",
                                       .formula = "low <= frac(x / period) < high",
                                       .paper = "peachey2003, p. 32",
                                       .dimensions = 1,
                                       .parameters = parameters,
                                       .parameters_size = sizeof(pulsetrain_parameters),
                                       .seed_offset = SIZE_MAX,
                                       .validate = validate,
                                       .describe = describe,
                                       .functions = BL_PRIMITIVE_FUNCTIONS};
