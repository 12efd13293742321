// SPDX-License-Identifier: MIT
//
// Functions in float without the mathematics library: the same bits for every instruction set, and
// loops of them become vectors.
//
// The polynomials were found by Remez's exchange in 30 digits; the errors are those of the
// polynomials, to which a few roundings of a float (6e-8 each) add.
#ifndef BL_NOISES_FLOAT_FUNCTIONS_H
#define BL_NOISES_FLOAT_FUNCTIONS_H

#include <math.h>
#include <stdint.h>

#include "noises/lattice/lattice.h"

// 2^x for x <= 0; what is below 2^-126 becomes about 2^-126. A polynomial on [-1/2, 1/2] with a
// relative error of 1.9e-9, times a power of two put together from its bits.
static inline float bl_float_exp2(float x) {
    x = x > -126 ? x : -126;
    float whole = floorf(x + 0.5f), t = x - whole;
    float even = (0.000153458121613f * (t * t) + 0.00961848895633f) * (t * t) + 0.240226468906f;
    float odd = (0.00133999311772f * (t * t) + 0.0555032877711f) * (t * t) + 0.693147205737f;
    // -126 <= whole <= 0: the exponent field is 1 to 127.
    float power = bl_float_of_bits((uint32_t)((int32_t)whole + 127) << 23);
    return (even * (t * t) + (odd * t + 1)) * power;
}

// sin(2 pi s) for |s| <= 1/4: s times a polynomial in s^2, |error| <= 3.7e-9 (|s| + 1/100).
static inline float bl_float_sine_part(float s) {
    float u = s * s;
    float p = (39.556941553f * u - 76.5528151627f) * u + 81.6011597369f;
    return s * ((p * u - 41.3416581428f) * u + 6.28318517893f);
}

// cos(2 pi x) and sin(2 pi x) for |x| < 2^22: x comes to [-1/2, 1/2], where cos(2 pi x) =
// sin(2 pi (1/4 - |x|)).
static inline float bl_float_cosine(float x) {
    float v = x - floorf(x + 0.5f);
    return bl_float_sine_part(0.25f - fabsf(v));
}

static inline float bl_float_sine(float x) {
    return bl_float_cosine(x - 0.25f);
}

#endif
