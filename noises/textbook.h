// SPDX-License-Identifier: MIT
//
// The tables of the text's own loops (peachey2003, pp. 69-80): the permutation of 256 entries and
// tables of 256 values, gradients and impulses, as `float` and filled from the project's generator
// where the text uses random(). They serve the `textbook` functions of the noises, which are the
// yardstick of the benchmark.
//
// bl_textbook_tables() may be called from any thread and returns the same constant tables.
#ifndef BL_NOISES_TEXTBOOK_H
#define BL_NOISES_TEXTBOOK_H

enum { BL_TEXTBOOK_SIZE = 256 };

typedef struct bl_textbook {
    float values[BL_TEXTBOOK_SIZE];
    float gradients[3 * BL_TEXTBOOK_SIZE];
    float impulses[4 * BL_TEXTBOOK_SIZE]; // x, y, z in [0, 1) and the amplitude
    float kernel[401];                    // radial Catmull-Rom by squared distance, 100 a unit
} bl_textbook;

extern bl_textbook bl_textbook_data; // filled by bl_textbook_tables

const bl_textbook *bl_textbook_tables(void);

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
