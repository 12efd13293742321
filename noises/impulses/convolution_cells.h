// SPDX-License-Identifier: MIT
//
// The lattice numbers of the convolution noises, for 16 cells at a time (lattice.h defines them).
//
// A cell has two words, the components 0 and 1 of lattice.h. Their low bits are weak, so each is
// folded once, word ^ word >> 15, a bijection, before impulses multiply it.
#ifndef BL_NOISES_IMPULSES_CONVOLUTION_CELLS_H
#define BL_NOISES_IMPULSES_CONVOLUTION_CELLS_H

#include <stdint.h>

#include "noises/lattice/lattice.h"

enum { LANES = 16 }; // of every block, whatever the instruction set

// The words of a cell.
typedef struct cell_words {
    uint32_t first, second;
} cell_words;

typedef struct cell_numbers {
    bl_lattice lattice;
    uint32_t plain[256];    // lattice=perm256: the first words of its entries ...
    uint32_t table[2][256]; // ... and both words, folded
} cell_numbers;

static inline uint32_t folded(uint32_t word) {
    return word ^ word >> 15;
}

static inline void cell_numbers_open(cell_numbers *numbers, const bl_lattice_settings *lattice) {
    numbers->lattice = bl_lattice_open(lattice);
    if (lattice->kind != BL_LATTICE_PERM256)
        return;
    bl_perm256_words(&numbers->lattice, 0, numbers->plain);
    bl_perm256_words(&numbers->lattice, 1, numbers->table[1]);
    for (int i = 0; i < 256; i++) {
        numbers->table[0][i] = folded(numbers->plain[i]);
        numbers->table[1][i] = folded(numbers->table[1][i]);
    }
}

static inline cell_words cell_words_at(const bl_lattice *lattice, const uint64_t cell[3]) {
    return (cell_words){folded(bl_lattice_word(lattice, cell, 0)),
                        folded(bl_lattice_word(lattice, cell, 1))};
}

// The keys of 16 cells along one axis; for perm256 `add` is the cell itself, modulo 2^32.
typedef struct lane_keys {
    uint32_t add[LANES], exclusive[LANES];
} lane_keys;

static inline bl_lattice_key lane_key(const cell_numbers *numbers, int axis, uint64_t cell) {
    uint64_t wrapped = bl_lattice_wrap(&numbers->lattice, (unsigned)axis, cell);
    bl_lattice_key key = bl_lattice_wrapped_key(&numbers->lattice, (unsigned)axis, wrapped);
    if (numbers->lattice.kind == BL_LATTICE_PERM256)
        key.add = (uint32_t)wrapped;
    return key;
}

static inline void set_lane_key(const cell_numbers *numbers, int axis, uint64_t cell,
                                lane_keys *keys, int lane) {
    bl_lattice_key key = lane_key(numbers, axis, cell);
    keys->add[lane] = key.add;
    keys->exclusive[lane] = key.exclusive;
}

// The keys of 16 cells at once; `cell` is left wrapped.
static inline void set_lane_keys(const cell_numbers *numbers, int axis, uint64_t cell[LANES],
                                 lane_keys *keys) {
    const bl_lattice *lattice = &numbers->lattice;
    if (lattice->period[axis]) // a division, which the loop below must not have in it
        for (int l = 0; l < LANES; l++)
            cell[l] = bl_lattice_wrap(lattice, (unsigned)axis, cell[l]);
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        bl_lattice_key key = bl_lattice_wrapped_key(lattice, (unsigned)axis, cell[l]);
        keys->add[l] = lattice->kind == BL_LATTICE_PERM256 ? (uint32_t)cell[l] : key.add;
        keys->exclusive[l] = key.exclusive;
    }
}

static inline void permuted_words(const cell_numbers *numbers, const uint32_t *const add[3],
                                  int count, uint32_t *restrict first, uint32_t *restrict second) {
    for (int i = 0; i < count; i++) {
        uint32_t index = bl_perm256_index(add[0][i], add[1][i], add[2][i]);
        first[i] = numbers->table[0][index];
        second[i] = numbers->table[1][index];
    }
}

// The words of cells from their keys; `count` is a multiple of LANES.
static inline void cells_words(const cell_numbers *numbers, const uint32_t *const add[3],
                               const uint32_t *const exclusive[3], int count,
                               uint32_t *restrict first, uint32_t *restrict second) {
    if (numbers->lattice.kind == BL_LATTICE_PERM256) {
        permuted_words(numbers, add, count, first, second);
        return;
    }
    const uint32_t *x = add[0], *y = add[1], *z = add[2];
    const uint32_t *u = exclusive[0], *v = exclusive[1], *w = exclusive[2];
    uint32_t add_1 = numbers->lattice.add[1], exclusive_1 = numbers->lattice.exclusive[1];
    for (int i = 0; i < count; i += LANES)
#pragma omp simd
        for (int l = i; l < i + LANES; l++) {
            uint32_t sum = x[l] + y[l] + z[l];
            uint32_t mixed = u[l] ^ v[l] ^ w[l];
            first[l] = folded(sum * mixed);
            second[l] = folded((sum + add_1) * (mixed ^ exclusive_1));
        }
}

static inline void lane_words(const cell_numbers *numbers, const lane_keys *const key[3],
                              uint32_t first[LANES], uint32_t second[LANES]) {
    const uint32_t *const add[3] = {key[0]->add, key[1]->add, key[2]->add};
    const uint32_t *const exclusive[3] = {key[0]->exclusive, key[1]->exclusive, key[2]->exclusive};
    cells_words(numbers, add, exclusive, LANES, first, second);
}

#endif
