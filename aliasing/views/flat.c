// SPDX-License-Identifier: MIT
//
// flat: the texture straight ahead, at any scale, rotation and offset.
//
//   (s, t) = (x, y) offset + scale / width * R(rotate) (pixel - middle of the image)
//
// Parameters
//   scale    units across the width of the image
//   rotate   of the texture against the image, degrees, counterclockwise
//   x, y     the place in the middle of the image
//   z, w     of the slice through a solid signal; random where they are not asked for
//
// t runs downwards, as rows do. The derivatives are exact and the same all over.
#include "aliasing/view.h"

#include <math.h>
#include <stddef.h>

typedef struct flat_parameters {
    double scale, rotate, x, y, z, w;
} flat_parameters;

static int see(const void *block, const double size[2], double x, double y, bl_sight *sight) {
    const flat_parameters *p = block;
    double pixel = p->scale / size[0], angle = p->rotate * (M_PI / 180);
    double along[2] = {pixel * cos(angle), pixel * sin(angle)};
    double right = x - 0.5 * size[0], down = y - 0.5 * size[1];
    *sight = (bl_sight){.at = {0, 0, p->z, p->w},
                        .across = {along[0], along[1]},
                        .down = {-along[1], along[0]},
                        .distance = 1};
    sight->at[0] = p->x + right * sight->across[0] + down * sight->down[0];
    sight->at[1] = p->y + right * sight->across[1] + down * sight->down[1];
    return 1;
}

// clang-format off
#define PLACE(field, usual, what, least, most)                                                     \
    {#field, BL_REAL, offsetof(flat_parameters, field), usual, "units", .minimum = least,          \
     .maximum = most, .help = what}
// clang-format on
static const bl_parameter parameters[] = {
    PLACE(scale, "4", "across the width of the image", 1e-12, 1e12),
    {"rotate", BL_REAL, offsetof(flat_parameters, rotate), "0", "degrees", .minimum = -360,
     .maximum = 360, .help = "of the texture against the image, counterclockwise"},
    PLACE(x, "0", "in the middle of the image", -1e15, 1e15),
    PLACE(y, "0", "in the middle of the image", -1e15, 1e15),
    PLACE(z, "0", "of the slice through a solid signal; without the key a random one", -1e15, 1e15),
    PLACE(w, "0", "the same along the fourth axis", -1e15, 1e15),
    {0}};

static const char *const examples[] = {"scale=7,rotate=30,x=3,y=-2", NULL};

BL_VIEW_DESCRIPTOR(flat) = {.name = "flat",
                            .title = "straight ahead",
                            .summary = "The texture at any scale, rotation and offset.",
                            .formula = "(s, t) = (x, y) + scale / width * R (pixel - middle)",
                            .parameters = parameters,
                            .parameters_size = sizeof(flat_parameters),
                            .examples = examples,
                            .see = see,
                            .affine = 1};
