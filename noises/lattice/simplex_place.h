// SPDX-License-Identifier: MIT
//
// The simplex of a point: the cell of the skewed point, its fractions in falling order, and the
// offset from corner 0 (noises/simplex_noise.c has the geometry).
//
// The skew F S of the sum S of the cells is what needs care: rounded as a double it would lose the
// fraction far out. Two ways, both good to 2^-52 of a cell:
//
//   near   all coordinates below 2^27 in size: F in three parts, in doubles alone, without a branch
//          or a wide product, so that loops of it become vectors
//   far    the others below 2^62: F has 128 bits
//
// The point alone decides which, and the reference goes the same ways, so that float and double
// agree on the simplex of every point, which a kernel that jumps at the facets needs.
#ifndef BL_NOISES_LATTICE_SIMPLEX_PLACE_H
#define BL_NOISES_LATTICE_SIMPLEX_PLACE_H

#include <math.h>
#include <stdint.h>

#include "core/signal.h"
#include "noises/lattice/lattice.h"
#include "noises/lattice/separable.h"

// F and G, by dims.
static const double simplex_skews[] = {0, 0, 0.36602540378443865, 1.0 / 3, 0.30901699437494742};
static const double simplex_unskews[] = {0, 0, 0.21132486540518712, 1.0 / 6, 0.13819660112501051};

// floor(2^128 F) by 64 bits, from whole square roots of 280 bits.
static const uint64_t simplex_skew_high[] = {0, 0, 0x5db3d742c265539d, 0x5555555555555555,
                                             0x4f1bbcdcbfa53e0a};
static const uint64_t simplex_skew_low[] = {0, 0, 0x92ba16b83c5c1dc4, 0x5555555555555555,
                                            0xf9ce60302e76e41a};

// F = high + middle + low, from whole square roots of 600 bits: the first 22 bits after the point,
// the next 24, and the rest as a double, which is off by less than 1e-30.
static const double simplex_near_high[] = {0, 0, 0x1.76cf5p-2, 0x1.55555p-2, 0x1.3c6efp-2};
static const double simplex_near_middle[] = {0, 0, 0x1.a16132p-23, 0x1.555554p-24, 0x1.b97f48p-25};
static const double simplex_near_low[] = {0, 0, 0x1.539d92ba16b84p-48, 0x1.5555555555555p-48,
                                          0x1.3e0af9ce60303p-48};

typedef struct simplex_place {
    double fraction[BL_AXES]; // of the skewed point
    double total;             // of the fractions
    uint64_t cell[BL_AXES];
} simplex_place;

BL_INLINE int simplex_is_near(unsigned dims, const double at[BL_AXES]) {
    int near = 1;
    for (unsigned a = 0; a < dims; a++)
        near &= fabs(at[a]) < BL_NEAR; // false for NaN
    return near;
}

// F S of near cells, of the sum S: its whole part to `whole`, or a neighbour of it, and the rest.
// |S| <= 2^29, so S * high (21 bits) and S * middle (24 bits) are exact. `whole` is at most 1 from
// F S, so that what remains is at most 1 in size except for 2^-17 (S * low), and the sum of the
// first two parts, a multiple of 2^-46, is exact: the one rounding is the last.
BL_INLINE double simplex_skew_near(unsigned dims, double cells, double *whole) {
    *whole = floor(cells * simplex_skews[dims]);
    return ((cells * simplex_near_high[dims] - *whole) + cells * simplex_near_middle[dims]) +
           cells * simplex_near_low[dims];
}

// The fraction of F S, S the sum of the cells; the whole part, modulo 2^64, to `whole`. In units of
// 2^-64: S times the high half of F modulo 2^128, which two's complement makes right for negative
// sums, and S times the low half, of which a bit is dropped: |S| < 2^64, so |S/2| < 2^63, and its
// product with 64 bits fits.
static inline double simplex_skew_far(unsigned dims, __int128 sum, uint64_t *whole) {
    __int128 low = ((__int128)(int64_t)(sum >> 1) * (__int128)simplex_skew_low[dims]) >> 63;
    unsigned __int128 all =
        (unsigned __int128)sum * simplex_skew_high[dims] + (unsigned __int128)low;
    *whole = (uint64_t)(all >> 64);
    return (double)(uint64_t)all * 0x1p-64;
}

// Returns 0 outside of the domain. Fractions of u are below 1 + 1 + n, so their floors are small.
static inline int simplex_place_of(unsigned dims, const double at[BL_AXES], simplex_place *place) {
    double fractions = 0, total = 0, rest;
    __int128 cells = 0;
    uint64_t whole;
    for (unsigned a = 0; a < dims; a++) {
        if (!bl_lattice_split(at[a], &place->cell[a], &place->fraction[a]))
            return 0;
        cells += (int64_t)place->cell[a];
        fractions += place->fraction[a];
    }
    if (simplex_is_near(dims, at)) {
        double down;
        rest = simplex_skew_near(dims, (double)(int64_t)cells, &down);
        whole = (uint64_t)(int64_t)down;
    } else {
        rest = simplex_skew_far(dims, cells, &whole);
    }
    double shift = rest + simplex_skews[dims] * fractions;
    for (unsigned a = 0; a < dims; a++) {
        double u = place->fraction[a] + shift, down = floor(u);
        place->cell[a] += whole + (uint64_t)(int64_t)down;
        place->fraction[a] = u - down;
        total += place->fraction[a];
    }
    place->total = total;
    return 1;
}

// The offset along an axis from corner 0, not skewed.
BL_INLINE double simplex_offset(unsigned dims, double fraction, double total) {
    return fraction - simplex_unskews[dims] * total;
}

// How many fractions come before those of each axis: 0 for the largest; of equals, the first.
BL_INLINE void simplex_ranks(unsigned dims, const double fraction[BL_AXES],
                             uint32_t rank[BL_AXES]) {
    for (unsigned a = 0; a < dims; a++)
        rank[a] = a;
    for (unsigned a = 0; a < dims; a++)
        for (unsigned b = a + 1; b < dims; b++) {
            uint32_t larger = fraction[b] > fraction[a];
            rank[a] += larger;
            rank[b] -= larger;
        }
}

#endif
