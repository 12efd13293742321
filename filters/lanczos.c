// SPDX-License-Identifier: MIT
//
// lanczos: sinc under the middle lobe of a sinc three times as wide.
//
//   k(t) = sinc(t) sinc(t/3) / N for |t| < 3, else 0,  with sinc(t) = sin(pi t) / (pi t)
//   N = (4 Si(4 pi) - 2 Si(2 pi)) / pi = 0.99706, so that the integral is 1
//
// With a = 2 pi / 3 and b = 4 pi / 3 the product is 3/(2 pi^2) (cos(a t) - cos(b t)) / t^2, whence
//
//   int_0^t k   = 3/(2 pi^2 N) (b Si(b t) - a Si(a t) - 2 sin(pi t) sin(pi t/3) / t)
//   int_0^t s k = 3/(2 pi^2 N) (Cin(b t) - Cin(a t))
//   response(f) = (trapezoid(f) + rest(f)) / N: the transform of the product without an end, 1 up
//   to |f| = 1/3 and 0 from 2/3 on, and what is cut off,
//   rest(f) = 1/(2 pi^2) (T(a+w) + T(|a-w|) - T(b+w) - T(|b-w|)),  w = 2 pi f,
//   T(p) = q (pi/2 - Si(q)) at q = 3 p
//
// All in closed form by the sine integral (filters/sine_integral.h), within 1e-15. The kernel is C1
// (it has a double zero at its ends), and its response falls as f^-3. Unlike the weights of a
// spline those of whole samples do not add to 1: they add to 1.003 to 1.010. The
// step overshoots by 0.0731, at a distance of one width.
//
// Source: duchon1979; the integral 1 and the closed forms are ours.
#include "filters/filter.h"

#include <math.h>

#include "filters/sine_integral.h"

static const double inner = 2 * M_PI / 3, outer = 4 * M_PI / 3;
// N, by the formula above, rounded once.
static const double total = 0.99705534595433968251;

static double kernel(double t) {
    double size = fabs(t);
    if (!(size < 3))
        return isnan(t) ? t : 0;
    if (size < 1e-9)
        return 1 / total; // (1 - 5 (pi t)^2 / 27) / N, within 2^-53
    return 3 * sin(M_PI * size) * sin(M_PI / 3 * size) / (M_PI * M_PI * size * size * total);
}

// int_0^t k for 0 <= t <= 3; the last term goes to 0 with t.
static double half_step(double t) {
    double waves = t > 0 ? 2 * sin(M_PI * t) * sin(M_PI / 3 * t) / t : 0;
    double integrals =
        outer * bl_sine_integral(outer * t) - inner * bl_sine_integral(inner * t) - waves;
    return 3 / (2 * M_PI * M_PI * total) * integrals;
}

static double step(double t) {
    if (!(fabs(t) < 3))
        return isnan(t) ? t : t > 0;
    return 0.5 + copysign(half_step(fabs(t)), t);
}

// int_0^t s k(s) ds
static double moment(double t) {
    return 3 / (2 * M_PI * M_PI * total) *
           (bl_entire_cosine_integral(outer * t) - bl_entire_cosine_integral(inner * t));
}

// By parts: t step(t) - int_-oo^t s k(s) ds, and what stands under the integral is odd.
static double ramp(double t) {
    if (!(fabs(t) < 3))
        return isnan(t) ? t : t > 0 ? t : 0;
    return t * step(t) + moment(3) - moment(fabs(t));
}

// T at q = 2 pi |n + v|, v = +-3f. The phase of q is that of v, which is reduced before it is
// scaled: the four T nearly cancel for large f, and would not if their phases were rounded apart.
static double cut_off(double n, double v) {
    double q = 2 * M_PI * fabs(n + v), phase = 2 * M_PI * remainder(v, 1);
    if (q == 0)
        return 0;
    bl_sine_auxiliary rest = bl_sine_integral_auxiliary(q);
    return q * (rest.f * cos(phase) + rest.g * copysign(1, n + v) * sin(phase));
}

static double response(double frequency) {
    double v = 3 * fabs(frequency);
    if (!(v < 1e100))
        return isnan(v) ? v : 0;
    double trapezoid = v <= 1 ? 1 : v >= 2 ? 0 : 2 - v;
    double rest = cut_off(1, v) + cut_off(1, -v) - cut_off(2, v) - cut_off(2, -v);
    return (trapezoid + rest / (2 * M_PI * M_PI)) / total;
}

BL_FILTER_DESCRIPTOR(lanczos) = {
    .name = "lanczos",
    .title = "Lanczos kernel, 3 lobes",
    .summary = "A sinc under the middle lobe of a wider sinc, scaled to the integral 1.",
    .formula = "sinc(t) sinc(t/3) / 0.99706 for |t| < 3, else 0",
    .paper = "duchon1979",
    .support = 3,
    .continuity = 1,
    .kernel = kernel,
    .step = step,
    .ramp = ramp,
    .response = response};
