// SPDX-License-Identifier: MIT
//
// parabola: the kernel whose step is smoothstep over one width.
//
//   k(t) = 6 (1/4 - t^2) for |t| < 1/2, else 0
//   step(t) = 3 u^2 - 2 u^3 with u = t + 1/2
//   response(f) = 3 (sin a - a cos a) / a^3 with a = pi f: the first zero is 1.4303, where
//   tan a = a
//
// It is the narrowest of all filters here, and blurs least of those that do not ring: at 1, where
// the box has its zero, it still passes 3/pi^2 = 0.30. Widths twice as large (smoothstep from x - w
// to x + w) are the user's to choose.
//
// Deviation: the text takes smoothstep over [x, x + w] for a better approximation to the ideal
// filter than the box of that width. Over the same width it is further from it, for white noise and
// for a step; over one and a half widths it is nearer (reports/figures/filtered_steps.c).
//
// Source: peachey2003, p. 64.
#include "filters/pieces.h"

static const bl_filter_pieces shape = {.kernel = {0, 2, {0.5}, {{3, 0, -12}}},
                                       .step = {1, 2, {0.5}, {{0, 3, 0, -4}}},
                                       .ramp = {0, 32, {0.5}, {{3, 0, 24, 0, -16}}}};

BL_PIECES_ABILITIES(shape)

BL_FILTER_DESCRIPTOR(parabola) = {.name = "parabola",
                                  .title = "parabola",
                                  .summary = "The kernel whose step is smoothstep over one width.",
                                  .formula = "6 (1/4 - t^2) for |t| < 1/2, else 0",
                                  .paper = "peachey2003, p. 64",
                                  .support = 0.5,
                                  .continuity = 0,
                                  BL_PIECES_FUNCTIONS(shape)};
