// SPDX-License-Identifier: MIT
//
// Random displacement from coarse to fine, on periodic grids: what the noises `midpoint` and
// `additions` are made of. Both are linear in the random numbers they draw, which is how their
// variance is found: bl_displacement_variance passes one unit number of each class through the
// same code, with no random number in sight.
#ifndef BL_NOISES_TILES_DISPLACEMENT_H
#define BL_NOISES_TILES_DISPLACEMENT_H

#include "noises/tiles/tile.h"

typedef struct bl_displacement {
    bl_tile_settings tile;
    double hurst;
    uint32_t all;        // 0: only the new points of a level move; 1: all of its points
    uint32_t lacunarity; // the ratio of the spacings of two levels, a power of two; 2 if not `all`
} bl_displacement;

extern const uint32_t bl_displacement_sizes[BL_TILE_AXES];

// How many random numbers it draws.
size_t bl_displacement_count(const bl_displacement *settings);

// Fills the grid, x fastest, from `numbers`; returns the sum over the levels of the standard
// deviation of a displacement: an upper bound of |value| / |largest number|.
double bl_displacement_fill(const bl_displacement *settings, const double *numbers, double *grid);

// The variance over places and seeds, as read back by the kernel. Errors: BL_DEVICE.
bl_status bl_displacement_variance(const bl_displacement *settings, double *variance,
                                   bl_message *message);

// Makes the tile. *scale is the factor that makes the variance 1; 0 asks for it. Errors: BL_DEVICE.
bl_status bl_displacement_build(const bl_displacement *settings, double *scale, bl_tile *tile,
                                bl_message *message);

// Facts: variance 1 and the range.
void bl_displacement_describe(const bl_displacement *settings, double scale, const bl_tile *tile,
                              bl_facts *facts);

#endif
