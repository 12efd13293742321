// SPDX-License-Identifier: MIT
//
// catmull-rom: the weights of the Catmull-Rom spline; its step is catstep.
//
//   k(t) = (2 - 5 |t|^2 + 3 |t|^3) / 2          for |t| < 1
//          (4 - 8 |t| + 5 |t|^2 - |t|^3) / 2    for |t| < 2, else 0
//   response: zeros of third order at all whole frequencies but 0, as 1 - O(f^4) near 0
//
// The weights of the samples about any point add to 1, and parabolas pass unchanged. It is negative
// for 1 < |t| < 2 and sharpens: its steps ring 1/24 beyond 0 and 1, at distances of one width. C1,
// not C2: the second derivative steps by 2 at |t| = 1 and by 1 at 2.
//
// Source: peachey2003, p. 65 (the filter and its step, by name); keys1981, for a = -1/2.
#include "filters/pieces.h"

static const bl_filter_pieces shape = {
    .kernel = BL_PIECEWISE_CATMULL_ROM,
    .step = {1, 24, {1, 2}, {{0, 24, 0, -20, 9}, {-4, 48, -48, 20, -3}}},
    .ramp = {0, 120, {1, 2}, {{14, 0, 60, 0, -25, 9}, {16, -20, 120, -80, 25, -3}}}};

BL_PIECES_ABILITIES(shape)

BL_FILTER_DESCRIPTOR(catmull_rom) = {
    .name = "catmull-rom",
    .title = "Catmull-Rom kernel",
    .summary = "The weights of the Catmull-Rom spline, with negative lobes: sharp, and it rings.",
    .formula = "(2 - 5t^2 + 3|t|^3)/2 for |t| < 1, (4 - 8|t| + 5t^2 - |t|^3)/2 for |t| < 2, else 0",
    .paper = "peachey2003, p. 65; keys1981",
    .support = 2,
    .continuity = 1,
    BL_PIECES_FUNCTIONS(shape)};
