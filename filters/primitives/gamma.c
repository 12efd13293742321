// SPDX-License-Identifier: MIT
//
// gamma: the curve that corrects a display, a power of x.
//
//   gamma(x) = x^(1 / gamma) on [0, 1]; 0 below and 1 above
//   filtered: the box has the exact mean of the power (filters/unit_curve.h); other filters see
//   filters/average.h
//
// Parameters
//   gamma                   from 1e-6 to 1e6; above 1 it brightens. gamma = 1/g is the inverse of g
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192
//
// Bound: 0 and 1; none for filters with negative lobes. Infinite width: 1/2, because it is 0 on one
// side and 1 on the other. NaN gives NaN, infinite x 0 or 1. The text's pow is not defined below 0,
// and goes on above 1; here the curve maps the unit interval to itself. Source: peachey2003, p. 37.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/unit_curve.h"

typedef struct gamma_parameters {
    double gamma;
    bl_averaging averaging;
} gamma_parameters;

static double average(const gamma_parameters *p, const bl_filter *filter, double x, double width) {
    const bl_unit_curve curve = bl_gamma_curve(p->gamma);
    return bl_unit_curve_average(&curve, filter, x, width);
}

BL_PRIMITIVE_ABILITIES(gamma_parameters)

BL_PRIMITIVE_VALIDATE(gamma_parameters, 1)

static void describe(const void *block, bl_facts *facts) {
    const gamma_parameters *p = block;
    *facts = bl_facts_unknown();
    bl_primitive_unit_facts(&p->averaging, facts);
}

static const bl_parameter parameters[] = {{"gamma", BL_REAL, offsetof(gamma_parameters, gamma),
                                           "2.2", "", .minimum = 1e-6, .maximum = 1e6,
                                           .help = "1 over the exponent"},
                                          BL_AVERAGING_PARAMETERS(gamma_parameters),
                                          {0}};

BL_PRIMITIVE_DESCRIPTOR(gamma) = {.name = "gamma",
                                  .title = "gamma correction",
                                  .summary = "A power of x on the unit interval.",
                                  .formula = "x^(1 / gamma)",
                                  .paper = "peachey2003, p. 37",
                                  .validate = validate,
                                  BL_PRIMITIVE_PARTS(gamma_parameters)};
