// SPDX-License-Identifier: MIT
//
// tent: two boxes, one after the other.
//
//   k(t) = 1 - |t| for |t| < 1, else 0
//   step(t) = 1/2 + t - t |t| / 2
//   response(f) = (sin(pi f) / (pi f))^2
//
// The weights of linear interpolation: two samples see every point, and their weights add to 1.
//
// Source: peachey2003, p. 64, the box applied to its own step.
#include "filters/pieces.h"

static const bl_filter_pieces shape = {.kernel = BL_PIECEWISE_TENT,
                                       .step = {1, 2, {1}, {{0, 2, -1}}},
                                       .ramp = {0, 6, {1}, {{1, 0, 3, -1}}}};

BL_PIECES_ABILITIES(shape)

BL_FILTER_DESCRIPTOR(tent) = {.name = "tent",
                              .title = "tent",
                              .summary = "Falls off linearly over one width to both sides.",
                              .formula = "1 - |t| for |t| < 1, else 0",
                              .paper = "peachey2003, p. 64",
                              .support = 1,
                              .continuity = 0,
                              BL_PIECES_FUNCTIONS(shape)};
