// SPDX-License-Identifier: MIT
//
// From the text of a signal to the one who opens it.
#include "sources/source.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/grammar.h"
#include "filters/primitive.h"
#include "sources/source_kinds.h"
#include "textures/texture.h"

int bl_source_ends_with(const char *text, size_t length, const char *ending) {
    size_t tail = strlen(ending);
    return length > tail && strncmp(text + length - tail, ending, tail) == 0;
}

// lib.so, and lib.so.1.2
static int is_shared_object(const char *text, size_t length) {
    while (length > 0 && (isdigit((unsigned char)text[length - 1]) ||
                          (text[length - 1] == '.' && isdigit((unsigned char)text[length]))))
        length--;
    return bl_source_ends_with(text, length, ".so") || bl_source_ends_with(text, length, ".so.");
}

bl_source_kind bl_source_kind_of(const char *text) {
    size_t length = strcspn(text, ":");
    if (strncmp(text, "cmd:", 4) == 0 || (strncmp(text, "cmd,", 4) == 0 && text[length]))
        return BL_SOURCE_PROGRAM;
    if (*text && access(text, F_OK) == 0 && !is_shared_object(text, strlen(text)) &&
        !bl_source_ends_with(text, strlen(text), ".raw"))
        return BL_SOURCE_IMAGE; // a file whose own name may hold a colon
    if (is_shared_object(text, length))
        return BL_SOURCE_PLUGIN;
    if (bl_source_ends_with(text, length, ".raw"))
        return BL_SOURCE_RAW;
    char *name = strndup(text, length);
    if (!name)
        return BL_SOURCE_DEFINITION;
    int is_file = strpbrk(name, "./") != NULL || (length > 0 && access(name, F_OK) == 0);
    free(name);
    return is_file ? BL_SOURCE_IMAGE : BL_SOURCE_DEFINITION;
}

int bl_source_is_file(const char *text) {
    return bl_source_kind_of(text) != BL_SOURCE_DEFINITION;
}

int bl_source_in_range(const double *at, unsigned dims) {
    for (unsigned a = 0; a < dims; a++)
        if (!(fabs(at[a]) <= 0x1p62))
            return 0;
    return 1;
}

// The grammar wants a name and a colon: what stands before the settings becomes one, of the same
// length.
bl_status bl_source_settings(const bl_parameter *parameters, const char *text, const char *settings,
                             size_t length, void *block, bl_message *message) {
    size_t before = settings ? (size_t)(settings - text) : strcspn(text, ":");
    char *plain = strndup(text, settings ? before + length : before), *quoted;
    bl_spec spec;
    if (!plain)
        return bl_report(message, BL_DEVICE, "out of memory reading '%s'", text);
    for (size_t i = 0; i < before; i++)
        plain[i] = plain[i] == ':' ? '_' : plain[i];
    if (settings)
        plain[before - 1] = ':';
    bl_status status = bl_spec_parse(plain, &spec, message);
    if (status != BL_OK && message && (quoted = strstr(message->text, plain)))
        memcpy(quoted, text, strlen(plain)); // the words of the user
    free(plain);
    if (status != BL_OK)
        return status;
    status = bl_parameters_read(parameters, &spec, text, block, message);
    bl_spec_free(&spec);
    return status;
}

// The text with another seed in it, which the caller frees; NULL if out of memory. In a program's
// text the settings end at the colon, in a plugin's at its end.
static char *with_seed(const char *text, bl_source_kind kind, uint64_t seed) {
    size_t head = kind == BL_SOURCE_PROGRAM ? strcspn(text, ":") : strlen(text);
    char *seeded = NULL;
    int length = asprintf(&seeded, "%.*s,seed=%llu%s", (int)head, text, (unsigned long long)seed,
                          text + head);
    return length < 0 ? NULL : seeded;
}

