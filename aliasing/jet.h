// SPDX-License-Identifier: MIT
//
// Second-order arithmetic in two variables: a value with its two first and three second
// derivatives, through which a formula carries its own exact derivatives along.
//
//   f(j) has  f' d,  and  f'' d_i d_j + f' d_ij
#ifndef BL_ALIASING_JET_H
#define BL_ALIASING_JET_H

#include <math.h>

typedef struct bl_jet {
    double value;
    double first[2];  // by x, by y
    double second[3]; // xx, xy, yy
} bl_jet;

static inline bl_jet bl_jet_constant(double value) {
    return (bl_jet){value, {0, 0}, {0, 0, 0}};
}

// a x + b y + c as it stands at one place.
static inline bl_jet bl_jet_linear(double value, double by_x, double by_y) {
    return (bl_jet){value, {by_x, by_y}, {0, 0, 0}};
}

// f of a jet, from f, f' and f'' at its value.
static inline bl_jet bl_jet_apply(bl_jet j, double f, double slope, double curve) {
    const double *d = j.first;
    return (bl_jet){f,
                    {slope * d[0], slope * d[1]},
                    {curve * d[0] * d[0] + slope * j.second[0],
                     curve * d[0] * d[1] + slope * j.second[1],
                     curve * d[1] * d[1] + slope * j.second[2]}};
}

static inline bl_jet bl_jet_scale(bl_jet j, double factor) {
    return bl_jet_apply(j, factor * j.value, factor, 0);
}

static inline bl_jet bl_jet_add(bl_jet a, bl_jet b) {
    for (int i = 0; i < 2; i++)
        a.first[i] += b.first[i];
    for (int i = 0; i < 3; i++)
        a.second[i] += b.second[i];
    a.value += b.value;
    return a;
}

static inline bl_jet bl_jet_subtract(bl_jet a, bl_jet b) {
    return bl_jet_add(a, bl_jet_scale(b, -1));
}

static inline bl_jet bl_jet_multiply(bl_jet a, bl_jet b) {
    const double *p = a.first, *q = b.first;
    return (bl_jet){a.value * b.value,
                    {p[0] * b.value + a.value * q[0], p[1] * b.value + a.value * q[1]},
                    {a.second[0] * b.value + 2 * p[0] * q[0] + a.value * b.second[0],
                     a.second[1] * b.value + p[0] * q[1] + p[1] * q[0] + a.value * b.second[1],
                     a.second[2] * b.value + 2 * p[1] * q[1] + a.value * b.second[2]}};
}

static inline bl_jet bl_jet_reciprocal(bl_jet j) {
    double r = 1 / j.value;
    return bl_jet_apply(j, r, -r * r, 2 * r * r * r);
}

static inline bl_jet bl_jet_divide(bl_jet a, bl_jet b) {
    return bl_jet_multiply(a, bl_jet_reciprocal(b));
}

static inline bl_jet bl_jet_root(bl_jet j) {
    double r = sqrt(j.value);
    return bl_jet_apply(j, r, 0.5 / r, -0.25 / (r * j.value));
}

// The angle of (x, y), of a value between -pi and pi. Its derivatives are those of atan(y / x), or
// of -atan(x / y), whichever divides by the larger.
static inline bl_jet bl_jet_angle(bl_jet y, bl_jet x) {
    int upright = fabs(y.value) > fabs(x.value);
    bl_jet ratio = upright ? bl_jet_scale(bl_jet_divide(x, y), -1) : bl_jet_divide(y, x);
    double t = ratio.value, slope = 1 / (1 + t * t);
    return bl_jet_apply(ratio, atan2(y.value, x.value), slope, -2 * t * slope * slope);
}

#endif
