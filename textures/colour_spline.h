// SPDX-License-Identifier: MIT
//
// Maps from a number to a colour: a Catmull-Rom spline through evenly spaced knots, and its means.
//
// With n knots the spline runs through knot 1 at x = 0 to knot n - 2 at x = 1; the first and the
// last knot only shape the ends. Below 0 and above 1 it stays at the colour of the end. It is C1
// (its second derivative jumps at the knots, whatever the text says), and may overshoot its knots.
#ifndef BL_TEXTURES_COLOUR_SPLINE_H
#define BL_TEXTURES_COLOUR_SPLINE_H

#include "textures/texture.h"

typedef struct bl_colour_spline {
    const bl_colour *knots;
    size_t count; // 4 at least
} bl_colour_spline;

// The colour at x; NaN gives NaN. Source: peachey2003, p. 35.
bl_colour bl_colour_spline_at(const bl_colour_spline *spline, double x);
// The mean over x - width/2 .. x + width/2, exact: the integral of a cubic is a quartic.
bl_colour bl_colour_spline_mean(const bl_colour_spline *spline, double x, double width);
// The mean over a normal distribution about x with this standard deviation, cut at 4 of them: exact
// means over 32 pieces, each with the mass of the normal distribution in it. Within a piece the
// density is taken as even, which is off by less than 1e-3 of the colours' differences.
bl_colour bl_colour_spline_normal(const bl_colour_spline *spline, double x, double deviation);
// Each component cut to [0, 1].
bl_colour bl_colour_clamp(bl_colour colour);

#endif
