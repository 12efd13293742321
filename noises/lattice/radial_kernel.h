// SPDX-License-Identifier: MIT
//
// The radial Catmull-Rom kernel of radius 2 (peachey2003, p. 79, `catrom2`).
//
//   K(r) = (2 - 5 r^2 + 3 r^3)/2             for r < 1
//        = (4 - 8 r + 5 r^2 - r^3)/2         for 1 <= r < 2
//        = 0                                 for r >= 2
//
// It is C1: at r = 1 the second derivative falls from 4 to 2, at r = 2 from -1 to 0. With
// m = max(1-r, 0) and n = max(2-r, 0) both branches are one expression without a choice:
//
//   2 K = (1-r) n^2 + m^2 (2 - 4 m)
//
// (the first term is the outer branch; inner minus outer is (1-r)^2 (2r-1)). This is the form that
// the rows use; it does not cancel: every term is small where the kernel is small.
//
// The text looks the kernel up in a table by squared distance d, `rate` entries a unit, nearest
// entry. Entry i holds K(sqrt(i/rate)), so the lookup is the kernel at the rounded squared distance
// and needs no memory. It jumps by up to 5/(4 rate) between entries.
#ifndef BL_NOISES_LATTICE_RADIAL_KERNEL_H
#define BL_NOISES_LATTICE_RADIAL_KERNEL_H

#include <math.h>
#include <stdint.h>

static inline double radial_kernel(double r) {
    if (r < 1)
        return 1 + r * r * (1.5 * r - 2.5);
    return r < 2 ? (1 - r) * (2 - r) * (2 - r) / 2 : 0;
}

// K'(r)/r, finite at 0: the gradient of K(|d|) is this times d.
static inline double radial_kernel_slope(double r) {
    if (r < 1)
        return 4.5 * r - 5;
    return r < 2 ? -4 / r + 5 - 1.5 * r : 0;
}

// The text's table of 4*rate+1 entries, looked up at a squared distance.
static inline double radial_kernel_table(double squared, uint32_t rate) {
    if (!(squared < 4))
        return 0;
    double entry = floor(squared * rate + 0.5); // at most 4*rate, where K is 0
    return radial_kernel(sqrt(entry / rate));
}

// 2 K(r) in float.
static inline float radial_twice(float r) {
    float q = 1 - r;
    float n = 2 - r;
    float m = q > 0 ? q : 0;
    n = n > 0 ? n : 0;
    return q * (n * n) + (m * m) * (2 - 4 * m);
}

// 2 K(r) for r >= 1; the same bits as radial_twice there, because its second term is 0.
static inline float radial_twice_outer(float r) {
    float q = 1 - r;
    float n = 2 - r;
    n = n > 0 ? n : 0;
    return q * (n * n);
}

// 2 K / RADIAL_FAR_SCALE at r = sqrt(4 - w), w <= 2, without a root: with 2 - r = w / (2 + r),
//
//   2 K = w^2 (1 - r)/(2 + r)^2
//
// whose second factor is analytic for w < 4. In its place stands the polynomial of degree 5 that is
// best for w^2 times it on [0, 2] (Remez's exchange in 30 digits): |error| of 2 K <= 3.5e-7. It is
// divided by its leading coefficient. `amplitude` is that of the impulse times RADIAL_FAR_SCALE.
// What depends on nothing else stands side by side: the processor holds too few instructions to
// wait for one long chain.
#define RADIAL_FAR_SCALE 0.000100537819488f
static inline float radial_far(float w, float amplitude) {
    w = w > 0 ? w : 0; // out of reach
    float square = w * w;
    float high = (w - 3.0005504305f) * square + (10.030807648f * w + 10.9367547286f);
    float low = 80.3239155421f * w - 622.071565552f;
    return (amplitude * square) * (high * square + low);
}

#endif
