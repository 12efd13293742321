// SPDX-License-Identifier: MIT
//
// Adds up the impulses around each sample of a row, 16 impulses at a time.
//
// The impulses within 2 of the row are listed cell after cell, so that those within two cells of a
// sample are a stretch of the list. It starts with a cell, in lane 0, whatever row asks; where it
// ends within a block of 16, the rest belongs to cells too far away and adds exactly 0. The lanes
// are added in a fixed order.
//
// Positions are relative to the middle of the sample's quad. A sample reaches two cells into the
// quads beside its own, so each impulse is listed with two positions: for the samples of even quads
// and for those of odd quads.
#ifndef BL_NOISES_IMPULSES_RADIAL_ROW_GATHER_H
#define BL_NOISES_IMPULSES_RADIAL_ROW_GATHER_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "noises/impulses/radial_row_profile.h"
#include "noises/impulses/radial_row_line.h"

enum {
    GATHER_QUADS = 8,                                   // in the list, when it is full
    GATHER_LIST = GATHER_QUADS * QUAD_MOST + 4 * LANES, // room for writes past the end
    GATHER_MOST = 5 * QUAD_CELLS + 1,                   // samples in a quad
};

typedef struct gather_list {
    float along[2][GATHER_LIST]; // from the middle of the even and of the odd quad
    float square[GATHER_LIST], amplitude[GATHER_LIST];
    int start[GATHER_QUADS * QUAD_CELLS + 1]; // of each cell
    int quads;
} gather_list;

// Appends the impulses of a quad within 2 of the row: writes each, and keeps it by advancing, since
// a branch would be guessed wrong.
static void keep_near(gather_list *list, const radial_quad *quad, int odd) {
    float *restrict along = list->along[odd], *restrict square = list->square;
    float *restrict amplitude = list->amplitude;
    int *start = list->start + list->quads++ * QUAD_CELLS;
    size_t count = (size_t)start[0];
    for (int s = 0; s < QUAD_CELLS; s++) {
        for (int n = 0; n < quad->impulses; n++) {
            size_t from = (size_t)((n * QUAD_CELLS + s) * quad->columns);
            for (size_t i = from; i < from + (size_t)quad->columns; i++) {
                along[count] = quad->along[i];
                square[count] = quad->square[i];
                amplitude[count] = quad->amplitude[i];
                count += quad->square[i] < 4;
            }
        }
        start[s + 1] = (int)count;
    }
    for (size_t l = count; l < count + LANES; l++) { // the last block reads past the end
        list->along[0][l] = list->along[1][l] = amplitude[l] = 0;
        square[l] = 4;
    }
}

// The positions of a quad for the samples of the quads beside it, `shift` cells on: first for the
// quad before, then for the quad after. All of them, so that what a block of 16 reads beyond its
// stretch stands where it is, too far away, however few the impulses are.
static void place_for_neighbour(gather_list *list, int at, int odd, float shift) {
    const int *start = list->start + at * QUAD_CELLS;
    const float *restrict own = list->along[odd];
    float *restrict other = list->along[!odd];
    for (int i = start[0]; i < start[QUAD_CELLS]; i++)
        other[i] = own[i] + shift;
}

// Keeps the last two quads.
static void drop_quads(gather_list *list) {
    int first = (list->quads - 2) * QUAD_CELLS, from = list->start[first];
    size_t size = (size_t)(list->start[list->quads * QUAD_CELLS] - from) * sizeof(float);
    for (int side = 0; side < 2; side++)
        memmove(list->along[side], list->along[side] + from, size);
    memmove(list->square, list->square + from, size);
    memmove(list->amplitude, list->amplitude + from, size);
    for (int s = 0; s <= 2 * QUAD_CELLS; s++)
        list->start[s] = list->start[first + s] - from;
    list->quads = 2;
}

static void append_quad(const radial_line *line, int64_t quad, int part, gather_list *list) {
    radial_quad impulses;
    int odd = (int)(quad & 1);
    if (list->quads == GATHER_QUADS)
        drop_quads(list);
    if (list->quads >= 2) // the quad before the last is behind the next samples
        place_for_neighbour(list, list->quads - 2, odd, -QUAD_CELLS);
    line->fill(line->context, quad, part, &impulses);
    keep_near(list, &impulses, odd);
    place_for_neighbour(list, list->quads - 1, odd, QUAD_CELLS);
}

// A stretch of the list as a sample sees it.
typedef struct gather_stretch {
    const float *along, *square, *amplitude;
    int count;
} gather_stretch;

