// SPDX-License-Identifier: MIT
//
// Special places of a cell, where functions break ties: random places never meet them.
//
// Planes: coordinates that are whole, half and zero (of both signs), on every set of axes. Ties:
// fractions that are equal, and coordinates that are. Sums: coordinates, with either sign, whose
// sum is whole or zero (antidiagonals). Skewed lattices: planes of the lattice of simplices, where
// x + F (x + y + ...) is whole. The other fractions are multiples of 2^-10, within 8 cells of 0, so
// that all of this is exact where the cell is a power of two, in floats as well.
#ifndef BL_SCORE_PROPERTIES_SPECIAL_H
#define BL_SCORE_PROPERTIES_SPECIAL_H

#include <stddef.h>

#include "core/random.h"
#include "core/signal.h"

enum { BL_SPECIAL_MOST = 640 };

typedef struct bl_special {
    size_t count;
    double at[BL_AXES][BL_SPECIAL_MOST]; // in units; 0 on axes that there are not
} bl_special;

// The places for a cell of that many units, the origin first.
void bl_special_fill(bl_special *special, unsigned dimensions, double cell, bl_random *random);

#endif
