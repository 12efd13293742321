// SPDX-License-Identifier: MIT
//
// Sparse convolution at scattered points, 16 points at a time.
//
// A point needs the impulses of the cells within 2 of it: 84 of the 125 around it on average. Which
// ones, depends on its place in its cell, so points are sorted by that place, coarsely, and a group
// of 16 visits the cells that any of its points needs. To have fewer places to sort by, each axis
// of each point is mirrored so that the fraction lies in [0, 1/2]: the cells are then numbered
// downwards, and only squares of distances are used. A cell too far from one point adds exactly 0
// to it, so that the bits do not depend on the company a point is sorted into.
#ifndef BL_NOISES_IMPULSES_SPARSE_POINTS_H
#define BL_NOISES_IMPULSES_SPARSE_POINTS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/impulses/convolution_cells.h"
#include "noises/lattice/radial_kernel.h"
#include "noises/impulses/sparse_impulses.h"

enum { POINT_BLOCK = 4096, PLACES = 6, PLACE_CLASSES = PLACES * PLACES * PLACES };

typedef struct point_block {
    int count;
    uint64_t cell[3][POINT_BLOCK];
    double fraction[3][POINT_BLOCK];
    uint16_t order[POINT_BLOCK + LANES];
    uint8_t valid[POINT_BLOCK];
} point_block;

// Splits coordinates into cell and fraction; the mirrored fraction is in [0, 1/2].
static void split_points(point_block *block, const double *const at[3], size_t from) {
    for (int i = 0; i < block->count; i++)
        block->valid[i] = 1;
    for (int a = 0; a < 3; a++) {
        const double *x = at[a] + from;
#pragma omp simd
        for (int i = 0; i < block->count; i++) {
            int valid = fabs(x[i]) < 0x1p62; // false for NaN
            double place = valid ? x[i] : 0;
            double lower = floor(place);
            block->cell[a][i] = (uint64_t)(int64_t)lower;
            block->fraction[a][i] = place - lower;
            block->valid[i] = (uint8_t)(block->valid[i] & valid);
        }
    }
}

static inline double mirrored(double fraction) {
    return fraction < 0.5 ? fraction : 1 - fraction;
}

// Sorts by place, along a path through the PLACES^3 boxes on which neighbours touch.
static void sort_points(point_block *block) {
    uint8_t class[POINT_BLOCK];
    int start[PLACE_CLASSES + 1] = {0};
    for (int i = 0; i < block->count; i++) {
        int place[3];
        for (int a = 0; a < 3; a++) { // mirrored <= 1/2: at most PLACES, and that only at 1/2
            int p = (int)(mirrored(block->fraction[a][i]) * (2 * PLACES));
            place[a] = p < PLACES ? p : PLACES - 1;
        }
        int y = place[0] & 1 ? PLACES - 1 - place[1] : place[1];
        int z = place[1] & 1 ? PLACES - 1 - place[2] : place[2];
        class[i] = (uint8_t)((place[0] * PLACES + y) * PLACES + z);
        start[class[i] + 1]++;
    }
    for (int c = 0; c < PLACE_CLASSES; c++)
        start[c + 1] += start[c];
    for (int i = 0; i < block->count; i++)
        block->order[start[class[i]]++] = (uint16_t)i;
    for (int l = 0; l < LANES; l++) // the last group is filled up with copies
        block->order[block->count + l] = block->order[block->count - 1];
}

// LANES points of similar places. Index 0..4 of an axis stands for the mirrored offsets -2..2.
typedef struct point_group {
    lane_keys key[3][5];
    float corner[3][5][LANES];  // from the middle of the cell to the point, in 2^-32 cells
    float nearest_square[3][5]; // of the distances from the cells' interval to the points
} point_group;

static void prepare_axis(const cell_numbers *numbers, const point_block *block,
                         const uint16_t *order, int axis, point_group *group) {
    uint64_t cell[LANES], forward[LANES];
    double fraction[LANES], sign[LANES];
    double least = 1, most = 0;
    for (int l = 0; l < LANES; l++) {
        cell[l] = block->cell[axis][order[l]];
        fraction[l] = block->fraction[axis][order[l]];
        int mirror = !(fraction[l] < 0.5);
        forward[l] = mirror ? UINT64_MAX : 1; // -1 modulo 2^64
        sign[l] = mirror ? -1 : 1;
        double within = mirrored(fraction[l]);
        least = within < least ? within : least;
        most = within > most ? within : most;
    }
    for (int i = 0; i < 5; i++) {
        uint64_t offset = (uint64_t)i - 2, visited[LANES];
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            visited[l] = cell[l] + forward[l] * offset;
            group->corner[axis][i][l] =
                (float)((fraction[l] - sign[l] * (i - 2) - 0.5) * IMPULSE_UNITS);
        }
        set_lane_keys(numbers, axis, visited, &group->key[axis][i]);
        double gap = i > 2 ? i - 2 - most : i < 2 ? least - (i - 1) : 0;
        gap = gap > 1e-5 ? gap - 1e-5 : 0; // more than the rounding of a distance
        group->nearest_square[axis][i] = (float)(gap * gap);
    }
}