static inline __attribute__((always_inline)) float
gather_share(const bl_profile profile, const gather_stretch *from, int i, float place) {
    float t = place - from->along[i];
    return from->amplitude[i] * radial_row_kernel(profile, t * t + from->square[i]);
}

// The lanes of the sum at one sample.
static inline __attribute__((always_inline)) void
gather_one(const bl_profile profile, const gather_stretch *from, float place, float sum[LANES]) {
    float lane[LANES] = {0};
    for (int i = 0; i < from->count; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            lane[l] += gather_share(profile, from, i + l, place);
    memcpy(sum, lane, sizeof lane);
}

// The same at two samples of one cell, which share what is read.
static inline __attribute__((always_inline)) void gather_two(const bl_profile profile,
                                                             const gather_stretch *from,
                                                             const float place[2],
                                                             float sum[2][LANES]) {
    float first[LANES] = {0}, second[LANES] = {0};
    for (int i = 0; i < from->count; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            first[l] += gather_share(profile, from, i + l, place[0]);
            second[l] += gather_share(profile, from, i + l, place[1]);
        }
    memcpy(sum[0], first, sizeof first);
    memcpy(sum[1], second, sizeof second);
}

// The samples in a quad: those from index `from` on.
typedef struct gather_quad {
    int samples;
    int cell[GATHER_MOST + 1]; // of the quad
    float place[GATHER_MOST + 1], lanes[GATHER_MOST + 1][LANES], sum[GATHER_MOST + 1];
} gather_quad;

static void samples_in_quad(const axis_row *row, size_t from, size_t count, int64_t quad,
                            gather_quad *samples) {
    double middle = quad_middle(quad);
    int n = 0;
    for (; from + (size_t)n < count && n < GATHER_MOST; n++) {
        double place = axis_row_place(row, (double)(from + (size_t)n)) - middle;
        if (place >= QUAD_CELLS / 2)
            break;
        samples->cell[n] = (int)(place + QUAD_CELLS / 2); // place >= -2
        samples->place[n] = (float)place;
    }
    samples->samples = n;
}

// Adds the lanes of all samples, halving their number.
static void add_lanes(gather_quad *samples) {
    int count = samples->samples;
    float four[GATHER_MOST][4];
    for (int k = 0; k < count; k++) {
        float *lane = samples->lanes[k];
#pragma omp simd
        for (int l = 0; l < 8; l++)
            lane[l] += lane[l + 8];
    }
    for (int k = 0; k < count; k++) {
        const float *lane = samples->lanes[k];
#pragma omp simd
        for (int l = 0; l < 4; l++)
            four[k][l] = lane[l] + lane[l + 4];
    }
    for (int k = 0; k < count; k++)
        samples->sum[k] = (four[k][0] + four[k][2]) + (four[k][1] + four[k][3]);
}

// `list` starts with the quad before that of the samples, at its quad `at`.
static inline __attribute__((always_inline)) void gather_in_quad(const bl_profile profile,
                                                                 const gather_list *list, int at,
                                                                 int odd, gather_quad *samples) {
    const int *start = list->start + at * QUAD_CELLS;
    for (int k = 0; k < samples->samples;) {
        int cell = samples->cell[k], first = start[cell + 2];
        gather_stretch from = {list->along[odd] + first, list->square + first,
                               list->amplitude + first, start[cell + 7] - first};
        if (k + 1 < samples->samples && samples->cell[k + 1] == cell) {
            gather_two(profile, &from, samples->place + k, samples->lanes + k);
            k += 2;
        } else {
            gather_one(profile, &from, samples->place[k], samples->lanes[k]);
            k++;
        }
    }
}

static inline __attribute__((always_inline)) void
gather_part(const bl_profile profile, const radial_line *line, int part, size_t count, float *out) {
    gather_list list;
    gather_quad samples;
    list.quads = list.start[0] = 0;
    int64_t filled = 0; // the quad after the last in the list
    for (size_t i = 0; i < count; i += (size_t)samples.samples) {
        int64_t quad = quad_at(axis_row_place(line->row, (double)i));
        if (i == 0)
            filled = quad - 1;
        for (; filled <= quad + 1; filled++)
            append_quad(line, filled, part, &list);
        samples_in_quad(line->row, i, count, quad, &samples);
        gather_in_quad(profile, &list, list.quads - 3, (int)(quad & 1), &samples);
        add_lanes(&samples);
        for (int k = 0; k < samples.samples; k++)
            out[i + (size_t)k] += samples.sum[k] * line->scale;
    }
}

static inline __attribute__((always_inline)) void
gather_row(const bl_profile profile, const radial_line *line, size_t count, float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = 0;
    for (int part = 0; part < line->parts; part++)
        gather_part(profile, line, part, count, out);
}

#endif
