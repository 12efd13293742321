// SPDX-License-Identifier: MIT
//
// smoothstep: from 0 to 1 between two edges, by a cubic that is level at both.
//
//   smoothstep(x) = t t (3 - 2 t), t = clamp((x - low) / (high - low), 0, 1)
//   filtered: the box has the exact mean of a cubic over [m - h/2, m + h/2], f(m) + f''(m) h^2 /
//   24; other filters see filters/average.h
//
// Parameters
//   low, high               the edges, any finite numbers. Equal ones make a step from there on.
//                           Reversed ones fall from 1 to 0, 1 - smoothstep of the other order, as
//                           the formula says; the text's listing steps up at low instead
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below (high - low) / 8192
//
// Bound: 0 and 1; none for filters with negative lobes. C1. Infinite width: 1/2. NaN gives NaN,
// infinite x the limits. Source: peachey2003, p. 29.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/unit_curve.h"

#include <math.h>

typedef struct smoothstep_parameters {
    double low, high;
    bl_averaging averaging;
} smoothstep_parameters;

// Rising, between the smaller and the larger edge.
static double rising(const void *block, size_t span, double x) {
    const double *edge = block;
    (void)span;
    return bl_unit_smoothstep((x - edge[0]) / (edge[1] - edge[0]));
}

static double mean(const void *block, size_t span, double from, double length) {
    const double *edge = block;
    double size = edge[1] - edge[0], h = length / size;
    double t = (from + 0.5 * length - edge[0]) / size;
    (void)span;
    return bl_unit_smoothstep(t) + (6 - 12 * t) * (h * h / 24);
}

static double average(const smoothstep_parameters *p, const bl_filter *filter, double x,
                      double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return 0.5;
    const double edge[2] = {fmin(p->low, p->high), fmax(p->low, p->high)};
    const bl_spans spans = {
        .block = edge, .knot = edge, .count = 2, .above = 1, .value = rising, .mean = mean};
    double up;
    if (edge[0] == edge[1])
        up = width > 0 ? filter->step((x - edge[0]) / width) : x >= edge[0];
    else
        up = width > 0 ? bl_average_spans(filter, &spans, x, width) : rising(edge, 0, x);
    return p->low <= p->high ? up : 1 - up;
}

BL_PRIMITIVE_ABILITIES(smoothstep_parameters)

BL_PRIMITIVE_VALIDATE(smoothstep_parameters, fabs(p->high - p->low))

static void describe(const void *block, bl_facts *facts) {
    const smoothstep_parameters *p = block;
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = 0;
        facts->upper = 1;
        facts->bound_proof = "the cubic is monotone, and a nowhere negative kernel averages it";
    }
    facts->mean = 0.5;
    facts->continuity = bl_averaging_continuity(&p->averaging, p->low == p->high ? -1 : 1);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(smoothstep_parameters, low, "0", "where it leaves 0"),
    BL_PRIMITIVE_REAL(smoothstep_parameters, high, "1", "where it reaches 1"),
    BL_AVERAGING_PARAMETERS(smoothstep_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(smoothstep) = {.name = "smoothstep",
                                       .title = "smooth step",
                                       .summary = "From 0 to 1 by a cubic, level at both ends.",
                                       .formula = "t t (3 - 2 t), t = (x - low) / (high - low)",
                                       .paper = "peachey2003, p. 29",
                                       .validate = validate,
                                       BL_PRIMITIVE_PARTS(smoothstep_parameters)};
