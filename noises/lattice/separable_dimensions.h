// SPDX-License-Identifier: MIT
//
// What the fast loops share in one, two and four dimensions: blocks of points, and the lines of
// lattice points beside a row. (Those of three have loops of their own: separable.h.)
#ifndef BL_NOISES_LATTICE_SEPARABLE_DIMENSIONS_H
#define BL_NOISES_LATTICE_SEPARABLE_DIMENSIONS_H

#include "noises/lattice/lattice_dimensions.h"
#include "noises/lattice/separable.h"

// --- blocks of points ---------------------------------------------------------------------------

static inline void bl_point_block_begin_in(bl_point_block *block, const bl_lattice *lattice,
                                           unsigned dimensions, int first, int knots) {
    bl_point_block_begin(block, lattice, first, knots);
    block->dimensions = dimensions;
}

// The words of one corner of every point.
static inline void bl_point_block_words_in(const bl_point_block *block, const int knot[BL_AXES],
                                           unsigned component, uint32_t *restrict words) {
    const unsigned dimensions = block->dimensions;
    const bl_lattice_key rest = bl_lattice_rest(block->lattice, dimensions, component);
    const size_t lanes = block->lanes;
    if (block->lattice->kind == BL_LATTICE_PERM256) {
        uint64_t cell[BL_AXES] = {0};
        for (size_t i = 0; i < lanes; i++) {
            for (unsigned axis = 0; axis < dimensions; axis++)
                cell[axis] = block->axis[axis].plane[knot[axis]][i];
            words[i] = block->words256[component][bl_perm256_index_in(dimensions, cell)];
        }
        return;
    }
    uint32_t sum[BL_BLOCK], mixed[BL_BLOCK];
    for (size_t i = 0; i < lanes; i++) {
        sum[i] = rest.add;
        mixed[i] = rest.exclusive;
    }
    for (unsigned axis = 0; axis < dimensions; axis++) {
        const uint32_t *restrict add = block->axis[axis].add[knot[axis]];
        const uint32_t *restrict exclusive = block->axis[axis].exclusive[knot[axis]];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            sum[i] += add[i];
            mixed[i] ^= exclusive[i];
        }
    }
#pragma omp simd
    for (size_t i = 0; i < lanes; i++)
        words[i] = sum[i] * mixed[i];
}

// --- rows ---------------------------------------------------------------------------------------

// As bl_row_axis; steps along axes that the noise lacks do not move it.
static inline int bl_row_axis_in(unsigned dimensions, const double step[BL_AXES], double widest) {
    double own[BL_AXES] = {0};
    int axis = 0, moving = 0;
    for (unsigned a = 0; a < dimensions; a++) {
        own[a] = step[a];
        if (own[a] != 0) {
            axis = (int)a;
            moving++;
        }
    }
    return moving <= 1 && fabs(own[axis]) <= widest ? axis : -1;
}

enum { BL_LINES = 64 }; // 4 planes along each of 3 axes

// The lines of lattice points parallel to a row, near enough to matter to it.
typedef struct bl_row_lines {
    const bl_lattice *lattice;
    unsigned dimensions, axis; // of the row
    int first, count;
    double fraction[BL_AXES];              // of the axes across
    unsigned char knot[BL_LINES][BL_AXES]; // the planes across that meet in a line, from `first`
    bl_lattice_key key[BL_LINES];          // of component 0
    uint64_t cell[BL_LINES][BL_AXES];      // wrapped
    uint32_t words256[2][256];
} bl_row_lines;

// Planes lie at whole numbers minus `shift`; `knots` of them from `first` of the cell on matter.
// Returns 0 outside of the domain.
static inline int bl_row_lines_open(bl_row_lines *lines, const bl_lattice *lattice,
                                    unsigned dimensions, unsigned axis, const double start[BL_AXES],
                                    int first, int knots, double shift) {
    uint64_t cell[BL_AXES] = {0};
    *lines = (bl_row_lines){
        .lattice = lattice, .dimensions = dimensions, .axis = axis, .first = first, .count = 1};
    for (unsigned a = 0; a < dimensions; a++) {
        if (a == axis)
            continue;
        if (!bl_lattice_split(start[a], &cell[a], &lines->fraction[a]))
            return 0;
        lines->fraction[a] += shift;
        if (lines->fraction[a] >= 1) {
            lines->fraction[a] -= 1;
            cell[a]++;
        }
        lines->count *= knots;
    }
    for (int n = 0; n < lines->count; n++) {
        int rest = n;
        lines->key[n] = bl_lattice_rest(lattice, dimensions, 0);
        for (unsigned a = 0; a < dimensions; a++) {
            if (a == axis)
                continue;
            int knot = rest % knots;
            rest /= knots;
            uint64_t plane = cell[a] + (uint64_t)(int64_t)(first + knot);
            uint64_t wrapped = bl_lattice_wrap(lattice, a, plane);
            bl_lattice_key key = bl_lattice_wrapped_key(lattice, a, wrapped);
            lines->knot[n][a] = (unsigned char)knot;
            lines->cell[n][a] = wrapped;
            lines->key[n].add += key.add;
            lines->key[n].exclusive ^= key.exclusive;
        }
    }
    for (unsigned component = 0; component < 2 && lattice->kind == BL_LATTICE_PERM256; component++)
        bl_perm256_words(lattice, component, lines->words256[component]);
    return 1;
}

// The words of a line on the planes of a row's block, whose keys are `add` and `exclusive`.
static inline void bl_row_line_words(const bl_row_lines *lines, const bl_row_block *block, int n,
                                     unsigned component, const uint32_t *restrict add,
                                     const uint32_t *restrict exclusive, uint32_t *restrict words) {
    const bl_lattice *lattice = lines->lattice;
    if (lattice->kind == BL_LATTICE_HASH) {
        const uint32_t plus = lines->key[n].add + lattice->add[component];
        const uint32_t exor = lines->key[n].exclusive ^ lattice->exclusive[component];
#pragma omp simd
        for (size_t m = 0; m < block->lanes; m++)
            words[m] = (add[m] + plus) * (exclusive[m] ^ exor);
        return;
    }
    const unsigned axis = lines->axis;
    uint64_t cell[BL_AXES];
    memcpy(cell, lines->cell[n], sizeof cell);
    cell[axis] = bl_lattice_wrap(lattice, axis, block->cell + (uint64_t)(int64_t)lines->first);
    for (size_t m = 0; m < block->lanes; m++) {
        words[m] = lines->words256[component][bl_perm256_index_in(lines->dimensions, cell)];
        cell[axis] = bl_lattice_next(lattice->period[axis], cell[axis]);
    }
}

#endif
