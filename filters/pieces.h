// SPDX-License-Identifier: MIT
//
// What the filters share whose kernel is a polynomial between knots: three tables of whole numbers
// make the kernel, its step and its ramp, and the kernel's transform is the response.
#ifndef BL_FILTERS_PIECES_H
#define BL_FILTERS_PIECES_H

#include <math.h>

#include "core/piecewise.h"
#include "filters/filter.h"

// The symmetries step(t) + step(-t) = 1 and ramp(t) - ramp(-t) = t leave an odd and an even part
// to be stored. Both are exact polynomials: a few roundings of numbers below the support.
typedef struct bl_filter_pieces {
    bl_piecewise kernel; // even, with the integral 1
    bl_piecewise step;   // odd: the step - 1/2, up to the support
    bl_piecewise ramp;   // even: the ramp - t/2, up to the support
} bl_filter_pieces;

static inline double bl_pieces_step(const bl_filter_pieces *pieces, double t) {
    double support = bl_piecewise_support(&pieces->kernel);
    return t <= -support ? 0 : t >= support ? 1 : 0.5 + bl_piecewise_value(&pieces->step, t);
}

static inline double bl_pieces_ramp(const bl_filter_pieces *pieces, double t) {
    double support = bl_piecewise_support(&pieces->kernel);
    return t <= -support ? 0 : t >= support ? t : 0.5 * t + bl_piecewise_value(&pieces->ramp, t);
}

static inline double bl_pieces_response(const bl_filter_pieces *pieces, double frequency) {
    if (fabs(frequency) < 1e-9)
        return 1; // 1 - O(f^2), within 2^-53
    bl_piecewise_jumps jumps = bl_piecewise_find_jumps(&pieces->kernel);
    return bl_piecewise_transform(&pieces->kernel, &jumps, frequency);
}

// In a filter's file, after `static const bl_filter_pieces shape = {...}`: its functions, for the
// descriptor as BL_PIECES_FUNCTIONS(shape).
#define BL_PIECES_ABILITIES(shape)                                                                 \
    static double kernel(double t) {                                                               \
        return bl_piecewise_value(&(shape).kernel, t);                                             \
    }                                                                                              \
    static double step(double t) {                                                                 \
        return bl_pieces_step(&(shape), t);                                                        \
    }                                                                                              \
    static double ramp(double t) {                                                                 \
        return bl_pieces_ramp(&(shape), t);                                                        \
    }                                                                                              \
    static double response(double frequency) {                                                     \
        return bl_pieces_response(&(shape), frequency);                                            \
    }
#define BL_PIECES_FUNCTIONS(shape)                                                                 \
    .kernel = kernel, .step = step, .ramp = ramp, .response = response, .pieces = &(shape).kernel

#endif
