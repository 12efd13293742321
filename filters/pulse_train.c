// SPDX-License-Identifier: MIT
#include "filters/pulse_train.h"

#include <math.h>

// The filter reaches support * width to both sides; each pulse there is a difference of two steps.
static double sum_of_pulses(const bl_filter *filter, double low, double high, double x,
                            double width) {
    double reach = ceil(filter->support * width) + 1, sum = 0;
    for (double k = -reach; k <= reach; k++)
        sum += filter->step((x - low - k) / width) - filter->step((x - high - k) / width);
    return sum;
}

double bl_pulse_train_average(const bl_filter *filter, double low, double high, double x,
                              double width) {
    if (!isfinite(x) || isnan(width))
        return NAN;
    x -= floor(x); // exact
    if (width == 0)
        return x >= low && x < high;
    return isinf(width) ? high - low : sum_of_pulses(filter, low, high, x, width);
}
