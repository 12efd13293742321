// SPDX-License-Identifier: MIT
//
// Averages of functions of one coordinate under a filter: of piecewise analytic functions that are
// constant outside of a span, and of periodic ones.
//
// The box has exact integrals, whose weights are the parts of one width, so that they sum to 1 at
// any width. Any other filter is integrated against the pieces by Gauss's rule with 16 nodes,
// between the breaks of the function and those of the kernel, which stand at multiples of half a
// width: there both are analytic, and the rule is exact to rounding. Beyond the reach of the kernel
// nothing is integrated. All functions are pure and may be called from several threads.
#ifndef BL_FILTERS_AVERAGE_H
#define BL_FILTERS_AVERAGE_H

#include <stddef.h>

#include "core/status.h"
#include "filters/filter.h"

// The distance in widths beyond which the filter's step is 0 or 1 within 2^-56; INFINITY for those
// that ring slowly, as the ideal filter does.
double bl_filter_reach(const bl_filter *filter);

// Whether the kernel is nowhere negative, so that averages stay within the bounds of the function.
int bl_filter_keeps_bounds(const bl_filter *filter);

// The continuity class of a function of class `continuity` (-1: it jumps) averaged by the filter.
int bl_filter_continuity(const bl_filter *filter, double width, int continuity);

// The mean of ramps: what the filter adds to max(distance, 0), for samples of this width. Even in
// `distance`, 0 far from it.
double bl_filter_bend(const bl_filter *filter, double distance, double width);

// A function given by pieces between increasing knots, analytic within each.
typedef struct bl_spans {
    const void *block; // handed to the functions
    const double *knot;
    size_t count;        // of knots, at least 2
    double below, above; // the values before the first knot and after the last
    double (*value)(const void *block, size_t piece, double x);
    // The mean over [from, from + length] within a piece, exact; the value for length 0.
    double (*mean)(const void *block, size_t piece, double from, double length);
    int graded; // 1: analytic but for the ends, where it is a power of the distance, or as steep
} bl_spans;

// The average about x for 0 < width < infinity. For a filter of infinite reach narrower than
// 1/BL_MOST_PANELS of the span it is not known: NaN (see bl_check_averaging).
double bl_average_spans(const bl_filter *filter, const bl_spans *pieces, double x, double width);

// A function of period 1 that is analytic from 0 up to 1.
typedef struct bl_wave {
    double (*value)(double u);                      // for 0 <= u < 1
    double (*mean)(double from, double length);     // over a part of [0, 1], exact
    double average;                                 // over the period
    void (*series)(double n, double *c, double *s); // of cos(2 pi n u) and sin(2 pi n u), n >= 1
} bl_wave;

// The average about x, -1 < x < 1 (so that places just below 0 keep their digits), for 0 < width. A
// wide sample of a filter other than the box is a Fourier series. For a filter of infinite reach
// narrower than 1/BL_MOST_PANELS: NaN.
double bl_average_wave(const bl_filter *filter, const bl_wave *wave, double x, double width);

enum { BL_MOST_PANELS = 8192 };

// Whether averages by this filter are known for samples of `width` on a span (or period) of this
// length. Errors: BL_USAGE with what to do.
bl_status bl_check_averaging(const bl_filter *filter, double width, double span,
                             bl_message *message);

#endif
