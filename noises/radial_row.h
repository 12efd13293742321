// SPDX-License-Identifier: MIT
//
// Rows of a noise that is a sum of radial kernels: samples along a line, impulses around it.
//
// Along a line only the impulses within the kernel's radius 2 of it matter, and each touches only
// its chord of half length c = sqrt(4 - h^2), h its distance from the line. A sample at distance t
// along the line from the foot of an impulse sees K(sqrt(t^2 + h^2)). Two ways to add these up:
//
//   splat    for each impulse, over the samples of its chord in blocks of 16: pays where a chord
//            holds several samples. An impulse with h >= 1 needs the outer branch of K alone, which
//            is flat enough to take every third root by multiplications, less exactly, so that the
//            divider and the multipliers work at the same time.
//   gather   for each two samples, over the impulses of the slabs within two of them, 16 at a time;
//            partial sums stay in 16 lanes that are added in a fixed order. Pays with few samples a
//            cell.
//
// A slab is the layer of lattice cells between two planes across the line. The caller fills a
// slab's impulses. All positions are relative to a nearby slab, so that floats lose nothing far
// out, and the order of every sum depends on the row alone: the bits are those of every instruction
// set.
#ifndef BL_NOISES_RADIAL_ROW_H
#define BL_NOISES_RADIAL_ROW_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/convolution_cells.h"
#include "noises/radial_kernel.h"

enum {
    SLAB_MOST = 25 * 64,  // impulses a slab may add: 25 cells across, 64 a cell
    BATCH = 384,          // impulses after which a splat starts
    SPLAT_SAMPLES = 2048, // samples of one run of splats
    SPLAT_CLASSES = 8,    // numbers of blocks told apart, the last for all above
    GATHER_SLABS = 64,
    GATHER_IMPULSES = 8192,
};

// Impulses whose distance from the line is below 2. LANES entries past the last may be written.
typedef struct radial_impulses {
    int count;
    float *along;     // from the lower plane of their slab
    float *square;    // squared distance from the line
    float *amplitude; // in the caller's unit
} radial_impulses;

typedef struct radial_line {
    // Appends the impulses of a slab, numbered from the slab of the row's first sample.
    void (*fill)(const void *context, int64_t slab, radial_impulses *impulses);
    const void *context;
    int slab_most; // impulses a slab may have
    double origin; // of sample 0 within slab 0, in [0, 1]
    double step;   // > 0
    float scale;   // of the results: sum of amplitude * 2 K, times scale
} radial_line;

// --- splat --------------------------------------------------------------------------------------

typedef struct splat_batch {
    radial_impulses impulses; // in these:
    float along[BATCH + SLAB_MOST + LANES];
    float square[BATCH + SLAB_MOST + LANES];
    float amplitude[BATCH + SLAB_MOST + LANES];
    float centre[BATCH + SLAB_MOST];   // from the impulse to the middle of its blocks
    int32_t first[BATCH + SLAB_MOST];  // sample
    int32_t blocks[BATCH + SLAB_MOST]; // of LANES samples
    float slab[BATCH + SLAB_MOST];     // of each impulse, an exact integer
    int32_t class[BATCH + SLAB_MOST];  // 2 * blocks, + 1 if the inner branch is never reached
    uint16_t order[BATCH + SLAB_MOST];
} splat_batch;

typedef struct splat_run {
    double place; // of the run's first sample, from the first slab that reaches it
    double step, samples_per_cell;
    int samples;
    float ramp[2 * SPLAT_SAMPLES + 2 * LANES]; // k * step, k from -ramp_middle
    int ramp_middle;
    float sum[SPLAT_SAMPLES + LANES];
} splat_run;

// Finds the samples in the chords, and the class that the splat sorts by. Where a chord starts and
// ends needs no precision, the kernel is 0 there with its slope; where the impulse stands does.
static void place_impulses(splat_batch *batch, const splat_run *run) {
    float last_sample = (float)(run->samples - 1), samples_per_cell = (float)run->samples_per_cell;
    double place = run->place, step = run->step;
    int count = batch->impulses.count;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        double position = ((double)batch->slab[i] - place) + (double)batch->along[i];
        float middle = (float)position;
        float half = sqrtf(4 - batch->square[i]);
        float first = ceilf((middle - half) * samples_per_cell);
        float last = floorf((middle + half) * samples_per_cell);
        first = first > 0 ? first : 0;
        last = last < last_sample ? last : last_sample;
        float blocks = ceilf((last - first + 1) * (1.0f / LANES));
        blocks = blocks > 0 ? blocks : 0;
        first = blocks > 0 ? first : 0;
        int32_t n = (int32_t)blocks;
        batch->first[i] = (int32_t)first;
        batch->blocks[i] = n;
        batch->centre[i] = (float)((double)(first + blocks * (LANES / 2)) * step - position);
        n = n < SPLAT_CLASSES ? n : SPLAT_CLASSES;
        batch->class[i] = 2 * n + (batch->square[i] >= 1);
    }
}

