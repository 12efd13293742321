// SPDX-License-Identifier: MIT
//
// What main and the verbs share: opening signals, threads, progress, verdict words.
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/verb.h"
#include "core/grid.h"
#include "reports/source.h"

bl_status bl_call_open(bl_call *call, const char *text, bl_signal **signal) {
    return bl_source_open(text, call->isa, signal, &call->message);
}

bl_status bl_call_seed_signal(bl_call *call, bl_signal **signal) {
    if (!call->common.seed_word)
        return BL_OK;
    bl_signal *seeded = bl_signal_reseed(*signal, call->common.seed);
    if (!seeded)
        return bl_report(&call->message, BL_MISMATCH, "--seed: '%s' has no seed; leave it out",
                         call->operands.words[0]);
    bl_signal_free(*signal);
    *signal = seeded;
    return BL_OK;
}

int bl_call_threads(const bl_call *call) {
    return bl_thread_count((int)call->common.threads);
}

void bl_progress(const bl_call *call, const char *format, ...) {
    const char *term = getenv("TERM");
    if (call->common.quiet || !isatty(STDERR_FILENO) || (term && strcmp(term, "dumb") == 0))
        return;
    fputs("\r\033[K", stderr); // to the first column, and clear the line
    if (!format)
        return;
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fflush(stderr);
}

const char *bl_call_verdict(const bl_call *call, bl_status status) {
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    if ((no_color && *no_color) || !term || strcmp(term, "dumb") == 0 || call->out != stdout ||
        !isatty(STDOUT_FILENO))
        return bl_status_word(status);
    switch (status) {
    case BL_OK:
        return "\033[32mpass\033[0m";
    case BL_INCONCLUSIVE:
        return "\033[33minconclusive\033[0m";
    case BL_FAIL:
        return "\033[31mfail\033[0m";
    default:
        return bl_status_word(status);
    }
}
