// SPDX-License-Identifier: MIT
//
// gain: an S-shaped curve from 0 to 1 through (1/2, 1/2), of two bias curves.
//
//   gain(x) = bias(1 - g, 2 x) / 2 up to 1/2, and 1 - gain(1 - x) above, on [0, 1]; 0 below and 1
//   above. Both forms of bias, power and schlick, make one.
//   filtered: the box has the exact mean (filters/unit_curve.h); other filters see
//   filters/average.h
//
// Parameters
//   g                       from 1e-9 to 1 - 1e-9; gain(1/4) = (1 - g) / 2. 1/2 is the identity,
//                           above it the middle is steep
//   form                    of the bias
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192
//
// The inverse of schlick's form is that of 1 - g, exactly. Schlick's formula with 1/g - 2, without
// the 1 - g, makes the curve of 1 - g; here both forms have the sense of the text.
// Bound: 0 and 1; none for filters with negative lobes. Infinite width: 1/2. NaN gives NaN,
// infinite x 0 or 1. Source: peachey2003, p. 39; schlick1994.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/unit_curve.h"

#include <math.h>

typedef struct gain_parameters {
    double g;
    uint32_t form;
    bl_averaging averaging;
} gain_parameters;

static double at(const void *block, size_t span, double x) {
    return span == 0 ? 0.5 * bl_unit_curve_value(block, 2 * x)
                     : 1 - 0.5 * bl_unit_curve_value(block, 2 * (1 - x));
}

// The upper half from its end on: 1 - x runs from 1 - from - length to 1 - from.
static double mean(const void *block, size_t span, double from, double length) {
    if (span == 0)
        return 0.5 * bl_unit_curve_mean(block, 2 * from, 2 * length);
    double begin = fmax(2 * ((1 - from) - length), 0);
    return 1 - 0.5 * bl_unit_curve_mean(block, begin, 2 * length);
}

static double average(const gain_parameters *p, const bl_filter *filter, double x, double width) {
    static const double knot[3] = {0, 0.5, 1};
    const bl_unit_curve curve = bl_bias_curve(p->form, 1 - p->g);
    const bl_spans spans = {.block = &curve,
                            .knot = knot,
                            .count = 3,
                            .above = 1,
                            .value = at,
                            .mean = mean,
                            .graded = 1};
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return 0.5;
    // 1 - x is exact in the upper half, where the end of the curve would lose digits.
    double mirrored = x > 0.5 ? 1 - x : x;
    double lower =
        width > 0 ? bl_average_spans(filter, &spans, mirrored, width) : at(&curve, 0, mirrored);
    return x > 0.5 ? 1 - lower : lower;
}

BL_PRIMITIVE_ABILITIES(gain_parameters)

BL_PRIMITIVE_VALIDATE(gain_parameters, 1)

static void describe(const void *block, bl_facts *facts) {
    const gain_parameters *p = block;
    *facts = bl_facts_unknown();
    bl_primitive_unit_facts(&p->averaging, facts);
}

static const bl_parameter parameters[] = {
    {"g", BL_REAL, offsetof(gain_parameters, g), "0.7", "", .minimum = 1e-9, .maximum = 1 - 1e-9,
     .help = "how steep the middle is; 1/2: a straight line"},
    {"form", BL_CHOICE, offsetof(gain_parameters, form), "power", "", .choices = bl_curve_words,
     .help = "of its bias: a power, or Schlick's ratio"},
    BL_AVERAGING_PARAMETERS(gain_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(gain) = {
    .name = "gain",
    .title = "gain",
    .summary = "An S-shaped curve of two bias curves.",
    .formula = "bias(1 - g, 2 x) / 2, then 1 - bias(1 - g, 2 - 2 x) / 2",
    .paper = "peachey2003, p. 39",
    .validate = validate,
    BL_PRIMITIVE_PARTS(gain_parameters)};
