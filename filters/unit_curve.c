// SPDX-License-Identifier: MIT
#include "filters/unit_curve.h"

#include <math.h>
#include <stddef.h>

#include "filters/average.h"

const char *const bl_curve_words[] = {"power", "schlick", NULL};

bl_unit_curve bl_gamma_curve(double gamma) {
    return (bl_unit_curve){BL_CURVE_POWER, 1 / gamma};
}

// b = (1/2)^exponent; and b = 1/2 / ((1/b - 2) / 2 + 1).
bl_unit_curve bl_bias_curve(bl_curve_form form, double b) {
    return form == BL_CURVE_POWER ? (bl_unit_curve){form, -log2(b)}
                                  : (bl_unit_curve){form, 1 / b - 2};
}

// x / (a (1 - x) + 1); the divisor is 1 + a > 0 at 0 and 1 at 1.
double bl_unit_curve_value(const bl_unit_curve *curve, double x) {
    if (isnan(x) || x <= 0 || x >= 1)
        return isnan(x) ? x : x > 0;
    return curve->form == BL_CURVE_POWER ? pow(x, curve->number)
                                         : x / (curve->number * (1 - x) + 1);
}

// ((from + length)^q - from^q) / (q length), q = exponent + 1. A short length cancels: there it is
// from^q expm1(q log1p(length / from)) / (q length).
static double power_mean(double exponent, double from, double length) {
    double q = exponent + 1, growth = q * log1p(length / from);
    if (length < from && growth < 1)
        return pow(from, exponent) * expm1(growth) / (q * (length / from));
    return (pow(from + length, q) - pow(from, q)) / (q * length);
}

// atanh(z) / z - 1 over z^2, for 0 <= |z| < 1: 1/3 + z^2/5 + z^4/7 + ... up to |z| = 1/4, where the
// first term left out is below 2^-54; beyond it the difference keeps all but some 6 bits.
static double atanh_rest(double z) {
    double square = z * z, sum = 0;
    if (square > 1.0 / 16)
        return (atanh(z) / z - 1) / square;
    for (int n = 27; n >= 3; n -= 2)
        sum = sum * square + 1.0 / n;
    return sum;
}

// The integral of x / (1 + a - a x) is a line and a logarithm, which cancel for short lengths and
// for small a. About the middle m of the length h, with d = 1 + a - a m, it is the value at m and
// (1 + a) a h^2 / (4 d^3) r, r = (atanh(z)/z - 1) / z^2, z = a h / (2 d).
static double schlick_mean(double a, double from, double length) {
    double middle = from + 0.5 * length, d = a * (1 - middle) + 1;
    double z = 0.5 * a * length / d;
    return middle / d + (1 + a) * a * length * length / (4 * d * d * d) * atanh_rest(z);
}

double bl_unit_curve_mean(const bl_unit_curve *curve, double from, double length) {
    if (!(length > 0))
        return bl_unit_curve_value(curve, from);
    return curve->form == BL_CURVE_POWER ? power_mean(curve->number, from, length)
                                         : schlick_mean(curve->number, from, length);
}

static double at(const void *block, size_t span, double x) {
    (void)span;
    return bl_unit_curve_value(block, x);
}

static double mean(const void *block, size_t span, double from, double length) {
    (void)span;
    return bl_unit_curve_mean(block, from, length);
}

double bl_unit_curve_average(const bl_unit_curve *curve, const bl_filter *filter, double x,
                             double width) {
    static const double knot[2] = {0, 1};
    const bl_spans spans = {.block = curve,
                            .knot = knot,
                            .count = 2,
                            .above = 1,
                            .value = at,
                            .mean = mean,
                            .graded = 1};
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return 0.5;
    return width > 0 ? bl_average_spans(filter, &spans, x, width) : bl_unit_curve_value(curve, x);
}
