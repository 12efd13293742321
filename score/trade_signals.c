// SPDX-License-Identifier: MIT
#include "score/trade_signals.h"

#include <math.h>
#include <stdlib.h>

#include "core/random.h"

static bl_status out_of_memory(bl_message *message) {
    return bl_report(message, BL_DEVICE, "out of memory for a trade");
}

static void free_places(bl_trade_places *places) {
    for (int a = 0; places && a < BL_AXES; a++)
        free(places->at[a]);
    if (places)
        free(places->reference);
    free(places);
}

static bl_trade_places *allocate_places(size_t count) {
    bl_trade_places *places = calloc(1, sizeof *places);
    int whole = places != NULL;
    for (int a = 0; whole && a < BL_AXES; a++)
        whole = (places->at[a] = malloc(count * sizeof(double))) != NULL;
    if (whole)
        whole = (places->reference = malloc(count * sizeof(double))) != NULL;
    if (whole) {
        places->count = count;
        return places;
    }
    free_places(places);
    return NULL;
}

bl_status bl_trade_places_make(const bl_signal *truth, double from, double to,
                               const bl_trade_settings *settings, bl_alternatives *alternatives,
                               bl_message *message) {
    static const size_t counts[] = {4096, 16384, 65536};
    bl_trade_places *places = allocate_places(counts[settings->size]);
    bl_random random = bl_random_seed(settings->seed, 0);
    bl_moments moments = {0};
    if (!places)
        return out_of_memory(message);
    alternatives->own = places;
    for (size_t i = 0; i < places->count; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = places->at[a][i] = from + (to - from) * bl_random_unit(&random);
        places->reference[i] = bl_signal_value(truth, at);
        bl_moments_add(&moments, places->reference[i]);
    }
    double variance = truth->facts.variance;
    places->deviation = sqrt(isfinite(variance) ? variance : bl_moments_variance(&moments));
    if (places->deviation > 0 && isfinite(places->deviation) && isfinite(moments.mean))
        return BL_OK;
    return bl_report(message, BL_MISMATCH,
                     "'%s' is constant or not finite in [%g, %g]: there is nothing to trade",
                     truth->text, from, to);
}

static void fill_points(bl_trade_timed *timed, size_t first, size_t count) {
    const double *at[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        at[a] = timed->places->at[a] + first;
    bl_signal_points(timed->signal, at, count, timed->out);
}

static void work_points(void *state, size_t count) {
    fill_points(state, 0, count);
}

void bl_trade_fill_double(bl_trade_timed *timed, size_t first, size_t count) {
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = timed->places->at[a][first + i];
        timed->out[i] = (float)bl_signal_value(timed->signal, at);
    }
}

void bl_trade_work_double(void *state, size_t count) {
    bl_trade_fill_double(state, 0, count);
}

bl_status bl_trade_add_signal(bl_alternatives *alternatives, const char *name, bl_signal *signal,
                              void (*work)(void *state, size_t count), bl_message *message) {
    bl_trade_timed *timed = calloc(1, sizeof *timed);
    bl_alternative *added = timed ? bl_alternatives_add(alternatives, name) : NULL;
    if (!added) {
        free(timed);
        bl_signal_free(signal);
        return out_of_memory(message);
    }
    timed->places = alternatives->own;
    timed->signal = signal;
    added->state = timed;
    added->work = work ? work : work_points;
    added->batch = BL_TRADE_BATCH;
    return BL_OK;
}

bl_estimate bl_root_estimate(bl_estimate square) {
    square.value = sqrt(fmax(0, square.value));
    square.lower = sqrt(fmax(0, square.lower));
    square.upper = sqrt(fmax(0, square.upper));
    return square;
}

void bl_trade_compare(bl_alternative *alternative, bl_trade_fill fill) {
    bl_trade_timed *timed = alternative->state;
    const bl_trade_places *places = timed->places;
    double *square = malloc(places->count * sizeof *square);
    alternative->error = (bl_estimate){NAN, NAN, NAN, 0.95, 0};
    alternative->largest = 0;
    for (size_t first = 0; square && first < places->count; first += BL_TRADE_BATCH) {
        (fill ? fill : fill_points)(timed, first, BL_TRADE_BATCH);
        for (size_t i = 0; i < BL_TRADE_BATCH; i++) {
            double error =
                fabs((double)timed->out[i] - places->reference[first + i]) / places->deviation;
            square[first + i] = error * error;
            alternative->largest = fmax(alternative->largest, error);
        }
    }
    if (square)
        alternative->error = bl_root_estimate(bl_mean_estimate(square, places->count, 0.95));
    free(square);
}

void bl_trade_close_signals(bl_alternatives *alternatives) {
    for (size_t i = 0; i < alternatives->count; i++) {
        bl_trade_timed *timed = alternatives->list[i].state;
        if (timed)
            bl_signal_free(timed->signal);
        free(timed);
    }
    free_places(alternatives->own);
}
