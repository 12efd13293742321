// SPDX-License-Identifier: MIT
//
// pulse: 1 from `low` up to `high`, else 0.
//
//   pulse(x) = step(x - low) - step(x - high)
//   filtered: the difference of two filtered steps; their edges keep their digits far from 0, as
//   only distances to edges are divided
//
// Parameters
//   low, high               the edges, any finite numbers. Reversed they make a pulse of -1 from
//                           high up to low, as the difference says; equal edges make 0
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// Bound: 0 and 1 (or -1 and 0); none for filters with negative lobes. Infinite width: 0. NaN gives
// NaN; infinite x gives 0. Source: peachey2003, p. 27.
#include "filters/average.h"
#include "filters/primitive.h"

#include <math.h>

typedef struct pulse_parameters {
    double low, high;
    bl_averaging averaging;
} pulse_parameters;

// Much wider than the pulse, the difference of two steps keeps few digits of what is left: there it
// is the integral of the kernel over the pulse.
static double one(const void *block, size_t span, double x) {
    (void)block, (void)span, (void)x;
    return 1;
}

static double one_mean(const void *block, size_t span, double from, double length) {
    (void)block, (void)span, (void)from, (void)length;
    return 1;
}

static double average(const pulse_parameters *p, const bl_filter *filter, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    double sign = p->low <= p->high ? 1 : -1;
    double knot[2] = {fmin(p->low, p->high), fmax(p->low, p->high)};
    if (isinf(x) || isinf(width))
        return 0;
    if (width == 0)
        return sign * (x >= knot[0] && x < knot[1]);
    if (knot[1] - knot[0] >= width)
        return sign * (filter->step((x - knot[0]) / width) - filter->step((x - knot[1]) / width));
    const bl_spans spans = {.knot = knot, .count = 2, .value = one, .mean = one_mean};
    return sign * bl_average_spans(filter, &spans, x, width);
}

BL_PRIMITIVE_ABILITIES(pulse_parameters)

static void describe(const void *block, bl_facts *facts) {
    const pulse_parameters *p = block;
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = p->low > p->high ? -1 : 0;
        facts->upper = p->low < p->high ? 1 : 0;
        facts->bound_proof = "it has two values, and a nowhere negative kernel averages them";
    }
    facts->mean = 0;
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(pulse_parameters, low, "0", "where it begins"),
    BL_PRIMITIVE_REAL(pulse_parameters, high, "1", "where it ends"),
    BL_AVERAGING_PARAMETERS(pulse_parameters),
    {.key = NULL}};

BL_PRIMITIVE_DESCRIPTOR(pulse) = {.name = "pulse",
                                  .title = "pulse",
                                  .summary = "1 between two edges, else 0.",
                                  .formula = "step(x - low) - step(x - high)",
                                  .paper = "peachey2003, p. 27",
                                  .dimensions = 1,
                                  .parameters = parameters,
                                  .parameters_size = sizeof(pulse_parameters),
                                  .seed_offset = SIZE_MAX,
                                  .describe = describe,
                                  .functions = BL_PRIMITIVE_FUNCTIONS};
