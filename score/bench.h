// SPDX-License-Identifier: MIT
//
// The measuring of the benchmark: its rows, and the files that fill them.
#ifndef BL_SCORE_BENCH_H
#define BL_SCORE_BENCH_H

#include "core/clock.h"
#include "core/signal.h"
#include "core/verdict.h"
#include "noises/noise.h"

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
    double ratio;               // yardstick / candidate by the minima: above 1 is faster
    double max_error;           // against the double reference; NAN for a peer
    double floor;               // the least ratio asked for
    double transforms, ceiling; // 1 / ratio and 1 / floor: what is measured in transforms
    int met;                    // whether the floor is
    bl_verdict verdict;
    int peer; // another library, beside which ours stands
} bl_bench_row;

typedef struct bl_bench {
    bl_isa isa;  // of the loop beside which a peer is timed
    int threads; // of the spectrum
    int rounds;
    double turn_seconds;
    // Optional: called before each piece of work, with what is timed.
    void (*progress)(void *user, const char *what);
    void *user;
    bl_bench_row *rows; // owned by the caller, who frees them
    size_t count;
} bl_bench;

// Appends a row whose times are per run, as measured, and turns them into times per sample; looks
// up its floor. False if out of memory.
int bl_bench_add(bl_bench *bench, const bl_bench_row *row);

// Whether the row is compared with bare transforms, where a smaller ratio is better, and not with
// textbook loops.
int bl_bench_is_transform(const bl_bench_row *row);
// The rows that have a floor and miss it.
size_t bl_bench_missed(const bl_bench *bench);

// Tells the progress callback.
void bl_bench_step(const bl_bench *bench, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// All paths and axes of one noise by its text.
bl_status bl_bench_noise(bl_bench *bench, const char *text, bl_isa isa, bl_message *message);
// Every other library that is there.
bl_status bl_bench_peers(bl_bench *bench, bl_message *message);
// The spectrum of a 4096 x 4096 buffer against the bare transform.
bl_status bl_bench_psd(bl_bench *bench, bl_message *message);

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
