// SPDX-License-Identifier: MIT
//
// What the files of noises/lattice/kernel.h share: the pieces, the jumps and the correlation's
// pieces. The tables are computed once, before the first use, and constant from then on.
#ifndef BL_NOISES_LATTICE_KERNEL_TABLES_H
#define BL_NOISES_LATTICE_KERNEL_TABLES_H

#include "core/piecewise.h"
#include "noises/lattice/kernel.h"

enum {
    BL_CORRELATION_PIECES = 4,                      // [0, 1], ... [3, 4]
    BL_CORRELATION_ORDERS = 2 * BL_PIECEWISE_ORDERS // degree 13 at most
};

extern const bl_piecewise bl_kernel_shapes[BL_KERNEL_COUNT];

typedef struct bl_correlation {
    int pieces; // piece n is a polynomial in t - n - 1/2 on [n, n+1]; knots are whole numbers
    double coefficient[BL_CORRELATION_PIECES][BL_CORRELATION_ORDERS];
} bl_correlation;

void bl_kernel_find_correlation(bl_kernel kernel, bl_correlation *correlation);

typedef struct bl_kernel_tables {
    bl_piecewise_jumps jumps[BL_KERNEL_COUNT];
    bl_correlation correlation[BL_KERNEL_COUNT];
    bl_correlation radial; // R on [n, n+1] for n > 0 is radial(d)/d, for n = 0 it is radial(d)
} bl_kernel_tables;

void bl_kernel_find_radial(const bl_correlation *ramp, bl_correlation *radial);
const bl_kernel_tables *bl_kernel_get_tables(void);

#endif