// The seed that the settings of the text name; false if they name none.
static int named_seed(const char *text, bl_source_kind kind, unsigned long long *seed) {
    size_t head = kind == BL_SOURCE_PROGRAM ? strcspn(text, ":") : strlen(text);
    char *settings = strndup(text, head), *rest = NULL;
    int found = 0;
    for (char *word = settings ? strtok_r(settings, ",", &rest) : NULL; word;
         word = strtok_r(NULL, ",", &rest))
        if (strncmp(word, "seed=", 5) == 0 && bl_read_unsigned(word + 5, seed))
            found = 1;
    free(settings);
    return found;
}

bl_status bl_source_open_seeded(const char *text, uint64_t seed, bl_isa isa, bl_signal **signal,
                                bl_message *message) {
    bl_source_kind kind = bl_source_kind_of(text);
    unsigned long long named = seed;
    if (kind != BL_SOURCE_PLUGIN &&
        !(kind == BL_SOURCE_PROGRAM && strstr(text + strcspn(text, ":"), "{seed}")))
        return bl_report(
            message, BL_MISMATCH, "--seed: '%s' has no seed; leave it out%s", text,
            kind == BL_SOURCE_PROGRAM ? ", or let {seed} stand where the program takes it" : "");
    if (named_seed(text, kind, &named))
        return named == seed ? bl_source_open(text, isa, signal, message)
                             : bl_report(message, BL_USAGE,
                                         "--seed %llu and seed=%llu in '%s' contradict each other; "
                                         "leave one of them out",
                                         (unsigned long long)seed, named, text);
    char *seeded = with_seed(text, kind, seed);
    if (!seeded)
        return bl_report(message, BL_DEVICE, "out of memory");
    bl_status status = bl_source_open(seeded, isa, signal, message);
    free(seeded);
    return status;
}

static const bl_definition *noise_at(size_t index) {
    return bl_noise_at(index, BL_ISA_BASELINE);
}

static const struct {
    size_t (*count)(void);
    const bl_definition *(*at)(size_t index);
} registries[] = {{bl_noise_count, noise_at},
                  {bl_primitive_count, bl_primitive_at},
                  {bl_texture_count, bl_texture_at}};

const bl_definition *bl_source_definition(const char *name, bl_isa isa) {
    const bl_definition *found = bl_noise_find(name, isa);
    if (!found)
        found = bl_primitive_find(name);
    return found ? found : bl_texture_find(name);
}

const bl_definition *bl_source_definition_at(size_t index) {
    for (size_t i = 0; i < sizeof registries / sizeof *registries; i++) {
        if (index < registries[i].count())
            return registries[i].at(index);
        index -= registries[i].count();
    }
    return NULL;
}

static bl_status report_unknown(const char *name, bl_message *message) {
    const bl_unknown unknown = {
        .what = "signal",
        .word = name,
        .where = " at column 1",
        .registries = (const bl_registry *const[]){&bl_noises, &bl_primitives, &bl_textures, NULL},
        .all = "`bandlimit list` shows all"};
    return bl_report_unknown(&unknown, message);
}

static bl_status open_definition(const char *text, bl_isa isa, bl_signal **signal,
                                 bl_message *message) {
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    const bl_definition *definition = bl_source_definition(spec.name, isa);
    status = definition ? bl_definition_open(definition, &spec, text, bl_noise_opener(isa), signal,
                                             message)
                        : report_unknown(spec.name, message);
    bl_spec_free(&spec);
    return status;
}

bl_status bl_source_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message) {
    switch (bl_source_kind_of(text)) {
    case BL_SOURCE_DEFINITION:
        break;
    case BL_SOURCE_IMAGE:
        return bl_image_text_open(text, signal, message);
    case BL_SOURCE_RAW:
        return bl_raw_open(text, signal, message);
    case BL_SOURCE_PLUGIN:
        return bl_plugin_open(text, signal, message);
    case BL_SOURCE_PROGRAM:
        return bl_program_open(text, signal, message);
    }
    return open_definition(text, isa, signal, message);
}
