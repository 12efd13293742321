// SPDX-License-Identifier: MIT
//
// mix: from one value to another, linearly.
//
//   mix(x) = (1 - x) a + x b for x in [0, 1], exactly a at 0 and exactly b at 1; beyond it
//   a + x (b - a), which goes on straight and does not cancel
//   filtered: itself, as all kernels are even
//
// Parameters
//   a, b                    the values at 0 and 1, any finite numbers
//   width, filter, anchor   of a sample (filters/primitive.h); only the anchor matters
//
// Not clamped. Bound: none, except for a = b. Infinite width: about x the value itself. NaN gives
// NaN, infinite x the limit. Source: peachey2003, p. 24.
#include "filters/primitive.h"

#include <math.h>

typedef struct mix_parameters {
    double a, b;
    bl_averaging averaging;
} mix_parameters;

static double average(const mix_parameters *p, const bl_filter *filter, double x, double width) {
    (void)filter;
    if (isnan(x) || isnan(width))
        return NAN;
    if (p->a == p->b)
        return p->a;
    return x >= 0 && x <= 1 ? (1 - x) * p->a + x * p->b : p->a + x * (p->b - p->a);
}

BL_PRIMITIVE_ABILITIES(mix_parameters)

static void describe(const void *block, bl_facts *facts) {
    const mix_parameters *p = block;
    *facts = bl_facts_unknown();
    if (p->a == p->b) {
        facts->lower = facts->upper = facts->mean = p->a;
        facts->bound_proof = "both values are the same";
    }
    facts->continuity = 99;
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(mix_parameters, a, "0", "the value at 0"),
    BL_PRIMITIVE_REAL(mix_parameters, b, "1", "the value at 1"),
    BL_AVERAGING_PARAMETERS(mix_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(mix) = {.name = "mix",
                                .title = "mix",
                                .summary = "From one value to another, linearly.",
                                .formula = "(1 - x) a + x b",
                                .paper = "peachey2003, p. 24",
                                BL_PRIMITIVE_PARTS(mix_parameters)};
