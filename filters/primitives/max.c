// SPDX-License-Identifier: MIT
//
// max: the maximum of x and a constant.
//
//   max(x) = x > low ? x : low
//   filtered: max(x) + w ramp(-|x - low| / w), with the ramp of the filter, which is 0 far from the
//   bend, so that no digits are lost there
//
// Parameters
//   low                     any finite number
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// Bound: none on one side; low on the other, except for filters with negative lobes. Infinite
// width: Plus infinity, as there is no mean. NaN gives NaN, infinite x the limit. Source:
// peachey2003, p. 28.
#include "filters/average.h"
#include "filters/primitive.h"

#include <math.h>

typedef struct max_parameters {
    double low;
    bl_averaging averaging;
} max_parameters;

static double average(const max_parameters *p, const bl_filter *filter, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return INFINITY;
    double plain = x > p->low ? x : p->low;
    return width == 0 || isinf(x) ? plain : plain + bl_filter_bend(filter, x - p->low, width);
}

BL_PRIMITIVE_ABILITIES(max_parameters)

static void describe(const void *block, bl_facts *facts) {
    const max_parameters *p = block;
    *facts = bl_facts_unknown();
    facts->continuity = bl_averaging_continuity(&p->averaging, 0);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(max_parameters, low, "0", "the least value"),
    BL_AVERAGING_PARAMETERS(max_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(max) = {.name = "max",
                                .title = "maximum",
                                .summary = "The maximum of x and a constant.",
                                .formula = "x > low ? x : low",
                                .paper = "peachey2003, p. 28",
                                BL_PRIMITIVE_PARTS(max_parameters)};
