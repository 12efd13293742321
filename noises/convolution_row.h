// SPDX-License-Identifier: MIT
//
// What the rows of the convolution noises share: recognising a row along an axis, and the way back
// to scattered points for every other row.
#ifndef BL_NOISES_CONVOLUTION_ROW_H
#define BL_NOISES_CONVOLUTION_ROW_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"
#include "noises/convolution_cells.h"

// A row along an axis in the direction of growing coordinates.
typedef struct axis_row {
    int axis, across[2];
    int reversed;  // the row ran the other way: reverse its samples
    double step;   // > 0
    uint64_t cell; // of the first sample, along the axis ...
    double origin; // ... and its place in that cell, in [0, 1)
    uint64_t cell_across[2];
    double fraction[2];
} axis_row;

// Along a row, sample i is taken to stand at start + i*step exactly. The contract rounds that to a
// double; below this limit the difference is at most 2^-22, within what a float shows.
#define AXIS_ROW_LIMIT 0x1p31
// Steps beyond share too little work; smaller ones would overflow the count of samples a cell.
#define AXIS_ROW_LONGEST_STEP 1.75
#define AXIS_ROW_SHORTEST_STEP 0x1p-30

static inline int axis_row_open(axis_row *row, const double start[BL_AXES],
                                const double step[BL_AXES], size_t count) {
    int axis = -1;
    for (int a = 0; a < 3; a++) {
        if (!(fabs(start[a]) < 0x1p62))
            return 0;
        if (step[a] == 0)
            continue;
        if (axis >= 0)
            return 0;
        axis = a;
    }
    if (axis < 0)
        return 0;
    double size = fabs(step[axis]), end = start[axis] + (double)(count - 1) * step[axis];
    if (!(size <= AXIS_ROW_LONGEST_STEP && size >= AXIS_ROW_SHORTEST_STEP &&
          fabs(start[axis]) < AXIS_ROW_LIMIT && fabs(end) < AXIS_ROW_LIMIT))
        return 0;
    row->axis = axis;
    row->reversed = step[axis] < 0;
    row->step = size;
    double lower = floor(row->reversed ? end : start[axis]);
    row->cell = (uint64_t)(int64_t)lower;
    row->origin = (row->reversed ? end : start[axis]) - lower;
    for (int s = 0; s < 2; s++) {
        int a = row->across[s] = (axis + 1 + s) % 3;
        lower = floor(start[a]);
        row->cell_across[s] = (uint64_t)(int64_t)lower;
        row->fraction[s] = start[a] - lower;
    }
    return 1;
}

static inline void reverse(float *out, size_t count) {
    for (size_t i = 0; i < count / 2; i++) {
        float kept = out[i];
        out[i] = out[count - 1 - i];
        out[count - 1 - i] = kept;
    }
}

typedef void points_function(const void *parameters, const double *const at[BL_AXES], size_t count,
                             float *out);

static inline void row_by_points(points_function *points, const void *parameters,
                                 const double start[BL_AXES], const double step[BL_AXES],
                                 size_t count, float *out) {
    enum { BLOCK = 1024 };
    double at[3][BLOCK];
    const double *const coordinates[BL_AXES] = {at[0], at[1], at[2], at[2]}; // the last is unused
    int still = step[0] == 0 && step[1] == 0 && step[2] == 0;
    for (size_t from = 0; from < count; from += BLOCK) {
        size_t n = count - from < BLOCK ? count - from : BLOCK;
        for (int a = 0; a < 3; a++)
            for (size_t i = 0; i < n; i++)
                at[a][i] = start[a] + (double)(from + i) * step[a];
        if (still && from) { // one place: its value is known
            for (size_t i = 0; i < n; i++)
                out[from + i] = out[0];
            continue;
        }
        points(parameters, coordinates, n, out + from);
    }
}

#endif
