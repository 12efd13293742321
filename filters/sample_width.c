// SPDX-License-Identifier: MIT
#include "filters/sample_width.h"

#include <math.h>
#include <stddef.h>

const char *const bl_width_estimator_words[] = {"sum", "maximum", "length", "distance", NULL};

double bl_sample_width(bl_width_estimator estimator, double across, double down, double distance,
                       double k) {
    double a = fabs(across), b = fabs(down);
    switch (estimator) {
    case BL_WIDTH_SUM:
        return a + b;
    case BL_WIDTH_MAXIMUM:
        return isnan(a) || isnan(b) ? NAN : a > b ? a : b; // fmax would hide a NaN
    case BL_WIDTH_LENGTH:
        return isnan(a) || isnan(b) ? NAN : hypot(a, b);
    default:
        return distance * k;
    }
}
