// SPDX-License-Identifier: MIT
//
// The geometry of a star about the origin, which `star` and `wallpaper` share.
//
// Angles are those of the text: phi = atan2(s, t) + pi, so that a tip points to -t. The star is cut
// into sectors of 2 pi / points, each is folded onto its half, and there one straight edge from the
// tip (radius `outer`) to the notch (radius `inner`) parts inside from outside.
#ifndef BL_TEXTURES_STAR_SHAPE_H
#define BL_TEXTURES_STAR_SHAPE_H

#include "textures/sampling.h"

enum { BL_STAR_POINTS_MOST = 32 };

typedef struct bl_star {
    unsigned points;
    double inner, outer;
    int printed; // the fraction of the sector, 0 to 1/2, is taken for the angle in radians, as in
                 // the text: for 5 points the angle is 1.257 times too small
} bl_star;

// The signed distance to the line of the edge, positive inside, and the direction in which it
// falls fastest. At the centre any edge may be taken.
double bl_star_distance(const bl_star *star, double s, double t, double outwards[2]);

// The share of the star that a sample of these widths sees, with the step at the edge that is
// plugged in: its width is that of the sample's box across the edge.
double bl_star_step(const bl_star *star, bl_edge edge, double s, double t,
                    const double width[BL_AXES]);

// The share of the box centred at (s, t) that the star covers, exact except for rounding: the area
// of the polygon clipped to the box. Of the right star only, and for finite widths above 0.
double bl_star_coverage(const bl_star *star, double s, double t, const double width[BL_AXES]);

double bl_star_area(const bl_star *star);

#endif
