// SPDX-License-Identifier: MIT
//
// The float loops that read a tile at points, included by the noise files, which are compiled for
// each instruction set.
//
// A coordinate is split in double, by itself: r x is exact, so are its floor and the fraction (but
// for a tiny negative x, whose fraction rounds to 1, where the kernels end as continuously as the
// next cell begins), and the floor modulo a power of two. The fraction is then rounded to a float.
// So a sample's bits depend on its own place only, and shifts by the period change none of them,
// where the shifted coordinate is exact.
#ifndef BL_NOISES_TILES_TILE_POINTS_H
#define BL_NOISES_TILES_TILE_POINTS_H

#include "noises/lattice/separable.h"
#include "noises/tiles/tile.h"

// Taps of a kernel: the numbers cell + first ... cell + first + count - 1. Those with an odd number
// of taps look from the nearest number, fraction 1/2 on it; the others from the one below.
BL_INLINE int bl_tile_tap_count(uint32_t kernel) {
    return kernel == BL_TILE_LINEAR          ? 2
           : kernel == BL_TILE_NEAREST       ? 1
           : kernel == BL_TILE_BSPLINE2      ? 3
           : kernel == BL_TILE_BSPLINE2_WIDE ? 6
                                             : 4;
}

BL_INLINE int bl_tile_first_tap(uint32_t kernel) {
    return kernel == BL_TILE_LINEAR || kernel == BL_TILE_NEAREST ? 0
           : kernel == BL_TILE_BSPLINE2_WIDE                     ? -2
                                                                 : -1;
}

BL_INLINE int bl_tile_is_shifted(uint32_t kernel) {
    return kernel == BL_TILE_NEAREST || kernel == BL_TILE_BSPLINE2;
}

// The cell, 0 to size - 1, and the fraction. Returns 0 outside of the domain.
BL_INLINE int bl_tile_split(double x, double rate, uint32_t size, int shifted, uint32_t *cell,
                            double *fraction) {
    int inside = fabs(x) < 0x1p62;
    double u = inside ? x * rate : 0, down = floor(u), t = u - down;
    if (shifted) { // by a half, in the fraction, which is exact where u + 1/2 would not be
        double up = t >= 0.5 ? 1 : 0;
        down += up;
        t += 0.5 - up;
    }
    // All exact: `down` has 53 bits, size is a power of two, and the rest is a whole number in [0,
    // size), size <= 2^24.
    double rest = down - floor(down / size) * size;
    *cell = (uint32_t)(int32_t)rest;
    *fraction = t;
    return inside;
}

typedef struct bl_tile_axis {
    uint32_t place[BL_TILE_TAPS][BL_BLOCK]; // of the taps, times the stride
    float weight[BL_TILE_TAPS][BL_BLOCK];
} bl_tile_axis;

BL_INLINE void bl_tile_fill_weights(uint32_t kernel, const float *restrict fraction, size_t lanes,
                                    float (*restrict w)[BL_BLOCK]) {
    switch (kernel) {
    case BL_TILE_BSPLINE3:
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            float t = fraction[i], r = 1 - t, t2 = t * t, r2 = r * r;
            w[0][i] = r2 * r * (1.0f / 6);
            w[1][i] = 2.0f / 3 - t2 * (1 - t * 0.5f);
            w[2][i] = 2.0f / 3 - r2 * (1 - r * 0.5f);
            w[3][i] = t2 * t * (1.0f / 6);
        }
        break;
    case BL_TILE_CATMULL_ROM:
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            float t = fraction[i], r = 1 - t;
            w[0][i] = -0.5f * t * (r * r);
            w[1][i] = 1 + t * t * (1.5f * t - 2.5f);
            w[2][i] = 1 + r * r * (1.5f * r - 2.5f);
            w[3][i] = -0.5f * r * (t * t);
        }
        break;
    case BL_TILE_LINEAR:
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            w[0][i] = 1 - fraction[i];
            w[1][i] = fraction[i];
        }
        break;
    case BL_TILE_NEAREST:
        for (size_t i = 0; i < lanes; i++)
            w[0][i] = 1;
        break;
    case BL_TILE_BSPLINE2:
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            float t = fraction[i], r = 1 - t;
            w[0][i] = 0.5f * (r * r);
            w[1][i] = 0.5f + t * r;
            w[2][i] = 0.5f * (t * t);
        }
        break;
    default:
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            float t = 0.5f * fraction[i], r = 0.5f - t; // half distances
            w[0][i] = 0.5f * (r * r);
            w[1][i] = 0.5f * ((1 - t) * (1 - t));
            w[2][i] = 0.75f - t * t;
            w[3][i] = 0.75f - r * r;
            w[4][i] = 0.5f * ((1 - r) * (1 - r));
            w[5][i] = 0.5f * (t * t);
        }
    }
}

