// SPDX-License-Identifier: MIT
//
// What main and the verbs share: opening signals, threads, progress, verdict words.
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/plain.h"
#include "cli/verb.h"
#include "core/file.h"
#include "core/grid.h"
#include "reports/table_json.h"
#include "sources/source.h"

// Whether a file can be written there, asked before an hour of measuring. It is made and removed;
// what is no plain file is never opened, as that may empty it or end what its reader reads.
bl_status bl_output_check(const char *path, bl_message *message) {
    struct stat own, target;
    int exists = lstat(path, &own) == 0;
    int folder = stat(path, &target) == 0 && S_ISDIR(target.st_mode);
    if (strcmp(path, "-") == 0)
        return BL_OK;
    if (exists && !S_ISREG(own.st_mode) && !folder) {
        if (access(path, W_OK) == 0 || errno == ENOENT) // a link to what is to be made
            return BL_OK;
        return bl_report(message, BL_DEVICE, "cannot write '%s': %s; check its permissions", path,
                         strerror(errno));
    }
    bl_file file;
    bl_status status = bl_file_create(path, &file, message);
    if (status == BL_OK)
        bl_file_discard(&file);
    return status;
}

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

bl_status bl_call_open_seeded(bl_call *call, bl_signal **signal) {
    const char *text = call->operands.words[0];
    *signal = NULL;
    if (!call->common.seed_word)
        return bl_call_open(call, text, signal);
    bl_status status =
        bl_source_open_seeded(text, call->common.seed, call->isa, signal, &call->message);
    return status == BL_OK ? watch(call, signal) : status;
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

void bl_call_may_warn(bl_call *call) {
    if (!call->warnings)
        call->warnings = json_array();
}

void bl_call_warn(bl_call *call, const char *format, ...) {
    char text[1024];
    va_list arguments;
    size_t index;
    json_t *said;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    bl_call_may_warn(call);
    json_array_foreach(call->warnings, index, said) {
        if (strcmp(json_string_value(said), text) == 0)
            return;
    }
    json_array_append_new(call->warnings, bl_json_text(text));
    if (call->is_hushed)
        return;
    bl_progress(call, NULL);
    fprintf(stderr, "bandlimit %s: warning: ", call->verb->name);
    bl_plain_text(stderr, text);
    fputc('\n', stderr);
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
