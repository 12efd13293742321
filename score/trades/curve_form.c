// SPDX-License-Identifier: MIT
//
// curve-form: a power against Schlick's ratio of two lines, for the primitives with the key form.
//
// Error: the difference from the power over the unit interval. The time is that of the primitive as
// a signal, which shares a few nanoseconds of arguments and averaging with any other.
//
// Source: peachey2003, pp. 38-39; schlick1994.
#include "core/setting.h"
#include "score/trade_signals.h"

#include <string.h>

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    const char *const *words = subject ? bl_signal_choices(subject, "form") : NULL;
    int both = 0;
    for (; words && *words; words++)
        both += strcmp(*words, "power") == 0 || strcmp(*words, "schlick") == 0;
    return both == 2;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    static const char *const forms[] = {"power", "schlick"};
    bl_signal *signal;
    bl_status status = bl_signal_with_setting(subject, "form", "power", &signal, message);
    if (status != BL_OK)
        return status;
    status = bl_trade_places_make(signal, 0, 1, settings, alternatives, message);
    bl_signal_free(signal);
    if (status == BL_OK) // errors of a curve are of its range, which is 1
        ((bl_trade_places *)alternatives->own)->deviation = 1;
    for (size_t i = 0; i < 2 && status == BL_OK; i++) {
        status = bl_signal_with_setting(subject, "form", forms[i], &signal, message);
        if (status == BL_OK)
            status = bl_trade_add_signal(alternatives, forms[i], signal, NULL, message);
        if (status == BL_OK)
            bl_trade_compare(&alternatives->list[i], NULL);
    }
    return status;
}

BL_TRADE_DESCRIPTOR(curve_form) = {
    .name = "curve-form",
    .title = "power against Schlick's form",
    .question = "What does a curve without a power save, and how far off is it?",
    .paper = "peachey2003, pp. 38-39",
    .error_name = "rms difference from the power over [0, 1]",
    .error_unit = "of the range",
    .sample = "a value",
    .subject = "bias",
    .applies = applies,
    .open = open,
    .close = bl_trade_close_signals};
