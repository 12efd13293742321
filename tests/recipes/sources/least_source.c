// SPDX-License-Identifier: MIT
//
// least: `ramp:`, whose value is x.
#include <math.h>
#include <string.h>

#include "sources/kind.h"

static int takes(const char *text) {
    return strcmp(text, "ramp:") == 0;
}

static double value(const void *block, const double at[BL_AXES]) {
    (void)block;
    return bl_source_in_range(at, 1) ? at[0] : NAN;
}

static const bl_signal_functions functions = {.value = value};

static bl_status open(const char *text, bl_signal **signal, bl_message *message) {
    *signal = bl_signal_new(&functions, "", 1, text);
    if (!*signal)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    (*signal)->name = "ramp";
    (*signal)->dimensions = 1;
    return BL_OK;
}

static const bl_parameter parameters[] = {{.key = NULL}};

BL_SOURCE_DESCRIPTOR(least_source) = {.name = "ramp",
                                      .title = "a ramp",
                                      .summary = "The value is x.",
                                      .paper = "bandlimit",
                                      .kind = "ramp",
                                      .form = "ramp:",
                                      .example = "ramp:",
                                      .parameters = parameters,
                                      .takes = takes,
                                      .open = open};
