// SPDX-License-Identifier: MIT
//
// Functions as users write them, good and bad, for t-plugin.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/bandlimit_plugin.h"

// --- the least that a plugin can be ---

BANDLIMIT_EXPORT bandlimit_function plain, full, unsafe, nowhere, constant;

double plain(const double p[4], unsigned dims, uint64_t seed, void *user) {
    return p[0] + 10 * p[1] + 100 * p[2] + 1000 * p[3] + 0.25 * (double)seed + 1e-3 * dims +
           (user ? 1e6 : 0);
}

// --- all companions ---

BANDLIMIT_EXPORT bandlimit_init full_init;
BANDLIMIT_EXPORT bandlimit_free full_free;
BANDLIMIT_EXPORT bandlimit_rows full_rows;
BANDLIMIT_EXPORT bandlimit_claim full_claims;
BANDLIMIT_EXPORT bandlimit_function full_alive; // how many seeds are alive

static int alive;

double full_alive(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)p, (void)dims, (void)seed, (void)user;
    return alive;
}

int full_init(uint64_t seed, void **user) {
    double *phase = malloc(sizeof *phase);
    if (!phase)
        return 1;
    *phase = (double)(seed % 1000) / 1000;
    *user = phase;
    __atomic_add_fetch(&alive, 1, __ATOMIC_SEQ_CST);
    return 0;
}

void full_free(void *user) {
    free(user);
    __atomic_sub_fetch(&alive, 1, __ATOMIC_SEQ_CST);
}

double full(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)seed;
    if (dims != 2 || p[2] != 0 || p[3] != 0 || !isfinite(p[0]) || !isfinite(p[1]))
        return 1e9; // a promise was broken
    double cycles = p[0] + *(double *)user, other = 0.5 * p[1];
    return 0.5 * sin(6.283185307179586 * (cycles - floor(cycles))) +
           0.5 * cos(6.283185307179586 * (other - floor(other)));
}

void full_rows(const double start[4], const double step[4], size_t count, unsigned dims,
               uint64_t seed, void *user, float *out) {
    for (size_t i = 0; i < count; i++) {
        double p[4];
        for (int a = 0; a < 4; a++)
            p[a] = start[a] + (double)i * step[a];
        out[i] = (float)full(p, dims, seed, user);
    }
}

void full_claims(struct bandlimit_claims *claims) {
    claims->dims = 2;
    claims->lower = -1;
    claims->upper = 1;
    claims->mean = 0;
    claims->variance = 0.25;
    claims->band_from = 0;
    claims->band_to = 1;
    claims->leak_db = -60;
    claims->continuity = 2;
    claims->period[0] = 1;
    claims->period[1] = 2;
    claims->cell = 0;
    claims->stationary = 1;
}

// --- a function that two threads may not call at once ---

BANDLIMIT_EXPORT bandlimit_claim unsafe_claims;

double unsafe(const double p[4], unsigned dims, uint64_t seed, void *user) {
    static volatile int inside;
    (void)dims, (void)seed, (void)user;
    int others = inside++;
    for (volatile int i = 0; i < 20; i++)
        continue;
    others += inside - 1;
    inside--;
    return others ? 1e9 : p[0];
}

void unsafe_claims(struct bandlimit_claims *claims) {
    claims->flags = BANDLIMIT_NOT_THREAD_SAFE;
}

double nowhere(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)seed, (void)user;
    return p[0] > 0 ? NAN : 1;
}

double constant(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)p, (void)dims, (void)seed, (void)user;
    return 0.1;
}

// --- claims that are not true, and one that is hard to tell ---

BANDLIMIT_EXPORT bandlimit_function liar, seldom;
BANDLIMIT_EXPORT bandlimit_claim liar_claims, seldom_claims;

static double wave(const double p[4], uint64_t seed) {
    uint64_t bits = seed * UINT64_C(0x9E3779B97F4A7C15);
    return sin(6.283185307179586 * (p[0] - floor(p[0]) + (double)(bits >> 40) * 0x1p-24));
}

