// SPDX-License-Identifier: MIT
//
// mitchell: the cubic of Mitchell and Netravali with B = C = 1/3, between blur and ringing.
//
//   k(t) = (16 - 36 t^2 + 21 |t|^3) / 18              for |t| < 1
//          (32 - 60 |t| + 36 t^2 - 7 |t|^3) / 18      for |t| < 2, else 0
//
// 1/3 of the cubic B-spline and 2/3 of the Catmull-Rom kernel, hence its response is that mix, with
// zeros at all whole frequencies but 0. Its negative lobes are half as deep as those of
// Catmull-Rom; its step overshoots by 0.0175, at a distance of 8/7 widths.
//
// Source: mitchell1988.
#include "filters/pieces.h"

static const bl_filter_pieces shape = {
    .kernel = {0, 18, {1, 2}, {{16, 0, -36, 21}, {32, -60, 36, -7}}},
    .step = {1, 72, {1, 2}, {{0, 64, 0, -48, 21}, {-12, 128, -120, 48, -7}}},
    .ramp = {0, 360, {1, 2}, {{56, 0, 160, 0, -60, 21}, {64, -60, 320, -200, 60, -7}}}};

BL_PIECES_ABILITIES(shape)

BL_FILTER_DESCRIPTOR(mitchell) = {
    .name = "mitchell",
    .title = "Mitchell-Netravali kernel",
    .summary = "A third of the cubic B-spline and two thirds of Catmull-Rom: B = C = 1/3.",
    .formula =
        "(16 - 36t^2 + 21|t|^3)/18 for |t| < 1, (32 - 60|t| + 36t^2 - 7|t|^3)/18 for "
        "|t| < 2, else 0",
    .paper = "mitchell1988",
    .support = 2,
    .continuity = 1,
    BL_PIECES_FUNCTIONS(shape)};
