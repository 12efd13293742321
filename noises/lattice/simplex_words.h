// SPDX-License-Identifier: MIT
//
// The words of the corners of simplices, for any lattice.
//
// Periods. In three dimensions, where F = 1/3, a whole shift P along x moves the skewed numbers by
// (P + P/3, P/3, P/3): the lattice falls on itself where P is a multiple of 3, and nowhere else. So
// a cell is wrapped where its place is: in sixths of a unit that is q_a = 6 u_a - sum u, which is
// taken modulo 6 P_a, and back goes u_a = (3 q_a + sum q) / 18, a whole number because both shifts
// were ones of the lattice. In two and four dimensions F is irrational, and no P will do.
#ifndef BL_NOISES_LATTICE_SIMPLEX_WORDS_H
#define BL_NOISES_LATTICE_SIMPLEX_WORDS_H

#include "noises/lattice/lattice.h"
#include "noises/lattice/lattice_dimensions.h"

// Whether cells need more than the keys of their own numbers.
static inline int simplex_is_plain(const bl_lattice *lattice) {
    return lattice->kind == BL_LATTICE_HASH &&
           !(lattice->period[0] | lattice->period[1] | lattice->period[2]);
}

// The cell in the box of the periods that stands for `cell`, in three dimensions. Skewed numbers
// are whole numbers of 64 bits but where all coordinates are beyond 2^61, far past the last
// fraction.
static inline void simplex_wrap(const bl_lattice *lattice, uint64_t cell[BL_AXES]) {
    __int128 total = 0, sum = 0, place[3];
    for (unsigned a = 0; a < 3; a++)
        total += (int64_t)cell[a];
    for (unsigned a = 0; a < 3; a++) {
        place[a] = 6 * (__int128)(int64_t)cell[a] - total;
        __int128 period = 6 * (__int128)lattice->period[a];
        if (period) {
            place[a] %= period;
            place[a] += place[a] < 0 ? period : 0;
        }
        sum += place[a];
    }
    for (unsigned a = 0; a < 3; a++)
        cell[a] = (uint64_t)((3 * place[a] + sum) / 18);
}

// The word of a skewed cell; `words256` are those of lattice=perm256.
static inline uint32_t simplex_word(const bl_lattice *lattice, unsigned dims,
                                    const uint64_t cell[BL_AXES], const uint32_t words256[256]) {
    uint64_t at[BL_AXES] = {0};
    memcpy(at, cell, dims * sizeof *at);
    if (dims == 3 && (lattice->period[0] | lattice->period[1] | lattice->period[2]))
        simplex_wrap(lattice, at);
    if (lattice->kind == BL_LATTICE_PERM256)
        return words256[bl_perm256_index_in(dims, at)];
    uint32_t add = 0, exclusive = 0;
    for (unsigned a = 0; a < dims; a++) {
        bl_lattice_key key = bl_lattice_wrapped_key(lattice, a, at[a]);
        add += key.add;
        exclusive ^= key.exclusive;
    }
    return add * exclusive;
}

#endif
