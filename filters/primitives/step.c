// SPDX-License-Identifier: MIT
//
// step: 0 below an edge, 1 from it on.
//
//   step(x) = 1 if x >= edge, else 0
//   filtered: the step of the filter at (x - edge) / width
//
// Parameters
//   edge                    where it steps, any finite number
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// Bound: 0 and 1 for filters that are nowhere negative, which the box is; those with negative lobes
// ring beyond them, and state no bound. Infinite width: 1/2, the mean over all x. NaN gives NaN;
// -inf gives 0, +inf 1. Not periodic, no band, no mean over seeds (it has none).
//
// Source: peachey2003, p. 27 and 64.
#include "filters/primitive.h"

#include <math.h>

typedef struct step_parameters {
    double edge;
    bl_averaging averaging;
} step_parameters;

static double average(const step_parameters *p, const bl_filter *filter, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return 0.5;
    return width > 0 ? filter->step((x - p->edge) / width) : x >= p->edge;
}

BL_PRIMITIVE_ABILITIES(step_parameters)

static void describe(const void *block, bl_facts *facts) {
    const step_parameters *p = block;
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = 0;
        facts->upper = 1;
        facts->bound_proof = "it has two values, and a nowhere negative kernel averages them";
    }
    facts->mean = 0.5;
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(step_parameters, edge, "0", "where it steps from 0 to 1"),
    BL_AVERAGING_PARAMETERS(step_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(step) = {.name = "step",
                                 .title = "step",
                                 .summary = "0 below an edge, 1 from it on.",
                                 .formula = "x >= edge",
                                 .paper = "peachey2003, p. 27",
                                 BL_PRIMITIVE_PARTS(step_parameters)};
