// SPDX-License-Identifier: MIT
//
// smoothstep: the parabola whose step is smoothstep over one width.
//
//   k(t) = 6 (1/4 - t^2) for |t| < 1/2, else 0
//   step(t) = 3 u^2 - 2 u^3 with u = t + 1/2
//   response(f) = 3 (sin a - a cos a) / a^3 with a = pi f: the first zero is 1.4303, where
//   tan a = a
//
// It is the narrowest of all filters here, and blurs least: at the sampling frequency 1, where the
// box has its zero, it still passes 3/pi^2 = 0.30. Widths twice as large (smoothstep from x - w to
// x + w) are the user's to choose.
//
// Deviation: the text calls the filter quadratic and third-order, and smoothstep over [x, x + w]
// better than the box for that; its response says by how much, and where not.
//
// Source: peachey2003, p. 64.
#include "filters/pieces.h"

static const bl_filter_pieces shape = {.kernel = {0, 2, {0.5}, {{3, 0, -12}}},
                                       .step = {1, 2, {0.5}, {{0, 3, 0, -4}}},
                                       .ramp = {0, 32, {0.5}, {{3, 0, 24, 0, -16}}}};

BL_PIECES_ABILITIES(shape)

BL_FILTER_DESCRIPTOR(smoothstep) = {
    .name = "smoothstep",
    .title = "parabola",
    .summary = "The kernel whose step is smoothstep over one width.",
    .formula = "6 (1/4 - t^2) for |t| < 1/2, else 0",
    .paper = "peachey2003, p. 64",
    .support = 0.5,
    .continuity = 0,
    BL_PIECES_FUNCTIONS(shape)};
