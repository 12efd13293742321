// SPDX-License-Identifier: MIT
#include "core/clock.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

enum { MOST_WORKS = 4, MOST_ROUNDS = 101, BLOCKS = 6 };

double bl_clock_seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double bl_clock_tick(void) {
    double tick = 1;
    for (int i = 0; i < 64; i++) {
        double start = bl_clock_seconds(), end = start;
        while (end == start)
            end = bl_clock_seconds();
        if (end - start < tick)
            tick = end - start;
    }
    return tick;
}

static double time_runs(const bl_work *work, size_t runs) {
    double taken = 0;
    for (size_t i = 0; work->prepare && i < runs; i++) {
        work->prepare(work->user);
        double start = bl_clock_seconds();
        work->run(work->user);
        taken += bl_clock_seconds() - start;
    }
    double start = bl_clock_seconds();
    for (size_t i = 0; !work->prepare && i < runs; i++)
        work->run(work->user);
    return work->prepare ? taken : bl_clock_seconds() - start;
}

// How many runs fill a turn: doubled until they do, which warms caches too.
static size_t runs_of(const bl_work *work, double seconds) {
    size_t runs = 1;
    while (time_runs(work, runs) < seconds && runs < (size_t)1 << 40)
        runs *= 2;
    return runs;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double find_worst_block(const double *taken, int rounds) {
    int blocks = rounds < BLOCKS ? rounds : BLOCKS;
    double worst = 0;
    for (int b = 0; b < blocks; b++) {
        double least = INFINITY;
        for (int i = b * rounds / blocks; i < (b + 1) * rounds / blocks; i++)
            least = fmin(least, taken[i]);
        worst = fmax(worst, least);
    }
    return worst;
}

void bl_time_by_turns(const bl_work *works, size_t count, int rounds, double turn_seconds,
                      bl_time *times) {
    double taken[MOST_WORKS][MOST_ROUNDS];
    size_t runs[MOST_WORKS];
    double seconds = fmax(turn_seconds, 1000 * bl_clock_tick());
    rounds = rounds < MOST_ROUNDS ? rounds : MOST_ROUNDS;
    for (size_t w = 0; w < count; w++)
        runs[w] = runs_of(&works[w], seconds);
    for (int round = 0; round < rounds; round++)
        for (size_t w = 0; w < count; w++)
            taken[w][round] = 1e9 * time_runs(&works[w], runs[w]) / (double)runs[w];
    for (size_t w = 0; w < count; w++) {
        double worst = find_worst_block(taken[w], rounds); // while they stand in order of time
        qsort(taken[w], (size_t)rounds, sizeof taken[w][0], ascending);
        times[w] = (bl_time){taken[w][0], taken[w][rounds / 2], worst};
    }
}
