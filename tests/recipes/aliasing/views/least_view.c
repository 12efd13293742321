// SPDX-License-Identifier: MIT
//
// least-view: a pixel is an eighth of a unit: (s, t) = (x, y) / 8.
#include "aliasing/view.h"

static int see(const void *block, const double size[2], double x, double y, bl_sight *sight) {
    (void)block, (void)size;
    *sight = (bl_sight){.at = {x / 8, y / 8}, .across = {0.125}, .down = {0, 0.125}, .distance = 1};
    return 1;
}

static const bl_parameter parameters[] = {{0}};

BL_VIEW_DESCRIPTOR(least_view) = {.name = "least-view",
                                  .title = "eighths",
                                  .summary = "A pixel is an eighth of a unit.",
                                  .formula = "(s, t) = (x, y) / 8",
                                  .parameters = parameters,
                                  .see = see,
                                  .affine = 1};
