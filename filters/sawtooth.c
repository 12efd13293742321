// SPDX-License-Identifier: MIT
#include "filters/sawtooth.h"

#include <math.h>

#include "filters/average.h"

static double value(double u) {
    return u;
}

static double mean(double from, double length) {
    return from + 0.5 * length;
}

// frac(u) = 1/2 - sum of sin(2 pi n u) / (pi n)
static void series(double n, double *c, double *s) {
    *c = 0;
    *s = -1 / (M_PI * n);
}

double bl_sawtooth_average(const bl_filter *filter, double x, double width) {
    static const bl_wave wave = {.value = value, .mean = mean, .average = 0.5, .series = series};
    return width == 0 ? x - floor(x) : bl_average_wave(filter, &wave, x, width);
}