// Places the impulses of one cell for each point: squared distances and amplitudes.
static inline __attribute__((always_inline)) void
place_cell(const sparse_source *source, const int impulses, const point_group *group,
           const int at[3], float square[][LANES], float amplitude[][LANES]) {
    const lane_keys *const key[3] = {&group->key[0][at[0]], &group->key[1][at[1]],
                                     &group->key[2][at[2]]};
    uint32_t first[LANES], second[LANES];
    lane_words(&source->numbers, key, first, second);
    const float *corner_x = group->corner[0][at[0]], *corner_y = group->corner[1][at[1]],
                *corner_z = group->corner[2][at[2]];
    for (int n = 0; n < impulses; n++) {
        const uint32_t *factor = source->factors.of[n];
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            float x = corner_x[l] - (float)(int32_t)(first[l] * factor[0]);
            float y = corner_y[l] - (float)(int32_t)(first[l] * factor[1]);
            float z = corner_z[l] - (float)(int32_t)(second[l] * factor[2]);
            square[n][l] = x * x + y * y + z * z;
            amplitude[n][l] = bl_lattice_value(second[l] * factor[3]);
        }
    }
}

// What one impulse gives to one point: amplitude times 2 K.
static inline float impulse_share(float square, float amplitude, const int outer) {
    float r = sqrtf(square) * (float)(1 / IMPULSE_UNITS);
    return amplitude * (outer ? radial_twice_outer(r) : radial_twice(r));
}

// Adds the impulses of a cell. Three of them, the default, meet before they enter the sum, which
// would otherwise be what everything waits for.
static inline __attribute__((always_inline)) void add_impulses(const int impulses,
                                                               float square[][LANES],
                                                               float amplitude[][LANES],
                                                               const int outer, float sum[LANES]) {
    if (impulses == 3) {
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += (impulse_share(square[0][l], amplitude[0][l], outer) +
                       impulse_share(square[1][l], amplitude[1][l], outer)) +
                      impulse_share(square[2][l], amplitude[2][l], outer);
        return;
    }
    for (int n = 0; n < impulses; n++)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += impulse_share(square[n][l], amplitude[n][l], outer);
}

// `impulses` is source->impulses, as a constant where it is the default.
static inline __attribute__((always_inline)) void sum_group(const sparse_source *source,
                                                            const int impulses,
                                                            const point_group *group,
                                                            float sum[LANES]) {
    float total[LANES] = {0};
    int at[3];
    for (at[0] = 0; at[0] < 5; at[0]++)
        for (at[1] = 0; at[1] < 5; at[1]++)
            for (at[2] = 0; at[2] < 5; at[2]++) {
                float nearest = group->nearest_square[0][at[0]] + group->nearest_square[1][at[1]] +
                                group->nearest_square[2][at[2]];
                if (nearest >= 4)
                    continue;
                float square[IMPULSES_MOST][LANES], amplitude[IMPULSES_MOST][LANES];
                place_cell(source, impulses, group, at, square, amplitude);
                if (nearest >= 1)
                    add_impulses(impulses, square, amplitude, 1, total);
                else
                    add_impulses(impulses, square, amplitude, 0, total);
            }
    for (int l = 0; l < LANES; l++)
        sum[l] = total[l];
}

static void sparse_points(const sparse_source *source, const double *const at[3], size_t count,
                          float *out) {
    point_block block;
    for (size_t from = 0; from < count; from += POINT_BLOCK) {
        block.count = count - from < POINT_BLOCK ? (int)(count - from) : POINT_BLOCK;
        split_points(&block, at, from);
        sort_points(&block);
        for (int g = 0; g < block.count; g += LANES) {
            const uint16_t *order = block.order + g;
            point_group group;
            float sum[LANES];
            for (int axis = 0; axis < 3; axis++)
                prepare_axis(&source->numbers, &block, order, axis, &group);
            if (source->impulses == 3)
                sum_group(source, 3, &group, sum);
            else
                sum_group(source, source->impulses, &group, sum);
            for (int l = 0; l < LANES && g + l < block.count; l++)
                out[from + order[l]] = block.valid[order[l]] ? sum[l] * source->scale : NAN;
        }
    }
}

#endif
