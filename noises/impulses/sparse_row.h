// SPDX-License-Identifier: MIT
//
// The impulses of sparse convolution around a row along an axis, a quad at a time (radial_row.h
// adds them up).
//
// A row passes through one cell of each layer across it; the impulses of the 25 cells around it in
// the layer can reach it, of those cells at least that come within 2. Such a column of cells keeps
// its keys across and its place beside the row from quad to quad.
#ifndef BL_NOISES_IMPULSES_SPARSE_ROW_H
#define BL_NOISES_IMPULSES_SPARSE_ROW_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/impulses/convolution_cells.h"
#include "noises/impulses/impulses.h"
#include "noises/impulses/radial_row.h"
#include "noises/impulses/sparse_impulses.h"

// The columns of cells within 2 of the row, repeated for each of a quad's cells along the row, and
// filled up to a multiple of 4 with columns out of reach.
typedef struct sparse_columns {
    const sparse_source *source;
    const impulse_source *poisson; // has the counts; NULL: they are fixed
    int axis, across[2];
    int columns;
    uint32_t add[3][QUAD_PLACES], exclusive[3][QUAD_PLACES]; // keys, along the two axes across
    float corner[2][QUAD_PLACES]; // from the middle of the column to the row, in 2^-32 cells
} sparse_columns;

// Sets a column of the quad's first cell.
static void set_column(sparse_columns *columns, const axis_row *row, int at, const int offset[2]) {
    for (int s = 0; s < 2; s++) {
        uint64_t cell = row->cell_across[s] + (uint64_t)(int64_t)offset[s];
        bl_lattice_key key = lane_key(&columns->source->numbers, row->across[s], cell);
        columns->add[row->across[s]][at] = key.add;
        columns->exclusive[row->across[s]][at] = key.exclusive;
        columns->corner[s][at] = (float)((row->fraction[s] - offset[s] - 0.5) * IMPULSE_UNITS);
    }
}

static void open_columns(sparse_columns *columns, const axis_row *row) {
    static const int out_of_reach[2] = {8, 8};
    int count = 0;
    for (int c = 0; c < 25; c++) {
        int offset[2] = {c / 5 - 2, c % 5 - 2};
        double square = 0;
        for (int s = 0; s < 2; s++) {
            double gap = fmax(offset[s] - row->fraction[s], row->fraction[s] - offset[s] - 1);
            square += gap > 0 ? gap * gap : 0;
        }
        if (square < 4)
            set_column(columns, row, count++, offset);
    }
    while (count % 4)
        set_column(columns, row, count++, out_of_reach);
    columns->columns = count;
    for (int s = 0; s < 2; s++) {
        int a = row->across[s];
        for (int i = count; i < QUAD_CELLS * count; i++) {
            columns->add[a][i] = columns->add[a][i - count];
            columns->exclusive[a][i] = columns->exclusive[a][i - count];
            columns->corner[s][i] = columns->corner[s][i - count];
        }
    }
}

// The words of the quad's cells, and where they stand from the middle of the quad.
typedef struct sparse_cells {
    uint32_t first[QUAD_PLACES], second[QUAD_PLACES];
    float middle[QUAD_PLACES];
    int32_t count[QUAD_PLACES]; // of impulses, for poisson
} sparse_cells;

// The counts of the cells from their keys; returns the largest.
static int fill_counts(const impulse_source *source, const uint32_t *const add[3],
                       const uint32_t *const exclusive[3], int places, int32_t *restrict count) {
    uint32_t third[QUAD_PLACES];
    const uint32_t *x = add[0], *y = add[1], *z = add[2];
    const uint32_t *u = exclusive[0], *v = exclusive[1], *w = exclusive[2];
    if (source->lattice.kind == BL_LATTICE_PERM256) {
        for (int i = 0; i < places; i++)
            third[i] = source->table[2][bl_perm256_index(x[i], y[i], z[i])];
    } else {
#pragma omp simd
        for (int i = 0; i < places; i++)
            third[i] = impulse_word(source, x[i] + y[i] + z[i], u[i] ^ v[i] ^ w[i], 2);
    }
    for (int i = 0; i < places; i++)
        count[i] = 0;
    for (int n = 0; n < source->most; n++) {
        const uint32_t limit = source->limit[n];
        uint32_t more = 0;
#pragma omp simd reduction(| : more)
        for (int i = 0; i < places; i++) {
            uint32_t here = limit <= third[i];
            count[i] += (int32_t)here;
            more |= here;
        }
        if (!more)
            return n;
    }
    return source->most;
}

