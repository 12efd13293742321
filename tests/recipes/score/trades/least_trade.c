// SPDX-License-Identifier: MIT
//
// least-trade: float values of gradient noise against the reference in double.
#include <string.h>

#include "score/trade_signals.h"

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && strcmp(subject->name, "gnoise") == 0;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    bl_status status = bl_trade_places_make(subject, -8, 8, settings, alternatives, message);
    if (status == BL_OK)
        status = bl_trade_add_signal(alternatives, "float", bl_signal_copy(subject), NULL, message);
    if (status == BL_OK)
        bl_trade_compare(alternatives->list, NULL);
    return status;
}

BL_TRADE_DESCRIPTOR(least_trade) = {.name = "least-trade",
                                    .title = "float values",
                                    .question = "How far off are float values?",
                                    .paper = "bandlimit",
                                    .error_name = "rms error against the reference in double",
                                    .error_unit = "of the standard deviation",
                                    .sample = "a value at a scattered point",
                                    .subject = "gnoise",
                                    .applies = applies,
                                    .open = open,
                                    .close = bl_trade_close_signals};
