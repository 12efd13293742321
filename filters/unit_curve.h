// SPDX-License-Identifier: MIT
//
// Monotone curves from the unit interval to itself, which gamma, bias and gain are made of: a power
// of x, and the ratio of two lines that Schlick (1994) puts in the place of bias; and the cubic of
// smoothstep.
#ifndef BL_FILTERS_UNIT_CURVE_H
#define BL_FILTERS_UNIT_CURVE_H

#include <stdint.h>

#include "filters/filter.h"

typedef enum bl_curve_form { BL_CURVE_POWER, BL_CURVE_SCHLICK } bl_curve_form;

extern const char *const bl_curve_words[]; // "power", "schlick", NULL

typedef struct bl_unit_curve {
    bl_curve_form form;
    double number; // the exponent, above 0; or 1/b - 2, above -1
} bl_unit_curve;

bl_unit_curve bl_gamma_curve(double gamma);                // x^(1/gamma)
bl_unit_curve bl_bias_curve(bl_curve_form form, double b); // b at 1/2, 0 < b < 1

// The curve at x, clamped to 0 and 1 outside of [0, 1]; NaN for NaN. Pure.
double bl_unit_curve_value(const bl_unit_curve *curve, double x);
// Its mean over [from, from + length] within [0, 1]: an exact integral, in forms that keep their
// digits at any length; the value for length 0. Pure.
double bl_unit_curve_mean(const bl_unit_curve *curve, double from, double length);

// The curve averaged about x over samples of this width; 1/2 for an infinite one, because it is 0
// on one side and 1 on the other. NaN for NaN, and as bl_average_spans says. Pure.
double bl_unit_curve_average(const bl_unit_curve *curve, const bl_filter *filter, double x,
                             double width);

// Smoothstep between 0 and 1, u^2 (3 - 2 u), clamped outside; NaN for NaN.
static inline double bl_unit_smoothstep(double u) {
    return u <= 0 ? 0 : u >= 1 ? 1 : u * u * (3 - 2 * u);
}

// Its integral from 0 up to u in [0, 1]; 1/2 over all of it.
static inline double bl_unit_smoothstep_integral(double u) {
    return u * u * u * (1 - 0.5 * u);
}

#endif
