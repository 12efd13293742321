// SPDX-License-Identifier: MIT
//
// The benchmark of the noises: rows along each axis and scattered points, against plain loops
// (the textbook's, or for other settings than the default the reference) at the same places, and
// the error of the very loops that were timed.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "score/bench.h"
#include "core/random.h"
#include "noises/textbook.h"

enum { SAMPLES = 4096, ERROR_SAMPLES = 512 };

// One loop at its places. A row has start and step; points have lists.
typedef struct loop_work {
    const bl_signal *signal;
    double start[BL_AXES], step[BL_AXES];
    const double *at[BL_AXES]; // NULL in a row
    size_t count;
    float *out;
} loop_work;

static void run_loop(void *user) {
    loop_work *work = user;
    if (work->at[0])
        bl_signal_points(work->signal, work->at, work->count, work->out);
    else
        bl_signal_row(work->signal, work->start, work->step, work->count, work->out);
}

void bl_textbook_run(void *user) {
    bl_textbook_work *work = user;
    for (size_t i = 0; i < work->count && work->textbook; i++)
        work->out[i] = work->textbook(work->at[0][i], work->at[1][i], work->at[2][i]);
    for (size_t i = 0; i < work->count && !work->textbook; i++) {
        const double at[BL_AXES] = {work->at[0][i], work->at[1][i], work->at[2][i], work->at[3][i]};
        work->out[i] = (float)bl_signal_value(work->signal, at);
    }
}

// The memory of one row of the benchmark; too large for a stack.
typedef struct bench_places {
    double at[BL_AXES][BL_SCATTERED];
    float at_float[BL_AXES][BL_SCATTERED];
    float out[BL_SCATTERED], textbook_out[BL_SCATTERED];
} bench_places;

// The place of sample i, as the contract of a row states it.
static double place_of(const loop_work *work, size_t i, int axis) {
    return work->at[0] ? work->at[axis][i] : work->start[axis] + (double)i * work->step[axis];
}

// The largest error of the loop where it is, and moved to other parts of space.
static double loop_error(const loop_work *work) {
    static const double bases[] = {0, 1e6, 1e9};
    static float out[ERROR_SAMPLES];
    static double moved[BL_AXES][ERROR_SAMPLES];
    double worst = 0;
    for (size_t b = 0; b < sizeof bases / sizeof *bases; b++) {
        loop_work here = *work;
        here.count = ERROR_SAMPLES;
        here.out = out;
        for (int a = 0; a < BL_AXES; a++) {
            here.start[a] += bases[b];
            for (size_t i = 0; work->at[0] && i < ERROR_SAMPLES; i++)
                moved[a][i] = work->at[a][i] + bases[b];
            here.at[a] = work->at[0] ? moved[a] : NULL;
        }
        run_loop(&here);
        for (size_t i = 0; i < ERROR_SAMPLES; i++) {
            double at[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                at[a] = place_of(&here, i, a);
            double error = fabs((double)out[i] - bl_signal_value(work->signal, at));
            worst = error <= worst ? worst : error; // keeps NaN
        }
    }
    return worst;
}

// Times one loop, by turns with the plain loop.
static int time_row(bl_bench *bench, bench_places *places, loop_work *work,
                    float (*textbook)(float, float, float), bl_bench_row *row) {
    for (size_t i = 0; i < work->count; i++)
        for (int a = 0; a < BL_AXES; a++)
            places->at_float[a][i] = (float)place_of(work, i, a);
    bl_textbook_work plain = {
        .textbook = textbook,
        .signal = work->signal,
        .at = {places->at_float[0], places->at_float[1], places->at_float[2], places->at_float[3]},
        .count = work->count,
        .out = places->textbook_out};
    const bl_work works[] = {{run_loop, work, NULL}, {bl_textbook_run, &plain, NULL}};
    bl_time times[2] = {{.minimum = 0}, {.minimum = NAN, .median = NAN, .worst_block = NAN}};
    bl_bench_step(bench, "%s %s %s", row->signal, row->path, row->axis ? row->axis : "");
    row->against = textbook ? "textbook" : "reference";
    bl_time_by_turns(works, 2, bench->rounds, bench->turn_seconds, times);
    row->candidate = times[0];
    row->yardstick = times[1];
    row->samples = work->count;
    row->max_error = loop_error(work);
    return bl_bench_add(bench, row);
}

static int time_along_axes(bl_bench *bench, bench_places *places, const bl_signal *signal,
                           float (*textbook)(float, float, float), bl_bench_row row) {
    static const struct {
        const char *path;
        double samples_per_cell;
    } paths[] = {{"row-20", 20}, {"row-2", 2}};
    static const char *const axes[] = {"x", "y", "z", "w"};
    for (size_t p = 0; p < sizeof paths / sizeof *paths; p++)
        for (unsigned a = 0; a < signal->dimensions; a++) {
            loop_work work = {.signal = signal,
                              .start = {0.37, 0.61, 0.83, 0.29},
                              .count = SAMPLES,
                              .out = places->out};
            row.path = paths[p].path;
            row.axis = axes[a];
            row.samples_per_cell = paths[p].samples_per_cell;
            work.step[a] = 1 / row.samples_per_cell;
            if (!time_row(bench, places, &work, textbook, &row))
                return 0;
        }
    return 1;
}

void bl_bench_scatter(int axes, double (*at)[BL_SCATTERED]) {
    bl_random random = bl_random_seed(1, 0);
    for (int a = 0; a < axes; a++)
        for (size_t i = 0; i < BL_SCATTERED; i++)
            at[a][i] = BL_SCATTER_CUBE * (bl_random_unit(&random) - 0.5);
}

static int time_scattered(bl_bench *bench, bench_places *places, const bl_signal *signal,
                          float (*textbook)(float, float, float), bl_bench_row row) {
    loop_work work = {.signal = signal, .count = BL_SCATTERED, .out = places->out};
    bl_bench_scatter(BL_AXES, places->at);
    for (int a = 0; a < BL_AXES; a++)
        work.at[a] = places->at[a];
    row.path = "points";
    row.samples_per_cell = BL_SCATTERED / pow(BL_SCATTER_CUBE, signal->dimensions);
    return time_row(bench, places, &work, textbook, &row);
}

bl_status bl_bench_noise(bl_bench *bench, const char *text, bl_isa isa, bl_message *message) {
    static bench_places places;
    bl_signal *signal;
    bl_status status = bl_noise_open(text, isa, &signal, message);
    if (status != BL_OK)
        return status;
    // The textbook's loop has the default settings, so it is no yardstick for others.
    const bl_noise *noise = bl_noise_find(signal->name, isa);
    float (*textbook)(float, float, float) =
        strcmp(text, noise->name) == 0 ? noise->textbook : NULL;
    bl_bench_row row = {.isa = bl_isa_name(isa), .floor = NAN};
    snprintf(row.signal, sizeof row.signal, "%s", text);
    bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE));
    if (!time_along_axes(bench, &places, signal, textbook, row) ||
        !time_scattered(bench, &places, signal, textbook, row))
        status = bl_report(message, BL_DEVICE, "out of memory");
    bl_signal_free(signal);
    return status;
}
