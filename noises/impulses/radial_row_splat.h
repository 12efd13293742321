// SPDX-License-Identifier: MIT
//
// Adds impulses to the samples of a row, one impulse after the other, each to its chord.
//
// What takes time are the roots, and branches guessed wrong at the ends of chords of different
// lengths. So the impulses of a quad are put into classes by their distance h from the row, which
// decides how they are evaluated and how many samples their chord can hold:
//
//   near   h^2 < 1       both branches of the kernel
//   side   1 <= h^2 < 2  the outer branch
//   far    2 <= h^2 < 4  a polynomial in h^2 and t^2 instead of root and kernel: it needs no
//                        divider, and takes turns with the others, which wait for theirs
//
// Kernels other than Catmull-Rom's need no root and are the same in every kind.
//
// Within a class all chords take the same number of half blocks of 8 samples. A sample beyond a
// chord receives exactly 0, so that it does not matter where blocks begin or that they reach too
// far, and a sample's sum runs through quads, parts, classes and impulses in a fixed order. The
// impulses add to four sums in turn, because reading what was just written at another alignment
// waits for the memory.
#ifndef BL_NOISES_IMPULSES_RADIAL_ROW_SPLAT_H
#define BL_NOISES_IMPULSES_RADIAL_ROW_SPLAT_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "noises/impulses/radial_row_profile.h"
#include "noises/impulses/radial_row_line.h"

enum {
    SPLAT_SAMPLES = 2048, // of one run
    HALF_BLOCK = LANES / 2,
    SUMS = 4,
    HALVES_MOST = 12, // longer chords form one class, whatever their length
    CLASSES_OF_KIND = HALVES_MOST + 2,
    KIND_NEAR = 0,
    KIND_SIDE,
    KIND_FAR,
    KIND_NONE,
    CLASS_NONE = KIND_NONE * CLASSES_OF_KIND, // the impulses out of reach: 4 classes
    CLASSES = CLASS_NONE + 4,
    SPLAT_MARGIN = HALVES_MOST * HALF_BLOCK, // samples that a chord may reach out of the run
};

// Chords are taken longer by this on both sides, more than the rounding of places within a quad.
#define CHORD_MARGIN 1e-5f

typedef struct splat_run {
    double first; // index of the run's first sample
    int samples;
    float place[SPLAT_MARGIN + SPLAT_SAMPLES + 2 * SPLAT_MARGIN]; // from the middle of a quad
    float sum[SUMS][SPLAT_MARGIN + SPLAT_SAMPLES + 2 * SPLAT_MARGIN];
    double per_cell; // samples
    int from;        // the first sample within reach of the quad ...
    float from_place;
} splat_run;

typedef struct splat_batch {
    radial_quad quad;
    int32_t first[QUAD_MOST]; // sample of the chords
    int32_t class[QUAD_MOST];
    int start[KIND_NONE + 1]; // of the impulses of each kind in the order
    uint16_t order[QUAD_MOST + LANES];
    uint16_t of_class[CLASSES][QUAD_MOST + LANES];
} splat_batch;

static inline int clamp_sample(double sample, int most) {
    return sample > 0 ? sample < most ? (int)sample : most : 0;
}

// The places of the samples that impulses of the quad can reach, and of those in the last blocks.
static void place_samples(const axis_row *row, int64_t quad, splat_run *run) {
    double middle = quad_middle(quad), per_cell = run->per_cell;
    double first = axis_row_place(row, run->first) - middle;
    double reach = 2 + QUAD_CELLS / 2 + 1e-3;
    int from = clamp_sample(floor((-reach - first) * per_cell) - 1, run->samples);
    int to = clamp_sample(ceil((reach - first) * per_cell) + 2 * LANES, run->samples);
    double index = run->first;
    float *place = run->place + SPLAT_MARGIN;
#pragma omp simd
    for (int i = from; i < to; i++)
        place[i] = (float)(axis_row_place(row, index + i) - middle);
    run->from = from;
    run->from_place = (float)(axis_row_place(row, index + from) - middle);
}

