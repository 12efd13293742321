// SPDX-License-Identifier: MIT
//
// The benchmark of the spectrum: from a buffer of 4096 x 4096 floats to its radial PSD with bands,
// against the bare in-place transform of the same buffer with the same threads.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "score/bench.h"
#include "core/random.h"
#include "core/fft.h"
#include "core/memory.h"
#include "spectra/psd.h"

enum { SIZE = 4096 };

// Both works overwrite their buffer, and each starts from the same samples.
typedef struct psd_work {
    const float *samples; // SIZE x SIZE
    float *buffer;
    size_t pitch;
    bl_psd_settings settings;
    const bl_fft *bare;
    bl_message message;
    bl_status status;
} psd_work;

static void restore(void *user) {
    psd_work *work = user;
    for (size_t j = 0; j < SIZE; j++)
        memcpy(work->buffer + j * work->pitch, work->samples + j * SIZE,
               SIZE * sizeof *work->buffer);
}

static void run_whole(void *user) {
    psd_work *work = user;
    bl_psd psd;
    if (work->status == BL_OK)
        work->status = bl_psd_of_buffer(work->buffer, &work->settings, &psd, &work->message);
    if (work->status == BL_OK)
        bl_psd_free(&psd);
}

static void run_bare(void *user) {
    psd_work *work = user;
    bl_fft_run(work->bare, work->buffer);
}

static void fill(float *samples) {
    bl_random random = bl_random_seed(1, 0);
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
        samples[i] = (float)(bl_random_unit(&random) - 0.5);
}

static bl_status time_both(bl_bench *bench, psd_work *whole, psd_work *bare, bl_message *message) {
    const bl_work works[] = {{run_whole, whole, restore}, {run_bare, bare, restore}};
    bl_time times[2];
    bl_bench_step(bench, "psd-4096");
    bl_time_by_turns(works, 2, bench->rounds < 5 ? 3 : 5, 0, times);
    if (whole->status != BL_OK)
        return bl_report(message, whole->status, "%s", whole->message.text);
    bl_bench_row row = {.signal = "psd",
                        .against = "transform",
                        .path = "psd-4096",
                        .isa = "as built",
                        .samples_per_cell = NAN,
                        .samples = (double)SIZE * SIZE,
                        .candidate = times[0],
                        .yardstick = times[1],
                        .max_error = NAN,
                        .floor = NAN};
    return bl_bench_add(bench, &row) ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
}

bl_status bl_bench_psd(bl_bench *bench, bl_message *message) {
    int threads = bench->threads;
    psd_work whole = {.pitch = bl_psd_pitch(SIZE), .settings = bl_psd_default_settings(2)};
    psd_work bare = {.pitch = 2 * (SIZE / 2 + 1)};
    whole.settings.size = SIZE;
    whole.settings.rate = 8;
    whole.settings.threads = threads;
    double bytes = 4.0 * SIZE * (SIZE + (double)whole.pitch + (double)bare.pitch);
    bl_status status = bl_memory_check(bytes, "the spectrum of 4096 x 4096 samples", message);
    if (status != BL_OK)
        return status;
    float *samples = malloc((size_t)SIZE * SIZE * sizeof *samples);
    whole.buffer = bl_fft_buffer(SIZE * whole.pitch * sizeof *whole.buffer);
    bare.buffer = bl_fft_buffer(SIZE * bare.pitch * sizeof *bare.buffer);
    if (!samples || !whole.buffer || !bare.buffer) {
        status = bl_report(message, BL_DEVICE, "out of memory");
    } else {
        fill(samples);
        whole.samples = bare.samples = samples;
        status = bl_fft_bare_2d(SIZE, threads, &bare.bare, message);
        if (status == BL_OK)
            status = time_both(bench, &whole, &bare, message);
    }
    free(samples);
    free(whole.buffer);
    free(bare.buffer);
    return status;
}
