// SPDX-License-Identifier: MIT
//
// The verb `list`: what there is, one line a thing.
#include <string.h>

#include "aliasing/method.h"
#include "score/trade.h"
#include "cli/json.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "filters/primitive.h"
#include "reports/figure.h"
#include "textures/texture.h"

typedef struct list_settings {
    int names;
} list_settings;

// One line of a list.
typedef struct list_entry {
    const char *name, *title, *paper, *summary;
    unsigned dimensions; // 0: has none
} list_entry;

// A kind of thing: how many there are, and the one at an index.
typedef struct list_section {
    const char *name;
    size_t (*count)(void);
    list_entry (*at)(size_t index);
} list_section;

static list_entry figure_at(size_t index) {
    const bl_figure *figure = bl_figure_at(index);
    return (list_entry){figure->name, figure->title, figure->paper, figure->question, 0};
}

static list_entry of_definition(const bl_definition *definition) {
    return (list_entry){definition->name, definition->title, definition->paper, definition->summary,
                        definition->dimensions};
}

static list_entry noise_at(size_t index) {
    return of_definition(bl_noise_at(index, BL_ISA_BASELINE));
}

static list_entry primitive_at(size_t index) {
    return of_definition(bl_primitive_at(index));
}

static list_entry texture_at(size_t index) {
    return of_definition(bl_texture_at(index));
}

static list_entry filter_at(size_t index) {
    const bl_filter *filter = bl_filter_at(index);
    return (list_entry){filter->name, filter->title, filter->paper, filter->summary, 0};
}

static list_entry view_at(size_t index) {
    const bl_view_kind *view = bl_view_at(index);
    return (list_entry){view->name, view->title, NULL, view->summary, 0};
}

static list_entry method_at(size_t index) {
    const bl_method_kind *method = bl_method_at(index);
    return (list_entry){method->name, method->title, method->paper, method->summary, 0};
}

static list_entry trade_at(size_t index) {
    const bl_trade *trade = bl_trade_at(index);
    return (list_entry){trade->name, trade->title, trade->paper, trade->question, 0};
}

static const list_section sections[] = {
    {"noises", bl_noise_count, noise_at},    {"primitives", bl_primitive_count, primitive_at},
    {"filters", bl_filter_count, filter_at}, {"textures", bl_texture_count, texture_at},
    {"views", bl_view_count, view_at},       {"methods", bl_method_count, method_at},
    {"trades", bl_trade_count, trade_at},    {"figures", bl_figure_count, figure_at},
};
enum { SECTIONS = sizeof sections / sizeof *sections };

static json_t *section_json(const list_section *section) {
    json_t *list = json_array();
    for (size_t i = 0; i < section->count(); i++) {
        list_entry entry = section->at(i);
        json_t *object = json_object();
        bl_json_set_text(object, "name", entry.name);
        bl_json_set_text(object, "title", entry.title);
        if (entry.dimensions)
            bl_json_set_count(object, "dimensions", entry.dimensions);
        bl_json_set_text(object, "paper", entry.paper);
        bl_json_set_text(object, "summary", entry.summary);
        json_array_append_new(list, object);
    }
    return list;
}

static void print_section(FILE *out, const list_section *section, int names) {
    if (!names)
        fprintf(out, "%s\n", section->name);
    int width = 0;
    for (size_t i = 0; i < section->count(); i++) {
        int letters = (int)strlen(section->at(i).name);
        width = letters > width ? letters : width;
    }
    for (size_t i = 0; i < section->count(); i++) {
        list_entry entry = section->at(i);
        if (names)
            fprintf(out, "%s\n", entry.name);
        else
            fprintf(out, "  %-*s  %s%s%s%s\n", width, entry.name, entry.title,
                    entry.paper ? " (" : "", entry.paper ? entry.paper : "",
                    entry.paper ? ")" : "");
    }
}

static bl_status run_list(bl_call *call) {
    const list_settings *settings = call->settings;
    const char *word = call->operands.count ? call->operands.words[0] : NULL, *known[SECTIONS + 1];
    int found = !word;
    for (size_t i = 0; i < SECTIONS; i++) {
        known[i] = sections[i].name;
        found |= word && strcmp(word, sections[i].name) == 0;
    }
    known[SECTIONS] = NULL;
    const char *near = found ? NULL : bl_suggest(word, known);
    if (!found)
        return bl_report(
            &call->message, BL_USAGE,
            "'%s' is not a list; use noises, primitives, filters, textures, views, methods, "
            "trades or figures%s%s%s",
            word, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    json_t *object = bl_json_start(call);
    for (size_t i = 0; i < SECTIONS; i++) {
        if (word && strcmp(word, sections[i].name) != 0)
            continue;
        if (object)
            json_object_set_new(object, sections[i].name, section_json(&sections[i]));
        else
            print_section(call->out, &sections[i], settings->names);
    }
    return BL_OK;
}

static const bl_option options[] = {{.name = "names",
                                     .kind = BL_OPTION_FLAG,
                                     .offset = offsetof(list_settings, names),
                                     .help = "the bare names, one a line, for scripts"},
                                    {0}};

const bl_verb bl_verb_list = {
    .name = "list",
    .operands = "[KIND]",
    .summary = "what there is, by kind",
    .text =
        "KIND is noises, primitives, filters, textures, views, methods (of sampling), trades or "
        "figures; "
        "without it all of them are listed.",
    .most = 1,
    .output_help = "write the list to PATH instead of stdout",
    .options = options,
    .settings_size = sizeof(list_settings),
    .run = run_list,
};
