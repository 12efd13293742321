// SPDX-License-Identifier: MIT
//
// Cost against error: the contract of a trade, and the registry of all trades.
//
// A trade is one file in score/trades/, which ends with one descriptor, and one line in
// trades.def. It knows the alternatives for one choice (the kernel table of a convolution, the
// precision of a noise, the filter of a texture, the samples of an estimate), and gives each one's
// error against the best that can be had, and a function that the harness times: all alternatives
// interleaved, repeated until the spread is known (core/clock.h).
//
// Times are in nanoseconds a sample; each trade says what a sample is. 15 turns or more are taken,
// until half of them lie within a tenth of the median: the quarters between which they lie are then
// an interval of the median at 96 % or more, whatever the distribution (15 turns: 1 - 2 P(B(15,
// 1/2) <= 3)). A load that comes and goes widens it and leaves the order alone.
#ifndef BL_SCORE_TRADE_H
#define BL_SCORE_TRADE_H

#include "core/registry.h"
#include "core/definition.h"
#include "core/size.h"
#include "core/statistics.h"

typedef struct bl_trade_settings {
    uint64_t seed;
    int threads;
    bl_size size;
    const char *view; // of textures; NULL: the trade's own
} bl_trade_settings;

// One way to do it.
typedef struct bl_alternative {
    char *name;                              // "table:100"; owned
    bl_estimate error;                       // in the unit of the trade; 0: exact
    double largest;                          // the largest error seen; NAN: not looked for
    void (*work)(void *state, size_t count); // does `count` samples, to be timed; NULL: the trade
                                             // has filled the times itself
    void *state;                             // owned by the trade's `close`
    size_t batch;                            // samples a call; 0: 1
    // Filled by the harness, in nanoseconds a sample: the median and the quarters.
    double ns, ns_lowest, ns_highest;
    int front; // no other is at least as cheap and as good, and clearly cheaper or clearly better
} bl_alternative;

typedef struct bl_alternatives {
    bl_alternative *list; // owned
    size_t count;
    void *own; // of the trade
} bl_alternatives;

typedef struct bl_trade {
    BL_ENTRY(title, question);
    const char *error_name; // "rms error against the exact kernel"
    const char *error_unit; // "of the standard deviation"
    const char *sample;     // what is timed: "a value at a scattered point"
    const char *subject;    // one that has the choice: the text of a signal, or a bare word
    // Whether the choice exists for this subject: a signal, or NULL with a bare word as "spectrum".
    int (*applies)(const bl_signal *subject, const char *word);
    bl_status (*open)(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message);
    void (*close)(bl_alternatives *alternatives);
} bl_trade;

BL_REGISTRY(bl_trade, bl_trade, bl_trades)

// Opens the alternatives, times them and marks the front; the caller ends with bl_trade_close.
bl_status bl_trade_run(const bl_trade *trade, const bl_signal *subject,
                       const bl_trade_settings *settings, bl_alternatives *alternatives,
                       bl_message *message);
void bl_trade_close(const bl_trade *trade, bl_alternatives *alternatives);

// The two halves of the harness. Times those that have work, by turns of `turn_seconds`.
bl_status bl_alternatives_time(bl_alternatives *alternatives, double turn_seconds,
                               bl_message *message);
// Marks the front. b beats a if b's median time and b's error are no larger than a's, and either
// the intervals of the times or those of the errors are apart: so two that cannot be told apart
// both stay, and someone always does. One without a time or an error is not on it.
void bl_alternatives_mark(bl_alternatives *alternatives);

// For the `open` of trades: appends an alternative with a copy of the name, all else zero, and no
// largest error. NULL out of memory; it is valid until the next one is added.
bl_alternative *bl_alternatives_add(bl_alternatives *alternatives, const char *name);
// Frees the names and the list, not `own` nor the states.
void bl_alternatives_free(bl_alternatives *alternatives);

// Names the descriptor of a trade file: BL_TRADE_DESCRIPTOR(kernel_table) = {...};
#define BL_TRADE_DESCRIPTOR(stem)                                                                  \
    extern const bl_trade bl_trade_##stem;                                                         \
    const bl_trade bl_trade_##stem

#endif
