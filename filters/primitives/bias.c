// SPDX-License-Identifier: MIT
//
// bias: a monotone curve from 0 to 1 that is b in the middle.
//
//   form=power     bias(x) = x^(ln b / ln (1/2))
//   form=schlick   bias(x) = x / ((1/b - 2)(1 - x) + 1), a hyperbola without a power
//   on [0, 1]; 0 below and 1 above
//   filtered: the box has the exact mean (filters/unit_curve.h); other filters see
//   filters/average.h
//
// Parameters
//   b                       from 1e-9 to 1 - 1e-9, the value at 1/2
//   form                    as above
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192
//
// The inverse of schlick's form is that of 1 - b, exactly; that of the power is the power
// 2^(-1 / e) for b = 2^-e, another bias, but not that of 1 - b, unless b = 1/2.
// Bound: 0 and 1; none for filters with negative lobes. Infinite width: 1/2. NaN gives NaN,
// infinite x 0 or 1. Source: peachey2003, p. 38; schlick1994.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/unit_curve.h"

typedef struct bias_parameters {
    double b;
    uint32_t form;
    bl_averaging averaging;
} bias_parameters;

static double average(const bias_parameters *p, const bl_filter *filter, double x, double width) {
    const bl_unit_curve curve = bl_bias_curve(p->form, p->b);
    return bl_unit_curve_average(&curve, filter, x, width);
}

BL_PRIMITIVE_ABILITIES(bias_parameters)

BL_PRIMITIVE_VALIDATE(bias_parameters, 1)

static void describe(const void *block, bl_facts *facts) {
    const bias_parameters *p = block;
    *facts = bl_facts_unknown();
    bl_primitive_unit_facts(&p->averaging, facts);
}

static const bl_parameter parameters[] = {
    {"b", BL_REAL, offsetof(bias_parameters, b), "0.7", "", .minimum = 1e-9, .maximum = 1 - 1e-9,
     .help = "the value at 1/2"},
    {"form", BL_CHOICE, offsetof(bias_parameters, form), "power", "", .choices = bl_curve_words,
     .help = "a power, or Schlick's ratio of two lines"},
    BL_AVERAGING_PARAMETERS(bias_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(bias) = {.name = "bias",
                                 .title = "bias",
                                 .summary = "A monotone curve that is b in the middle.",
                                 .formula = "x^(ln b / ln (1/2)), or x / ((1/b - 2)(1 - x) + 1)",
                                 .paper = "peachey2003, p. 38",
                                 .validate = validate,
                                 BL_PRIMITIVE_PARTS(bias_parameters)};
