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

static void fill_colour_row(const bl_signal *signal, const bl_grid *grid, size_t j,
                            const double width[BL_AXES], float *out) {
    for (size_t i = 0; i < grid->width; i++) {
        double at[BL_AXES], rgb[3];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = grid->origin[a] + (double)j * grid->down[a] + (double)i * grid->right[a];
        bl_signal_colour(signal, at, width, rgb);
        for (int c = 0; c < 3; c++)
            out[3 * i + (size_t)c] = (float)rgb[c];
    }
}

void bl_grid_fill_colour(const bl_signal *signal, const bl_grid *grid, const double width[BL_AXES],
                         int threads, float *out) {
#pragma omp parallel for num_threads(bl_thread_count(threads)) schedule(dynamic, 4)
    for (size_t j = 0; j < grid->height; j++)
        fill_colour_row(signal, grid, j, width, out + 3 * j * grid->width);
}
