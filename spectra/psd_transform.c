// SPDX-License-Identifier: MIT
//
// One average: mean off, window on, transform, powers, sums over the bins.
//
// A slice is transformed by rows, then by columns in blocks of 16 that are copied to a scratch of
// their own, transformed there, and summed without going back to memory. Every block and every row
// is one piece of work whose result does not depend on who does it, and partial sums are merged in
// the order of the blocks: the bits do not depend on the threads.
#include "spectra/psd_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <omp.h>

// Columns: 128 bytes of each row, and a block of 4096 rows stays in the L2 cache.
enum { BLOCK = BL_CELLS_AT_ONCE, LINE_FLOATS = 16 /* floats in a cache line */ };

// Blocks that share partial sums: one piece of work.
enum { CHUNK = 4 };

// Rows start on cache lines, an odd number of them apart, so that the cells of a column fall into
// different sets of the cache.
size_t bl_psd_pitch(size_t size) {
    size_t lines = (2 * (size / 2 + 1) + LINE_FLOATS - 1) / LINE_FLOATS;
    return (lines | 1) * LINE_FLOATS;
}

static bl_status plan_transform(bl_transform *transform, bl_message *message) {
    size_t size = transform->size, last = transform->count % BLOCK;
    bl_fft_shape shape = {.kind = BL_FFT_REAL, .dims = 1, .size = {size, size, size}};
    if (transform->dims != 2) {
        shape.dims = transform->dims;
        shape.precision = transform->dims == 1 ? BL_FFT_DOUBLE : BL_FFT_FLOAT;
        return bl_fft_plan(&shape, &transform->whole, message);
    }
    shape.kind = BL_FFT_ROW;
    bl_status status = bl_fft_plan(&shape, &transform->row, message);
    shape.kind = BL_FFT_COLUMNS;
    shape.columns = BLOCK;
    if (status == BL_OK && transform->count >= BLOCK)
        status = bl_fft_plan(&shape, &transform->columns, message);
    shape.columns = last;
    if (status == BL_OK && last)
        status = bl_fft_plan(&shape, &transform->last_columns, message);
    return status;
}

bl_status bl_transform_open(unsigned dims, size_t size, bl_window window, bl_transform *transform,
                            bl_message *message) {
    *transform = (bl_transform){.dims = dims, .size = size, .count = size / 2 + 1};
    transform->pitch = dims == 2 ? bl_psd_pitch(size) : 2 * (size / 2 + 1);
    transform->loops = bl_psd_loops();
    transform->line_pitch = (2 * (size / 2 + 1) + 7) / 8 * 8; // whole cache lines
    transform->window = malloc(size * sizeof(double));
    transform->window_float = malloc(size * sizeof(float));
    if (!transform->window || !transform->window_float) {
        bl_transform_close(transform);
        return bl_report(message, BL_DEVICE, "out of memory for a window of %zu samples", size);
    }
    bl_window_fill(window, size, transform->window);
    double power = 0;
    for (size_t i = 0; i < size; i++) {
        // Slices and volumes are weighted in float: the sum of squares is that of the floats.
        transform->window_float[i] = (float)transform->window[i];
        double w = dims == 1 ? transform->window[i] : (double)transform->window_float[i];
        power += w * w;
    }
    transform->window_power = pow(power, dims);
    transform->scale = 1 / (transform->window_power * pow((double)size, dims));
    bl_status status = plan_transform(transform, message);
    if (status != BL_OK)
        bl_transform_close(transform);
    return status;
}

void bl_transform_close(bl_transform *transform) {
    free(transform->window);
    free(transform->window_float);
    *transform = (bl_transform){0};
}

// --- lines ---

static double run_line(const bl_transform *transform, double *samples, double mean, int keep,
                       bl_bin_sum *sums) {
    double windowed = 0;
    size_t size = transform->size, last = transform->count - 1;
    for (size_t i = 0; i < size; i++) {
        samples[i] = (samples[i] - mean) * transform->window[i];
        windowed += samples[i] * samples[i];
    }
    bl_fft_run(transform->whole, samples);
    for (size_t k = 0; k <= last; k++) {
        double re = samples[2 * k], im = samples[2 * k + 1];
        double power = (re * re + im * im) * transform->scale;
        double weight = k == 0 || 2 * k == size ? 1 : 2;
        sums[k] = (bl_bin_sum){weight * power, weight * power * power};
        if (keep)
            samples[2 * k] = power;
    }
    return windowed;
}

// --- slices and volumes ---

// Cells off the first and last column stand for two.
static void fill_weights(const bl_transform *transform, size_t from, size_t columns,
                         double weight[BLOCK]) {
    for (size_t i = 0; i < columns; i++)
        weight[i] = from + i == 0 || 2 * (from + i) == transform->size ? 1 : 2;
}

static void merge_sums(bl_bin_sum *into, const bl_bin_sum *parts, size_t bins, size_t blocks,
                       double scale) {
    memset(into, 0, bins * sizeof *into);
    for (size_t block = 0; block < blocks; block++)
        for (size_t bin = 0; bin < bins; bin++) {
            into[bin].sum += parts[block * bins + bin].sum;
            into[bin].square += parts[block * bins + bin].square;
        }
    for (size_t bin = 0; bin < bins; bin++) {
        into[bin].sum *= scale;
        into[bin].square *= scale * scale;
    }
}

