// SPDX-License-Identifier: MIT
//
// precision: float, double, and fixed point of 8 to 24 bits, for any noise of the library.
//
// fixed:B rounds each coordinate to B bits after the point, as a texture unit does with the place
// within a texel, and the value to 2^B levels between the noise's stated bounds. Its error has two
// parts: the slope of the noise times the rounding of the place, and that of the value; both fall
// as 2^-B, down to that of float. Its cost is that of doing so in software around the loops in
// float: graphics hardware has it for nothing. Places are within 64 units of the origin, where a
// coordinate in float would keep 17 bits after the point; the library's is a double at the door.
//
// Error: against the reference in double. Source: our own.
#include "score/trade_signals.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && subject->definition && subject->functions->points &&
           isfinite(subject->facts.lower) && subject->facts.upper > subject->facts.lower;
}

// Places are below 2^6 and bits at most 24, so the scaled numbers are below 2^30 and exact.
static void fill_fixed(bl_trade_timed *timed, size_t first, size_t count) {
    double at[BL_AXES][BL_TRADE_BATCH];
    const double *places[BL_AXES];
    const double scale = ldexp(1, (int)timed->bits), finest = 1 / scale;
    const double lower = timed->signal->facts.lower;
    const double step = (timed->signal->facts.upper - lower) / (scale - 1);
    for (int a = 0; a < BL_AXES; a++) {
        for (size_t i = 0; i < count; i++)
            at[a][i] = floor(timed->places->at[a][first + i] * scale + 0.5) * finest;
        places[a] = at[a];
    }
    bl_signal_points(timed->signal, places, count, timed->out);
    for (size_t i = 0; i < count; i++)
        timed->out[i] = (float)(floor(((double)timed->out[i] - lower) / step + 0.5) * step + lower);
}

static void work_fixed(void *state, size_t count) {
    fill_fixed(state, 0, count);
}

static bl_status add(const bl_signal *subject, const char *name, unsigned bits,
                     bl_alternatives *alternatives, bl_message *message) {
    bl_signal *copy = bl_signal_copy(subject);
    int is_double = strcmp(name, "double") == 0;
    if (!copy)
        return bl_report(message, BL_DEVICE, "out of memory, or '%s' cannot be copied",
                         subject->text);
    bl_status status = bl_trade_add_signal(alternatives, name, copy,
                                           bits        ? work_fixed
                                           : is_double ? bl_trade_work_double
                                                       : NULL,
                                           message);
    if (status != BL_OK)
        return status;
    bl_alternative *added = &alternatives->list[alternatives->count - 1];
    ((bl_trade_timed *)added->state)->bits = bits;
    if (is_double) {
        added->error = (bl_estimate){.level = 0.95};
        added->largest = 0;
    } else
        bl_trade_compare(added, bits ? fill_fixed : NULL);
    return BL_OK;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    static const unsigned bits[] = {8, 10, 12, 16, 20, 24};
    char name[16];
    bl_status status = bl_trade_places_make(subject, -64, 64, settings, alternatives, message);
    for (size_t i = 0; i < sizeof bits / sizeof *bits && status == BL_OK; i++) {
        snprintf(name, sizeof name, "fixed:%u", bits[i]);
        status = add(subject, name, bits[i], alternatives, message);
    }
    if (status == BL_OK)
        status = add(subject, "float", 0, alternatives, message);
    return status == BL_OK ? add(subject, "double", 0, alternatives, message) : status;
}

BL_TRADE_DESCRIPTOR(precision) = {.name = "precision",
                                  .title = "precision of the arithmetic",
                                  .question = "How many bits does a noise need?",
                                  .paper = "bandlimit",
                                  .error_name = "rms error against the reference in double",
                                  .error_unit = "standard deviations",
                                  .sample = "a value at a scattered point",
                                  .subject = "gnoise",
                                  .applies = applies,
                                  .open = open,
                                  .close = bl_trade_close_signals};