// Fills an axis for `lanes` coordinates, and marks those outside of the domain.
static inline void bl_tile_load(const bl_tile *tile, uint32_t axis, const double *restrict x,
                                size_t lanes, bl_tile_axis *restrict out,
                                uint32_t *restrict outside) {
    uint32_t cell[BL_BLOCK], stride = 1, kernel = tile->kernel[axis];
    const uint32_t mask = tile->size[axis] - 1, size = tile->size[axis];
    const int shifted = bl_tile_is_shifted(kernel);
    const double rate = tile->rate;
    float fraction[BL_BLOCK];
    for (uint32_t a = 0; a < axis; a++)
        stride *= tile->size[a];
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        double t;
        uint32_t own;
        int inside = bl_tile_split(x[i], rate, size, shifted, &own, &t);
        outside[i] |= !inside;
        cell[i] = own;
        fraction[i] = (float)t;
    }
    bl_tile_fill_weights(kernel, fraction, lanes, out->weight);
    for (int k = 0; k < bl_tile_tap_count(kernel); k++) {
        const uint32_t shift = (uint32_t)(bl_tile_first_tap(kernel) + k);
        uint32_t *restrict place = out->place[k];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++)
            place[i] = ((cell[i] + shift) & mask) * stride;
    }
}

// Adds the taps along x at one tap across, whose place and weight are given.
BL_INLINE void bl_tile_add_line(const float *restrict number, const bl_tile_axis *restrict x,
                                int taps, size_t lanes, const uint32_t *restrict place,
                                const float *restrict weight, float *restrict sum) {
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        float line = 0;
        for (int k = 0; k < taps; k++)
            line += x->weight[k][i] * number[(int32_t)(place[i] + x->place[k][i])];
        sum[i] += weight[i] * line;
    }
}

static inline void bl_tile_block(const bl_tile *tile, const double *const at[BL_AXES], size_t from,
                                 size_t lanes, float *restrict out) {
    bl_tile_axis axis[BL_TILE_AXES];
    uint32_t outside[BL_BLOCK] = {0}, place[BL_BLOCK];
    float weight[BL_BLOCK], sum[BL_BLOCK] = {0};
    int taps[BL_TILE_AXES] = {1, 1, 1};
    for (uint32_t a = 0; a < BL_TILE_AXES; a++) {
        if (a < tile->dimensions) {
            bl_tile_load(tile, a, at[a] + from, lanes, &axis[a], outside);
            taps[a] = bl_tile_tap_count(tile->kernel[a]);
            continue;
        }
        for (size_t i = 0; i < lanes; i++) {
            axis[a].place[0][i] = 0;
            axis[a].weight[0][i] = 1;
        }
    }
    for (int k = 0; k < taps[2]; k++)
        for (int j = 0; j < taps[1]; j++) {
#pragma omp simd
            for (size_t i = 0; i < lanes; i++) {
                place[i] = axis[2].place[k][i] + axis[1].place[j][i];
                weight[i] = axis[2].weight[k][i] * axis[1].weight[j][i];
            }
            // Each number of taps is a loop of its own, unrolled.
            switch (taps[0]) {
            case 1:
                bl_tile_add_line(tile->number, &axis[0], 1, lanes, place, weight, sum);
                break;
            case 2:
                bl_tile_add_line(tile->number, &axis[0], 2, lanes, place, weight, sum);
                break;
            case 3:
                bl_tile_add_line(tile->number, &axis[0], 3, lanes, place, weight, sum);
                break;
            case 4:
                bl_tile_add_line(tile->number, &axis[0], 4, lanes, place, weight, sum);
                break;
            default:
                bl_tile_add_line(tile->number, &axis[0], 6, lanes, place, weight, sum);
            }
        }
    for (size_t i = 0; i < lanes; i++)
        out[i] = outside[i] ? NAN : sum[i];
}

static inline void bl_tile_points(const bl_tile *tile, const double *const at[BL_AXES],
                                  size_t count, float *out) {
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_tile_block(tile, at, done, here, out + done);
    }
}

#ifdef BL_ISA // in a noise file

// The functions of a noise whose parameter block begins with its tile.
static void bl_tile_noise_points(const void *block, const double *const at[BL_AXES], size_t count,
                                 float *out) {
    bl_tile_points(block, at, count, out);
}

static void bl_tile_noise_row(const void *block, const double start[BL_AXES],
                              const double step[BL_AXES], size_t count, float *out) {
    bl_row_by_points(bl_tile_noise_points, block, start, step, 0, count, out);
}

static double bl_tile_noise_value(const void *block, const double at[BL_AXES]) {
    return bl_tile_value(block, at, NULL);
}

static void bl_tile_noise_gradient(const void *block, const double at[BL_AXES],
                                   double out[BL_AXES]) {
    bl_tile_value(block, at, out);
}

static inline void bl_tile_noise_release(void *block) {
    bl_tile_release(block);
}

#define BL_TILE_FUNCTIONS                                                                          \
    .row = bl_tile_noise_row, .points = bl_tile_noise_points, .value = bl_tile_noise_value,        \
    .gradient = bl_tile_noise_gradient, .covariance = bl_tile_noise_covariance,                    \
    .release = bl_tile_noise_release

#endif

#endif
