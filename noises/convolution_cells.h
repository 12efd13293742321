// SPDX-License-Identifier: MIT
//
// Random numbers of lattice cells for the convolution noises: two 32-bit words a cell, and from
// them any number of impulses.
//
//   key(axis, cell) = mix(cell + stream of the seed and the axis)                64 bits
//   u = sum of the low halves of the three keys, v = xor of the high halves
//   words: finalise(u, v) and finalise(u + 0x9e3779b9, v)
//
// Both halves are fully mixed, so lattice planes share nothing; the sum and the xor do not commute,
// so that a rectangle of four cells does not cancel as it would with one linear operation; two
// multiplications then mix them. The work for each cell is a dozen 32-bit operations and vectorises
// over cells or points.
//
// With lattice=perm256 the words depend on the cell by the text's 8-bit index alone,
// P(x + P(y + P(z))), and the noise has period 256 along x, y and z.
#ifndef BL_NOISES_CONVOLUTION_CELLS_H
#define BL_NOISES_CONVOLUTION_CELLS_H

#include <math.h>
#include <stdint.h>

#include "core/hash.h"
#include "noises/textbook.h"

enum { LANES = 16 }; // of every block of this file's users, whatever the instruction set

// Coordinates below this in size have a cell number that fits in 64 bits with room for neighbours.
#define COORDINATE_LIMIT 0x1p62

typedef struct cell_numbers {
    uint64_t stream[3]; // one an axis
    uint64_t table;     // the stream of the 256 entries
    int permuted;       // lattice=perm256
} cell_numbers;

typedef struct cell_words {
    uint32_t first, second;
} cell_words;

static inline cell_numbers cell_numbers_of(uint64_t seed, int permuted) {
    return (cell_numbers){{bl_stream(seed, 0), bl_stream(seed, 1), bl_stream(seed, 2)},
                          bl_stream(seed, 3),
                          permuted};
}

// The key of a cell along an axis; for perm256 just the cell's number modulo 256.
static inline uint64_t cell_key(const cell_numbers *numbers, int axis, uint64_t cell) {
    return numbers->permuted ? cell & 255 : bl_mix(cell + numbers->stream[axis]);
}

static inline uint32_t finalise(uint32_t u, uint32_t v) {
    uint32_t h = (u ^ v) * UINT32_C(0x7feb352d);
    h = ((h ^ h >> 15) + v) * UINT32_C(0x846ca68b);
    return h ^ h >> 16;
}

static inline cell_words cell_words_of(uint32_t u, uint32_t v) {
    return (cell_words){finalise(u, v), finalise(u + UINT32_C(0x9e3779b9), v)};
}

static inline uint64_t permuted_key(const cell_numbers *numbers, uint32_t x, uint32_t y,
                                    uint32_t z) {
    uint32_t index = bl_permutation[z & 255];
    index = bl_permutation[(y + index) & 255];
    index = bl_permutation[(x + index) & 255];
    return bl_mix(numbers->table + index);
}

// The words of one cell from its three keys.
static inline cell_words cell_words_at(const cell_numbers *numbers, const uint64_t key[3]) {
    uint32_t u = (uint32_t)key[0] + (uint32_t)key[1] + (uint32_t)key[2];
    uint32_t v = (uint32_t)((key[0] ^ key[1] ^ key[2]) >> 32);
    if (numbers->permuted) {
        uint64_t entry = permuted_key(numbers, (uint32_t)key[0], (uint32_t)key[1], (uint32_t)key[2]);
        u = (uint32_t)entry;
        v = (uint32_t)(entry >> 32);
    }
    return cell_words_of(u, v);
}

// Keys of LANES cells along one axis, in halves.
typedef struct lane_keys {
    uint32_t low[LANES], high[LANES];
} lane_keys;

// u and v of LANES cells.
static inline void join_lane_keys(const cell_numbers *numbers, const lane_keys *x,
                                  const lane_keys *y, const lane_keys *z, lane_keys *joined) {
    if (numbers->permuted) {
        for (int l = 0; l < LANES; l++) {
            uint64_t entry = permuted_key(numbers, x->low[l], y->low[l], z->low[l]);
            joined->low[l] = (uint32_t)entry;
            joined->high[l] = (uint32_t)(entry >> 32);
        }
        return;
    }
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        joined->low[l] = x->low[l] + y->low[l] + z->low[l];
        joined->high[l] = x->high[l] ^ y->high[l] ^ z->high[l];
    }
}

// An odd multiple of 2^-24 in (-1, 1), all 2^24 of them equally likely, times 2^24: the mean is
// exactly 0. The shift of a negative number is arithmetic in every compiler we use.
static inline float signed_unit(uint32_t word) {
    return (float)(((int32_t)word >> 7) | 1);
}
#define SIGNED_UNIT_SCALE 0x1p-24

#endif
