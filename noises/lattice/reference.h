// SPDX-License-Identifier: MIT
//
// What the references in double of lattice noises share: the lattice points about a place, with the
// key of each plane made once for the place, and the lattice opened once for a batch of places.
#ifndef BL_NOISES_LATTICE_REFERENCE_H
#define BL_NOISES_LATTICE_REFERENCE_H

#include "noises/lattice/lattice_dimensions.h"
#include "noises/lattice/separable.h"

// The planes `first`, first + 1, ... of the cell of a place along each of its axes.
typedef struct bl_reference_cells {
    const bl_lattice *lattice;
    unsigned dimensions;
    double fraction[BL_AXES]; // of the place within its cell
    uint64_t cell[BL_AXES][BL_KNOTS];
    bl_lattice_key key[BL_AXES][BL_KNOTS];
} bl_reference_cells;

// 0 for a place that is in no cell: NaN, infinite or too large.
static inline int bl_reference_cells_load(bl_reference_cells *cells, const bl_lattice *lattice,
                                          unsigned dimensions, const double at[BL_AXES], int first,
                                          int knots) {
    cells->lattice = lattice;
    cells->dimensions = dimensions;
    for (unsigned a = 0; a < dimensions; a++) {
        uint64_t cell;
        if (!bl_lattice_split(at[a], &cell, &cells->fraction[a]))
            return 0;
        for (int k = 0; k < knots; k++) {
            cells->cell[a][k] = cell + (uint64_t)(int64_t)(first + k);
            cells->key[a][k] = bl_lattice_key_of(lattice, a, cells->cell[a][k]);
        }
    }
    return 1;
}

// The word of the lattice point on these planes, one an axis: that of bl_lattice_word_in.
static inline uint32_t bl_reference_word(const bl_reference_cells *cells,
                                         const unsigned knot[BL_AXES], unsigned component) {
    if (cells->lattice->kind == BL_LATTICE_PERM256) {
        uint64_t there[BL_AXES] = {0};
        for (unsigned a = 0; a < cells->dimensions; a++)
            there[a] = cells->cell[a][knot[a]];
        return bl_lattice_word_in(cells->lattice, cells->dimensions, there, component);
    }
    bl_lattice_key word = bl_lattice_rest(cells->lattice, cells->dimensions, component);
    for (unsigned a = 0; a < cells->dimensions; a++) {
        word.add += cells->key[a][knot[a]].add;
        word.exclusive ^= cells->key[a][knot[a]].exclusive;
    }
    return word.add * word.exclusive;
}

// In a noise file, after `static double value_at(const void *block, const opened *noise, const
// double at[BL_AXES])`: its abilities `value` and `values`, of a noise that `open(block)` opens.
#define BL_VALUES_OF_OPENED(opened, open)                                                          \
    static double value(const void *block, const double at[BL_AXES]) {                             \
        const opened noise = open(block);                                                          \
        return value_at(block, &noise, at);                                                        \
    }                                                                                              \
    static void values(const void *block, const double *const at[BL_AXES], size_t count,           \
                       double *out) {                                                              \
        const opened noise = open(block);                                                          \
        for (size_t i = 0; i < count; i++)                                                         \
            out[i] = value_at(block, &noise,                                                       \
                              (const double[BL_AXES]){at[0][i], at[1][i], at[2][i], at[3][i]});    \
    }

#endif
