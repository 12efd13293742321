// SPDX-License-Identifier: MIT
//
// box: the mean over one sample's width.
//
//   k(t) = 1 for |t| < 1/2, 1/2 at the two ends, else 0
//   step(t) = clamp(t + 1/2, 0, 1); the filtered step that the text calls boxstep
//   response(f) = sin(pi f) / (pi f), with zeros at all whole frequencies
//
// Exact except for the rounding of each operation. An anchor of x .. x + w, as the text has it, is
// the same filter half a width further on.
//
// Source: peachey2003, p. 64.
#include "filters/filter.h"

#include <math.h>

static double kernel(double t) {
    if (isnan(t))
        return t;
    double distance = fabs(t);
    return distance < 0.5 ? 1 : distance == 0.5 ? 0.5 : 0;
}

static double step(double t) {
    return t < -0.5 ? 0 : t > 0.5 ? 1 : t + 0.5;
}

static double ramp(double t) {
    return t < -0.5 ? 0 : t > 0.5 ? t : 0.5 * (t + 0.5) * (t + 0.5);
}

// sin(pi f) is 0 at whole f only if the phase is reduced before it is rounded.
static double response(double frequency) {
    if (fabs(frequency) < 1e-9)
        return 1; // 1 - (pi f)^2 / 6, within 2^-53
    double phase = remainder(frequency, 2);
    return isinf(frequency) ? 0 : sin(M_PI * phase) / (M_PI * frequency);
}

static const bl_piecewise pieces = {0, 1, {0.5}, {{1}}};

BL_FILTER_DESCRIPTOR(box) = {.name = "box",
                             .title = "box",
                             .summary = "The mean over one width: the simplest filter.",
                             .formula = "1 for |t| < 1/2, else 0",
                             .paper = "peachey2003, p. 64",
                             .support = 0.5,
                             .continuity = -1,
                             .kernel = kernel,
                             .step = step,
                             .ramp = ramp,
                             .response = response,
                             .pieces = &pieces};
