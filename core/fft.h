// SPDX-License-Identifier: MIT
//
// Real Fourier transforms of one to three dimensions, float and double, in place.
//
// All transforms are unnormalised, forward with exp(-2 pi i j k / n). A real transform stands in
// its buffer as rows of 2*(n/2+1) numbers, n = the last size; after the forward transform each row
// holds n/2+1 complex numbers. Buffers come from bl_fft_buffer, or start at a multiple of
// BL_FFT_ALIGNMENT bytes.
//
// Plans are made once and kept for the life of the process, under a lock: all functions here may be
// called from several threads, and a plan may run on many buffers at once.
//
// The same transform gives the same bits on every run: a plan is measured only where its wisdom
// can be kept in $XDG_CACHE_HOME/bandlimit (or ~/.cache/bandlimit), from where the next process
// takes it; elsewhere plans are estimated, which uses no clock.
#ifndef BL_CORE_FFT_H
#define BL_CORE_FFT_H

#include <stddef.h>

#include "core/status.h"

enum { BL_FFT_ALIGNMENT = 64 }; // bytes: a cache line

typedef enum bl_fft_kind {
    BL_FFT_REAL,    // real to complex
    BL_FFT_BACK,    // complex to real; n times the original comes back
    BL_FFT_COLUMNS, // complex, float, 1-D: `columns` interleaved columns, [size][columns]
    BL_FFT_ROW      // real to complex, float, 1-D, from one buffer to another: bl_fft_run_row
} bl_fft_kind;

typedef enum bl_fft_precision { BL_FFT_FLOAT, BL_FFT_DOUBLE } bl_fft_precision;

typedef struct bl_fft_shape {
    bl_fft_kind kind;
    bl_fft_precision precision;
    unsigned dims;  // 1 to 3
    size_t size[3]; // slowest axis first; entries past dims are ignored
    size_t columns; // for BL_FFT_COLUMNS
    int threads;    // inside the transform: 0 and 1 mean one; more changes the bits
} bl_fft_shape;

typedef struct bl_fft bl_fft; // a plan; never freed by the caller

// Finds or makes the plan. Errors: BL_USAGE for a shape that is none, BL_MISMATCH where a size
// exceeds what the transform can index, BL_DEVICE out of memory.
bl_status bl_fft_plan(const bl_fft_shape *shape, const bl_fft **plan, bl_message *message);

// Transforms one buffer in place. Thread-safe on different buffers.
void bl_fft_run(const bl_fft *plan, void *buffer);

// Transforms `samples`, which it may overwrite, into `spectrum`; both aligned as said above.
void bl_fft_run_row(const bl_fft *plan, float *samples, float *spectrum);

// The bytes that a real transform of this shape takes in its buffer; SIZE_MAX if no size_t holds
// them.
size_t bl_fft_bytes(const bl_fft_shape *shape);

// An aligned buffer, not cleared, in large pages where it is large; freed with free(). NULL out of
// memory.
void *bl_fft_buffer(size_t bytes);

// The yardstick of the benchmark: plans, once, the library's own in-place 2-D real transform of
// size x size floats (rows of 2*(size/2+1)) over `threads` threads; then bl_fft_run it. Its bits
// may depend on the threads; nothing else in the project uses it.
bl_status bl_fft_bare_2d(size_t size, int threads, const bl_fft **plan, bl_message *message);

// Whether plans are measured and their wisdom kept, and where; the caller frees *folder (NULL if
// there is none).
int bl_fft_keeps_wisdom(char **folder);

// Forgets all plans and all wisdom in memory (not on disk). No transform may be running. For tests.
void bl_fft_forget(void);

#endif
