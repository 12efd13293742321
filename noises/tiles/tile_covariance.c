// SPDX-License-Identifier: MIT
#include "noises/tiles/tile_covariance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/fft.h"

enum { LARGEST = 1 << 22, REACH = 6 }; // numbers; of the widest correlation, in numbers

// --- making -------------------------------------------------------------------------------------

int bl_tile_wants_covariance(const bl_tile *tile) {
    return !tile->covariance && bl_tile_count(tile->size) <= LARGEST;
}

// Estimated, as that of the tiles themselves (noises/tiles/synthesis.c).
static bl_fft_shape shape_of(const bl_tile *tile) {
    return (bl_fft_shape){.kind = BL_FFT_BACK,
                          .precision = BL_FFT_DOUBLE,
                          .dims = 3,
                          .size = {tile->size[2], tile->size[1], tile->size[0]}};
}

double *bl_tile_powers(const bl_tile *tile) {
    bl_fft_shape shape = shape_of(tile);
    size_t bytes = bl_fft_bytes(&shape);
    double *powers = bl_fft_buffer(bytes);
    if (powers)
        memset(powers, 0, bytes);
    return powers;
}

double *bl_tile_power_at(const bl_tile *tile, double *powers, const int k[BL_TILE_AXES]) {
    size_t width = tile->size[0] / 2 + 1; // complex numbers
    size_t y = (uint32_t)k[1] & (tile->size[1] - 1), z = (uint32_t)k[2] & (tile->size[2] - 1);
    return powers + 2 * ((z * tile->size[1] + y) * width + (size_t)k[0]);
}

bl_status bl_tile_set_powers(bl_tile *tile, double *powers, bl_message *message) {
    bl_fft_shape shape = shape_of(tile);
    const bl_fft *plan;
    bl_tile_covariance *made = malloc(sizeof *made);
    bl_status status = made ? bl_fft_plan(&shape, &plan, message)
                            : bl_report(message, BL_DEVICE, "out of memory for a covariance");
    if (status != BL_OK) {
        free(made);
        free(powers);
        return status;
    }
    bl_fft_run(plan, powers);
    bl_tile_close_rows(powers, (size_t)tile->size[1] * tile->size[2], tile->size[0]);
    *made = (bl_tile_covariance){.number = powers, .users = 1};
    memcpy(made->size, tile->size, sizeof made->size);
    tile->covariance = made;
    return BL_OK;
}

void bl_tile_covariance_keep(bl_tile_covariance *covariance) {
    if (covariance)
        __atomic_add_fetch(&covariance->users, 1, __ATOMIC_RELAXED);
}

void bl_tile_covariance_drop(bl_tile_covariance *covariance) {
    if (!covariance || __atomic_sub_fetch(&covariance->users, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    free(covariance->number);
    free(covariance);
}

// --- reading ------------------------------------------------------------------------------------

// The numbers near a lag along one axis, and what each counts.
typedef struct axis_lags {
    int count;
    uint32_t index[2 * REACH];
    double weight[2 * REACH];
} axis_lags;

// False for a lag that is no number.
static int find_lags(const bl_tile *tile, int axis, double lag, axis_lags *out) {
    uint32_t size = tile->size[axis];
    *out = (axis_lags){.count = 1, .weight = {1}};
    if ((uint32_t)axis >= tile->dimensions)
        return 1;
    double t = lag * tile->rate;
    t -= size * floor(t / size); // exact but for rounding, in [0, size]
    if (!(t >= 0 && t <= size))  // an infinity
        return 0;
    double down = floor(t);
    out->count = 0;
    for (int l = 1 - REACH; l <= REACH; l++) {
        double weight = bl_tile_correlation((bl_tile_kernel)tile->kernel[axis], t - (down + l));
        if (weight == 0)
            continue;
        out->weight[out->count] = weight;
        out->index[out->count++] = ((uint32_t)down + (uint32_t)l) & (size - 1);
    }
    return 1;
}

double bl_tile_noise_covariance(const void *block, const double lag[BL_AXES]) {
    const bl_tile *tile = block;
    axis_lags axis[BL_TILE_AXES];
    for (int a = 0; a < BL_TILE_AXES; a++)
        if (!find_lags(tile, a, lag[a], &axis[a]))
            return NAN;
    double sum = 0;
    for (int k = 0; k < axis[2].count; k++)
        for (int j = 0; j < axis[1].count; j++) {
            size_t row = ((size_t)axis[2].index[k] * tile->size[1] + axis[1].index[j]);
            const double *number = tile->covariance->number + row * tile->size[0];
            double line = 0;
            for (int i = 0; i < axis[0].count; i++)
                line += axis[0].weight[i] * number[axis[0].index[i]];
            sum += axis[2].weight[k] * axis[1].weight[j] * line;
        }
    return sum;
}

int bl_tile_noise_has_covariance(const void *block) {
    return ((const bl_tile *)block)->covariance != NULL;
}
