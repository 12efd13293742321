// SPDX-License-Identifier: MIT
#include "core/piecewise.h"

#include <math.h>

double bl_polynomial(const double *coefficient, int orders, double x) {
    double sum = 0;
    for (int i = orders - 1; i >= 0; i--)
        sum = sum * x + coefficient[i];
    return sum;
}

static int piece_count(const bl_piecewise *function) {
    return function->knot[1] > 0 ? 2 : 1;
}

double bl_piecewise_support(const bl_piecewise *function) {
    return function->knot[piece_count(function) - 1];
}

double bl_piecewise_value(const bl_piecewise *function, double x) {
    double size = fabs(x);
    for (int i = 0; i < piece_count(function); i++)
        if (size < function->knot[i]) {
            double value = bl_polynomial(function->coefficient[i], BL_PIECEWISE_ORDERS, size) /
                           function->divisor;
            return function->odd && x < 0 ? -value : value;
        }
    return isnan(x) ? x : 0;
}

// The m-th derivative at x of a polynomial with whole coefficients.
static double derivative(const double *coefficient, int m, double x) {
    double sum = 0;
    for (int i = BL_PIECEWISE_ORDERS - 1; i >= m; i--) {
        double falling = 1; // i (i-1) ... (i-m+1)
        for (int j = 0; j < m; j++)
            falling *= i - j;
        sum = sum * x + falling * coefficient[i];
    }
    return sum;
}

bl_piecewise_jumps bl_piecewise_find_jumps(const bl_piecewise *function) {
    int pieces = piece_count(function);
    bl_piecewise_jumps jumps = {.count = pieces + 1};
    for (int m = 0; m < BL_PIECEWISE_ORDERS; m++) {
        // Left of 0 the m-th derivative is (-1)^m times the right one; an odd function turns it.
        int flips = (m & 1) != function->odd;
        jumps.jump[0][m] = flips ? 2 * derivative(function->coefficient[0], m, 0) : 0;
        for (int i = 0; i < pieces; i++) {
            double x = function->knot[i];
            double right = i + 1 < pieces ? derivative(function->coefficient[i + 1], m, x) : 0;
            jumps.knot[i + 1] = x;
            jumps.jump[i + 1][m] = right - derivative(function->coefficient[i], m, x);
        }
    }
    return jumps;
}

int bl_piecewise_continuity(const bl_piecewise *function) {
    bl_piecewise_jumps jumps = bl_piecewise_find_jumps(function);
    for (int m = 0; m < BL_PIECEWISE_ORDERS; m++)
        for (int i = 0; i < jumps.count; i++)
            if (jumps.jump[i][m] != 0)
                return m - 1;
    return BL_PIECEWISE_ORDERS;
}
