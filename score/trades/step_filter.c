// SPDX-License-Identifier: MIT
//
// step-filter: the kernel that filters a step.
//
// A step has the spectrum 1 / (2 pi f), so filtered by a kernel of the response H, for samples one
// width apart, it has beyond the Nyquist frequency of 1/2 the energy
//
//   2 int_{1/2}^inf |H(f)|^2 / (2 pi f)^2 df,   1/pi^2 with no filter at all
//
// which folds back into the samples. Error: its share of that of the bare step. The integral is
// taken to f = 256 by 16 nodes in each of 8 pieces a cycle; what lies beyond is at most the largest
// |H|^2 of the last 8 cycles times 1 / (2 pi^2 256), for the responses that fall, as all of the
// registry do, and is the width of the interval.
//
// Leak is not all: the ideal filter has none, and rings.
//
// Source: peachey2003, pp. 64-66.
#include "score/trade.h"
#include "core/quadrature.h"
#include "core/random.h"
#include "filters/filter.h"
#include "filters/primitive.h"

#include <math.h>
#include <stdlib.h>

enum { BATCH = 256, CYCLES = 256, PIECES = 8, LAST = 8 };

typedef struct step_work {
    const bl_filter *filter; // NULL: none
    double sum;              // so that the values are computed
    double place[BATCH];     // widths
} step_work;

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && subject->definition && subject->definition == bl_primitive_find("step");
}

static void work(void *state, size_t count) {
    step_work *work = state;
    double sum = 0;
    if (work->filter)
        for (size_t i = 0; i < count; i++)
            sum += work->filter->step(work->place[i]);
    else
        for (size_t i = 0; i < count; i++)
            sum += work->place[i] >= 0 ? 1 : 0;
    *(volatile double *)&work->sum = sum;
}

static double density(const bl_filter *filter, double f, double *largest) {
    double h = filter->response(f), square = h * h;
    if (f > CYCLES - LAST)
        *largest = fmax(*largest, square);
    return square / (4 * M_PI * M_PI * f * f);
}

static bl_estimate leak_of(const bl_filter *filter) {
    const double half = 0.5 / PIECES, bare = 1 / (M_PI * M_PI);
    double sum = 0, largest = 0;
    for (int piece = PIECES / 2; piece < CYCLES * PIECES; piece++)
        for (int i = 0; i < BL_QUADRATURE_NODES; i++)
            sum += bl_quadrature_weight[i] *
                   density(filter, (2 * piece + 1 + bl_quadrature_node[i]) * half, &largest);
    double beyond = largest / (2 * M_PI * M_PI * CYCLES);
    return (bl_estimate){.value = 2 * half * sum / bare,
                         .lower = 2 * half * sum / bare,
                         .upper = (2 * half * sum + beyond) / bare,
                         .level = 1,
                         .samples = (CYCLES * PIECES - PIECES / 2) * BL_QUADRATURE_NODES};
}

// Places within two widths of the step, where filtered steps have work to do.
static bl_status add(const char *name, const bl_filter *filter, uint64_t seed,
                     bl_alternatives *alternatives, bl_message *message) {
    bl_random random = bl_random_seed(seed, 0);
    step_work *state = calloc(1, sizeof *state);
    bl_alternative *added = state ? bl_alternatives_add(alternatives, name) : NULL;
    if (!added) {
        free(state);
        return bl_report(message, BL_DEVICE, "out of memory for a trade");
    }
    state->filter = filter;
    for (size_t i = 0; i < BATCH; i++)
        state->place[i] = 4 * bl_random_unit(&random) - 2;
    added->state = state;
    added->work = work;
    added->batch = BATCH;
    added->error = filter ? leak_of(filter) : (bl_estimate){1, 1, 1, 1, 1};
    return BL_OK;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    (void)subject;
    bl_status status = add("none", NULL, settings->seed, alternatives, message);
    for (size_t i = 0; i < bl_filter_count() && status == BL_OK; i++)
        status = add(bl_filter_at(i)->name, bl_filter_at(i), settings->seed, alternatives, message);
    return status;
}

static void close_steps(bl_alternatives *alternatives) {
    for (size_t i = 0; i < alternatives->count; i++)
        free(alternatives->list[i].state);
}

BL_TRADE_DESCRIPTOR(step_filter) = {
    .name = "step-filter",
    .title = "kernel of a filtered step",
    .question = "How much of a step's alias does each kernel leave?",
    .paper = "peachey2003, pp. 64-66",
    .error_name = "energy beyond the Nyquist frequency",
    .error_unit = "of the bare step's",
    .sample = "a value within two widths of the step",
    .subject = "step",
    .applies = applies,
    .open = open,
    .close = close_steps};
