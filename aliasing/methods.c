// SPDX-License-Identifier: MIT
//
// The list of all methods of sampling, and the opening of one by its text.
#include "aliasing/method.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/setting.h"

#define BL_METHOD(stem) extern const bl_method_kind bl_method_##stem;
#include "aliasing/methods.def"
#undef BL_METHOD

static const void *const list[] = {
#define BL_METHOD(stem) &bl_method_##stem,
#include "aliasing/methods.def"
#undef BL_METHOD
};

const bl_registry bl_methods = {"method", "methods", list, sizeof list / sizeof *list};

static bl_status report_unknown(const char *name, const bl_signal *signal, bl_message *message) {
    char where[160];
    snprintf(where, sizeof where, " at column 1 for '%.64s'", signal->text);
    const bl_unknown unknown = {.what = bl_methods.kind,
                                .word = name,
                                .where = where,
                                .words = bl_method_own_words(signal),
                                .registries = (const bl_registry *const[]){&bl_methods, NULL}};
    return bl_report_unknown(&unknown, message);
}

static bl_status read_settings(const bl_method_kind *kind, const bl_spec *spec, const char *text,
                               bl_method *method, bl_message *message) {
    method->kind = kind;
    method->parameters = calloc(1, kind->parameters_size + 1);
    if (!method->parameters)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    bl_status status =
        bl_parameters_read(kind->parameters, spec, text, method->parameters, message);
    if (status != BL_OK)
        return status;
    method->text = bl_parameters_text(spec->name, kind->parameters, method->parameters);
    return method->text ? BL_OK : bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
}

// The signal as the method reads it: with the word that named the method.
static bl_status read_signal(const bl_signal *signal, const char *word, bl_method *method,
                             bl_message *message) {
    if (word)
        return bl_signal_with_setting(signal, bl_method_own_key(signal), word, &method->signal,
                                      message);
    method->borrowed = signal->functions->release && !signal->functions->build;
    // What is borrowed is only read: nobody writes through it.
    method->signal = method->borrowed ? (bl_signal *)(uintptr_t)signal : bl_signal_copy(signal);
    return method->signal
               ? BL_OK
               : bl_report(message, BL_DEVICE, "out of memory opening '%s'", signal->text);
}

bl_status bl_method_open(const char *text, const bl_signal *signal, bl_method *method,
                         bl_message *message) {
    bl_spec spec;
    *method = (bl_method){0};
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    int own = bl_method_is_own(signal, spec.name);
    const bl_method_kind *kind = bl_method_find(own ? "own" : spec.name);
    if (!kind)
        status = report_unknown(spec.name, signal, message);
    else if (strcmp(kind->name, "own") == 0 && !signal->functions->filtered)
        status = bl_report(message, BL_USAGE,
                           "'%s' at column 1: '%.64s' cannot filter itself; use another method",
                           spec.name, signal->text);
    if (status == BL_OK)
        status = read_settings(kind, &spec, text, method, message);
    if (status == BL_OK)
        status = read_signal(signal, own ? spec.name : NULL, method, message);
    bl_spec_free(&spec);
    if (status != BL_OK)
        bl_method_close(method);
    return status;
}
