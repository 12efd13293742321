// SPDX-License-Identifier: MIT
//
// impulses: how many impulses a cell, for the noises with the key impulses.
//
// The spectrum of such a noise is that of its kernel for any density (Campbell's theorem); what
// more impulses buy is a distribution nearer to its limit, the normal one. Error: the size of the
// excess kurtosis, 0 for the normal; for impulses at independent places it falls exactly as 1/N.
// It is the mean of (value / sigma)^4 - 3 over fresh seeds, with the variance that the noise
// states; the interval is Student's, of the means of the seeds.
//
// Source: peachey2003, p. 81; lewis1989.
#include "core/setting.h"
#include "score/trade_signals.h"
#include "core/hash.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && bl_signal_parameter(subject, "impulses") && subject->facts.variance > 0 &&
           subject->facts.mean == 0 && subject->seed_offset != SIZE_MAX;
}

// The mean of the fourth power over the places, for one fresh seed.
static double fourth_moment(bl_trade_timed *timed, const bl_signal *fresh) {
    const double *at[BL_AXES];
    double sum = 0, variance = fresh->facts.variance;
    for (int a = 0; a < BL_AXES; a++)
        at[a] = timed->places->at[a];
    bl_signal_points(fresh, at, BL_TRADE_BATCH, timed->out);
    for (size_t i = 0; i < BL_TRADE_BATCH; i++) {
        double square = (double)timed->out[i] * (double)timed->out[i] / variance;
        sum += square * square;
    }
    return sum / BL_TRADE_BATCH;
}

// |kurtosis - 3|, with limits that end at 0 if the interval holds it.
static bl_estimate size_of(bl_estimate excess) {
    bl_estimate size = excess;
    size.value = fabs(excess.value);
    size.lower = excess.lower > 0 ? excess.lower : excess.upper < 0 ? -excess.upper : 0;
    size.upper = fmax(fabs(excess.lower), fabs(excess.upper));
    return size;
}

static bl_status measure(bl_alternative *alternative, const bl_trade_settings *settings,
                         bl_message *message) {
    static const size_t seeds[] = {64, 256, 2048};
    bl_trade_timed *timed = alternative->state;
    double *excess = malloc(seeds[settings->size] * sizeof *excess);
    if (!excess)
        return bl_report(message, BL_DEVICE, "out of memory for a trade");
    for (size_t s = 0; s < seeds[settings->size]; s++) {
        bl_signal *fresh = bl_signal_reseed(timed->signal, bl_stream(settings->seed, s));
        excess[s] = fourth_moment(timed, fresh ? fresh : timed->signal) - 3;
        bl_signal_free(fresh);
    }
    alternative->error = size_of(bl_mean_estimate(excess, seeds[settings->size], 0.95));
    free(excess);
    return BL_OK;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    static const unsigned counts[] = {1, 2, 3, 5, 8, 16, 32, 64};
    const bl_parameter *impulses = bl_signal_parameter(subject, "impulses");
    bl_status status = bl_trade_places_make(subject, -1024, 1024, settings, alternatives, message);
    for (size_t i = 0; i < sizeof counts / sizeof *counts && status == BL_OK; i++) {
        bl_signal *signal;
        char word[16];
        if (counts[i] < impulses->minimum || counts[i] > impulses->maximum)
            continue;
        snprintf(word, sizeof word, "%u", counts[i]);
        status = bl_signal_with_setting(subject, "impulses", word, &signal, message);
        if (status == BL_OK)
            status = bl_trade_add_signal(alternatives, word, signal, NULL, message);
        if (status == BL_OK)
            status = measure(&alternatives->list[alternatives->count - 1], settings, message);
    }
    return status;
}

BL_TRADE_DESCRIPTOR(impulses) = {
    .name = "impulses",
    .title = "number of impulses",
    .question = "How many impulses a cell until the values are normal?",
    .paper = "peachey2003, p. 81",
    .error_name = "excess kurtosis, its size",
    .error_unit = "0 for the normal limit",
    .sample = "a value at a scattered point",
    .subject = "scnoise",
    .applies = applies,
    .open = open,
    .close = bl_trade_close_signals};
