// SPDX-License-Identifier: MIT
#include "filters/checker.h"

#include "filters/pulse_train.h"

// The average of the wave that is 1 where floor(x) is even and -1 elsewhere; halving is exact.
static double square_wave(const bl_filter *filter, double x, double width) {
    return 2 * bl_pulse_train_average(filter, 0, 0.5, 0.5 * x, 0.5 * width) - 1;
}

double bl_checker_average(const bl_filter *filter, double x, double y, const double width[2]) {
    return 0.5 + 0.5 * square_wave(filter, x, width[0]) * square_wave(filter, y, width[1]);
}
