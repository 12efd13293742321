// SPDX-License-Identifier: MIT
//
// What the rows of the convolution noises share: recognising a row along an axis, and the way back
// to scattered points for every other row.
#ifndef BL_NOISES_IMPULSES_CONVOLUTION_ROW_H
#define BL_NOISES_IMPULSES_CONVOLUTION_ROW_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"
#include "noises/impulses/convolution_cells.h"

// A row along an axis, walked in the direction of growing coordinates.
typedef struct axis_row {
    int axis, across[2];
    int reversed;                     // walked from the last sample to the first
    double start, signed_step, first; // of the row; the index of the sample where the walk begins
    double step;                      // > 0
    uint64_t cell_across[2];
    double fraction[2];
} axis_row;

// Where sample k of the walk stands along the axis: the contract's own start + i*step, rounded
// twice, so that equal coordinates are equal numbers.
static inline double axis_row_place(const axis_row *row, double k) {
    return row->start + (row->first + (row->reversed ? -k : k)) * row->signed_step;
}

// Below this limit doubles are at most 2^-22 apart, less than what is added to chords.
#define AXIS_ROW_LIMIT 0x1p31
// Steps beyond share too little work; smaller ones would overflow the count of samples a cell.
#define AXIS_ROW_LONGEST_STEP 1.75
#define AXIS_ROW_SHORTEST_STEP 0x1p-30

// Opens the samples first .. first+count-1 of a row; returns 0 where it does not run along an axis
// within the limits.
static inline int axis_row_open(axis_row *row, const double start[BL_AXES],
                                const double step[BL_AXES], size_t first, size_t count) {
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
    double size = fabs(step[axis]), last = (double)first + (double)(count - 1);
    if (!(size <= AXIS_ROW_LONGEST_STEP && size >= AXIS_ROW_SHORTEST_STEP &&
          fabs(start[axis] + (double)first * step[axis]) < AXIS_ROW_LIMIT &&
          fabs(start[axis] + last * step[axis]) < AXIS_ROW_LIMIT))
        return 0;
    row->axis = axis;
    row->reversed = step[axis] < 0;
    row->step = size;
    row->start = start[axis];
    row->signed_step = step[axis];
    row->first = row->reversed ? last : (double)first;
    for (int s = 0; s < 2; s++) {
        int a = row->across[s] = (axis + 1 + s) % 3;
        double lower = floor(start[a]);
        row->cell_across[s] = (uint64_t)(int64_t)lower;
        row->fraction[s] = start[a] - lower;
    }
    return 1;
}

// Whether a row along an axis may be added up in quads: a shift by the period must move quads onto
// quads, even ones onto even ones, or the same place would be rounded in two ways.
static inline int quads_repeat(const bl_lattice_settings *lattice, int axis) {
    return lattice->period[axis] % 8 == 0;
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
                                 size_t first, size_t count, float *out) {
    enum { BLOCK = 1024 };
    double at[3][BLOCK];
    const double *const coordinates[BL_AXES] = {at[0], at[1], at[2], at[2]}; // the last is unused
    int still = step[0] == 0 && step[1] == 0 && step[2] == 0;
    for (size_t from = 0; from < count; from += BLOCK) {
        size_t n = count - from < BLOCK ? count - from : BLOCK;
        for (int a = 0; a < 3; a++)
            for (size_t i = 0; i < n; i++)
                at[a][i] = start[a] + (double)(first + from + i) * step[a];
        if (still && from) { // one place: its value is known
            for (size_t i = 0; i < n; i++)
                out[from + i] = out[0];
            continue;
        }
        points(parameters, coordinates, n, out + from);
    }
}

// The first of `count` samples that is not on the near side of a limit, seen in the direction of
// the step.
static inline size_t first_beyond(double start, double step, size_t count, double limit) {
    size_t below = 0, above = count; // all before `below` are near, none from `above` on
    while (below < above) {
        size_t middle = below + (above - below) / 2;
        double place = start + (double)middle * step;
        if ((step < 0 ? -place : place) < limit)
            below = middle + 1;
        else
            above = middle;
    }
    return below;
}

// The samples *from .. *to-1 of a row are those within AXIS_ROW_LIMIT along the axis of its step.
// The others go by points, so that the path of a sample does not depend on the rest of its row.
static inline void find_inside(const double start[BL_AXES], const double step[BL_AXES],
                               size_t count, size_t *from, size_t *to) {
    *from = 0;
    *to = count;
    for (int a = 0; a < 3; a++)
        if (step[a] != 0 && fabs(start[a]) < 0x1p62) {
            *from = first_beyond(start[a], step[a], count, nextafter(-AXIS_ROW_LIMIT, 0));
            *to = first_beyond(start[a], step[a], count, AXIS_ROW_LIMIT);
            return;
        }
}

#endif
