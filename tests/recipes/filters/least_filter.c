// SPDX-License-Identifier: MIT
//
// least-filter: the quadratic B-spline, three boxes one after another.
//
//   k(t) = 3/4 - t^2 for |t| < 1/2, (3/2 - |t|)^2 / 2 for |t| < 3/2, else 0
#include "filters/pieces.h"

static const bl_filter_pieces shape = {
    .kernel = {0, 8, {0.5, 1.5}, {{6, 0, -8}, {9, -12, 4}}},
    .step = {1, 48, {0.5, 1.5}, {{0, 36, 0, -16}, {-3, 54, -36, 8}}},
    .ramp = {0, 384, {0.5, 1.5}, {{78, 0, 144, 0, -32}, {81, -24, 216, -96, 16}}}};

BL_PIECES_ABILITIES(shape)

BL_FILTER_DESCRIPTOR(least_filter) = {.name = "least-filter",
                                      .title = "quadratic B-spline",
                                      .summary = "Three boxes one after another.",
                                      .formula = "3/4 - t^2, then (3/2 - |t|)^2 / 2",
                                      .paper = "bandlimit",
                                      .support = 1.5,
                                      .continuity = 1,
                                      BL_PIECES_FUNCTIONS(shape)};