// Finds each chord's samples and class. Where a chord starts and ends needs no precision.
static void classify(splat_batch *batch, const splat_run *run) {
    const radial_quad *quad = &batch->quad;
    float per_cell = (float)run->per_cell, from_place = run->from_place;
    int from = run->from, samples = run->samples, count = quad_count(quad);
    for (int i = 0; i < count; i += LANES)
#pragma omp simd
        for (int l = i; l < i + LANES; l++) {
            float square = quad->square[l];
            float half = sqrtf(square < 4 ? 4 - square : 0) + CHORD_MARGIN;
            float first = ceilf((quad->along[l] - from_place - half) * per_cell);
            first = first > -2 * SPLAT_SAMPLES ? first : -2 * SPLAT_SAMPLES;
            first = first < 2 * SPLAT_SAMPLES ? first : 2 * SPLAT_SAMPLES;
            int32_t begin = (int32_t)first + from;
            begin = begin > -SPLAT_MARGIN ? begin : -SPLAT_MARGIN;
            batch->first[l] = begin < samples ? begin : samples;
            // A stretch of length L holds at most floor(L) + 1 samples.
            float halves = half * (per_cell * (2.0f / HALF_BLOCK));
            halves = halves < HALVES_MOST ? halves : HALVES_MOST;
            int32_t class = (int32_t)halves + 1 + (square < 1 ? 0 : CLASSES_OF_KIND);
            class += square < 2 ? 0 : CLASSES_OF_KIND;
            batch->class[l] = square < 4 ? class : CLASS_NONE + (l & 3);
        }
}

// Sorts the impulses by class; those of equal class keep their order.
static void sort_by_class(splat_batch *batch) {
    int size[CLASSES] = {0}, count = quad_count(&batch->quad), at = 0;
    for (int i = 0; i < count; i++) {
        int c = batch->class[i];
        batch->of_class[c][size[c]++] = (uint16_t)i;
    }
    for (int c = 0; c <= CLASS_NONE; c++) {
        if (c % CLASSES_OF_KIND == 0)
            batch->start[c / CLASSES_OF_KIND] = at;
        if (c == CLASS_NONE)
            break;
        for (int i = 0; i < size[c]; i += LANES)
            memcpy(batch->order + at + i, batch->of_class[c] + i, LANES * sizeof(uint16_t));
        at += size[c];
    }
}

// The chord of one impulse, cut into half blocks.
typedef struct splat_chord {
    const float *place;
    float *sum;
    int halves;
    float along, square, amplitude;
} splat_chord;

// The half blocks of a chord too long for the classes, from its first sample in the run on.
static int long_chord(const splat_run *run, float along, float square, int *first) {
    double half = sqrt(4 - (double)square) + (double)CHORD_MARGIN;
    double beyond = run->from + (along - (double)run->from_place + half) * run->per_cell + 1;
    int last = clamp_sample(beyond, run->samples);
    *first = *first > 0 ? *first : 0;
    return last > *first ? (last - *first + HALF_BLOCK - 1) / HALF_BLOCK : 0;
}

// The chord of the impulse at a place in the order.
static inline splat_chord chord_at(const splat_batch *batch, splat_run *run, int at, int kind) {
    const radial_quad *quad = &batch->quad;
    int i = batch->order[at], first = batch->first[i];
    int halves = batch->class[i] - kind * CLASSES_OF_KIND;
    if (halves > HALVES_MOST)
        halves = long_chord(run, quad->along[i], quad->square[i], &first);
    first += SPLAT_MARGIN;
    return (splat_chord){run->place + first, run->sum[at % SUMS] + first, halves, quad->along[i],
                         quad->square[i],    quad->amplitude[i]};
}

