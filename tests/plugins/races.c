// SPDX-License-Identifier: MIT
//
// Functions for the test of races: each of the first kind keeps something between two lines that
// another thread can change, and is right from one thread; those of the second keep it well.
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "include/bandlimit_plugin.h"

BANDLIMIT_EXPORT bandlimit_function race_place, race_seed, race_cell, race_first_call, race_rows;
BANDLIMIT_EXPORT bandlimit_rows race_rows_rows;
BANDLIMIT_EXPORT bandlimit_function own_place, locked_place, once_first_call, serial_place;
BANDLIMIT_EXPORT bandlimit_claim serial_place_claims;

static uint64_t mix(uint64_t h) {
    h = (h ^ h >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ h >> 27) * UINT64_C(0x94d049bb133111eb);
    return h ^ h >> 31;
}

static double corner(double x, double y, uint64_t seed) {
    uint64_t h = mix(mix(mix(seed) ^ (uint64_t)(int64_t)x) ^ 3 * (uint64_t)(int64_t)y);
    return (double)(h >> 11) * 0x1p-52 - 1;
}

// Bilinear between random numbers; only x and y count.
static double value(double x, double y, uint64_t seed) {
    double i = floor(x), j = floor(y), u = x - i, v = y - j;
    return (1 - v) * ((1 - u) * corner(i, j, seed) + u * corner(i + 1, j, seed)) +
           v * ((1 - u) * corner(i, j + 1, seed) + u * corner(i + 1, j + 1, seed));
}

// --- with a race -------------------------------------------------------------------------------

static volatile double kept_x, kept_y;

double race_place(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    kept_x = p[0], kept_y = p[1];
    return value(kept_x, kept_y, seed);
}

static volatile uint64_t current_seed;

double race_seed(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    double sum = 0;
    current_seed = seed;
    for (int octave = 0; octave < 4; octave++)
        sum += value(ldexp(p[0], octave), ldexp(p[1], octave), current_seed + (uint64_t)octave);
    return sum;
}

// The corner of the cell it was in last.
static volatile double last_i = NAN, last_j, last_corner;
static volatile uint64_t last_seed;

double race_cell(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    double i = floor(p[0] / 64), j = floor(p[1] / 64);
    if (i != last_i || j != last_j || seed != last_seed) {
        last_i = i, last_j = j, last_seed = seed;
        last_corner = corner(i, j, seed);
    }
    return last_corner;
}

// A table that is made at the first call, and said to be ready too early.
static volatile int is_ready;
static volatile double table[4096];

double race_first_call(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    if (!is_ready) {
        is_ready = 1;
        for (int i = 0; i < 4096; i++)
            table[i] = corner(i, 0, 1);
    }
    return table[mix(mix(seed) + (uint64_t)(int64_t)floor(p[0])) % 4096];
}

// Right at single points, and wrong in rows.
static volatile double row_start;

double race_rows(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    return value(p[0], 0.5, seed);
}

void race_rows_rows(const double start[4], const double step[4], size_t count, unsigned dims,
                    uint64_t seed, void *user, float *out) {
    (void)dims, (void)user;
    row_start = start[0];
    for (size_t i = 0; i < count; i++)
        out[i] = (float)value(row_start + (double)i * step[0], 0.5, seed);
}

// --- without one -------------------------------------------------------------------------------

double own_place(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    static _Thread_local volatile double x, y;
    x = p[0], y = p[1];
    return value(x, y, seed);
}

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

double locked_place(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    pthread_mutex_lock(&lock);
    kept_x = p[0], kept_y = p[1];
    double found = value(kept_x, kept_y, seed);
    pthread_mutex_unlock(&lock);
    return found;
}

static pthread_once_t once = PTHREAD_ONCE_INIT;
static double table_once[4096];

static void make_table(void) {
    for (int i = 0; i < 4096; i++)
        table_once[i] = corner(i, 0, 1);
}

double once_first_call(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    pthread_once(&once, make_table);
    return table_once[mix(mix(seed) + (uint64_t)(int64_t)floor(p[0])) % 4096];
}

// Says that it is not thread-safe: one thread at a time asks, and it is right.
double serial_place(const double p[4], unsigned dims, uint64_t seed, void *user) {
    return race_place(p, dims, seed, user);
}

void serial_place_claims(struct bandlimit_claims *claims) {
    claims->flags = BANDLIMIT_NOT_THREAD_SAFE;
}
