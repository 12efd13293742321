// SPDX-License-Identifier: MIT
//
// What the two ways of summing radial kernels along a row (radial_row.h) share: the samples of the
// row, and the impulses around it.
//
// Lattice cells along the row come in tiles of 4, aligned to multiples of 4. Positions are floats
// relative to the middle of a tile near them, so that they lose nothing far out: within 4 of the
// middle a float is exact to 1.2e-7. A tile's impulses come in parts, few enough to be held in
// arrays. Order and reference points of all sums depend on tiles, cells and parts alone, never on
// where a row starts: the value of a sample is a function of its coordinates and the row's step.
#ifndef BL_NOISES_IMPULSES_RADIAL_ROW_LINE_H
#define BL_NOISES_IMPULSES_RADIAL_ROW_LINE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/impulses/convolution_cells.h"
#include "noises/impulses/convolution_row.h"

enum {
    TILE_CELLS = 4,                          // along the row
    TILE_COLUMNS = 28,                       // most cells across it: 25, filled up
    TILE_IMPULSES = 8,                       // most of a cell in a part
    TILE_PLACES = TILE_CELLS * TILE_COLUMNS, // most cells
    TILE_MOST = TILE_PLACES * TILE_IMPULSES, // most impulses in a part of a tile
};

// A part of the impulses of a tile, near the row or not. Impulse n of column c in the tile's cell s
// has the index (n * TILE_CELLS + s) * columns + c. `columns` is a multiple of 4, so that the count
// of impulses is one of 16.
typedef struct radial_tile {
    int columns, impulses;
    float along[TILE_MOST];     // from the middle of the tile, in [-2, 2]
    float square[TILE_MOST];    // squared distance from the row, 4 or more: out of reach
    float amplitude[TILE_MOST]; // in the caller's unit
} radial_tile;

static inline int tile_count(const radial_tile *tile) {
    return tile->columns * TILE_CELLS * tile->impulses;
}

typedef struct radial_line {
    const axis_row *row;
    // Makes part `part` of the impulses of a tile, the cells 4 * tile + 0..3.
    void (*fill)(const void *context, int64_t tile, int part, radial_tile *impulses);
    const void *context;
    int parts;
    float scale; // of the results: sum of amplitude * radial_row_kernel, times scale
} radial_line;

static inline double tile_middle(int64_t tile) {
    return (double)tile * TILE_CELLS + TILE_CELLS / 2;
}

static inline int64_t tile_at(double place) {
    return (int64_t)floor(place * (1.0 / TILE_CELLS));
}

#endif