// Returns the largest count of a cell.
static int fill_cells(const sparse_columns *columns, int64_t quad, sparse_cells *cells) {
    const cell_numbers *numbers = &columns->source->numbers;
    uint32_t add[QUAD_PLACES], exclusive[QUAD_PLACES];
    int count = columns->columns;
    for (int s = 0; s < QUAD_CELLS; s++) {
        uint64_t cell = (uint64_t)quad * QUAD_CELLS + (uint64_t)s;
        bl_lattice_key key = lane_key(numbers, columns->axis, cell);
        for (int i = s * count; i < (s + 1) * count; i++) {
            add[i] = key.add;
            exclusive[i] = key.exclusive;
            cells->middle[i] = (float)s - 1.5f;
        }
    }
    const uint32_t *adds[3] = {columns->add[0], columns->add[1], columns->add[2]};
    const uint32_t *exclusives[3] = {columns->exclusive[0], columns->exclusive[1],
                                     columns->exclusive[2]};
    adds[columns->axis] = add;
    exclusives[columns->axis] = exclusive;
    cells_words(numbers, adds, exclusives, QUAD_CELLS * count, cells->first, cells->second);
    return columns->poisson
               ? fill_counts(columns->poisson, adds, exclusives, QUAD_CELLS * count, cells->count)
               : columns->source->impulses;
}

// Impulse n of each cell.
static void place_impulses(const sparse_columns *columns, const sparse_cells *cells,
                           const uint32_t factor[4], float *restrict along, float *restrict square,
                           float *restrict amplitude) {
    // The word and the factor of each axis: x and y from the first word, z from the second.
    const uint32_t *const word[3] = {cells->first, cells->first, cells->second};
    const uint32_t *word_along = word[columns->axis], *word_0 = word[columns->across[0]],
                   *word_1 = word[columns->across[1]];
    uint32_t factor_along = factor[columns->axis], factor_0 = factor[columns->across[0]],
             factor_1 = factor[columns->across[1]], factor_amplitude = factor[3];
    const float *corner_0 = columns->corner[0], *corner_1 = columns->corner[1];
    int count = QUAD_CELLS * columns->columns;
    for (int i = 0; i < count; i += LANES)
#pragma omp simd
        for (int l = i; l < i + LANES; l++) {
            float u = corner_0[l] - (float)(int32_t)(word_0[l] * factor_0);
            float v = corner_1[l] - (float)(int32_t)(word_1[l] * factor_1);
            u *= (float)(1 / IMPULSE_UNITS);
            v *= (float)(1 / IMPULSE_UNITS);
            square[l] = u * u + v * v;
            along[l] = (float)(int32_t)(word_along[l] * factor_along) * (float)(1 / IMPULSE_UNITS) +
                       cells->middle[l];
            amplitude[l] = bl_lattice_value(cells->second[l] * factor_amplitude);
        }
}

// Puts impulse n of the cells that have fewer out of reach.
static void drop_missing(const sparse_columns *columns, const sparse_cells *cells, int32_t n,
                         float *restrict square) {
    int count = QUAD_CELLS * columns->columns;
#pragma omp simd
    for (int i = 0; i < count; i++)
        square[i] = n < cells->count[i] ? square[i] : 4;
}

static void fill_quad(const void *context, int64_t quad, int part, radial_quad *impulses) {
    const sparse_columns *columns = context;
    sparse_cells cells;
    int first = part * QUAD_IMPULSES, last = first + QUAD_IMPULSES;
    int most = fill_cells(columns, quad, &cells);
    last = last < most ? last : most;
    impulses->columns = columns->columns;
    impulses->impulses = last > first ? last - first : 0;
    for (int n = first; n < last; n++) {
        int at = (n - first) * QUAD_CELLS * columns->columns;
        const uint32_t *factor =
            columns->poisson ? columns->poisson->factor[n] : columns->source->factors.of[n];
        place_impulses(columns, &cells, factor, impulses->along + at, impulses->square + at,
                       impulses->amplitude + at);
        if (columns->poisson)
            drop_missing(columns, &cells, n, impulses->square + at);
    }
}

// `poisson` has the counts, or is NULL where they are fixed.
static inline __attribute__((always_inline)) void
sparse_row(const sparse_source *source, const impulse_source *poisson, const bl_profile profile,
           const axis_row *row, size_t count, float *out) {
    sparse_columns columns = {.source = source, .poisson = poisson, .axis = row->axis};
    columns.across[0] = row->across[0];
    columns.across[1] = row->across[1];
    open_columns(&columns, row);
    int most = poisson ? poisson->most : source->impulses;
    radial_line line = {.row = row,
                        .fill = fill_quad,
                        .context = &columns,
                        .parts = (most + QUAD_IMPULSES - 1) / QUAD_IMPULSES,
                        .scale =
                            profile == BL_PROFILE_CATMULL_ROM ? source->scale : 2 * source->scale};
    radial_row_of(profile, &line, count, out);
}

#endif
