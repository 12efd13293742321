// SPDX-License-Identifier: MIT
#include "core/footprint.h"

#include <math.h>
#include <string.h>

const bl_footprint bl_footprint_point = {{0}, {0}, {0}};

bl_footprint bl_footprint_of_widths(const double width[BL_AXES]) {
    bl_footprint footprint = {.across = {width[0]}, .down = {0, width[1]}};
    memcpy(footprint.width, width, sizeof footprint.width);
    return footprint;
}

bl_footprint bl_footprint_of_width(double width) {
    return bl_footprint_of_widths((const double[BL_AXES]){width, width, width, width});
}

double bl_footprint_widest(const bl_footprint *footprint, unsigned dimensions) {
    double widest = 0;
    for (unsigned a = 0; a < dimensions; a++) {
        if (isnan(footprint->width[a]))
            return NAN;
        if (footprint->width[a] > widest)
            widest = footprint->width[a];
    }
    return widest;
}

int bl_footprint_is_whole(const bl_footprint *footprint, unsigned dimensions) {
    for (unsigned a = 0; a < dimensions; a++)
        if (!isinf(footprint->width[a]))
            return 0;
    return 1;
}

bl_samples bl_samples_part(const bl_samples *samples, size_t first, size_t most) {
    bl_samples part = *samples;
    for (int a = 0; a < BL_AXES; a++)
        part.at[a] += first;
    part.footprint += first * part.step;
    part.count = part.count - first < most ? part.count - first : most;
    return part;
}
