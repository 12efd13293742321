// SPDX-License-Identifier: MIT
//
// octaves: how many octaves of a sum are kept, the others left out.
//
// Error: the share of the variance that is lost, var(full - kept) / var(full), over random places
// and fresh seeds; the interval is that of a ratio of sums over seeds. A constant that leaving out
// an octave of sizes takes away is no part of it.
//
// Source: peachey2003, p. 83, and its section Clamping.
#include "core/setting.h"
#include "score/trade_signals.h"
#include "core/hash.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "noises/octaves/octaves.h"

enum { SEEDS_MOST = 256 };

static const bl_octaves_plan *plan_of(const bl_signal *subject) {
    return &((const bl_octaves_settings *)subject->parameters)->octaves->plan;
}

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && bl_octaves_is_sum(subject) && plan_of(subject)->count > 1 &&
           (bl_signal_parameter(subject, "octaves") || bl_signal_parameter(subject, "max"));
}

// The sum of the first `count` octaves. Octaves of the keys min and max lie below max, which is put
// between the last that is kept and the next.
static bl_status keep(const bl_signal *subject, unsigned count, bl_signal **kept,
                      bl_message *message) {
    char value[32];
    if (bl_signal_parameter(subject, "octaves")) {
        snprintf(value, sizeof value, "%u", count);
        return bl_signal_with_setting(subject, "octaves", value, kept, message);
    }
    snprintf(value, sizeof value, "%.17g", 1.5 * plan_of(subject)->frequency[count - 1]);
    return bl_signal_with_setting(subject, "max", value, kept, message);
}

// Sums over the places of one seed, the mean of the difference removed.
static void compare_seed(const bl_trade_places *places, const bl_signal *full,
                         const bl_signal *kept, double *lost, double *whole) {
    float values[2][BL_TRADE_BATCH];
    const double *at[BL_AXES];
    bl_moments difference = {0}, all = {0};
    for (int a = 0; a < BL_AXES; a++)
        at[a] = places->at[a];
    bl_signal_points(full, at, BL_TRADE_BATCH, values[0]);
    bl_signal_points(kept, at, BL_TRADE_BATCH, values[1]);
    for (size_t i = 0; i < BL_TRADE_BATCH; i++) {
        bl_moments_add(&difference, (double)values[0][i] - (double)values[1][i]);
        bl_moments_add(&all, (double)values[0][i]);
    }
    *lost = difference.m2;
    *whole = all.m2;
}

static bl_status measure(const bl_signal *subject, bl_alternative *alternative,
                         const bl_trade_settings *settings, bl_message *message) {
    static const size_t seeds[] = {8, 32, SEEDS_MOST};
    const bl_trade_timed *timed = alternative->state;
    double lost[SEEDS_MOST], whole[SEEDS_MOST];
    for (size_t s = 0; s < seeds[settings->size]; s++) {
        uint64_t seed = bl_stream(settings->seed, s);
        bl_signal *full = bl_signal_reseed(subject, seed);
        bl_signal *kept = bl_signal_reseed(timed->signal, seed);
        int whole_pair = full && kept;
        if (whole_pair)
            compare_seed(timed->places, full, kept, &lost[s], &whole[s]);
        bl_signal_free(full);
        bl_signal_free(kept);
        if (!whole_pair)
            return bl_report(message, BL_DEVICE, "out of memory for a trade");
    }
    bl_estimate share = bl_ratio_estimate(lost, whole, seeds[settings->size], 0.95);
    share.lower = fmax(0, share.lower);
    alternative->error = share;
    return BL_OK;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    unsigned count = plan_of(subject)->count;
    bl_status status = bl_trade_places_make(subject, -64, 64, settings, alternatives, message);
    for (unsigned kept = 1; kept <= count && status == BL_OK; kept++) {
        bl_signal *signal;
        char name[32];
        snprintf(name, sizeof name, "%u", kept);
        status = keep(subject, kept, &signal, message);
        if (status == BL_OK)
            status = bl_trade_add_signal(alternatives, name, signal, NULL, message);
        if (status == BL_OK)
            status =
                measure(subject, &alternatives->list[alternatives->count - 1], settings, message);
    }
    return status;
}

BL_TRADE_DESCRIPTOR(octaves) = {.name = "octaves",
                                .title = "octaves kept",
                                .question = "What does a sum lose with its finest octaves?",
                                .paper = "peachey2003, p. 83",
                                .error_name = "variance lost",
                                .error_unit = "of the variance",
                                .sample = "a value at a scattered point",
                                .subject = "fractalsum",
                                .applies = applies,
                                .open = open,
                                .close = bl_trade_close_signals};
