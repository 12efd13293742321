// SPDX-License-Identifier: MIT
//
// min: the minimum of x and a constant.
//
//   min(x) = x < high ? x : high
//   filtered: min(x) - w ramp(-|x - high| / w), with the ramp of the filter, which is 0 far from
//   the bend, so that no digits are lost there
//
// Parameters
//   high                    any finite number
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// Bound: none on one side; high on the other, except for filters with negative lobes. Infinite
// width: minus infinity, as there is no mean. NaN gives NaN, infinite x the limit. Source:
// peachey2003, p. 28.
#include "filters/average.h"
#include "filters/primitive.h"

#include <math.h>

typedef struct min_parameters {
    double high;
    bl_averaging averaging;
} min_parameters;

static double average(const min_parameters *p, const bl_filter *filter, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return -INFINITY;
    double plain = x < p->high ? x : p->high;
    return width == 0 || isinf(x) ? plain : plain - bl_filter_bend(filter, x - p->high, width);
}

BL_PRIMITIVE_ABILITIES(min_parameters)

static void describe(const void *block, bl_facts *facts) {
    const min_parameters *p = block;
    *facts = bl_facts_unknown();
    facts->continuity = bl_averaging_continuity(&p->averaging, 0);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(min_parameters, high, "1", "the largest value"),
    BL_AVERAGING_PARAMETERS(min_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(min) = {.name = "min",
                                .title = "minimum",
                                .summary = "The minimum of x and a constant.",
                                .formula = "x < high ? x : high",
                                .paper = "peachey2003, p. 28",
                                BL_PRIMITIVE_PARTS(min_parameters)};
