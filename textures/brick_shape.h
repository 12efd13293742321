// SPDX-License-Identifier: MIT
//
// The geometry of bricks, which the textures made of them share: rows of bricks in mortar, each
// second row shifted by half a brick. In brick coordinates (units of one brick with its mortar) a
// brick spans edge .. 1 - edge along both axes.
#ifndef BL_TEXTURES_BRICK_SHAPE_H
#define BL_TEXTURES_BRICK_SHAPE_H

#include "textures/texture.h"

typedef struct bl_brick_sizes {
    double brick_width, brick_height, mortar; // units
} bl_brick_sizes;

typedef struct bl_brick {
    double size[2]; // of a brick with its mortar, units
    double edge[2]; // half the mortar, in bricks
} bl_brick;

extern const bl_colour bl_brick_colour, bl_mortar_colour; // those of the text

bl_brick bl_brick_of(const bl_brick_sizes *sizes);
// The share of brick in all of the wall, and the mean colour of the wall.
double bl_brick_share(const bl_brick *brick);
bl_colour bl_brick_mean(const bl_brick *brick);
// How far a row is shifted: half a brick if its number is odd.
double bl_brick_shift(double row);
// The box average of being brick, over samples of these widths centred at a place, in units: exact
// over any number of rows, of both parities.
double bl_brick_average(const bl_brick *brick, const double at[BL_AXES],
                        const double width[BL_AXES]);

// clang-format off
// The keys of bl_brick_sizes, for a block that has them as `field`.
#define BL_BRICK_LENGTH_(block, field, name, usual, what)                                          \
    {#name, BL_REAL, offsetof(block, field.name), usual, "units", .minimum = 1e-6,                 \
     .maximum = 1e6, .help = what}
// clang-format on
#define BL_BRICK_PARAMETERS(block, field)                                                          \
    BL_BRICK_LENGTH_(block, field, brick_width, "0.25", "of a brick"),                             \
        BL_BRICK_LENGTH_(block, field, brick_height, "0.08", "of a brick"),                        \
        BL_BRICK_LENGTH_(block, field, mortar, "0.01", "thickness of the mortar")

#endif
