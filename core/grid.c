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
                            const bl_footprint *footprint, float *out) {
    double at[BL_AXES][BL_BATCH], rgb[3 * BL_BATCH];
    for (size_t done = 0, here; done < grid->width; done += here) {
        here = grid->width - done < BL_BATCH ? grid->width - done : BL_BATCH;
        for (int a = 0; a < BL_AXES; a++)
            for (size_t i = 0; i < here; i++)
                at[a][i] = grid->origin[a] + (double)j * grid->down[a] +
                           (double)(done + i) * grid->right[a];
        const bl_samples samples = {{at[0], at[1], at[2], at[3]}, footprint, 0, here};
        bl_signal_colours(signal, &samples, rgb);
        for (size_t i = 0; i < 3 * here; i++)
            out[3 * done + i] = (float)rgb[i];
    }
}

void bl_grid_fill_colour(const bl_signal *signal, const bl_grid *grid, const double width[BL_AXES],
                         int threads, float *out) {
    const bl_footprint footprint = bl_footprint_of_widths(width);
#pragma omp parallel for num_threads(bl_thread_count(threads)) schedule(dynamic, 4)
    for (size_t j = 0; j < grid->height; j++)
        fill_colour_row(signal, grid, j, &footprint, out + 3 * j * grid->width);
}