// One impulse as a splat sees it.
typedef struct splat_impulse {
    float centre, square, amplitude;
} splat_impulse;

// Adds an impulse to a block of samples. `outer`: its distance from the line is at least 1;
// `quick`: by multiplications instead of the divider. Both are constants where it is called.
static inline __attribute__((always_inline)) void splat_block(const float *restrict ramp,
                                                              float *restrict sum,
                                                              splat_impulse one, const int outer,
                                                              const int quick) {
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        float t = ramp[l] + one.centre;
        float squared = t * t + one.square;
        float r = quick ? quick_root(squared) : sqrtf(squared);
        sum[l] += one.amplitude * (outer ? radial_twice_outer(r) : radial_twice(r));
    }
}

static inline __attribute__((always_inline)) void
splat_chord(const float *ramp, float *sum, splat_impulse one, int blocks, const int outer) {
    for (; blocks >= 3; blocks -= 3, ramp += 3 * LANES, sum += 3 * LANES) {
        splat_block(ramp, sum, one, outer, 0);
        splat_block(ramp + LANES, sum + LANES, one, outer, outer);
        splat_block(ramp + 2 * LANES, sum + 2 * LANES, one, outer, 0);
    }
    if (blocks >= 1)
        splat_block(ramp, sum, one, outer, 0);
    if (blocks >= 2)
        splat_block(ramp + LANES, sum + LANES, one, outer, outer);
}

// Splats the impulses order[0..count).
static inline __attribute__((always_inline)) void splat_class(const splat_batch *batch,
                                                              const uint16_t *order, int count,
                                                              splat_run *run, const int outer) {
    for (int k = 0; k < count; k++) {
        int i = order[k], blocks = batch->blocks[i];
        const float *ramp = run->ramp + run->ramp_middle - blocks * (LANES / 2);
        splat_impulse one = {batch->centre[i], batch->square[i], batch->amplitude[i]};
        splat_chord(ramp, run->sum + batch->first[i], one, blocks, outer);
    }
}

// Sorts the batch by class, so that the lengths of the loops are foreseen.
static void splat(splat_batch *batch, splat_run *run) {
    enum { CLASSES = 2 * SPLAT_CLASSES + 2 };
    int start[CLASSES + 1] = {0}, next[CLASSES];
    int count = batch->impulses.count;
    place_impulses(batch, run);
    for (int i = 0; i < count; i++)
        start[batch->class[i] + 1]++;
    for (int c = 0; c < CLASSES; c++) {
        next[c] = start[c];
        start[c + 1] += start[c];
    }
    for (int i = 0; i < count; i++)
        batch->order[next[batch->class[i]]++] = (uint16_t)i;
    for (int c = 2; c < CLASSES; c++) // the classes 0 and 1 have no sample in their chords
        if (c % 2)
            splat_class(batch, batch->order + start[c], start[c + 1] - start[c], run, 1);
        else
            splat_class(batch, batch->order + start[c], start[c + 1] - start[c], run, 0);
    batch->impulses.count = 0;
}

static void prepare_ramp(splat_run *run) {
    // A chord is at most 4 long: 4/step + 1 samples, in blocks of LANES.
    double most = fmin(ceil(4 * run->samples_per_cell) + 1, SPLAT_SAMPLES);
    run->ramp_middle = ((int)most + LANES - 1) / LANES * (LANES / 2);
    for (int k = 0; k < 2 * run->ramp_middle; k++)
        run->ramp[k] = (float)((k - run->ramp_middle) * run->step);
}

static void splat_row(const radial_line *line, size_t count, float *out) {
    splat_batch batch;
    splat_run run;
    run.step = line->step;
    run.samples_per_cell = 1 / line->step;
    batch.impulses = (radial_impulses){0, batch.along, batch.square, batch.amplitude};
    prepare_ramp(&run);
    for (size_t done = 0; done < count; done += (size_t)run.samples) {
        run.samples = count - done < SPLAT_SAMPLES ? (int)(count - done) : SPLAT_SAMPLES;
        run.place = line->origin + (double)done * line->step;
        for (int i = 0; i < run.samples + LANES; i++)
            run.sum[i] = 0;
        int64_t first = (int64_t)floor(run.place) - 2;
        int64_t last = (int64_t)floor(run.place + run.samples * line->step) + 2;
        run.place -= (double)first;
        for (int64_t slab = first; slab <= last; slab++) {
            int from = batch.impulses.count;
            line->fill(line->context, slab, &batch.impulses);
            for (int i = from; i < batch.impulses.count; i++)
                batch.slab[i] = (float)(slab - first);
            if (batch.impulses.count >= BATCH || slab == last)
                splat(&batch, &run);
        }
        for (int i = 0; i < run.samples; i++)
            out[done + (size_t)i] = run.sum[i] * line->scale;
    }
}