// Row y and row size - y are as far from the origin, and are binned together.
static void run_block(const bl_transform *transform, float *samples, size_t block, float *scratch,
                      int keep, bl_bin_sum *sums) {
    size_t size = transform->size, from = block * BLOCK;
    size_t columns = transform->count - from < BLOCK ? transform->count - from : BLOCK;
    for (size_t y = 0; y < size; y++) {
        const float *cells = samples + y * transform->pitch + 2 * from;
        if (columns == BLOCK) // a length the compiler knows takes a few vectors, not a call
            memcpy(scratch + y * 2 * BLOCK, cells, 2 * BLOCK * sizeof(float));
        else
            memcpy(scratch + y * 2 * columns, cells, 2 * columns * sizeof(float));
    }
    bl_fft_run(columns == BLOCK ? transform->columns : transform->last_columns, scratch);
    double weight[BLOCK];
    fill_weights(transform, from, columns, weight);
    for (size_t y = 0; 2 * y <= size; y++) {
        int paired = y != 0 && 2 * y != size;
        float *cells = scratch + y * 2 * columns;
        float *mirror = paired ? scratch + (size - y) * 2 * columns : NULL;
        transform->loops->bin_cells(cells, mirror, from, columns, (double)y * (double)y, weight,
                                    transform->count, sums);
        for (size_t i = 0; keep && i < columns; i++) {
            samples[y * transform->pitch + 2 * (from + i)] = cells[2 * i];
            if (paired)
                samples[(size - y) * transform->pitch + 2 * (from + i)] = mirror[2 * i];
        }
    }
}

static bl_status run_slice(const bl_transform *transform, float *samples, double mean, int threads,
                           int keep, bl_transformed *result, bl_message *message) {
    size_t size = transform->size, bins = transform->count + 1;
    size_t blocks = (transform->count + BLOCK - 1) / BLOCK;
    size_t chunks = (blocks + CHUNK - 1) / CHUNK;
    size_t scratch_floats = size * 2 * BLOCK;
    float *scratch = bl_fft_buffer((size_t)threads * scratch_floats * sizeof(float));
    bl_bin_sum *parts = calloc(chunks * bins, sizeof *parts);
    double *squares = malloc(size * sizeof *squares);
    if (!scratch || !parts || !squares) {
        free(scratch);
        free(parts);
        free(squares);
        return bl_report(message, BL_DEVICE, "out of memory transforming a slice of %zu x %zu",
                         size, size);
    }
    const float *window = transform->window_float;
#pragma omp parallel num_threads(threads) if (threads > 1)
    {
        float *own = scratch + (size_t)omp_get_thread_num() * scratch_floats;
#pragma omp for schedule(static)
        for (size_t y = 0; y < size; y++) {
            float *row = samples + y * transform->pitch;
            squares[y] =
                transform->loops->weight_row(row, window, size, (float)mean, window[y], own);
            bl_fft_run_row(transform->row, own, row);
        }
#pragma omp for schedule(dynamic, 1)
        for (size_t chunk = 0; chunk < chunks; chunk++)
            for (size_t b = chunk * CHUNK; b < blocks && b < (chunk + 1) * CHUNK; b++)
                run_block(transform, samples, b, own, keep, parts + chunk * bins);
    }
    merge_sums(result->sums, parts, bins, chunks, transform->scale);
    result->windowed = 0;
    for (size_t y = 0; y < size; y++)
        result->windowed += squares[y];
    free(scratch);
    free(parts);
    free(squares);
    return BL_OK;
}

static double run_volume(const bl_transform *transform, float *samples, double mean,
                         bl_bin_sum *sums) {
    size_t size = transform->size, count = transform->count;
    const float *window = transform->window_float;
    double windowed = 0;
    for (size_t row = 0; row < size * size; row++) {
        float *at = samples + row * transform->pitch;
        float factor = window[row % size] * window[row / size];
        windowed += transform->loops->weight_row(at, window, size, (float)mean, factor, at);
    }
    bl_fft_run(transform->whole, samples);
    bl_bin_sum *raw = sums + count + 1; // the caller gives twice the room
    memset(raw, 0, (count + 1) * sizeof *raw);
    for (size_t row = 0; row < size * size; row++) {
        double ky = (double)bl_folded(row % size, size), kz = (double)bl_folded(row / size, size);
        float *cells = samples + row * transform->pitch;
        for (size_t from = 0; from < count; from += BLOCK) {
            double weight[BLOCK];
            size_t columns = count - from < BLOCK ? count - from : BLOCK;
            fill_weights(transform, from, columns, weight);
            transform->loops->bin_cells(cells + 2 * from, NULL, from, columns, ky * ky + kz * kz,
                                        weight, count, raw);
        }
    }
    merge_sums(sums, raw, count + 1, 1, transform->scale);
    return windowed;
}

bl_status bl_transform_run(const bl_transform *transform, void *samples, double mean, int threads,
                           int keep, bl_transformed *result, bl_message *message) {
    bl_status status = BL_OK;
    if (transform->dims == 1)
        result->windowed = run_line(transform, samples, mean, keep, result->sums);
    else if (transform->dims == 2)
        status = run_slice(transform, samples, mean, threads, keep, result, message);
    else
        result->windowed = run_volume(transform, samples, mean, result->sums);
    result->windowed /= transform->window_power;
    return status;
}

void bl_transform_add(const bl_transform *transform, const void *samples, double *half) {
    size_t count = transform->count, rows = 1;
    for (unsigned d = 1; d < transform->dims; d++)
        rows *= transform->size;
    for (size_t row = 0; row < rows; row++)
        for (size_t x = 0; x < count; x++)
            half[row * count + x] +=
                transform->dims == 1
                    ? ((const double *)samples)[2 * x]
                    : transform->scale *
                          (double)((const float *)samples)[row * transform->pitch + 2 * x];
}
