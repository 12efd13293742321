// SPDX-License-Identifier: MIT
#include "filters/average.h"

#include <math.h>
#include <string.h>

#include "core/quadrature.h"

// Beyond it a kernel without an end that has not died away is taken to have none.
static const double farthest_reach = 16;

double bl_filter_reach(const bl_filter *filter) {
    if (isfinite(filter->support))
        return filter->support;
    for (double t = 0.5; t <= farthest_reach; t += 0.5) {
        int within = 1;
        for (int i = 0; i < 8 && within; i++)
            within = fabs(filter->step(-t - 0.37 * i)) <= 0x1p-56;
        if (within)
            return t;
    }
    return INFINITY;
}

int bl_filter_keeps_bounds(const bl_filter *filter) {
    double end = fmin(filter->support, farthest_reach);
    for (double t = 0; t <= end; t += 1.0 / 64)
        if (filter->kernel(t) < -0x1p-50)
            return 0;
    return 1;
}

int bl_filter_continuity(const bl_filter *filter, double width, int continuity) {
    if (width == 0)
        return continuity;
    int sum = continuity + filter->continuity + 2;
    return filter->continuity >= 99 || sum > 99 || isinf(width) ? 99 : sum;
}

double bl_filter_bend(const bl_filter *filter, double distance, double width) {
    double t = -fabs(distance) / width; // -inf for the narrowest
    return t < -0x1p60 || t < -filter->support ? 0 : width * filter->ramp(t);
}

// --- the box ------------------------------------------------------------------------------------

// Where a knot cuts the width about x, from -width/2 to width/2.
static double cut(double knot, double x, double width) {
    double distance = knot - x, half = 0.5 * width;
    return distance < -half ? -half : distance > half ? half : distance;
}

// The weights are differences of cuts, so that they sum to 1 however narrow the width is.
static double box_spans(const bl_spans *pieces, double x, double width) {
    double last = cut(pieces->knot[0], x, width);
    double sum = pieces->below * ((last + 0.5 * width) / width);
    for (size_t i = 0; i + 1 < pieces->count; i++) {
        double next = cut(pieces->knot[i + 1], x, width), length = next - last;
        if (length > 0) {
            double from = fmax(x + last, pieces->knot[i]);
            double most = fmax(pieces->knot[i + 1] - from, 0); // by rounding only it is less
            sum += pieces->mean(pieces->block, i, from, fmin(length, most)) * (length / width);
        }
        last = next;
    }
    return sum + pieces->above * ((0.5 * width - last) / width);
}

// Whole periods and a rest that begins at the left end of the width; the distance from there to the
// next whole number is taken from x, as the end is rounded.
static double box_wave(const bl_wave *wave, double x, double width) {
    double whole = floor(width), rest = width - whole;
    double next = floor(x - 0.5 * width) + 1;
    double distance = fmin(fmax((next - x) + 0.5 * width, 0), 1);
    double sum = whole * wave->average;
    if (rest <= distance)
        return (sum + rest * wave->mean(fmin(1 - distance, 1 - rest), rest)) / width;
    return (sum + distance * wave->mean(1 - distance, distance) +
            (rest - distance) * wave->mean(0, fmin(rest - distance, 1))) /
           width;
}

static int is_box(const bl_filter *filter) {
    return strcmp(filter->name, "box") == 0;
}

// --- other filters ------------------------------------------------------------------------------

// An integral of kernel times function over a part of the widths t about x.
typedef struct sum {
    const bl_filter *filter;
    const bl_spans *pieces;
    double x, width, reach;
} sum;

// From t0 to t1, where both are analytic.
static double panel(const sum *s, size_t piece, double t0, double t1) {
    double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0), total = 0;
    double from = s->pieces->knot[piece], to = s->pieces->knot[piece + 1];
    for (int i = 0; i < BL_QUADRATURE_NODES; i++) {
        double t = middle + half * bl_quadrature_node[i];
        double at = fmin(fmax(s->x - s->width * t, from), to);
        total += bl_quadrature_weight[i] * s->filter->kernel(t) *
                 s->pieces->value(s->pieces->block, piece, at);
    }
    return half * total;
}

// Where a kernel without an end is cut: beyond it, the integral of sin(pi t) / (pi t) against
// anything monotone is below 2^-53, and 2 t + 1 would not be exact.
static const double farthest_place = 0x1p51;

// From place `from` to place `to` of the function, cut where the kernel may break.
static double part(const sum *s, size_t piece, double from, double to) {
    double reach = fmin(s->reach, farthest_place), total = 0;
    double t0 = fmax((s->x - to) / s->width, -reach);
    double t1 = fmin((s->x - from) / s->width, reach);
    while (t0 < t1) {
        double next = fmin(0.5 * (floor(2 * t0) + 1), t1);
        total += panel(s, piece, t0, next);
        t0 = next;
    }
    return total;
}

