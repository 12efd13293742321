// SPDX-License-Identifier: MIT
//
// What main and the verbs share: opening signals, threads, progress, verdict words.
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/plain.h"
#include "cli/verb.h"
#include "core/grammar.h"
#include "core/grid.h"
#include "sources/source.h"

// Keeps a copy of a signal whose source may fail, to ask for its complaint when the verb is done
// with the signal itself.
static bl_status watch(bl_call *call, bl_signal **signal) {
    if (!(*signal)->functions->complaint)
        return BL_OK;
    bl_signal **more = realloc(call->watched, (call->watched_count + 1) * sizeof *more);
    bl_signal *copy = more ? bl_signal_copy(*signal) : NULL;
    if (more)
        call->watched = more;
    if (copy) {
        call->watched[call->watched_count++] = copy;
        return BL_OK;
    }
    bl_signal_free(*signal);
    *signal = NULL;
    return bl_report(&call->message, BL_DEVICE, "out of memory");
}

bl_status bl_call_open(bl_call *call, const char *text, bl_signal **signal) {
    bl_status status = bl_source_open(text, call->isa, signal, &call->message);
    return status == BL_OK ? watch(call, signal) : status;
}

// A failure goes before what the verb found; a value that is no number explains it.
bl_status bl_call_complaints(bl_call *call, bl_status status) {
    for (size_t i = 0; i < call->watched_count; i++) {
        bl_message complaint, own = call->message;
        bl_status fault = bl_signal_complaint(call->watched[i], &complaint);
        if (fault == BL_DEVICE) {
            call->message = complaint;
            return fault;
        }
        if (fault == BL_MISMATCH && status == BL_MISMATCH)
            bl_report(&call->message, status, "%.480s; %.500s", own.text, complaint.text);
    }
    return status;
}

void bl_call_unwatch(bl_call *call) {
    for (size_t i = 0; i < call->watched_count; i++)
        bl_signal_free(call->watched[i]);
    free(call->watched);
    call->watched = NULL;
    call->watched_count = 0;
}

// The key that the noise of a signal takes its seed from.
static const char *seed_key(const bl_signal *signal) {
    const bl_noise *noise = bl_noise_find(signal->name, BL_ISA_BASELINE);
    const bl_parameter *parameter = noise ? noise->parameters : NULL;
    for (; parameter && parameter->key; parameter++)
        if (parameter->kind == BL_SEED && parameter->offset == signal->seed_offset)
            return parameter->key;
    return NULL;
}

// Refuses a text that names another seed than --seed does.
static bl_status check_seed(bl_call *call, const char *text, const char *key) {
    bl_spec spec;
    unsigned long long named;
    bl_status status = bl_spec_parse(text, &spec, &call->message);
    if (status != BL_OK)
        return status;
    for (size_t i = 0; i < spec.count; i++)
        if (strcmp(spec.settings[i].key, key) == 0 &&
            bl_read_unsigned(spec.settings[i].value, &named) && named != call->common.seed)
            status = bl_report(&call->message, BL_USAGE,
                               "--seed %s and %s=%s in '%s' contradict each other; leave one of "
                               "them out",
                               call->common.seed_word, key, spec.settings[i].value, text);
    bl_spec_free(&spec);
    return status;
}

// The canonical text of the signal lacks a seed that is the default, and those are refused above
// that differ; so whatever seed it has is the right one.
static bl_status open_with_seed(bl_call *call, const char *key, bl_signal **signal) {
    const char *text = (*signal)->text;
    char setting[64], *seeded = NULL;
    snprintf(setting, sizeof setting, "%s=", key);
    const char *after = strchr(text, ':');
    if (after && strstr(after, setting))
        return BL_OK;
    if (asprintf(&seeded, "%s%c%s%llu", text, after ? ',' : ':', setting,
                 (unsigned long long)call->common.seed) < 0)
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    bl_signal_free(*signal);
    *signal = NULL;
    bl_status status = bl_call_open(call, seeded, signal);
    free(seeded);
    return status;
}

bl_status bl_call_open_seeded(bl_call *call, bl_signal **signal) {
    const char *text = call->operands.words[0];
    *signal = NULL;
    if (call->common.seed_word && bl_source_is_file(text)) {
        bl_status seeded =
            bl_source_open_seeded(text, call->common.seed, call->isa, signal, &call->message);
        return seeded == BL_OK ? watch(call, signal) : seeded;
    }
    bl_status status = bl_call_open(call, text, signal);
    if (status != BL_OK || !call->common.seed_word)
        return status;
    const char *key = seed_key(*signal);
    if (!key)
        status =
            bl_report(&call->message, BL_MISMATCH, "--seed: '%s' has no seed; leave it out", text);
    if (status == BL_OK)
        status = check_seed(call, text, key);
    if (status == BL_OK)
        status = open_with_seed(call, key, signal);
    if (status != BL_OK) {
        bl_signal_free(*signal);
        *signal = NULL;
    }
    return status;
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
    char line[512];
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    bl_plain_text(stderr, line);
    fflush(stderr);
}

int bl_call_coloured(const bl_call *call) {
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    return !(no_color && *no_color) && term && strcmp(term, "dumb") != 0 && call->out == stdout &&
           isatty(STDOUT_FILENO);
}

const char *bl_call_verdict(const bl_call *call, bl_verdict verdict) {
    if (!bl_call_coloured(call))
        return bl_verdict_word(verdict);
    static const char *const coloured[] = {"\033[32mpass\033[0m", "\033[33minconclusive\033[0m",
                                           "\033[31mfail\033[0m", "not-run"};
    return coloured[verdict];
}
