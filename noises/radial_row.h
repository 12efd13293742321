// SPDX-License-Identifier: MIT
//
// Rows of a noise that is a sum of radial kernels: samples along a line, impulses around it.
//
// Along a line only the impulses within the kernel's radius 2 of it matter, and each touches only
// its chord of half length c = sqrt(4 - h^2), h its distance from the line. A sample at distance t
// along the line from the foot of an impulse sees K(sqrt(t^2 + h^2)). Two ways to add these up:
//
//   splat    for each impulse, over the samples of its chord in blocks of 16: pays where a chord
//            holds several samples. An impulse with h >= 1 needs the outer branch of K alone. Every
//            third block takes its root by multiplications, so that the divider and the multipliers
//            work at the same time.
//   gather   for each sample, over the impulses of the five slabs around it, 16 at a time; partial
//            sums stay in 16 lanes that are added in a fixed order. Pays with few samples a cell.
//
// A slab is the layer of lattice cells between two planes across the line. The caller fills a slab's
// impulses. All positions are relative to a nearby slab, so that floats lose nothing far out, and
// the order of every sum depends on the row alone: the bits are those of every instruction set.
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
    SPLAT_BLOCKS_FIXED = 8, // up to this many blocks have code of their own
    GATHER_SLABS = 64,
    GATHER_IMPULSES = 8192,
};

// Impulses whose distance from the line is below 2.
typedef struct radial_impulses {
    int count;
    float along[BATCH + SLAB_MOST + LANES];     // from the lower plane of their slab
    float square[BATCH + SLAB_MOST + LANES];    // squared distance from the line
    float amplitude[BATCH + SLAB_MOST + LANES]; // in the caller's unit
} radial_impulses;

typedef struct radial_line {
    // Appends the impulses of a slab, numbered from the slab of the row's first sample.
    void (*fill)(const void *context, int64_t slab, radial_impulses *impulses);
    const void *context;
    int slab_most;  // impulses a slab may have
    double origin;  // of sample 0 within slab 0, in [0, 1]
    double step;    // > 0
    float scale;    // of the results: sum of amplitude * 2 K, times scale
} radial_line;

// --- splat --------------------------------------------------------------------------------------

typedef struct splat_batch {
    radial_impulses impulses;
    float centre[BATCH + SLAB_MOST];   // from the impulse to the middle of its blocks
    int32_t first[BATCH + SLAB_MOST];  // sample
    int32_t blocks[BATCH + SLAB_MOST]; // of LANES samples
    uint16_t order[BATCH + SLAB_MOST];
} splat_batch;

typedef struct splat_run {
    double place; // of the run's first sample, from slab 0
    double step, samples_per_cell;
    int samples;
    float ramp[2 * SPLAT_SAMPLES + 2 * LANES]; // k * step, k from -ramp_middle
    int ramp_middle;
    float sum[SPLAT_SAMPLES + LANES];
} splat_run;

// Finds the samples in the chords of impulses [from, count), all of one slab.
static inline void place_impulses(splat_batch *batch, int from, double slab, const splat_run *run) {
    double last_sample = run->samples - 1;
    const radial_impulses *impulses = &batch->impulses;
#pragma omp simd
    for (int i = from; i < impulses->count; i++) {
        double position = (slab - run->place) + (double)impulses->along[i];
        double half = (double)sqrtf(4 - impulses->square[i]);
        double first = ceil((position - half) * run->samples_per_cell);
        double last = floor((position + half) * run->samples_per_cell);
        first = first > 0 ? first : 0;
        last = last < last_sample ? last : last_sample;
        double blocks = ceil((last - first + 1) * (1.0 / LANES));
        blocks = blocks > 0 ? blocks : 0;
        first = blocks > 0 ? first : 0;
        batch->first[i] = (int32_t)first;
        batch->blocks[i] = (int32_t)blocks;
        batch->centre[i] = (float)((first + blocks * (LANES / 2)) * run->step - position);
    }
}

// One impulse as a splat sees it.
typedef struct splat_impulse {
    float centre, square, amplitude;
} splat_impulse;

// Adds an impulse to a block of samples. `outer`: its distance from the line is at least 1;
// `quick`: by multiplications instead of the divider. Both are constants where it is called.
static inline __attribute__((always_inline)) void
splat_block(const float *restrict ramp, float *restrict sum, splat_impulse one, const int outer,
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
        splat_block(ramp + LANES, sum + LANES, one, outer, 1);
        splat_block(ramp + 2 * LANES, sum + 2 * LANES, one, outer, 0);
    }
    if (blocks >= 1)
        splat_block(ramp, sum, one, outer, 0);
    if (blocks >= 2)
        splat_block(ramp + LANES, sum + LANES, one, outer, 1);
}

