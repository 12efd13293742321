// SPDX-License-Identifier: MIT
//
// How often cells of lattice=perm256 that lie near each other share a number.
//
// The index of a cell is p[(x + A(y, z)) mod 256] with A(y, z) = p[(y + p[z]) mod 256], p a
// permutation, so the cells at c and c + l have one index exactly where
// A(y, z) - A(y + l_y, z + l_z) = l_x: counted over the 2^16 pairs (y, z), which is exact for the
// mean over all places. Within a row along x no two indices are the same.
#ifndef BL_NOISES_LATTICE_LATTICE_REPEATS_H
#define BL_NOISES_LATTICE_LATTICE_REPEATS_H

enum { BL_REPEATS_REACH = 3 }; // cells, along each axis

// The share of the cells whose number is that of the cell `lag` further, in one to three
// dimensions; components are at most BL_REPEATS_REACH in size, and 0 beyond the dimensions.
double bl_perm256_repeats(unsigned dimensions, const int lag[3]);

#endif
