// SPDX-License-Identifier: MIT
#include "noises/octaves/gardner_theory.h"

#include <math.h>

// The third term, u_2 = 2 u_1: with U = U_1 and U' = U + dU, the mean over U of
//   (1/4 + J0(alpha)/2 (cos 2U + cos 2U') + 1/2 E[cos a cos a' | U]) (1/4 + 1/2 E[cos b cos b' |
//   U]).
static double third_term(double alpha, double beta, double across, double before_up, double up) {
    enum { PLACES = 24 };
    double sum = 0, half = before_up / 2;
    double still = j0(alpha), apart = cos(2 * across) * j0(2 * alpha * sin(half));
    double together = j0(2 * alpha * cos(half));
    for (int k = 0; k < PLACES; k++) {
        double phase = 2 * M_PI * k / PLACES, there = phase + across;
        double first = 0.25 + still / 2 * (cos(2 * phase) + cos(2 * there)) +
                       (apart + together * cos(2 * (phase + there))) / 2;
        double second = 0.25 + cos(up + beta * (cos(there) - cos(phase))) / 2;
        sum += first * second;
    }
    return sum / PLACES - 1.0 / 16;
}

double bl_gardner_covariance(const bl_gardner_terms *terms, const double lag[BL_AXES]) {
    double sum = 0, across_before = 0, up_before = 0; // phases of the lag
    for (unsigned i = 0; i < terms->count; i++) {
        double across = 2 * M_PI * terms->across[i] * lag[0];
        double up = 2 * M_PI * terms->up[i] * lag[1];
        double alpha = i ? 2 * M_PI * terms->across[i] * BL_GARDNER_X_PHASE : 0;
        double beta = i ? 2 * M_PI * terms->up[i] * BL_GARDNER_Y_PHASE : 0, own;
        if (i == 2) {
            own = third_term(alpha, beta, across_before, up_before, up);
        } else {
            double a = cos(across) * j0(2 * alpha * sin(up_before / 2));
            double b = cos(up) * j0(2 * beta * sin(across_before / 2));
            own = (a + b) / 8 + a * b / 4;
        }
        sum += terms->square[i] * terms->square[i] * own;
        across_before = across;
        up_before = up;
    }
    return sum;
}
