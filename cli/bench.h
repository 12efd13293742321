// SPDX-License-Identifier: MIT
//
// The rows of the benchmark, and the files that fill them.
#ifndef BL_CLI_BENCH_H
#define BL_CLI_BENCH_H

#include "core/clock.h"
#include "cli/verb.h"

// What one row says. NAN stands for what does not apply.
typedef struct bl_bench_row {
    char signal[128];
    const char *path; // "row-20", "row-2", "points", "psd-4096"
    const char *axis; // "x", "y", "z"; NULL for scattered points
    const char *isa;
    double samples_per_cell;
    double samples;      // in one run
    bl_time candidate;   // nanoseconds a sample
    const char *against; // what the yardstick is: "textbook", "reference", "transform"; NULL: none
    bl_time yardstick;
    double ratio;     // yardstick / candidate by the minima: above 1 is faster
    double max_error; // against the double reference; NAN for a peer
    double floor;     // the least ratio asked for
    int peer;         // another library, beside which ours stands
} bl_bench_row;

typedef struct bl_bench {
    bl_call *call;
    int rounds;
    double turn_seconds;
    bl_bench_row *rows;
    size_t count;
} bl_bench;

// Appends a row whose times are per run, as measured, and turns them into times per sample; looks
// up its floor. False if out of memory.
int bl_bench_add(bl_bench *bench, const bl_bench_row *row);

// All paths and axes of one noise by its text.
bl_status bl_bench_noise(bl_bench *bench, const char *text, bl_isa isa);
// Every other library that is there.
bl_status bl_bench_peers(bl_bench *bench);
// The spectrum of a 4096 x 4096 buffer against the bare transform.
bl_status bl_bench_psd(bl_bench *bench);

// Scattered points are many enough, and on both sides of the origin, so that neither the caches nor
// the branch predictor learn their order.
enum { BL_SCATTERED = 32768, BL_SCATTER_CUBE = 1000 };
void bl_bench_scatter(int axes, double (*at)[BL_SCATTERED]);

// The plain loop of a noise at given places, a call a point, as a piece of work: the textbook's
// loop, or where `textbook` is NULL the signal's own reference.
typedef struct bl_textbook_work {
    float (*textbook)(float x, float y, float z);
    const bl_signal *signal;
    const float *at[BL_AXES]; // the textbook takes three
    size_t count;
    float *out;
} bl_textbook_work;
void bl_textbook_run(void *user);

// Another library's noise at one place; NULL where it is not there.
typedef double (*bl_peer_function)(double x, double y, double z);
bl_peer_function bl_peer_stb(void);

#endif
