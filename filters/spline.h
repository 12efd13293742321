// SPDX-License-Identifier: MIT
//
// The Catmull-Rom spline through evenly spaced knots, and its averages under any filter: what the
// primitive `spline` and the maps from numbers to colours are made of.
//
// With n knots the spline runs from knot 1 at x = 0 to knot n - 2 at x = 1; the first and the last
// only shape the ends. Outside of [0, 1] it stays at the ends. It is C1 between the ends (its
// second derivative jumps at the knots), and may overshoot its knots. All functions are pure and
// may be called from several threads; NaN gives NaN. Source: peachey2003, p. 34.
#ifndef BL_FILTERS_SPLINE_H
#define BL_FILTERS_SPLINE_H

#include <stddef.h>

#include "filters/filter.h"

enum { BL_SPLINE_LEAST = 4, BL_SPLINE_MOST = 128 }; // knots

typedef struct bl_spline {
    const double *knot; // borrowed: `count` of them, `stride` apart in the array
    size_t count, stride;
    const double *place; // borrowed: what bl_spline_places gives for this count
} bl_spline;

// Where the count - 2 knots stand that the spline passes through: i / (count - 3).
void bl_spline_places(size_t count, double *place);

double bl_spline_at(const bl_spline *spline, double x);

// The average for a sample of this width, 0 or more, about x: by the box exact, the integral of a
// cubic in a form that keeps its digits; by others see filters/average.h, where also stands what a
// filter without an end cannot. Width 0 is the spline itself, infinity half of each end.
double bl_spline_average(const bl_spline *spline, const bl_filter *filter, double x, double width);

#endif