// Adds the impulse to `count` samples; count and kind are constants where it is called.
static inline __attribute__((always_inline)) void splat_block(const bl_profile profile,
                                                              const splat_chord *chord, int from,
                                                              const int count, const int kind) {
    const float *restrict place = chord->place + from;
    float *restrict sum = chord->sum + from;
    float along = chord->along, square = chord->square, amplitude = chord->amplitude;
    float reach = 4 - square, scaled = amplitude * RADIAL_FAR_SCALE;
#pragma omp simd
    for (int l = 0; l < count; l++) {
        float t = place[l] - along;
        if (profile != BL_PROFILE_CATMULL_ROM)
            sum[l] += amplitude * radial_row_kernel(profile, t * t + square);
        else if (kind == KIND_FAR)
            sum[l] += radial_far(reach - t * t, scaled);
        else if (kind == KIND_SIDE)
            sum[l] += amplitude * radial_twice_outer(sqrtf(t * t + square));
        else
            sum[l] += amplitude * radial_twice(sqrtf(t * t + square));
    }
}

// Splats the impulse at a place in the order.
static inline __attribute__((always_inline)) void splat_one(const bl_profile profile,
                                                            const splat_batch *batch,
                                                            splat_run *run, int at,
                                                            const int kind) {
    splat_chord chord = chord_at(batch, run, at, kind);
    int count = chord.halves * HALF_BLOCK, i = 0;
    for (; i + LANES <= count; i += LANES)
        splat_block(profile, &chord, i, LANES, kind);
    if (i < count)
        splat_block(profile, &chord, i, HALF_BLOCK, kind);
}

// Adds the impulses to the samples, a far one and another in turn.
static inline __attribute__((always_inline)) void splat(const bl_profile profile,
                                                        splat_batch *batch, splat_run *run) {
    classify(batch, run);
    sort_by_class(batch);
    const int *start = batch->start;
    int other = 0, far = start[KIND_FAR];
    for (; other < start[KIND_SIDE] && far < start[KIND_NONE]; other++, far++) {
        splat_one(profile, batch, run, other, KIND_NEAR);
        splat_one(profile, batch, run, far, KIND_FAR);
    }
    for (; other < start[KIND_SIDE]; other++)
        splat_one(profile, batch, run, other, KIND_NEAR);
    for (; other < start[KIND_FAR] && far < start[KIND_NONE]; other++, far++) {
        splat_one(profile, batch, run, other, KIND_SIDE);
        splat_one(profile, batch, run, far, KIND_FAR);
    }
    for (; other < start[KIND_FAR]; other++)
        splat_one(profile, batch, run, other, KIND_SIDE);
    for (; far < start[KIND_NONE]; far++)
        splat_one(profile, batch, run, far, KIND_FAR);
}

static inline __attribute__((always_inline)) void
splat_row(const bl_profile profile, const radial_line *line, size_t count, float *out) {
    const axis_row *row = line->row;
    splat_batch batch;
    splat_run run;
    run.per_cell = 1 / row->step;
    memset(run.place, 0, sizeof run.place);
    for (size_t done = 0; done < count; done += (size_t)run.samples) {
        run.samples = count - done < SPLAT_SAMPLES ? (int)(count - done) : SPLAT_SAMPLES;
        run.first = (double)done;
        memset(run.sum, 0, sizeof run.sum);
        int64_t first = quad_at(axis_row_place(row, run.first) - 2);
        int64_t last = quad_at(axis_row_place(row, run.first + run.samples - 1) + 2);
        for (int64_t quad = first; quad <= last; quad++) {
            place_samples(row, quad, &run);
            for (int part = 0; part < line->parts; part++) {
                line->fill(line->context, quad, part, &batch.quad);
                splat(profile, &batch, &run);
            }
        }
        for (int i = 0, at = SPLAT_MARGIN; i < run.samples; i++, at++)
            out[done + (size_t)i] =
                ((run.sum[0][at] + run.sum[1][at]) + (run.sum[2][at] + run.sum[3][at])) *
                line->scale;
    }
}

#endif
