// SPDX-License-Identifier: MIT
//
// On span i, s = x (n - 3) - i in [0, 1], through the knots k0 .. k3 = knot i .. i + 3:
// k1 + s (k2 - k0)/2 + s^2 (k0 - 5/2 k1 + 2 k2 - k3/2) + s^3 (3/2 (k1 - k2) + (k3 - k0)/2).
// The text's listing takes one span too many at x = 1, and reads a knot past the last there
// (times 0).
#include "filters/spline.h"

#include <math.h>

#include "filters/average.h"

typedef struct cubic {
    double value, slope, square, cube;
} cubic;

static cubic make_cubic(const bl_spline *spline, size_t span) {
    const double *knot = spline->knot + span * spline->stride;
    double k0 = knot[0], k1 = knot[spline->stride], k2 = knot[2 * spline->stride],
           k3 = knot[3 * spline->stride];
    return (cubic){k1, 0.5 * (k2 - k0), k0 - 2.5 * k1 + 2 * k2 - 0.5 * k3,
                   1.5 * (k1 - k2) + 0.5 * (k3 - k0)};
}

static double spans_of(const bl_spline *spline) {
    return (double)(spline->count - 3);
}

static double at_place(const cubic *c, double s) {
    return ((c->cube * s + c->square) * s + c->slope) * s + c->value;
}

static double value_at(const void *block, size_t piece, double x) {
    const bl_spline *spline = block;
    cubic c = make_cubic(spline, piece);
    return at_place(&c, fmin(fmax(x * spans_of(spline) - (double)piece, 0), 1));
}

// Of a cubic over [m - h/2, m + h/2]: f(m) + f''(m) h^2 / 24.
static double mean_over(const void *block, size_t piece, double from, double length) {
    const bl_spline *spline = block;
    cubic c = make_cubic(spline, piece);
    double h = length * spans_of(spline);
    double s = (from + 0.5 * length) * spans_of(spline) - (double)piece;
    return at_place(&c, s) + (6 * c.cube * s + 2 * c.square) * (h * h / 24);
}

void bl_spline_places(size_t count, double *place) {
    for (size_t i = 0; i + 2 < count; i++)
        place[i] = (double)i / (double)(count - 3);
}

static double first_of(const bl_spline *spline) {
    return spline->knot[spline->stride];
}

static double last_of(const bl_spline *spline) {
    return spline->knot[(spline->count - 2) * spline->stride];
}

double bl_spline_at(const bl_spline *spline, double x) {
    if (isnan(x))
        return NAN;
    if (x <= 0 || x >= 1)
        return x > 0 ? last_of(spline) : first_of(spline);
    double piece = fmin(floor(x * spans_of(spline)), spans_of(spline) - 1); // 0 <= piece < spans
    return value_at(spline, (size_t)piece, x);
}

double bl_spline_average(const bl_spline *spline, const bl_filter *filter, double x, double width) {
    double first = first_of(spline), last = last_of(spline);
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return 0.5 * first + 0.5 * last;
    if (!(width > 0))
        return bl_spline_at(spline, x);
    const bl_spans pieces = {.block = spline,
                             .knot = spline->place,
                             .count = spline->count - 2,
                             .below = first,
                             .above = last,
                             .value = value_at,
                             .mean = mean_over};
    return bl_average_spans(filter, &pieces, x, width);
}
