// SPDX-License-Identifier: MIT
//
// The covariance of Gardner's sum of cosines over places, exact.
//
// Its waves have the phases U_i = 2 pi u_i x and V_i = 2 pi v_i y, and
//
//   a_i = U_i + alpha_i cos V_{i-1},   b_i = V_i + beta_i cos U_{i-1},   alpha_0 = beta_0 = 0
//
// except for constants in a_0 and b_0. Over all places phases whose frequencies have no common
// measure are independent and uniform. For a lag (dx, dy) then
//
//   2 E[cos a_i cos a_i'] = cos(2 pi u_i dx) J0(2 alpha_i sin(pi v_{i-1} dy)) =: A_i
//
// (the difference of the phases is alpha_i (cos V' - cos V) = -2 alpha_i sin(dV/2) sin(V + dV/2)),
// B_i alike, and the covariance of the i-th term is  A_i/8 + B_i/8 + A_i B_i/4  times its square.
//
// One pair of phases is not independent: u_2 = 2 u_1. Given U_1 the third term is averaged over V_1
// and V_2 as above, where sums of phases no longer vanish, and then over U_1 by a sum of 24 places,
// exact to rounding: its harmonics end, as J_n(2 beta_2), before the 20th. All other waves of
// different terms, and of one, differ (t-gardner counts them), up to the seventh term; with the
// eighth, u_7 = 6 u_5 and u_7 = 5/2 u_6, and nothing is stated.
#ifndef BL_NOISES_OCTAVES_GARDNER_THEORY_H
#define BL_NOISES_OCTAVES_GARDNER_THEORY_H

#include "core/signal.h"

enum { BL_GARDNER_TERMS = 8, BL_GARDNER_KNOWN = 7 };

// The swing of the phases of x and y, units.
#define BL_GARDNER_X_PHASE (0.9 * 1.57079632679489661923)
#define BL_GARDNER_Y_PHASE (1.1 * 1.57079632679489661923)

// What the parameters make: constant for a call.
typedef struct bl_gardner_terms {
    unsigned count;
    double across[BL_GARDNER_TERMS], up[BL_GARDNER_TERMS]; // u_i and v_i, cycles a unit
    double square[BL_GARDNER_TERMS];                       // A_i^2, times the weight kept
    double x, y;                                           // added to the coordinates
    double lost; // the sum of the means of what is removed
    double all;  // of all A_i^2
} bl_gardner_terms;

// Of at most BL_GARDNER_KNOWN terms.
double bl_gardner_covariance(const bl_gardner_terms *terms, const double lag[BL_AXES]);

#endif
