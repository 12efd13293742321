// SPDX-License-Identifier: MIT
//
// sinc: the ideal filter, which passes what is below the Nyquist frequency and nothing else.
//
//   k(t) = sin(pi t) / (pi t)
//   step(t) = 1/2 + Si(pi t) / pi
//   ramp(t) = t step(t) + cos(pi t) / pi^2
//   response(f) = 1 for |f| < 1/2, 1/2 at 1/2, else 0
//
// The kernel falls as 1/t only: its integral is 1 as a limit, and averages by it exist for periodic
// functions and for those that end, as limits too. The step overshoots by 9 % of its height (Gibbs)
// at every width, at a distance of one width, and rings on as 1/t.
//
// Source: peachey2003, p. 64, as the ideal; gibbs1899 for the overshoot.
#include "filters/filter.h"

#include <math.h>

#include "filters/sine_integral.h"

// sin(pi t) and cos(pi t): the phase is reduced before it is rounded.
static double kernel(double t) {
    if (fabs(t) < 1e-9)
        return 1; // 1 - (pi t)^2 / 6, within 2^-53
    return isinf(t) ? 0 : sin(M_PI * remainder(t, 2)) / (M_PI * t);
}

static double step(double t) {
    double size = fabs(t);
    if (!(size > 1))
        return 0.5 + bl_sine_integral(M_PI * t) / M_PI;
    if (isinf(t))
        return t > 0;
    double phase = M_PI * remainder(size, 2);
    bl_sine_auxiliary rest = bl_sine_integral_auxiliary(M_PI * size);
    double left = (rest.f * cos(phase) + rest.g * sin(phase)) / M_PI;
    return t > 0 ? 1 - left : left;
}

static double ramp(double t) {
    if (isinf(t))
        return t > 0 ? t : 0;
    return t * step(t) + cos(M_PI * remainder(t, 2)) / (M_PI * M_PI);
}

static double response(double frequency) {
    double size = fabs(frequency);
    return isnan(size) ? size : size < 0.5 ? 1 : size == 0.5 ? 0.5 : 0;
}

BL_FILTER_DESCRIPTOR(sinc) = {.name = "sinc",
                              .title = "sinc",
                              .summary =
                                  "The ideal filter: all below the Nyquist frequency, "
                                  "nothing above; it rings without end.",
                              .formula = "sin(pi t) / (pi t)",
                              .paper = "peachey2003, p. 64",
                              .support = INFINITY,
                              .continuity = 99,
                              .kernel = kernel,
                              .step = step,
                              .ramp = ramp,
                              .response = response};
