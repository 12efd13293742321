// SPDX-License-Identifier: MIT
//
// The property `cost`: nanoseconds a sample, of rows with 20 samples a cell along x and of
// scattered points, on one thread.
//
// For information: a time is a fact about this machine at this moment, so it is never held against
// anything, and the verdict is "not run" even where there are numbers. Rows and points are timed by
// turns, each repeated until the clock can be trusted; the least of the turns is the cost, the
// median tells how disturbed they were. The interval of the cost goes from the least to the largest
// of the minima of six blocks of turns: it holds the median of such minima unless all six lie on
// one side of it, which has the probability 2^-5. This is the one property that differs from run to
// run.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/clock.h"
#include "score/properties/sampling.h"
#include "score/score.h"

enum { MOST = 4096, LEAST = 64 };

typedef struct loop_work {
    const bl_signal *signal;
    double start[BL_AXES], step[BL_AXES];
    const double *at[BL_AXES];
    size_t count;
    float *out;
} loop_work;

static void run_row(void *user) {
    loop_work *work = user;
    bl_signal_row(work->signal, work->start, work->step, work->count, work->out);
}

static void run_points(void *user) {
    loop_work *work = user;
    bl_signal_points(work->signal, work->at, work->count, work->out);
}

// As many samples as one run takes a fiftieth of a turn for, so that slow signals are timed too.
static void choose_count(loop_work *work, double turn_seconds) {
    size_t most = work->count;
    for (work->count = LEAST; work->count < most; work->count *= 2) {
        double start = bl_clock_seconds();
        run_points(work);
        if (bl_clock_seconds() - start > 0.02 * turn_seconds)
            break;
    }
    work->count = work->count < most ? work->count : most;
}

static void place_row(loop_work *work) {
    const bl_extent *extent = &work->signal->extent;
    double cell = work->signal->facts.cell;
    static const double start[BL_AXES] = {0.37, 0.61, 0.83, 0.29};
    for (int a = 0; a < BL_AXES; a++)
        work->start[a] = bl_score_on_grid(work->signal) ? 0 : start[a];
    work->step[0] = bl_score_on_grid(work->signal) ? extent->spacing[0] : 0.05;
    if (cell > 0 && !bl_score_on_grid(work->signal))
        work->step[0] = 0.05 * cell;
    if (bl_score_on_grid(work->signal) && extent->size[0] < work->count)
        work->count = extent->size[0];
}

static void judge(bl_score_property *result, const bl_time times[2], double samples) {
    double row = times[0].minimum / samples, points = times[1].minimum / samples;
    if (!(row > 0) || !(points > 0) || !isfinite(row) || !isfinite(points)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the clock could not be trusted: a run took no time that it could tell");
        return;
    }
    double level = 1 - 0x1p-5, row_worst = times[0].worst_block / samples;
    bl_score_add(result, "row_ns", (bl_estimate){row, row, row_worst, level, 6});
    bl_score_add_seen(result, "row_median_ns", times[0].median / samples);
    double points_worst = times[1].worst_block / samples;
    bl_score_add(result, "points_ns", (bl_estimate){points, points, points_worst, level, 6});
    bl_score_add_seen(result, "points_median_ns", times[1].median / samples);
    snprintf(result->cell, sizeof result->cell, "%.3g ns", row);
    bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                   "for information: %.3g ns a sample in rows, %.3g ns a scattered point", row,
                   points);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    double turn = bl_size_pick(settings->size, 2e-4, 2e-3, 5e-3);
    int rounds = (int)bl_size_pick(settings->size, 12, 18, 36);
    loop_work work = {.signal = subject->signal, .count = MOST};
    double *room = malloc(MOST * (BL_AXES * sizeof(double) + sizeof(float)));
    if (!room)
        return bl_report(message, BL_DEVICE, "out of memory");
    work.out = (float *)(room + (size_t)BL_AXES * MOST);
    bl_random random = bl_random_seed(settings->seed, 0);
    for (size_t i = 0; i < MOST; i++) {
        double at[BL_AXES];
        bl_score_place(subject->signal, 500, &random, at);
        for (int a = 0; a < BL_AXES; a++)
            room[(size_t)a * MOST + i] = at[a];
    }
    for (int a = 0; a < BL_AXES; a++)
        work.at[a] = room + (size_t)a * MOST;
    place_row(&work);
    choose_count(&work, turn);
    const bl_work works[] = {{run_row, &work, NULL}, {run_points, &work, NULL}};
    bl_time times[2];
    bl_time_by_turns(works, 2, rounds, turn, times);
    judge(result, times, (double)work.count);
    free(room);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(cost) = {
    .name = "cost",
    .title = "cost",
    .entry = "time a sample of a row; not judged",
    .question = "What does a sample cost on this machine?",
    .measure = measure,
};
