// SPDX-License-Identifier: MIT
//
// abs: x without its sign.
//
//   abs(x) = |x|
//   filtered: |x| + 2 w ramp(-|x| / w), with the ramp of the filter, which is 0 far from the bend
//
// Parameters
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// Bound: none above; infinite width gives infinity, as there is no mean. NaN gives NaN, infinite x
// infinity. Source: peachey2003, p. 29.
#include "filters/average.h"
#include "filters/primitive.h"

#include <math.h>

typedef struct abs_parameters {
    bl_averaging averaging;
} abs_parameters;

static double average(const abs_parameters *p, const bl_filter *filter, double x, double width) {
    (void)p;
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(x) || isinf(width))
        return INFINITY;
    return width == 0 ? fabs(x) : fabs(x) + 2 * bl_filter_bend(filter, x, width);
}

BL_PRIMITIVE_ABILITIES(abs_parameters)

static void describe(const void *block, bl_facts *facts) {
    const abs_parameters *p = block;
    *facts = bl_facts_unknown();
    facts->continuity = bl_averaging_continuity(&p->averaging, 0);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {BL_AVERAGING_PARAMETERS(abs_parameters), {0}};

BL_PRIMITIVE_DESCRIPTOR(abs) = {.name = "abs",
                                .title = "absolute value",
                                .summary = "x without its sign.",
                                .formula = "|x|",
                                .paper = "peachey2003, p. 29",
                                BL_PRIMITIVE_PARTS(abs_parameters)};