// Panels get four times shorter towards both ends of a piece, until the rest weighs less than 2^-56
// of a width. On [h/4, h] a power of the distance is analytic with its singularity one third of a
// panel away: the rule leaves 3^-32. A power that is steep at 1, e^(-E) on a panel, is negligible
// before the rule fails.
static double graded_piece(const sum *s, size_t piece, double from, double to) {
    double middle = from + 0.5 * (to - from), ratio = 0.25, total = 0;
    double least = 0x1p-56 * fmin(to - from, s->width);
    for (double length = middle - from; length > 0; length *= ratio) {
        double inner = length * ratio > least ? length * ratio : 0;
        total +=
            part(s, piece, from + inner, from + length) + part(s, piece, to - length, to - inner);
        if (inner == 0)
            break;
    }
    return total;
}

double bl_average_spans(const bl_filter *filter, const bl_spans *pieces, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    if (isinf(x))
        return x < 0 ? pieces->below : pieces->above;
    if (is_box(filter))
        return box_spans(pieces, x, width);
    double first = pieces->knot[0], last = pieces->knot[pieces->count - 1];
    const sum s = {filter, pieces, x, width, bl_filter_reach(filter)};
    if (isinf(s.reach) && (last - first) / width > BL_MOST_PANELS)
        return NAN;
    double total = pieces->below * filter->step((first - x) / width) +
                   pieces->above * filter->step((x - last) / width);
    for (size_t i = 0; i + 1 < pieces->count; i++)
        total += pieces->graded ? graded_piece(&s, i, pieces->knot[i], pieces->knot[i + 1])
                                : part(&s, i, pieces->knot[i], pieces->knot[i + 1]);
    return total;
}

// --- waves --------------------------------------------------------------------------------------

// The period from k to k + 1, with nothing outside of it. Its ends are subtracted from the place,
// not the place moved: just below 0 that would cost digits.
typedef struct period {
    const bl_wave *wave;
    double k;
} period;

static double period_value(const void *block, size_t piece, double x) {
    const period *p = block;
    (void)piece;
    return p->wave->value(x - p->k);
}

static double one_period(const bl_filter *filter, const bl_wave *wave, double k, double x,
                         double width, double reach) {
    const period block = {wave, k};
    const double knot[2] = {k, k + 1};
    const bl_spans pieces = {.block = &block, .knot = knot, .count = 2, .value = period_value};
    const sum s = {filter, &pieces, x, width, reach};
    return part(&s, 0, k, k + 1);
}

// Of one period and more the harmonics fall at least as 1/n^2 by the filter and as 1/n by the wave.
static double series(const bl_filter *filter, const bl_wave *wave, double x, double width,
                     double terms) {
    double total = 0;
    for (double n = terms; n >= 1; n--) {
        double response = filter->response(n * width), phase = 2 * M_PI * remainder(n * x, 1), c, s;
        if (fabs(response) < 0x1p-70) // of a coefficient of at most 1, in a sum of about 1
            continue;
        wave->series(n, &c, &s);
        total += response * (c * cos(phase) + s * sin(phase));
    }
    return wave->average + total;
}

enum { WIDEST_SUM = 512, MOST_TERMS = 2048 };

// The response of a continuous kernel falls as 1/f^2: the harmonics beyond 2^27 cycles per width
// are below 2^-54. From the widest sum on, 2048 of them leave 2e-14.
static double term_count(const bl_filter *filter, double width) {
    return filter->continuity < 0 ? MOST_TERMS : fmin(fmax(ceil(0x1p27 / width), 1), MOST_TERMS);
}

double bl_average_wave(const bl_filter *filter, const bl_wave *wave, double x, double width) {
    if (!isfinite(x) || isnan(width))
        return NAN;
    if (isinf(width))
        return wave->average;
    if (is_box(filter))
        return box_wave(wave, x, width);
    double reach = bl_filter_reach(filter);
    if (isinf(reach)) // its response ends, at half a cycle per width
        return width * BL_MOST_PANELS < 1
                   ? NAN
                   : series(filter, wave, x, width, fmax(1, ceil(1 / width)));
    if (width > WIDEST_SUM)
        return series(filter, wave, x, width, term_count(filter, width));
    double total = 0, last = floor(x + reach * width);
    for (double k = floor(x - reach * width); k <= last; k++)
        total += one_period(filter, wave, k, x, width, reach);
    return total;
}

bl_status bl_check_averaging(const bl_filter *filter, double width, double span,
                             bl_message *message) {
    if (width == 0 || isfinite(bl_filter_reach(filter)) || span / width <= BL_MOST_PANELS)
        return BL_OK;
    return bl_report(message, BL_USAGE,
                     "filter=%s has no closed form here, and reaches too far for width=%g; use a "
                     "width of at least %g, or another filter",
                     filter->name, width, span / BL_MOST_PANELS);
}
