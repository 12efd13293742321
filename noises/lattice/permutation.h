// SPDX-License-Identifier: MIT
//
// The text's permutation of 0..255 as it is printed (peachey2003, p. 70): of the lattice=perm256
// (noises/lattice/lattice.h) and of the plain loops (noises/textbook.h).
#ifndef BL_NOISES_LATTICE_PERMUTATION_H
#define BL_NOISES_LATTICE_PERMUTATION_H

extern const unsigned char bl_permutation[256];

#endif
