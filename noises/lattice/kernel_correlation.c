// SPDX-License-Identifier: MIT
//
// The correlation of a kernel with itself, exact.
//
// Its jumps are products of the kernel's (noises/lattice/kernel.h). A piecewise polynomial that
// vanishes right of its last knot is minus the sum of what still jumps:
//     rho(t) = - sum over knots d > t and orders p of  jump(d, p) (t - d)^p / p!.
// On [n, n+1] we expand each power about n + 1/2. The jumps are whole numbers below 2^53 (the
// largest is 4320^2), and the sums are in long double; the coefficients of the quintic ramp, the
// worst, come out to 1e-17.
#include <math.h>

#include "noises/lattice/kernel_tables.h"

typedef struct knot_jumps {
    double knot;
    double jump[BL_PIECEWISE_ORDERS];
} knot_jumps;

// All knots of the kernel, on both sides of 0.
static int both_sides(bl_kernel kernel, knot_jumps out[2 * BL_PIECEWISE_PIECES + 1]) {
    bl_piecewise_jumps jumps = bl_piecewise_find_jumps(&bl_kernel_shapes[kernel]);
    int odd = bl_kernel_is_odd(kernel), count = 0;
    for (int i = 0; i < jumps.count; i++)
        for (int side = i == 0 ? 1 : -1; side <= 1; side += 2, count++) {
            out[count].knot = side * jumps.knot[i];
            for (int m = 0; m < BL_PIECEWISE_ORDERS; m++)
                out[count].jump[m] =
                    side > 0 || ((m & 1) != odd) ? jumps.jump[i][m] : -jumps.jump[i][m];
        }
    return count;
}

// sum += scale * (s + shift)^p as a polynomial in s.
static void add_power(long double *sum, long double scale, long double shift, int p) {
    long double term = scale; // scale * binomial(p, i) * shift^(p-i), from i = p down
    for (int i = p; i >= 0; i--) {
        sum[i] += term;
        term *= shift * i / (p - i + 1);
    }
}

void bl_kernel_find_correlation(bl_kernel kernel, bl_correlation *correlation) {
    knot_jumps at[2 * BL_PIECEWISE_PIECES + 1];
    int count = both_sides(kernel, at);
    long double factorial[BL_CORRELATION_ORDERS] = {1};
    for (int p = 1; p < BL_CORRELATION_ORDERS; p++)
        factorial[p] = p * factorial[p - 1];
    double divisor = bl_kernel_shapes[kernel].divisor;
    *correlation = (bl_correlation){.pieces = (int)(2 * bl_kernel_support(kernel))};
    for (int n = 0; n < correlation->pieces; n++) {
        long double sum[BL_CORRELATION_ORDERS] = {0};
        for (int i = 0; i < count; i++)
            for (int j = 0; j < count; j++) {
                double d = at[j].knot - at[i].knot;
                if (d <= n)
                    continue;
                for (int m = 0; m < BL_PIECEWISE_ORDERS; m++)
                    for (int k = 0; k < BL_PIECEWISE_ORDERS; k++) {
                        double jump = at[i].jump[m] * at[j].jump[k] * (m & 1 ? 1 : -1);
                        if (jump != 0)
                            add_power(sum, -jump / factorial[m + k + 1], n + 0.5L - d, m + k + 1);
                    }
            }
        for (int p = 0; p < BL_CORRELATION_ORDERS; p++)
            correlation->coefficient[n][p] = (double)(sum[p] / (divisor * divisor));
    }
}

double bl_kernel_correlation(bl_kernel kernel, double lag) {
    const bl_correlation *correlation = &bl_kernel_get_tables()->correlation[kernel];
    double size = fabs(lag);
    if (!(size < correlation->pieces))
        return isnan(lag) ? lag : 0;
    int n = (int)size;
    return bl_polynomial(correlation->coefficient[n], BL_CORRELATION_ORDERS, size - n - 0.5);
}