// --- gather -------------------------------------------------------------------------------------

typedef struct gather_window {
    float along[GATHER_IMPULSES + SLAB_MOST + LANES];
    float slab[GATHER_IMPULSES + SLAB_MOST + LANES]; // from the window's first, an exact integer
    float square[GATHER_IMPULSES + SLAB_MOST + LANES];
    float amplitude[GATHER_IMPULSES + SLAB_MOST + LANES];
    int start[GATHER_SLABS + 6]; // of each slab's impulses
} gather_window;

static void fill_window(const radial_line *line, int64_t first, int slabs, gather_window *window) {
    radial_impulses impulses = {0, window->along, window->square, window->amplitude};
    for (int s = 0; s < slabs; s++) {
        int from = window->start[s] = impulses.count;
        line->fill(line->context, first + s, &impulses);
#pragma omp simd
        for (int i = from; i < impulses.count; i++)
            window->slab[i] = (float)s;
    }
    int total = window->start[slabs] = impulses.count;
    for (int i = total; i < total + LANES; i++) { // the last block reads past the end
        window->along[i] = window->slab[i] = window->amplitude[i] = 0;
        window->square[i] = 4;
    }
}

static inline float add_lanes(const float *lane) {
    float eight[8], four[4];
    for (int l = 0; l < 8; l++)
        eight[l] = lane[l] + lane[l + 8];
    for (int l = 0; l < 4; l++)
        four[l] = eight[l] + eight[l + 4];
    return (four[0] + four[2]) + (four[1] + four[3]);
}

// The sums over the impulses of slabs first-2 .. last+2 at two samples in the cells first and last;
// `fraction` is within the cell. An impulse too far from a sample adds exactly 0 to it, also those
// of the slab after, into which the last block may reach.
static inline void gather_two(const gather_window *window, const int cell[2],
                              const float fraction[2], float out[2]) {
    float sum[2][LANES] = {{0}};
    float base[2] = {(float)cell[0], (float)cell[1]};
    for (int i = window->start[cell[0] - 2]; i < window->start[cell[1] + 3]; i += LANES) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            float along = window->along[i + l], slab = window->slab[i + l];
            float square = window->square[i + l], amplitude = window->amplitude[i + l];
            float s = (fraction[0] - along) - (slab - base[0]);
            float t = (fraction[1] - along) - (slab - base[1]);
            sum[0][l] += amplitude * radial_twice(sqrtf(s * s + square));
            sum[1][l] += amplitude * radial_twice(sqrtf(t * t + square));
        }
    }
    out[0] = add_lanes(sum[0]);
    out[1] = add_lanes(sum[1]);
}

// Finds the places of samples i and i+1 in the window whose slab 2 is `first`: how many are in it.
// Where only one is, the second is a copy of it.
static inline int pair_of_samples(const radial_line *line, size_t i, size_t count, double first,
                                  int slabs, int cell[2], float fraction[2]) {
    int n = 0;
    for (; n < 2 && i + (size_t)n < count; n++) {
        double place = line->origin + (double)(i + (size_t)n) * line->step - first;
        double lower = floor(place);
        if (lower >= slabs)
            break;
        cell[n] = (int)lower + 2;
        fraction[n] = (float)(place - lower);
    }
    if (n == 1) {
        cell[1] = cell[0];
        fraction[1] = fraction[0];
    }
    return n;
}

static void gather_row(const radial_line *line, size_t count, float *out) {
    gather_window window;
    int most = GATHER_IMPULSES / line->slab_most;
    int cells = (most < GATHER_SLABS ? most : GATHER_SLABS) - 5; // with two slabs on each side
    size_t i = 0;
    while (i < count) {
        double first = floor(line->origin + (double)i * line->step);
        double last = floor(line->origin + (double)(count - 1) * line->step);
        int slabs = last - first < cells ? (int)(last - first) + 1 : cells;
        fill_window(line, (int64_t)first - 2, slabs + 4, &window);
        while (i < count) {
            int cell[2];
            float fraction[2], pair[2];
            int n = pair_of_samples(line, i, count, first, slabs, cell, fraction);
            if (n == 0)
                break;
            gather_two(&window, cell, fraction, pair);
            for (int k = 0; k < n; k++)
                out[i++] = pair[k] * line->scale;
        }
    }
}

// --- the choice ---------------------------------------------------------------------------------

enum { SPLAT_LEAST_PER_CELL = 5 }; // samples a cell from which splatting is faster

static inline void radial_row(const radial_line *line, size_t count, float *out) {
    int window_fits = GATHER_IMPULSES / line->slab_most >= 24;
    if (line->step * SPLAT_LEAST_PER_CELL > 1 && window_fits)
        gather_row(line, count, out);
    else
        splat_row(line, count, out);
}

#endif
