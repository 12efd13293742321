// SPDX-License-Identifier: MIT
//
// floor: the largest whole number that is not above x.
//
//   floor(x)
//   filtered: x less the averaged fraction (filters/sawtooth.h), taken within the unit, so that no
//   digits are lost far from 0
//
// Parameters
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192
//
// The text's macro casts to an int, which is undefined beyond 2^31. Bound: none. Infinite width has
// no mean over all x, but about x a limit, x - 1/2. NaN gives NaN, infinite x itself.
// Source: peachey2003, p. 33.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/sawtooth.h"

#include <math.h>

typedef struct floor_parameters {
    bl_averaging averaging;
} floor_parameters;

static double average(const floor_parameters *p, const bl_filter *filter, double x, double width) {
    (void)p;
    double whole = trunc(x); // just below 0 the rest keeps its digits
    if (isnan(width) || width == 0 || !isfinite(x))
        return isnan(width) ? width : floor(x);
    return whole + ((x - whole) - bl_sawtooth_average(filter, x - whole, width));
}

BL_PRIMITIVE_ABILITIES(floor_parameters)

BL_PRIMITIVE_VALIDATE(floor_parameters, 1)

static void describe(const void *block, bl_facts *facts) {
    const floor_parameters *p = block;
    *facts = bl_facts_unknown();
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {BL_AVERAGING_PARAMETERS(floor_parameters), {0}};

BL_PRIMITIVE_DESCRIPTOR(floor) = {.name = "floor",
                                  .title = "floor",
                                  .summary = "The largest whole number that is not above x.",
                                  .formula = "floor(x)",
                                  .paper = "peachey2003, p. 33",
                                  .validate = validate,
                                  BL_PRIMITIVE_PARTS(floor_parameters)};
