// SPDX-License-Identifier: MIT
#include "reports/figures/estimates.h"

#include <math.h>

bl_estimate bl_exactly(double value, double samples) {
    return (bl_estimate){value, value, value, 1, samples};
}

bl_estimate bl_observed(double value, double samples) {
    return (bl_estimate){value, value, value, 0, samples};
}

bl_estimate bl_difference(bl_estimate a, bl_estimate b) {
    double value = a.value - b.value;
    return (bl_estimate){value, value - hypot(a.value - a.lower, b.upper - b.value),
                         value + hypot(a.upper - a.value, b.value - b.lower), a.level,
                         fmin(a.samples, b.samples)};
}

bl_estimate bl_ratio_db(bl_estimate a, bl_estimate b) {
    const double db = 10 / log(10);
    double value = db * log(a.value / b.value);
    double below = db * hypot((a.value - a.lower) / a.value, (b.upper - b.value) / b.value);
    double above = db * hypot((a.upper - a.value) / a.value, (b.value - b.lower) / b.value);
    return (bl_estimate){value, value - below, value + above, a.level, fmin(a.samples, b.samples)};
}

bl_estimate bl_scaled(bl_estimate e, double factor) {
    return (bl_estimate){e.value * factor, e.lower * factor, e.upper * factor, e.level, e.samples};
}

double bl_slope(const double *x, const double *y, size_t count) {
    double n = (double)count, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (size_t i = 0; i < count; i++) {
        sum_x += x[i];
        sum_y += y[i];
        sum_xx += x[i] * x[i];
        sum_xy += x[i] * y[i];
    }
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

void bl_make_claim(bl_run *run, const char *source, const char *sentence, const char *reading,
                   const char *unit, double lower, double upper, bl_estimate measured,
                   const char *counted) {
    bl_run_claim(run, &(bl_claim){.sentence = sentence,
                                  .source = source,
                                  .reading = reading,
                                  .unit = unit,
                                  .expected_lower = lower,
                                  .expected_upper = upper,
                                  .measured = measured,
                                  .counted = counted});
}