// Splats the impulses order[0..count), all of the same number of blocks and all outer or not; the
// constant `blocks` lets the compiler unroll, 0 stands for any number.
static inline __attribute__((always_inline)) void
splat_class(const splat_batch *batch, const uint16_t *order, int count, splat_run *run,
            const int outer, const int blocks) {
    for (int k = 0; k < count; k++) {
        int i = order[k];
        int n = blocks ? blocks : batch->blocks[i];
        const float *ramp = run->ramp + run->ramp_middle - n * (LANES / 2);
        float *sum = run->sum + batch->first[i];
        splat_impulse one = {batch->centre[i], batch->impulses.square[i],
                             batch->impulses.amplitude[i]};
        splat_chord(ramp, sum, one, n, outer);
    }
}

static void splat_one_class(const splat_batch *batch, const uint16_t *order, int count,
                            splat_run *run, int class) {
    switch (class) {
#define SPLAT_CLASS(n)                                                                             \
    case 2 * (n): splat_class(batch, order, count, run, 0, n); break;                              \
    case 2 * (n) + 1: splat_class(batch, order, count, run, 1, n); break;
        SPLAT_CLASS(1)
        SPLAT_CLASS(2)
        SPLAT_CLASS(3)
        SPLAT_CLASS(4)
        SPLAT_CLASS(5)
        SPLAT_CLASS(6)
        SPLAT_CLASS(7)
#undef SPLAT_CLASS
    case 2 * SPLAT_BLOCKS_FIXED: splat_class(batch, order, count, run, 0, 0); break;
    case 2 * SPLAT_BLOCKS_FIXED + 1: splat_class(batch, order, count, run, 1, 0); break;
    default: break; // no sample in its chord
    }
}

// Sorts the batch by class, so that the loops have constant lengths and no branch is a guess.
static void splat(splat_batch *batch, splat_run *run) {
    enum { CLASSES = 2 * SPLAT_BLOCKS_FIXED + 2 };
    uint16_t class[BATCH + SLAB_MOST];
    int start[CLASSES + 1] = {0};
    int count = batch->impulses.count;
    for (int i = 0; i < count; i++) {
        int blocks = batch->blocks[i] < SPLAT_BLOCKS_FIXED ? batch->blocks[i] : SPLAT_BLOCKS_FIXED;
        class[i] = (uint16_t)(2 * blocks + (batch->impulses.square[i] >= 1));
        start[class[i] + 1]++;
    }
    for (int c = 0; c < CLASSES; c++)
        start[c + 1] += start[c];
    int next[CLASSES];
    for (int c = 0; c < CLASSES; c++)
        next[c] = start[c];
    for (int i = 0; i < count; i++)
        batch->order[next[class[i]]++] = (uint16_t)i;
    for (int c = 2; c < CLASSES; c++)
        splat_one_class(batch, batch->order + start[c], start[c + 1] - start[c], run, c);
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
    batch.impulses.count = 0;
    prepare_ramp(&run);
    for (size_t done = 0; done < count; done += (size_t)run.samples) {
        run.samples = count - done < SPLAT_SAMPLES ? (int)(count - done) : SPLAT_SAMPLES;
        run.place = line->origin + (double)done * line->step;
        for (int i = 0; i < run.samples + LANES; i++)
            run.sum[i] = 0;
        int64_t last = (int64_t)floor(run.place + run.samples * line->step) + 2;
        for (int64_t slab = (int64_t)floor(run.place) - 2; slab <= last; slab++) {
            int from = batch.impulses.count;
            line->fill(line->context, slab, &batch.impulses);
            place_impulses(&batch, from, (double)slab, &run);
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
    radial_impulses part;
    int total = 0;
    for (int s = 0; s < slabs; s++) {
        window->start[s] = total;
        part.count = 0;
        line->fill(line->context, first + s, &part);
#pragma omp simd
        for (int i = 0; i < part.count; i++) {
            window->along[total + i] = part.along[i];
            window->slab[total + i] = (float)s;
            window->square[total + i] = part.square[i];
            window->amplitude[total + i] = part.amplitude[i];
        }
        total += part.count;
    }
    window->start[slabs] = total;
    for (int i = 0; i < LANES; i++) { // the last block reads past the end
        window->along[total + i] = window->slab[total + i] = 0;
        window->square[total + i] = 4;
        window->amplitude[total + i] = 0;
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

// The sum over the impulses of slabs cell-2 .. cell+2 at a sample; `fraction` within its cell. The
// last block may reach into the next slab, whose impulses are too far to count.
static inline float gather_sample(const gather_window *window, int cell, float fraction) {
    float sum[LANES] = {0};
    for (int i = window->start[cell - 2]; i < window->start[cell + 3]; i += LANES) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            float t = (fraction - window->along[i + l]) - (window->slab[i + l] - (float)cell);
            float r = sqrtf(t * t + window->square[i + l]);
            sum[l] += window->amplitude[i + l] * radial_twice(r);
        }
    }
    return add_lanes(sum);
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
        for (; i < count; i++) {
            double place = line->origin + (double)i * line->step - first;
            double cell = floor(place);
            if (cell >= slabs)
                break;
            out[i] = gather_sample(&window, (int)cell + 2, (float)(place - cell)) * line->scale;
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
