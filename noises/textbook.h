// SPDX-License-Identifier: MIT
//
// The tables of the plain loops: the text's own (peachey2003, pp. 69-80), which are the permutation
// of 256 entries and tables of 256 values, gradients and impulses, and what the loops of other
// sources read: tangents, an inverse matrix, tiles. All are `float` and filled from the project's
// generator where the text uses random(). They serve the `textbook` functions of the noises, which
// are the yardstick of the benchmark; noises/textbook_loops.h has what several of these share.
//
// Tiles are filled with random numbers of the size that gives the noise read from them the variance
// 1, not with the spectrum of the noise: what they are to show is the cost of reading.
//
// bl_textbook_tables() may be called from any thread and returns the same constant tables.
#ifndef BL_NOISES_TEXTBOOK_H
#define BL_NOISES_TEXTBOOK_H

#include <stdint.h>

enum { BL_TEXTBOOK_SIZE = 256, BL_TEXTBOOK_TILE = 64, BL_TEXTBOOK_CUBE = 32 };

typedef struct bl_textbook {
    float values[BL_TEXTBOOK_SIZE];
    float gradients[3 * BL_TEXTBOOK_SIZE];
    float impulses[4 * BL_TEXTBOOK_SIZE]; // x, y, z in [0, 1) and the amplitude
    float kernel[401];                    // radial Catmull-Rom by squared distance, 100 a unit
    float tangents[3 * BL_TEXTBOOK_SIZE]; // uniform in (-1, 1)
    float inverse[4][4];                  // of the covariances exp(-d^2/2) of four points on a line
    // Tiles, x runs fastest, to be read by cubic and by quadratic B-splines and by Catmull-Rom.
    float bspline3[BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE];
    float catmull_rom[BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE];
    float bspline2[BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE];
} bl_textbook;

extern bl_textbook bl_textbook_data; // filled by bl_textbook_tables

const bl_textbook *bl_textbook_tables(void);

// Fills the tables anew, for tests of their statistics: not safe from several threads, and not
// beside bl_textbook_tables.
void bl_textbook_refill(uint64_t seed);

// The permutation as printed; data of the text.
extern const unsigned char bl_permutation[BL_TEXTBOOK_SIZE];

static inline int bl_textbook_floor(float x) {
    return (int)x - (x < 0 && x != (float)(int)x);
}

static inline int bl_textbook_index(int ix, int iy, int iz) {
    int row = bl_permutation[iz & 255];
    row = bl_permutation[(iy + row) & 255];
    return bl_permutation[(ix + row) & 255];
}

#endif
