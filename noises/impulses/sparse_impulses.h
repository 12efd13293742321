// SPDX-License-Identifier: MIT
//
// The impulses of sparse convolution: where they are in their cell, and how strong.
//
// A cell has two words (convolution_cells.h). Impulse n multiplies them by odd constants of its
// own, modulo 2^32: the first word for x and y, the second for z and the amplitude. Multiplication
// by an odd number permutes the words, so each coordinate is uniform; two coordinates of one word,
// or the same coordinate of two impulses, form a lattice of 2^32 points in the unit square.
//
//   x, y, z     word as a signed number times 2^-32, rounded to float, from the middle of the cell:
//               in [-1/2, 1/2], steps of 2^-25 or finer
//   amplitude   the lattice value of its word: odd multiples of 2^-20 in (-1, 1)
//
// These floats are the definition; the double reference starts from the same ones.
#ifndef BL_NOISES_IMPULSES_SPARSE_IMPULSES_H
#define BL_NOISES_IMPULSES_SPARSE_IMPULSES_H

#include <stdint.h>

#include "core/hash.h"
#include "noises/impulses/convolution_cells.h"

enum { IMPULSES_MOST = 64, IMPULSES_DEFAULT = 3 };

#define IMPULSE_UNITS 0x1p32 // of a position within a cell

// The odd constants of each impulse: for x, y, z and the amplitude.
typedef struct impulse_factors {
    uint32_t of[IMPULSES_MOST][4];
} impulse_factors;

static inline void impulse_factors_open(impulse_factors *factors, uint32_t impulses) {
    for (uint32_t n = 0; n < impulses; n++)
        for (uint32_t field = 0; field < 4; field++)
            factors->of[n][field] = (uint32_t)(bl_mix(4 * n + field + 1) >> 32) | 1;
}

typedef struct sparse_source {
    cell_numbers numbers;
    impulse_factors factors;
    int impulses;
    float scale; // of a sum of amplitude * 2 K, the amplitudes in BL_LATTICE_UNIT
} sparse_source;

static inline void sparse_source_open(sparse_source *source, const bl_lattice_settings *lattice,
                                      uint32_t impulses) {
    cell_numbers_open(&source->numbers, lattice);
    impulse_factors_open(&source->factors, impulses);
    source->impulses = (int)impulses;
    source->scale = (float)(BL_LATTICE_UNIT / 2 / impulses);
}

typedef struct impulse {
    double place[3]; // from the lower corner of its cell
    double amplitude;
} impulse;

static inline impulse impulse_of(const impulse_factors *factors, cell_words words, uint32_t n) {
    const uint32_t *factor = factors->of[n];
    const uint32_t word[3] = {words.first, words.first, words.second};
    impulse result;
    for (int a = 0; a < 3; a++)
        result.place[a] = (double)(float)(int32_t)(word[a] * factor[a]) / IMPULSE_UNITS + 0.5;
    result.amplitude = (double)bl_lattice_value(words.second * factor[3]) * BL_LATTICE_UNIT;
    return result;
}

#endif
