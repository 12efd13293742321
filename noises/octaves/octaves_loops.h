// SPDX-License-Identifier: MIT
//
// The loops of sums of octaves over samples, compiled for each instruction set.
//
// Where an octave scales the coordinates by a power of two, and does nothing else to them, a row of
// the sum is a row of the basis: (start + i step) f and start f + i (step f) round alike. Any
// other octave takes its places one by one, through points, so that a sample stays a function of
// its own coordinate wherever its row was cut. Octaves are added in their order, in float.
#ifndef BL_NOISES_OCTAVES_OCTAVES_LOOPS_H
#define BL_NOISES_OCTAVES_OCTAVES_LOOPS_H

#include <math.h>
#include <stdlib.h>

#include "noises/octaves/octaves.h"
#include "noises/lattice/separable.h"

enum { BL_OCTAVES_ROW = 2048 }; // the longest row that needs no memory but the stack

// --- adding an octave ---------------------------------------------------------------------------

static inline void bl_octaves_add_plain(size_t count, float weight, const float *restrict noise,
                                        float *restrict out) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] += weight * noise[i];
}

static inline void bl_octaves_add_size(size_t count, float weight, const float *restrict noise,
                                       float *restrict out) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] += weight * fabsf(noise[i]);
}

// `next` is the weight of this octave, and then that of the next one.
static inline void bl_octaves_add_ridge(const bl_octaves *octaves, unsigned index, size_t count,
                                        const float *restrict noise, float *restrict next,
                                        float *restrict out) {
    const float kept = (float)octaves->plan.kept[index];
    const float lost = (float)((1 - octaves->plan.kept[index]) * octaves->lost);
    const float amplitude = (float)octaves->plan.amplitude[index];
    const float offset = (float)octaves->rules.ridge_offset;
    const float gain = (float)octaves->rules.ridge_gain;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        float height = offset - fabsf(noise[i]);
        float ridge = (kept * (height * height) + lost) * next[i];
        float weight = gain * ridge;
        out[i] += amplitude * ridge;
        next[i] = weight < 1 ? weight : 1;
    }
}

static inline void bl_octaves_begin(const bl_octaves *octaves, size_t count, float *next,
                                    float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = (float)octaves->constant;
    for (size_t i = 0; i < count && octaves->rules.fold == BL_FOLD_RIDGE; i++)
        next[i] = 1;
}

static inline void bl_octaves_add(const bl_octaves *octaves, unsigned index, size_t count,
                                  const float *noise, float *next, float *out) {
    float weight = (float)(octaves->plan.amplitude[index] * octaves->plan.kept[index]);
    if (octaves->rules.fold == BL_FOLD_NONE)
        bl_octaves_add_plain(count, weight, noise, out);
    else if (octaves->rules.fold == BL_FOLD_SIZE)
        bl_octaves_add_size(count, weight, noise, out);
    else
        bl_octaves_add_ridge(octaves, index, count, noise, next, out);
}

// The removed octaves of a ridge have their mean height, but still the weight of the one before.
static inline void bl_octaves_end(const bl_octaves *octaves, size_t count, float *noise,
                                  float *next, float *out) {
    if (octaves->rules.fold != BL_FOLD_RIDGE || octaves->plan.evaluated == 0)
        return;
    for (size_t i = 0; i < count; i++)
        noise[i] = 0; // which weighs nothing
    for (unsigned o = octaves->plan.evaluated; o < octaves->plan.count; o++)
        bl_octaves_add_ridge(octaves, o, count, noise, next, out);
}

// The basis says where its domain ends, unless it is seen at frequencies below 1 only, or not at
// all.
static inline int bl_octaves_needs_guard(const bl_octaves *octaves) {
    for (unsigned o = 0; o < octaves->plan.evaluated; o++)
        if (octaves->octave[o].frequency >= 1 && !octaves->octave[o].rotated)
            return 0;
    return 1;
}

// --- points -------------------------------------------------------------------------------------

// The basis of one octave at up to BL_BLOCK places.
static inline void bl_octave_points(const bl_octaves *octaves, const bl_octave *octave,
                                    const double *const at[BL_AXES], size_t count, float *noise) {
    double place[BL_AXES][BL_BLOCK];
    const double *columns[BL_AXES] = {at[0], at[1], at[2], at[3]};
    const unsigned dimensions = octaves->dimensions;
    for (unsigned a = 0; a < dimensions; a++)
        columns[a] = place[a];
    if (!octave->rotated && !octave->shifted) {
        const double frequency = octave->frequency;
        for (unsigned a = 0; a < dimensions; a++) {
            const double *restrict from = at[a];
            double *restrict to = place[a];
#pragma omp simd
            for (size_t i = 0; i < count; i++)
                to[i] = from[i] * frequency;
        }
    } else
        for (size_t i = 0; i < count; i++) {
            double out[BL_AXES] = {0};
            bl_octave_place(octave, dimensions,
                            (const double[BL_AXES]){at[0][i], at[1][i], at[2][i], at[3][i]}, out);
            for (unsigned a = 0; a < dimensions; a++)
                place[a][i] = out[a];
        }
    bl_signal_points(octave->basis, columns, count, noise);
}

