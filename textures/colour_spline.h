// SPDX-License-Identifier: MIT
//
// Maps from a number to a colour: each component is a Catmull-Rom spline (filters/spline.h) through
// evenly spaced knots.
#ifndef BL_TEXTURES_COLOUR_SPLINE_H
#define BL_TEXTURES_COLOUR_SPLINE_H

#include "textures/texture.h"

typedef struct bl_colour_spline {
    const bl_colour *knots;
    size_t count; // BL_SPLINE_LEAST to BL_SPLINE_MOST
} bl_colour_spline;

// The colour at x; NaN gives NaN. Source: peachey2003, p. 35.
bl_colour bl_colour_spline_at(const bl_colour_spline *spline, double x);
// The mean over x - width/2 .. x + width/2, exact.
bl_colour bl_colour_spline_mean(const bl_colour_spline *spline, double x, double width);
// The mean over a normal distribution about x with this standard deviation, cut at 4 of them: exact
// means over 32 pieces, each with the mass of the normal distribution in it. Within a piece the
// density is taken as even, which is off by less than 1e-3 of the colours' differences.
bl_colour bl_colour_spline_normal(const bl_colour_spline *spline, double x, double deviation);
// Each component cut to [0, 1].
bl_colour bl_colour_clamp(bl_colour colour);

#endif
