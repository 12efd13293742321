// SPDX-License-Identifier: MIT
#include "aliasing/method.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BL_METHOD(stem) extern const bl_method_kind bl_method_##stem;
#include "aliasing/methods.def"
#undef BL_METHOD

static const bl_method_kind *const registry[] = {
#define BL_METHOD(stem) &bl_method_##stem,
#include "aliasing/methods.def"
#undef BL_METHOD
};
enum { METHOD_COUNT = sizeof registry / sizeof *registry, WORDS_MOST = 64 };

// The keys whose words are ways that a signal filters itself: those of textures and primitives, and
// those of sums of octaves.
static const char *const own_keys[] = {"filter", "clamp"};
enum { OWN_KEYS = sizeof own_keys / sizeof *own_keys };

size_t bl_method_count(void) {
    return METHOD_COUNT;
}

const bl_method_kind *bl_method_at(size_t index) {
    return index < METHOD_COUNT ? registry[index] : NULL;
}

const bl_method_kind *bl_method_find(const char *name) {
    for (size_t i = 0; i < METHOD_COUNT; i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}

const char *bl_method_own_key(const bl_signal *signal) {
    for (size_t k = 0; k < OWN_KEYS && signal->functions->filtered; k++)
        if (bl_signal_choices(signal, own_keys[k]))
            return own_keys[k];
    return NULL;
}

const char *const *bl_method_own_words(const bl_signal *signal) {
    static const char *const none[] = {NULL};
    const char *key = bl_method_own_key(signal);
    return key ? bl_signal_choices(signal, key) : none;
}

int bl_method_is_own(const bl_signal *signal, const char *word) {
    for (const char *const *own = bl_method_own_words(signal); *own; own++)
        if (strcmp(*own, word) == 0)
            return 1;
    return 0;
}

static bl_status report_unknown(const char *name, const bl_signal *signal, bl_message *message) {
    const char *names[METHOD_COUNT + WORDS_MOST + 1] = {NULL};
    size_t count = 0;
    for (; count < METHOD_COUNT; count++)
        names[count] = registry[count]->name;
    for (const char *const *own = bl_method_own_words(signal);
         *own && count < METHOD_COUNT + WORDS_MOST; own++)
        names[count++] = *own;
    const char *near = bl_nearest(name, names);
    char known[768] = "";
    for (size_t i = 0; i < count; i++)
        if (strlen(known) + strlen(names[i]) + 4 < sizeof known)
            sprintf(known + strlen(known), "%s%s", i ? ", " : "", names[i]);
    return bl_report(message, BL_USAGE, "unknown method '%s' at column 1%s%s%s for '%.64s' use %s",
                     name, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : ";",
                     signal->text, known);
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
        return bl_signal_with_choice(signal, bl_method_own_key(signal), word, &method->signal,
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

void bl_method_close(bl_method *method) {
    free(method->parameters);
    free(method->text);
    if (!method->borrowed)
        bl_signal_free(method->signal);
    *method = (bl_method){0};
}

// The raw colour at what is seen, or the background.
void bl_scene_point(const bl_scene *scene, double x, double y, double rgb[3]) {
    static const double none[BL_AXES] = {0};
    bl_sight sight;
    if (bl_view_see(scene->view, x, y, &sight))
        bl_signal_colour(scene->signal, sight.at, none, rgb);
    else
        memcpy(rgb, scene->background, 3 * sizeof *rgb);
}
