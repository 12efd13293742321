// SPDX-License-Identifier: MIT
//
// What the files of noises/kernel.h share: the pieces, the jumps and the correlation's pieces. The
// tables are computed once, before the first use, and constant from then on.
#ifndef BL_NOISES_KERNEL_TABLES_H
#define BL_NOISES_KERNEL_TABLES_H

#include "noises/kernel.h"

enum {
    BL_KERNEL_ORDERS = 7,                        // derivatives 0 to 6: x times a quintic
    BL_KERNEL_PIECES = 2,                        // at x >= 0
    BL_CORRELATION_PIECES = 4,                   // [0, 1], ... [3, 4]
    BL_CORRELATION_ORDERS = 2 * BL_KERNEL_ORDERS // degree 13 at most
};

typedef struct bl_kernel_shape {
    const char *name;
    int odd;
    double divisor;                // of the coefficients: they are whole numbers
    double knot[BL_KERNEL_PIECES]; // the right end of each piece; 0 after the last
    double coefficient[BL_KERNEL_PIECES][BL_KERNEL_ORDERS]; // of x^0, x^1, ...
} bl_kernel_shape;

extern const bl_kernel_shape bl_kernel_shapes[BL_KERNEL_COUNT];

// The jumps at the knots x >= 0, times the divisor; whole numbers over powers of two, so exact.
// At -x the jump is -(-1)^m J(x, m) for an even kernel, (-1)^m J(x, m) for an odd one.
typedef struct bl_kernel_jumps {
    int count;
    double knot[BL_KERNEL_PIECES + 1];
    double jump[BL_KERNEL_PIECES + 1][BL_KERNEL_ORDERS];
} bl_kernel_jumps;

typedef struct bl_correlation {
    int pieces; // piece n is a polynomial in t - n - 1/2 on [n, n+1]; knots are whole numbers
    double coefficient[BL_CORRELATION_PIECES][BL_CORRELATION_ORDERS];
} bl_correlation;

bl_kernel_jumps bl_kernel_find_jumps(bl_kernel kernel);
void bl_kernel_find_correlation(bl_kernel kernel, bl_correlation *correlation);

typedef struct bl_kernel_tables {
    bl_kernel_jumps jumps[BL_KERNEL_COUNT];
    bl_correlation correlation[BL_KERNEL_COUNT];
    bl_correlation radial; // R on [n, n+1] for n > 0 is radial(d)/d, for n = 0 it is radial(d)
} bl_kernel_tables;

void bl_kernel_find_radial(const bl_correlation *ramp, bl_correlation *radial);
const bl_kernel_tables *bl_kernel_get_tables(void);

// sum of coefficient[i] x^i, i < orders.
double bl_polynomial(const double *coefficient, int orders, double x);

#endif
