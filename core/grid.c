// SPDX-License-Identifier: MIT
#include "core/grid.h"

#include <omp.h>

int bl_thread_count(int threads) {
    return threads > 0 ? threads : omp_get_max_threads();
}

void bl_grid_fill(const bl_signal *signal, const bl_grid *grid, int threads, float *out) {
#pragma omp parallel for num_threads(bl_thread_count(threads)) schedule(dynamic, 4)
    for (size_t j = 0; j < grid->height; j++) {
        double start[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            start[a] = grid->origin[a] + (double)j * grid->down[a];
        bl_signal_row(signal, start, grid->right, grid->width, out + j * grid->width);
    }
}
