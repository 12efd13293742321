// SPDX-License-Identifier: MIT
//
// ceil: the smallest whole number that is not below x.
//
//   ceil(x) = -floor(-x), filtered or not, as all kernels are even
//   filtered: x and what is missing to the next whole number (filters/sawtooth.h), taken within the
//   unit, so that no digits are lost far from 0
//
// Parameters
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192
//
// The text's macro casts to an int, which is undefined beyond 2^31. Bound: none. Infinite width has
// no mean over all x, but about x a limit, x + 1/2. NaN gives NaN, infinite x itself.
// Source: peachey2003, p. 33.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/sawtooth.h"

#include <math.h>

typedef struct ceil_parameters {
    bl_averaging averaging;
} ceil_parameters;

static double average(const ceil_parameters *p, const bl_filter *filter, double x, double width) {
    (void)p;
    double whole = trunc(x); // just above 0 the rest keeps its digits
    if (isnan(width) || width == 0 || !isfinite(x))
        return isnan(width) ? width : ceil(x);
    return whole - ((whole - x) - bl_sawtooth_average(filter, whole - x, width));
}

BL_PRIMITIVE_ABILITIES(ceil_parameters)

BL_PRIMITIVE_VALIDATE(ceil_parameters, 1)

static void describe(const void *block, bl_facts *facts) {
    const ceil_parameters *p = block;
    *facts = bl_facts_unknown();
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {BL_AVERAGING_PARAMETERS(ceil_parameters), {0}};

BL_PRIMITIVE_DESCRIPTOR(ceil) = {.name = "ceil",
                                 .title = "ceiling",
                                 .summary = "The smallest whole number that is not below x.",
                                 .formula = "-floor(-x)",
                                 .paper = "peachey2003, p. 33",
                                 .validate = validate,
                                 BL_PRIMITIVE_PARTS(ceil_parameters)};
