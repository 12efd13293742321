// SPDX-License-Identifier: MIT
#include "spectra/integrate.h"

#include <math.h>
#include <stdlib.h>

#include "core/quadrature.h"

void bl_breaks_add(bl_breaks *breaks, double x) {
    if (isfinite(x) && breaks->count < BL_BREAKS_MOST)
        breaks->at[breaks->count++] = x;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void bl_breaks_sort(bl_breaks *breaks) {
    qsort(breaks->at, breaks->count, sizeof *breaks->at, by_size);
}

static double panel(bl_integrand *f, const void *context, double from, double to) {
    double half = (to - from) / 2, middle = from + half, sum = 0;
    for (int n = 0; n < BL_QUADRATURE_NODES; n++)
        sum += bl_quadrature_weight[n] * f(context, middle + half * bl_quadrature_node[n]);
    return half * sum;
}

// A panel whose halves do not agree with it is halved again, eight times at most: 16 nodes on
// 2^-8 of a smooth panel are far below rounding, so only a break in the middle of it gets there.
static double halved(bl_integrand *f, const void *context, double from, double to, double whole,
                     double tolerance, int depth) {
    double middle = from + (to - from) / 2;
    double left = panel(f, context, from, middle), right = panel(f, context, middle, to);
    if (depth == 0 || fabs(left + right - whole) <= tolerance)
        return left + right;
    return halved(f, context, from, middle, left, tolerance / 2, depth - 1) +
           halved(f, context, middle, to, right, tolerance / 2, depth - 1);
}

static double between(bl_integrand *f, const void *context, double from, double to, double longest,
                      double tolerance) {
    double panels = ceil((to - from) / longest), sum = 0;
    for (double i = 0; i < panels; i++) {
        double a = from + (to - from) * (i / panels), b = from + (to - from) * ((i + 1) / panels);
        sum += halved(f, context, a, b, panel(f, context, a, b), tolerance, 8);
    }
    return sum;
}

double bl_integrate(bl_integrand *f, const void *context, double from, double to,
                    const bl_breaks *breaks, double longest, double tolerance) {
    double sum = 0, left = from;
    for (size_t i = 0; i < breaks->count; i++) {
        double right = breaks->at[i];
        if (right <= left || right >= to)
            continue;
        sum += between(f, context, left, right, longest, tolerance);
        left = right;
    }
    return left < to ? sum + between(f, context, left, to, longest, tolerance) : sum;
}
