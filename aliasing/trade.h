// SPDX-License-Identifier: MIT
//
// Cost against error: the contract of a trade, and the registry of all trades.
//
// A trade is one file in aliasing/trades/, which ends with one descriptor, and one line in
// trades.def. It knows the alternatives for one choice (the kernel table of a convolution, the
// precision of a noise, the filter of a texture, the samples of an estimate), and gives each one's
// error against the best that can be had, and a function that the harness times: all alternatives
// interleaved, repeated until the spread is known (core/clock.h).
#ifndef BL_ALIASING_TRADE_H
#define BL_ALIASING_TRADE_H

#include "core/definition.h"
#include "core/statistics.h"

typedef struct bl_trade_settings {
    uint64_t seed;
    int threads;
    int size;         // 0 quick, 1 normal, 2 full
    const char *view; // of textures; NULL: the trade's own
} bl_trade_settings;

// One way to do it.
typedef struct bl_alternative {
    char *name;                              // "table:100"; owned
    bl_estimate error;                       // in the unit of the trade; 0: exact
    void (*work)(void *state, size_t count); // does it `count` times, to be timed
    void *state;                             // owned by the trade's `close`
    // Filled by the harness, in nanoseconds a sample:
    double ns, ns_lowest, ns_highest;
    int front; // no other is both cheaper and better
} bl_alternative;

typedef struct bl_alternatives {
    bl_alternative *list; // owned
    size_t count;
    void *own; // of the trade
} bl_alternatives;

typedef struct bl_trade {
    const char *name; // "kernel-table"
    const char *title, *question, *paper;
    const char *error_name; // "rms error against the exact kernel"
    const char *error_unit; // "of the standard deviation"
    // Whether the choice exists for this subject: a signal, or NULL with a bare word as "spectrum".
    int (*applies)(const bl_signal *subject, const char *word);
    bl_status (*open)(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message);
    void (*close)(bl_alternatives *alternatives);
} bl_trade;

size_t bl_trade_count(void);
const bl_trade *bl_trade_at(size_t index);       // NULL past the end
const bl_trade *bl_trade_find(const char *name); // NULL for an unknown name

// Opens the alternatives, times them and marks the front; the caller ends with bl_trade_close.
bl_status bl_trade_run(const bl_trade *trade, const bl_signal *subject,
                       const bl_trade_settings *settings, bl_alternatives *alternatives,
                       bl_message *message);
void bl_trade_close(const bl_trade *trade, bl_alternatives *alternatives);

#define BL_TRADE_DESCRIPTOR(stem)                                                                  \
    extern const bl_trade bl_trade_##stem;                                                         \
    const bl_trade bl_trade_##stem

#endif
