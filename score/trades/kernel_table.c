// SPDX-License-Identifier: MIT
//
// kernel-table: a table of the radial kernel in squared distance, against the kernel itself, for
// the noises with the key kernel=exact|table:N.
//
// Error: of the values in float, against the exact kernel in double, at random places. That of the
// exact kernel is the rounding of floats. A table is read at the nearest entry of r^2, so its error
// falls as 1/N.
//
// A table jumps between its entries, so the library finds the entry in double; what it saves is
// seen beside the exact kernel in double, and the loops in float have no table.
//
// Source: peachey2003, p. 79.
#include "core/setting.h"
#include "score/trade_signals.h"

#include <stdio.h>
#include <string.h>

// Whether the key is a choice that has these words.
static int has_word(const bl_signal *subject, const char *key, const char *word) {
    const char *const *words = bl_signal_choices(subject, key);
    for (; words && *words; words++)
        if (strcmp(*words, word) == 0)
            return 1;
    return 0;
}

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && has_word(subject, "kernel", "table:N") &&
           has_word(subject, "kernel", "exact");
}

static bl_status add(const bl_signal *subject, const char *kernel, int in_double,
                     bl_alternatives *alternatives, bl_message *message) {
    bl_signal *signal;
    bl_status status = bl_signal_with_setting(subject, "kernel", kernel, &signal, message);
    if (status == BL_OK)
        status = bl_trade_add_signal(alternatives, in_double ? "exact (double)" : kernel, signal,
                                     in_double ? bl_trade_work_double : NULL, message);
    if (status == BL_OK)
        bl_trade_compare(&alternatives->list[alternatives->count - 1],
                         in_double ? bl_trade_fill_double : NULL);
    return status;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    static const unsigned entries[] = {4, 8, 16, 32, 64, 100, 256, 1024, 4096};
    const bl_parameter *kernel = bl_signal_parameter(subject, "kernel");
    bl_signal *truth;
    char word[32];
    bl_status status = bl_signal_with_setting(subject, "kernel", "exact", &truth, message);
    if (status != BL_OK)
        return status;
    status = bl_trade_places_make(truth, -64, 64, settings, alternatives, message);
    bl_signal_free(truth);
    for (size_t i = 0; i < sizeof entries / sizeof *entries && status == BL_OK; i++) {
        if (entries[i] < kernel->minimum || entries[i] > kernel->maximum)
            continue;
        snprintf(word, sizeof word, "table:%u", entries[i]);
        status = add(subject, word, 0, alternatives, message);
    }
    if (status == BL_OK)
        status = add(subject, "exact", 1, alternatives, message);
    return status == BL_OK ? add(subject, "exact", 0, alternatives, message) : status;
}

BL_TRADE_DESCRIPTOR(kernel_table) = {
    .name = "kernel-table",
    .title = "kernel table size",
    .question = "How many entries does the table of a radial kernel need?",
    .paper = "peachey2003, p. 79",
    .error_name = "rms error against the exact kernel",
    .error_unit = "standard deviations",
    .sample = "a value at a scattered point",
    .subject = "vcnoise",
    .applies = applies,
    .open = open,
    .close = bl_trade_close_signals};