static inline void bl_octaves_guard(const bl_octaves *octaves, const double *const at[BL_AXES],
                                    size_t count, float *out) {
    for (unsigned a = 0; a < octaves->dimensions; a++)
        for (size_t i = 0; i < count; i++)
            if (!(fabs(at[a][i]) < 0x1p62))
                out[i] = NAN;
}

static inline void bl_octaves_points(const void *block, const double *const at[BL_AXES],
                                     size_t count, float *out) {
    const bl_octaves *octaves = ((const bl_octaves_settings *)block)->octaves;
    float noise[BL_BLOCK], next[BL_BLOCK];
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        const double *const rest[BL_AXES] = {at[0] + done, at[1] + done, at[2] + done,
                                             at[3] + done};
        bl_octaves_begin(octaves, here, next, out + done);
        for (unsigned o = 0; o < octaves->plan.evaluated; o++) {
            bl_octave_points(octaves, &octaves->octave[o], rest, here, noise);
            bl_octaves_add(octaves, o, here, noise, next, out + done);
        }
        bl_octaves_end(octaves, here, noise, next, out + done);
        if (bl_octaves_needs_guard(octaves))
            bl_octaves_guard(octaves, rest, here, out + done);
    }
}

// --- rows ---------------------------------------------------------------------------------------

// Whether the octave's row is a row of its basis. A step that the scaling could round (subnormal)
// or push beyond the doubles is none; a start so small is lost beside any other step. The answer
// does not depend on the start, so the parts of a row have the same.
static inline int bl_octave_row_is_exact(const bl_octave *octave, const double step[BL_AXES]) {
    if (!octave->exact || octave->shifted || octave->rotated)
        return 0;
    for (int a = 0; a < BL_AXES; a++)
        if (step[a] != 0 && !(fabs(step[a]) >= 0x1p-900 && fabs(step[a]) <= 0x1p900))
            return 0;
    return 1;
}

static inline void bl_octave_row(const bl_octaves *octaves, const bl_octave *octave,
                                 const double start[BL_AXES], const double step[BL_AXES],
                                 size_t count, float *noise) {
    if (bl_octave_row_is_exact(octave, step)) {
        double from[BL_AXES], by[BL_AXES];
        for (int a = 0; a < BL_AXES; a++) {
            from[a] = start[a] * octave->frequency;
            by[a] = step[a] * octave->frequency;
        }
        bl_signal_row(octave->basis, from, by, count, noise);
        return;
    }
    double at[BL_AXES][BL_BLOCK];
    const double *const columns[BL_AXES] = {at[0], at[1], at[2], at[3]};
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        for (int a = 0; a < BL_AXES; a++)
            bl_row_coordinates(start[a], step[a], done, here, at[a]);
        bl_octave_points(octaves, octave, columns, here, noise + done);
    }
}

static inline void bl_octaves_guard_row(const bl_octaves *octaves, const double start[BL_AXES],
                                        const double step[BL_AXES], size_t count, float *out) {
    double at[BL_AXES][BL_BLOCK];
    const double *const columns[BL_AXES] = {at[0], at[1], at[2], at[3]};
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        for (int a = 0; a < BL_AXES; a++)
            bl_row_coordinates(start[a], step[a], done, here, at[a]);
        bl_octaves_guard(octaves, columns, here, out + done);
    }
}

// `noise` and `next` have room for the row.
static inline void bl_octaves_row_into(const bl_octaves *octaves, const double start[BL_AXES],
                                       const double step[BL_AXES], size_t count, float *noise,
                                       float *next, float *out) {
    bl_octaves_begin(octaves, count, next, out);
    for (unsigned o = 0; o < octaves->plan.evaluated; o++) {
        bl_octave_row(octaves, &octaves->octave[o], start, step, count, noise);
        bl_octaves_add(octaves, o, count, noise, next, out);
    }
    bl_octaves_end(octaves, count, noise, next, out);
    if (bl_octaves_needs_guard(octaves))
        bl_octaves_guard_row(octaves, start, step, count, out);
}

static inline void bl_octaves_row(const void *block, const double start[BL_AXES],
                                  const double step[BL_AXES], size_t count, float *out) {
    const bl_octaves *octaves = ((const bl_octaves_settings *)block)->octaves;
    float noise[BL_OCTAVES_ROW], next[BL_OCTAVES_ROW];
    if (count <= BL_OCTAVES_ROW) {
        bl_octaves_row_into(octaves, start, step, count, noise, next, out);
        return;
    }
    // A part of a row cannot be asked for: its start would be rounded once more.
    float *more = malloc(2 * count * sizeof *more);
    if (more)
        bl_octaves_row_into(octaves, start, step, count, more, more + count, out);
    // Without memory: rows of one sample, each the same as in the whole row.
    for (size_t i = 0; !more && i < count; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        bl_octaves_row_into(octaves, at, step, 1, noise, next, out + i);
    }
    free(more);
}

#endif
