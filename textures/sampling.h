// SPDX-License-Identifier: MIT
//
// What the files of textures share about the steps that the text plugs in.
#ifndef BL_TEXTURES_SAMPLING_H
#define BL_TEXTURES_SAMPLING_H

#include <math.h>

#include "core/signal.h"
#include "filters/filter.h"
#include "filters/unit_curve.h"

extern const bl_filter bl_filter_box;

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
