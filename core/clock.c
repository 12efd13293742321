// SPDX-License-Identifier: MIT
#include "core/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/statistics.h"

enum { MOST_ROUNDS = 101, BLOCKS = 6 };

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

// Of turns that still stand in the order of time.
static double find_worst_block(const double *taken, size_t rounds) {
    size_t blocks = rounds < BLOCKS ? rounds : BLOCKS;
    double worst = 0;
    for (size_t b = 0; b < blocks; b++) {
        double least = INFINITY;
        for (size_t i = b * rounds / blocks; i < (b + 1) * rounds / blocks; i++)
            least = fmin(least, taken[i]);
        worst = fmax(worst, least);
    }
    return worst;
}

static bl_time summarise(double *taken, size_t rounds) {
    double worst = find_worst_block(taken, rounds);
    qsort(taken, rounds, sizeof *taken, bl_ascending);
    return (bl_time){.minimum = taken[0],
                     .median = taken[rounds / 2],
                     .maximum = taken[rounds - 1],
                     .lower = taken[rounds / 4],
                     .upper = taken[rounds - 1 - rounds / 4],
                     .worst_block = worst};
}

void bl_time_by_turns(const bl_work *works, size_t count, int rounds, double turn_seconds,
                      bl_time *times) {
    const size_t turns = rounds < 1 ? 1 : rounds < MOST_ROUNDS ? (size_t)rounds : MOST_ROUNDS;
    double *taken = malloc(count * turns * sizeof *taken);
    size_t *runs = malloc(count * sizeof *runs);
    double seconds = fmax(turn_seconds, 1000 * bl_clock_tick());
    for (size_t w = 0; w < count; w++)
        times[w] = (bl_time){NAN, NAN, NAN, NAN, NAN, NAN};
    for (size_t w = 0; taken && runs && w < count; w++)
        runs[w] = runs_of(&works[w], seconds);
    for (size_t turn = 0; taken && runs && turn < turns; turn++)
        for (size_t w = 0; w < count; w++)
            taken[w * turns + turn] = 1e9 * time_runs(&works[w], runs[w]) / (double)runs[w];
    for (size_t w = 0; taken && runs && w < count; w++)
        times[w] = summarise(taken + w * turns, turns);
    free(runs);
    free(taken);
}

void bl_processor_name(char *name, size_t size) {
    char line[256];
    snprintf(name, size, "unknown");
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info && fgets(line, sizeof line, info)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon)
            continue;
        colon[strcspn(colon, "\n")] = '\0';
        snprintf(name, size, "%s", colon + 1 + (colon[1] == ' '));
        break;
    }
    if (info)
        fclose(info);
}
