// SPDX-License-Identifier: MIT
//
// The distribution of a signal's values.
//
// Samples come in blocks: off a grid, 4096 random places in +-2^20 with a fresh seed for each block
// where the signal has one; on a grid, all samples in 8 x 8 blocks (fewer where it is small). The
// blocks are the replicates behind every interval, because values of one seed, and neighbours on a
// grid, are not independent: mean and variance by their spread over blocks, quantiles by the ranks
// n p -+ z sqrt(n p (1-p) n/n_e), where n_e is the number of independent samples that would give
// the spread over blocks of the share below the quantile, at most n.
//
// Blocks are filled in parallel into their own place and merged in their order: the result does not
// depend on the threads.
#include <math.h>
#include <stdlib.h>

#include "core/grid.h"
#include "core/hash.h"
#include "core/random.h"
#include "spectra/histogram_parts.h"
#include "core/memory.h"

enum { BLOCK = 4096, GRID_BLOCKS = 8 };

static const double REACH = 0x1p20;

bl_histogram_settings bl_histogram_default_settings(void) {
    return (bl_histogram_settings){
        .samples = (size_t)1 << 20, .bins = 64, .seed = 1, .level = 0.95};
}

size_t bl_histogram_usual_samples(bl_size size) {
    return (size_t)bl_size_pick(size, 0x1p16, 0x1p20, 0x1p26);
}

// --- blocks ---

static size_t grid_size(const bl_sampling *s, unsigned axis) {
    size_t size = s->signal->extent.size[axis];
    return size ? size : 1;
}

// The part of an axis that a block covers.
static void block_range(const bl_sampling *s, size_t block, size_t from[BL_AXES],
                        size_t to[BL_AXES]) {
    for (unsigned a = 0; a < BL_AXES; a++) {
        size_t index = block % s->grid_blocks[a], size = grid_size(s, a);
        block /= s->grid_blocks[a];
        from[a] = index * size / s->grid_blocks[a];
        to[a] = (index + 1) * size / s->grid_blocks[a];
    }
}

static void grid_point(const bl_sampling *s, size_t block, size_t index, double at[BL_AXES]) {
    size_t from[BL_AXES], to[BL_AXES];
    block_range(s, block, from, to);
    for (unsigned a = 0; a < BL_AXES; a++) {
        size_t width = to[a] - from[a];
        at[a] = s->signal->extent.size[a]
                    ? s->signal->extent.spacing[a] * (double)(from[a] + index % width)
                    : 0;
        index /= width;
    }
}

static void random_points(const bl_sampling *s, size_t block, size_t count,
                          double *const at[BL_AXES]) {
    bl_random random = bl_random_seed(s->settings.seed, 2 * (uint64_t)block);
    for (size_t i = 0; i < count; i++)
        for (unsigned a = 0; a < BL_AXES; a++)
            at[a][i] = (2 * bl_random_unit(&random) - 1) * REACH;
}

void bl_sampling_point(const bl_sampling *s, size_t block, size_t index, double at[BL_AXES]) {
    if (s->on_grid) {
        grid_point(s, block, index, at);
        return;
    }
    bl_random random = bl_random_seed(s->settings.seed, 2 * (uint64_t)block);
    for (size_t i = 0; i <= index; i++)
        for (unsigned a = 0; a < BL_AXES; a++)
            at[a] = (2 * bl_random_unit(&random) - 1) * REACH;
}

static void fill_grid_block(const bl_sampling *s, size_t block, float *out) {
    size_t from[BL_AXES], to[BL_AXES];
    block_range(s, block, from, to);
    size_t width = to[0] - from[0], count = s->first[block + 1] - s->first[block];
    double step[BL_AXES] = {s->signal->extent.spacing[0]}, start[BL_AXES];
    for (size_t i = 0; i < count; i += width) {
        grid_point(s, block, i, start);
        bl_signal_row(s->signal, start, step, width, out + i);
    }
}

static void fill_random_block(const bl_sampling *s, size_t block, float *out) {
    static const size_t axis_bytes = BLOCK * sizeof(double);
    double *room = malloc(BL_AXES * axis_bytes);
    size_t count = s->first[block + 1] - s->first[block];
    if (!room) { // a value that is not finite stops the measurement, as it must
        for (size_t i = 0; i < count; i++)
            out[i] = NAN;
        return;
    }
    double *const at[BL_AXES] = {room, room + BLOCK, room + 2 * BLOCK, room + 3 * BLOCK};
    const double *const places[BL_AXES] = {at[0], at[1], at[2], at[3]};
    random_points(s, block, count, at);
    bl_signal *fresh =
        bl_signal_reseed(s->signal, bl_stream(s->settings.seed, 2 * (uint64_t)block + 1));
    bl_signal_points(fresh ? fresh : s->signal, places, count, out);
    bl_signal_free(fresh);
    free(room);
}

