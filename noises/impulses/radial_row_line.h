// SPDX-License-Identifier: MIT
//
// What the two ways of summing radial kernels along a row (radial_row.h) share: the samples of the
// row, and the impulses around it.
//
// Lattice cells along the row come in quads of 4, aligned to multiples of 4. Positions are floats
// relative to the middle of a quad near them, so that they lose nothing far out: within 4 of the
// middle a float is exact to 1.2e-7. A quad's impulses come in parts, few enough to be held in
// arrays. Order and reference points of all sums depend on quads, cells and parts alone, never on
// where a row starts: the value of a sample is a function of its coordinates and the row's step.
#ifndef BL_NOISES_IMPULSES_RADIAL_ROW_LINE_H
#define BL_NOISES_IMPULSES_RADIAL_ROW_LINE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/impulses/convolution_cells.h"
#include "noises/impulses/convolution_row.h"

enum {
    QUAD_CELLS = 4,                          // along the row
    QUAD_COLUMNS = 28,                       // most cells across it: 25, filled up
    QUAD_IMPULSES = 8,                       // most of a cell in a part
    QUAD_PLACES = QUAD_CELLS * QUAD_COLUMNS, // most cells
    QUAD_MOST = QUAD_PLACES * QUAD_IMPULSES, // most impulses in a part of a quad
};

// A part of the impulses of a quad, near the row or not. Impulse n of column c in the quad's cell s
// has the index (n * QUAD_CELLS + s) * columns + c. `columns` is a multiple of 4, so that the count
// of impulses is one of 16.
typedef struct radial_quad {
    int columns, impulses;
    float along[QUAD_MOST];     // from the middle of the quad, in [-2, 2]
    float square[QUAD_MOST];    // squared distance from the row, 4 or more: out of reach
    float amplitude[QUAD_MOST]; // in the caller's unit
} radial_quad;

static inline int quad_count(const radial_quad *quad) {
    return quad->columns * QUAD_CELLS * quad->impulses;
}

typedef struct radial_line {
    const axis_row *row;
    // Makes part `part` of the impulses of a quad, the cells 4 * quad + 0..3.
    void (*fill)(const void *context, int64_t quad, int part, radial_quad *impulses);
    const void *context;
    int parts;
    float scale; // of the results: sum of amplitude * radial_row_kernel, times scale
} radial_line;

static inline double quad_middle(int64_t quad) {
    return (double)quad * QUAD_CELLS + QUAD_CELLS / 2;
}

static inline int64_t quad_at(double place) {
    return (int64_t)floor(place * (1.0 / QUAD_CELLS));
}

#endif
