// SPDX-License-Identifier: MIT
//
// clamp: x, but not below `low` and not above `high`.
//
//   clamp(x) = min(max(x, low), high)
//   filtered: low + w ramp((x - low) / w) - w ramp((x - high) / w), with the ramp of the filter,
//   and where the width is much larger than high - low, the integral against the kernel: the two
//   ramps would lose their digits in the difference
//
// Parameters
//   low, high               any finite numbers. Reversed (low > high) all is `high`: the text's
//                           listing jumps from low to high there, and clamping twice is not
//                           clamping once; its own identity min(max(x, a), b) has neither defect
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// Bound: low and high; none for filters with negative lobes. Infinite width: (low + high) / 2. NaN
// gives NaN, infinite x low or high. Source: peachey2003, p. 28.
#include "filters/average.h"
#include "filters/primitive.h"

#include <math.h>

typedef struct clamp_parameters {
    double low, high;
    bl_averaging averaging;
} clamp_parameters;

static double clamp(const clamp_parameters *p, double x) {
    double raised = x < p->low ? p->low : x;
    return raised > p->high ? p->high : raised;
}

static double identity(const void *block, size_t span, double x) {
    (void)block, (void)span;
    return x;
}

static double middle(const void *block, size_t span, double from, double length) {
    (void)block, (void)span;
    return from + 0.5 * length;
}

static double average(const clamp_parameters *p, const bl_filter *filter, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    if (p->low >= p->high)
        return p->high;
    if (isinf(width))
        return 0.5 * p->low + 0.5 * p->high;
    if (width == 0 || isinf(x))
        return clamp(p, x);
    if (p->high - p->low >= width)
        return clamp(p, x) + (bl_filter_bend(filter, x - p->low, width) -
                              bl_filter_bend(filter, x - p->high, width));
    const double knot[2] = {p->low, p->high};
    const bl_spans spans = {.knot = knot,
                            .count = 2,
                            .below = p->low,
                            .above = p->high,
                            .value = identity,
                            .mean = middle};
    return bl_average_spans(filter, &spans, x, width);
}

BL_PRIMITIVE_ABILITIES(clamp_parameters)

static void describe(const void *block, bl_facts *facts) {
    const clamp_parameters *p = block;
    int reversed = p->low >= p->high;
    *facts = bl_facts_unknown();
    if (reversed || bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = reversed ? p->high : p->low;
        facts->upper = p->high;
        facts->bound_proof = "it is clamped, and a nowhere negative kernel averages it";
    }
    facts->mean = reversed ? p->high : 0.5 * p->low + 0.5 * p->high;
    facts->continuity = bl_averaging_continuity(&p->averaging, 0);
    bl_primitive_period(facts, 0);
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(clamp_parameters, low, "0", "the least value"),
    BL_PRIMITIVE_REAL(clamp_parameters, high, "1", "the largest value"),
    BL_AVERAGING_PARAMETERS(clamp_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(clamp) = {.name = "clamp",
                                  .title = "clamp",
                                  .summary = "x, but within two limits.",
                                  .formula = "min(max(x, low), high)",
                                  .paper = "peachey2003, p. 28",
                                  BL_PRIMITIVE_PARTS(clamp_parameters)};