static bl_status lay_blocks(bl_sampling *s, bl_message *message) {
    s->samples = s->settings.samples;
    s->blocks = (s->samples + BLOCK - 1) / BLOCK;
    double all = 1; // in doubles: sizes whose product no size_t holds are refused, not wrapped
    for (unsigned a = 0; s->on_grid && a < BL_AXES; a++)
        all *= (double)grid_size(s, a);
    double bytes = 12 * (s->on_grid ? all : (double)s->samples) + 64.0 * (double)s->blocks;
    bl_status status = bl_memory_check(bytes, "this histogram", message);
    if (status != BL_OK)
        return status;
    if (s->on_grid) {
        s->samples = s->blocks = 1;
        for (unsigned a = 0; a < BL_AXES; a++) {
            size_t size = grid_size(s, a);
            s->samples *= size;
            s->grid_blocks[a] = a > 1 ? 1 : size < GRID_BLOCKS ? size : GRID_BLOCKS;
            s->blocks *= s->grid_blocks[a];
        }
    }
    s->values = malloc(s->samples * sizeof *s->values);
    s->first = malloc((s->blocks + 1) * sizeof *s->first);
    s->moments = calloc(s->blocks, sizeof *s->moments);
    if (!s->values || !s->first || !s->moments)
        return bl_report(message, BL_DEVICE, "out of memory for %zu samples", s->samples);
    s->first[0] = 0;
    for (size_t block = 0; block < s->blocks; block++) {
        size_t count = BLOCK, from[BL_AXES], to[BL_AXES];
        if (s->on_grid) {
            block_range(s, block, from, to);
            count = 1;
            for (unsigned a = 0; a < BL_AXES; a++)
                count *= to[a] - from[a];
        } else if (count > s->samples - s->first[block]) {
            count = s->samples - s->first[block];
        }
        s->first[block + 1] = s->first[block] + count;
    }
    return BL_OK;
}

// --- values ---

static bl_status not_finite(const bl_sampling *s, size_t index, bl_message *message) {
    size_t block = 0;
    while (s->first[block + 1] <= index)
        block++;
    double at[BL_AXES];
    bl_sampling_point(s, block, index - s->first[block], at);
    return bl_report(message, BL_MISMATCH,
                     "'%s' gives %g at (%.9g, %.9g, %.9g, %.9g); a histogram needs finite values",
                     s->signal->text, (double)s->values[index], at[0], at[1], at[2], at[3]);
}

static bl_status fill_values(bl_sampling *s, bl_message *message) {
    int threads = bl_thread_count(s->settings.threads);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
    for (size_t block = 0; block < s->blocks; block++) {
        float *out = s->values + s->first[block];
        if (s->on_grid)
            fill_grid_block(s, block, out);
        else
            fill_random_block(s, block, out);
        for (size_t i = 0; i < s->first[block + 1] - s->first[block]; i++)
            bl_moments_add(&s->moments[block], (double)out[i]);
    }
    for (size_t i = 0; i < s->samples; i++)
        if (!isfinite(s->values[i]))
            return not_finite(s, i, message);
    return BL_OK;
}

static bl_status check_settings(const bl_signal *signal, bl_histogram_settings *settings,
                                int on_grid, bl_message *message) {
    if (settings->bins == 0)
        settings->bins = 64;
    if (settings->samples == 0 && !on_grid)
        return bl_report(message, BL_USAGE, "a histogram of no samples; ask for 1 or more");
    if (!(settings->level > 0 && settings->level < 1))
        return bl_report(message, BL_USAGE,
                         "the confidence level is %g; give a number between 0 and 1, as 0.95",
                         settings->level);
    if (!(settings->missed >= 0 && settings->missed < 1))
        return bl_report(message, BL_USAGE,
                         "the probability to miss is %g; give a number from 0 to below 1",
                         settings->missed);
    if (!isfinite(settings->from) || !isfinite(settings->to) ||
        (settings->from >= settings->to && (settings->from != 0 || settings->to != 0)))
        return bl_report(message, BL_USAGE,
                         "a histogram of '%s' from %g to %g: the range must be finite and grow",
                         signal->text, settings->from, settings->to);
    if (settings->threads < 0)
        return bl_report(message, BL_USAGE,
                         "%d threads cannot be had; give 1 or more, or 0 for all",
                         settings->threads);
    bl_status status = bl_signal_check_statistics(signal, message);
    return status == BL_OK ? bl_memory_check(16.0 * (double)settings->bins, "these bins", message)
                           : status;
}

bl_status bl_histogram_measure(const bl_signal *signal, const bl_histogram_settings *settings,
                               bl_histogram *histogram, bl_message *message) {
    bl_sampling s = {.signal = signal, .settings = *settings};
    *histogram = (bl_histogram){0};
    for (unsigned a = 0; a < BL_AXES; a++)
        s.on_grid |= signal->extent.size[a] != 0;
    bl_status status = check_settings(signal, &s.settings, s.on_grid, message);
    if (status == BL_OK)
        status = lay_blocks(&s, message);
    if (status == BL_OK)
        status = fill_values(&s, message);
    if (status == BL_OK)
        status = bl_histogram_fill(&s, histogram, message);
    if (status != BL_OK)
        bl_histogram_free(histogram);
    free(s.values);
    free(s.first);
    free(s.moments);
    return status;
}

void bl_histogram_free(bl_histogram *histogram) {
    free(histogram->edges);
    free(histogram->counts);
    *histogram = (bl_histogram){0};
}
