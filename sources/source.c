// SPDX-License-Identifier: MIT
//
// From the text of a signal to the one who opens it.
#include "sources/source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grammar.h"
#include "filters/primitive.h"
#include "textures/texture.h"

const bl_source *bl_source_of(const char *text) {
    for (size_t i = 0; i < bl_source_count(); i++)
        if (bl_source_at(i)->takes(text))
            return bl_source_at(i);
    return NULL;
}

const bl_definition *bl_source_definition(const char *name, bl_isa isa) {
    const bl_definition *found = bl_noise_find(name, isa);
    if (!found)
        found = bl_primitive_find(name);
    return found ? found : bl_texture_find(name);
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
    const bl_source *source = bl_source_of(text);
    return source ? source->open(text, signal, message)
                  : open_definition(text, isa, signal, message);
}

// --- seeds --------------------------------------------------------------------------------------

static bl_status report_contradiction(const char *text, const char *key, const char *value,
                                      uint64_t seed, bl_message *message) {
    return bl_report(message, BL_USAGE,
                     "--seed %llu and %s=%s in '%s' contradict each other; leave one of them out",
                     (unsigned long long)seed, key, value, text);
}

// The setting ",seed=N" of a source, which stands in the first `head` letters of its text, where no
// comma of theirs is quoted; NULL without one whose N is a number.
static const char *find_seed(const char *text, size_t head, char value[32],
                             unsigned long long *seed) {
    for (const char *word = text; (word = strstr(word, ",seed=")) && word < text + head; word++) {
        snprintf(value, 32, "%.*s", (int)strcspn(word + 6, ",:"), word + 6);
        if (bl_read_unsigned(value, seed)) // else its opening says so
            return word;
    }
    return NULL;
}

static bl_status seed_source(const bl_source *source, const char *text, uint64_t seed,
                             char **seeded, bl_message *message) {
    size_t head = source->seed_place ? source->seed_place(text) : 0;
    unsigned long long named;
    char value[32];
    if (!head)
        return bl_report(message, BL_MISMATCH, "--seed: '%s' has no seed; leave it out%s", text,
                         source->seed_hint ? source->seed_hint : "");
    if (find_seed(text, head, value, &named)) {
        if (named != seed)
            return report_contradiction(text, "seed", value, seed, message);
        *seeded = strdup(text);
        return *seeded ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    }
    int length = asprintf(seeded, "%.*s,seed=%llu%s", (int)head, text, (unsigned long long)seed,
                          text + head);
    return length < 0 ? bl_report(message, BL_DEVICE, "out of memory") : BL_OK;
}

char *bl_source_text_unseeded(const bl_signal *signal) {
    const char *text = signal->text;
    const bl_source *source = signal->definition ? NULL : bl_source_of(text);
    const bl_parameter *seed = signal->definition ? bl_definition_seed(signal->definition) : NULL;
    size_t head = source && source->seed_place ? source->seed_place(text) : 0;
    unsigned long long named;
    char value[32], *changed = NULL;
    const char *setting = find_seed(text, head, value, &named);
    if (setting &&
        asprintf(&changed, "%.*s%s", (int)(setting - text), text, setting + 6 + strlen(value)) < 0)
        return NULL;
    if (seed && bl_text_drop(text, seed->key, &changed, NULL) != BL_OK)
        return NULL;
    return changed ? changed : strdup(text);
}

static bl_status seed_definition(const char *text, uint64_t seed, bl_isa isa, char **seeded,
                                 bl_message *message) {
    bl_spec spec;
    unsigned long long named;
    char value[32];
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    const bl_definition *definition = bl_source_definition(spec.name, isa);
    const bl_parameter *parameter = definition ? bl_definition_seed(definition) : NULL;
    const char *word = parameter ? bl_spec_get(&spec, parameter->key) : NULL;
    snprintf(value, sizeof value, "%llu", (unsigned long long)seed);
    if (!definition)
        status = report_unknown(spec.name, message);
    else if (!parameter)
        status = bl_report(message, BL_MISMATCH, "--seed: '%s' has no seed; leave it out", text);
    else if (word && bl_read_unsigned(word, &named) && named != seed)
        status = report_contradiction(text, parameter->key, word, seed, message);
    else if (word) // the same, or what its opening refuses
        status = (*seeded = strdup(text)) ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    else
        status = bl_text_set(text, parameter->key, value, seeded, message);
    bl_spec_free(&spec);
    return status;
}

bl_status bl_source_open_seeded(const char *text, uint64_t seed, bl_isa isa, bl_signal **signal,
                                bl_message *message) {
    const bl_source *source = bl_source_of(text);
    char *seeded = NULL;
    bl_status status = source ? seed_source(source, text, seed, &seeded, message)
                              : seed_definition(text, seed, isa, &seeded, message);
    if (status == BL_OK)
        status = bl_source_open(seeded, isa, signal, message);
    free(seeded);
    return status;
}
