// SPDX-License-Identifier: MIT
//
// What the files of textures share about places, widths and the steps that the text plugs in.
#ifndef BL_TEXTURES_SAMPLING_H
#define BL_TEXTURES_SAMPLING_H

#include <math.h>

#include "core/signal.h"
#include "filters/filter.h"
#include "filters/unit_curve.h"

extern const bl_filter bl_filter_box;

// A place of these dimensions has a value: it is finite, and no larger than noises take.
static inline int bl_is_place(const double at[BL_AXES], unsigned dimensions) {
    for (unsigned a = 0; a < dimensions; a++)
        if (!(fabs(at[a]) <= 0x1p62))
            return 0;
    return 1;
}

// The largest of the widths, for what filters alike in all directions; NaN if one is.
static inline double bl_widest(const double width[BL_AXES], unsigned dimensions) {
    double widest = 0;
    for (unsigned a = 0; a < dimensions; a++)
        if (!(width[a] <= widest))
            widest = width[a];
    return widest;
}

// Whether nothing but the mean is left, whatever the filter.
static inline int bl_is_all(const double width[BL_AXES], unsigned dimensions) {
    for (unsigned a = 0; a < dimensions; a++)
        if (!isinf(width[a]))
            return 0;
    return 1;
}

static inline int bl_has_width(const double width[BL_AXES], unsigned dimensions) {
    return bl_widest(width, dimensions) > 0;
}

// What stands for step(0, distance): the steps that the text replaces it by, for a sample as wide
// as `width` centred there.
typedef enum bl_edge { BL_EDGE_SHARP, BL_EDGE_BOXSTEP, BL_EDGE_SMOOTHSTEP } bl_edge;

static inline double bl_edge_step(bl_edge edge, double distance, double width) {
    if (edge == BL_EDGE_SHARP || width == 0)
        return isnan(distance) ? NAN : distance >= 0;
    double x = bl_filter_box.step(distance / width);
    return edge == BL_EDGE_SMOOTHSTEP ? bl_unit_smoothstep(x) : x;
}

#endif
