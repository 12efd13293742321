// SPDX-License-Identifier: MIT
//
// The samples behind a histogram; private to spectra/histogram*.c.
#ifndef BL_SPECTRA_HISTOGRAM_PARTS_H
#define BL_SPECTRA_HISTOGRAM_PARTS_H

#include "spectra/histogram.h"

typedef struct bl_sampling {
    const bl_signal *signal;
    bl_histogram_settings settings;
    int on_grid;
    size_t samples, blocks;
    size_t grid_blocks[BL_AXES]; // along each axis
    float *values;               // in the order of the blocks
    size_t *first;               // [blocks + 1] where each block begins
    bl_moments *moments;         // [blocks]
} bl_sampling;

// The place of a sample by its block and its index in the block.
void bl_sampling_point(const bl_sampling *s, size_t block, size_t index, double at[BL_AXES]);

// Everything that follows from the values.
bl_status bl_histogram_fill(const bl_sampling *s, bl_histogram *histogram, bl_message *message);

#endif
