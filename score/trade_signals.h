// SPDX-License-Identifier: MIT
//
// What the trades share whose alternatives are signals: places, references in double at them, the
// error of each alternative there, and its timing at scattered points.
#ifndef BL_SCORE_TRADE_SIGNALS_H
#define BL_SCORE_TRADE_SIGNALS_H

#include "score/trade.h"

enum { BL_TRADE_BATCH = 1024 }; // points that are timed together

// Scattered points, uniform in [from, to) along each axis.
typedef struct bl_trade_places {
    size_t count;        // at least BL_TRADE_BATCH
    double *at[BL_AXES]; // owned
    double *reference;   // the value of `truth` there, in double; owned
    double deviation;    // standard deviation of the truth: as stated, else of the reference
} bl_trade_places;

// One alternative: how it is evaluated at points, for its error and for the clock alike.
typedef struct bl_trade_timed {
    const bl_trade_places *places;
    bl_signal *signal; // owned
    unsigned bits;     // of fixed point, for a trade that has it
    float out[BL_TRADE_BATCH];
} bl_trade_timed;

// Fills `timed->out` with the values at `count` (at most BL_TRADE_BATCH) places from `first` on.
typedef void (*bl_trade_fill)(bl_trade_timed *timed, size_t first, size_t count);

// 4096, 16384 or 65536 places by the size of the settings, with the values of the truth. It becomes
// alternatives->own. Errors: BL_DEVICE out of memory; BL_MISMATCH for values that are not finite or
// constant.
bl_status bl_trade_places_make(const bl_signal *truth, double from, double to,
                               const bl_trade_settings *settings, bl_alternatives *alternatives,
                               bl_message *message);

// Adds an alternative that reads this signal, which it owns from now on, also on failure; timed
// through `work`, or NULL: float values at points.
bl_status bl_trade_add_signal(bl_alternatives *alternatives, const char *name, bl_signal *signal,
                              void (*work)(void *state, size_t count), bl_message *message);

// The reference in double instead: what to fill and to time with, where an alternative has no float
// path, or for the sake of one that has none.
void bl_trade_fill_double(bl_trade_timed *timed, size_t first, size_t count);
void bl_trade_work_double(void *state, size_t count);

// The root mean square of the differences from the reference over all places, in standard
// deviations of the truth, and the largest; `fill` NULL: float values at points.
void bl_trade_compare(bl_alternative *alternative, bl_trade_fill fill);

// The root of an estimate of a mean square, limits and all.
bl_estimate bl_root_estimate(bl_estimate square);

// The `close` of a trade whose alternatives were all added so.
void bl_trade_close_signals(bl_alternatives *alternatives);

#endif