double liar(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    return wave(p, seed);
}

void liar_claims(struct bandlimit_claims *claims) {
    claims->dims = 1;
    claims->mean = 0.5; // it is 0
    claims->continuity = 2;
}

// Of one seed in eight; their variance is 8 times 1/2.
double seldom(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    return (seed * UINT64_C(0xBF58476D1CE4E5B9)) >> 61 ? 0 : sqrt(8) * wave(p, seed);
}

void seldom_claims(struct bandlimit_claims *claims) {
    claims->dims = 1;
    claims->mean = 0;
    claims->variance = 0.5;
    claims->continuity = 2;
}

// --- bad ones ---

BANDLIMIT_EXPORT extern int data;
int data = 1;

BANDLIMIT_EXPORT bandlimit_function no_init;
BANDLIMIT_EXPORT bandlimit_init no_init_init;

double no_init(const double p[4], unsigned dims, uint64_t seed, void *user) {
    return plain(p, dims, seed, user);
}

int no_init_init(uint64_t seed, void **user) {
    (void)user;
    return seed == 7 ? 0 : 42;
}

// --- what crashes, at places above 0 ---

BANDLIMIT_EXPORT bandlimit_function crash_read, crash_abort, crash_deep;

double crash_read(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)seed, (void)user;
    // Not NULL: the undefined-behaviour sanitizer would end the program before the signal.
    const double *volatile nowhere_at_all = (const double *)sizeof(double);
    return p[0] > 0 ? *nowhere_at_all : 0;
}

double crash_abort(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)seed, (void)user;
    if (p[0] > 0)
        abort();
    return 0;
}

static double deeper(double depth) {
    volatile char room[4096];
    room[0] = (char)depth;
    return depth < 0 ? depth : deeper(depth + 1) + room[0];
}

double crash_deep(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)seed, (void)user;
    return p[0] > 0 ? deeper(1) : 0;
}

#define BAD_CLAIM(name, what)                                                                      \
    BANDLIMIT_EXPORT bandlimit_function name;                                                      \
    BANDLIMIT_EXPORT bandlimit_claim name##_claims;                                                \
    double name(const double p[4], unsigned dims, uint64_t seed, void *user) {                     \
        return plain(p, dims, seed, user);                                                         \
    }                                                                                              \
    void name##_claims(struct bandlimit_claims *claims) {                                          \
        what;                                                                                      \
    }

BAD_CLAIM(bad_bound, claims->lower = 1; claims->upper = -1)
BAD_CLAIM(bad_mean, claims->lower = -1; claims->upper = 1; claims->mean = 2)
BAD_CLAIM(bad_variance, claims->lower = -1; claims->upper = 1; claims->variance = 1.1)
BAD_CLAIM(bad_sign, claims->variance = -1)
BAD_CLAIM(bad_band, claims->band_from = 2; claims->band_to = 1)
BAD_CLAIM(half_band, claims->band_to = 1)
BAD_CLAIM(bad_leak, claims->leak_db = 3)
BAD_CLAIM(bad_dims, claims->dims = 5)
BAD_CLAIM(bad_period, claims->period[1] = -1)
BAD_CLAIM(bad_cell, claims->cell = -1)
BAD_CLAIM(endless_cell, claims->cell = INFINITY)
BAD_CLAIM(bad_class, claims->continuity = -3)
BAD_CLAIM(bad_flags, claims->flags = 1u << 30)
BAD_CLAIM(bad_size, claims->size = 8)
// A struct of a later version, longer than this one.
BAD_CLAIM(long_claims, memset((char *)claims + sizeof *claims, 0, 64))

// --- detail that nobody states ---

BANDLIMIT_EXPORT bandlimit_function fine; // 100.3 cycles per unit along x

double fine(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)seed, (void)user;
    return sin(6.283185307179586 * (100.3 * p[0] + 0.4 * p[1]));
}
