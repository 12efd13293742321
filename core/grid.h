// SPDX-License-Identifier: MIT
//
// Grids: a signal sampled on a parallelogram of points, row by row.
#ifndef BL_CORE_GRID_H
#define BL_CORE_GRID_H

#include "core/signal.h"

// A grid of `height` rows of `width` points: point (i, j) lies at origin + i*right + j*down.
typedef struct bl_grid {
    double origin[BL_AXES];
    double right[BL_AXES];
    double down[BL_AXES];
    size_t width, height;
} bl_grid;

// Fills out[j*width + i]. Rows are shared among `threads` threads (0: as many as OpenMP gives);
// the values do not depend on their number.
void bl_grid_fill(const bl_signal *signal, const bl_grid *grid, int threads, float *out);

// Fills out[3 (j*width + i)] and the two behind it with the red, green and blue of the signal, for
// samples of this width along each axis.
void bl_grid_fill_colour(const bl_signal *signal, const bl_grid *grid, const double width[BL_AXES],
                         int threads, float *out);

// How many threads a request of `threads` (0: all) means.
int bl_thread_count(int threads);

#endif
