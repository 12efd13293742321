// SPDX-License-Identifier: MIT
//
// The verb `list`: what there is, one line a thing.
#include <string.h>

#include "cli/json.h"
#include "cli/verb.h"
#include "filters/primitive.h"
#include "textures/texture.h"

typedef struct list_settings {
    int names;
} list_settings;

static unsigned dimensions_of(const bl_registry *registry, size_t index) {
    const bl_definition *definition = bl_registry_at(registry, index);
    return registry == &bl_noises || registry == &bl_primitives || registry == &bl_textures
               ? definition->dimensions
               : 0;
}

static json_t *registry_json(const bl_registry *registry) {
    json_t *list = json_array();
    for (size_t i = 0; i < registry->count; i++) {
        const bl_entry *entry = bl_registry_entry(registry, i);
        unsigned dimensions = dimensions_of(registry, i);
        json_t *object = json_object();
        bl_json_set_text(object, "name", entry->name);
        bl_json_set_text(object, "title", entry->title);
        if (dimensions)
            bl_json_set_count(object, "dimensions", dimensions);
        bl_json_set_text(object, "paper", bl_entry_paper(entry));
        bl_json_set_text(object, "summary", entry->summary);
        json_array_append_new(list, object);
    }
    return list;
}

static void print_registry(FILE *out, const bl_registry *registry, int names) {
    int width = 0;
    if (!names)
        fprintf(out, "%s\n", registry->kinds);
    for (size_t i = 0; i < registry->count; i++) {
        int letters = (int)strlen(bl_registry_entry(registry, i)->name);
        width = letters > width ? letters : width;
    }
    for (size_t i = 0; i < registry->count; i++) {
        const bl_entry *entry = bl_registry_entry(registry, i);
        if (names)
            fprintf(out, "%s\n", entry->name);
        else
            fprintf(out, "  %-*s  %s%s%s%s\n", width, entry->name, entry->title,
                    entry->paper ? " (" : "", entry->paper ? entry->paper : "",
                    entry->paper ? ")" : "");
    }
}

static bl_status report_unknown(bl_call *call, const char *word) {
    enum { KINDS_MOST = 31 };
    const char *words[KINDS_MOST + 1] = {NULL};
    for (size_t i = 0; call->registries[i] && i < KINDS_MOST; i++)
        words[i] = call->registries[i]->kinds;
    return bl_report_unknown(&(bl_unknown){.what = "list", .word = word, .words = words},
                             &call->message);
}

static bl_status run_list(bl_call *call) {
    const list_settings *settings = call->settings;
    const char *word = call->operands.count ? call->operands.words[0] : NULL;
    int found = !word;
    for (size_t i = 0; call->registries[i]; i++)
        found |= word && strcmp(word, call->registries[i]->kinds) == 0;
    if (!found)
        return report_unknown(call, word);
    json_t *object = bl_json_start(call);
    for (size_t i = 0; call->registries[i]; i++) {
        const bl_registry *registry = call->registries[i];
        if (word && strcmp(word, registry->kinds) != 0)
            continue;
        if (object)
            json_object_set_new(object, registry->kinds, registry_json(registry));
        else
            print_registry(call->out, registry, settings->names);
    }
    return BL_OK;
}

static const bl_option options[] = {{"names", BL_OPTION_FLAG, offsetof(list_settings, names),
                                     .help = "the bare names, one a line, for scripts"},
                                    {0}};

const bl_verb bl_verb_list = {
    .name = "list",
    .operands = "[KIND]",
    .summary = "what there is, by kind",
    .text =
        "KIND is noises, primitives, filters, textures, sources (of the user's own signals), "
        "views, methods (of sampling), trades, properties (of the scorecard), figures or "
        "verbs; without it all of them are listed. `bandlimit show NAME` explains each.",
    .most = 1,
    .output_help = "write the list to PATH instead of stdout",
    .options = options,
    .settings_size = sizeof(list_settings),
    .run = run_list,
};
