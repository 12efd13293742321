// SPDX-License-Identifier: MIT
//
// The tables of the plain loops: the text's own (peachey2003, pp. 69-80), which are the permutation
// of 256 entries and tables of 256 values, gradients and impulses, and what the loops of other
// sources read: tangents, places, an inverse matrix, tiles. They serve the `textbook` functions of
// the noises, which are the yardstick of the benchmark; noises/textbook_loops.h has what several of
// these share. All are `float`.
//
// Where the text uses random(), the tables hold the numbers that lattice=perm256 draws
// (noises/lattice/lattice.h), and tiles are those of the noises. So most loops compute, up to
// rounding, the very field of their noise with the settings that its descriptor names
// (`textbook_settings`), and t-textbook holds them to it. The others draw otherwise and have its
// statistics:
//   scnoise       the text lets cells share impulses
//   simplex       picks a gradient by the index itself
//   gabor, spot   a generator a cell
//   white         a hash of the 32 bits of a float
//
// bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE)) makes the tiles by opening noises; it may be
// called from any thread and returns the same tables; the loops read
// them without looking whether they are there, so it must have been called before. A tile for
// which there is no memory is NaN.
#ifndef BL_NOISES_TEXTBOOK_H
#define BL_NOISES_TEXTBOOK_H

#include <stdint.h>

#include "core/signal.h"
#include "noises/lattice/permutation.h"

enum { BL_TEXTBOOK_SIZE = 256, BL_TEXTBOOK_TILE = 64, BL_TEXTBOOK_CUBE = 32 };

// The seed of the text. Values and gradients are those of the two parts of vgnoise, whose seeds are
// the streams 16 and 17 of it: bl_stream(665, 16) and bl_stream(665, 17).
#define BL_TEXTBOOK_SEED 665
#define BL_TEXTBOOK_TILE_SETTINGS "seed=665"
#define BL_TEXTBOOK_PERM256 "seed=665,lattice=perm256"
#define BL_TEXTBOOK_VALUES "seed=0x769d89804be48c6b,lattice=perm256"
#define BL_TEXTBOOK_GRADIENTS "seed=0x3824f71dec142041,lattice=perm256"
#define BL_TEXTBOOK_OCTAVES "seed=0x3824f71dec142041,basis.lattice=perm256"

typedef struct bl_textbook {
    float values[BL_TEXTBOOK_SIZE];       // in (-1, 1), as are ...
    float tangents[3 * BL_TEXTBOOK_SIZE]; // ... three further numbers
    float gradients[3 * BL_TEXTBOOK_SIZE];
    unsigned char edges[BL_TEXTBOOK_SIZE]; // 0 to 15
    float places[3 * BL_TEXTBOOK_SIZE];    // in (0, 1), from the value and two of the tangent
    float impulses[4 * BL_TEXTBOOK_SIZE];  // x, y, z in [0, 1) and the amplitude
    float kernel[401];                     // radial Catmull-Rom by squared distance, 100 a unit
    float inverse[4][4]; // of the covariances exp(-d^2/2) of four points on a line
    // Tiles, x runs fastest.
    float fourier[BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE];
    float midpoint[BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE];
    float additions[BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE];
    float wavelet[BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE];
} bl_textbook;

extern bl_textbook bl_textbook_data; // filled by bl_textbook_tables

const bl_textbook *bl_textbook_tables(bl_opener *open);

// Draws the random numbers of a set of tables from another seed; the tiles stay.
void bl_textbook_draw(bl_textbook *tables, uint64_t seed);

static inline int bl_textbook_floor(float x) {
    return (int)x - (x < 0 && x != (float)(int)x);
}

static inline int bl_textbook_index(int ix, int iy, int iz) {
    int row = bl_permutation[iz & 255];
    row = bl_permutation[(iy + row) & 255];
    return bl_permutation[(ix + row) & 255];
}

#endif
