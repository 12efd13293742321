// SPDX-License-Identifier: MIT
#include "cli/verb.h"

#include <ctype.h>
#include <string.h>

#include "aliasing/view.h"
#include "cli/words.h"
#include "core/grammar.h"
#include "filters/filter.h"
#include "reports/figure.h"
#include "sources/source.h"

#define BL_VERB(stem) extern const bl_verb bl_verb_##stem;
#include "cli/verbs.def"
#undef BL_VERB

static const bl_verb *const registry[] = {
#define BL_VERB(stem) &bl_verb_##stem,
#include "cli/verbs.def"
#undef BL_VERB
};

enum { VERB_COUNT = sizeof registry / sizeof *registry };

const bl_option bl_no_options[] = {{0}};

#define AT(member) offsetof(bl_common, member)
const bl_option bl_common_options[] = {
    {.name = "json",
     .kind = BL_OPTION_FLAG,
     .offset = AT(json),
     .help = "print one JSON object and nothing else to stdout"},
    {.name = "output",
     .kind = BL_OPTION_WORD,
     .letter = 'o',
     .offset = AT(output),
     .value = "PATH",
     .help = "write to PATH: the report, or what the verb's help says; - is standard output, for "
             "reports and CSV"},
    {.name = "seed",
     .kind = BL_OPTION_WORD,
     .offset = AT(seed_word),
     .value = "N",
     .help = "seed of random places and fresh signals, 0 to 2^64-1 (default: 1); for eval and "
             "render, the seed of the signal (default: what its text says, else 0)"},
    {.name = "threads",
     .kind = BL_OPTION_UNSIGNED,
     .offset = AT(threads),
     .value = "N",
     .minimum = 1,
     .maximum = 1024,
     .help = "threads to use (default: all cores)"},
    {.name = "quick",
     .kind = BL_OPTION_FLAG,
     .offset = AT(quick),
     .help = "smaller settings: seconds"},
    {.name = "full",
     .kind = BL_OPTION_FLAG,
     .offset = AT(full),
     .help = "larger settings: as precise as is sensible"},
    {.name = "isa",
     .kind = BL_OPTION_WORD,
     .offset = AT(isa),
     .value = "SET",
     .help = "instruction set baseline, v3 or v4, for bench also all (default: the best here); the "
             "values are the same bit for bit"},
    {.name = "quiet",
     .kind = BL_OPTION_FLAG,
     .letter = 'q',
     .offset = AT(quiet),
     .help = "no progress and no report on a terminal: errors, files and JSON alone"},
    {.name = "help",
     .kind = BL_OPTION_FLAG,
     .letter = 'h',
     .offset = AT(help),
     .help = "print this help"},
    {.name = "version", .kind = BL_OPTION_FLAG, .offset = AT(version), .help = "print the version"},
    {0}};
#undef AT

size_t bl_verb_count(void) {
    return VERB_COUNT;
}

const bl_verb *bl_verb_at(size_t index) {
    return index < VERB_COUNT ? registry[index] : NULL;
}

const bl_verb *bl_verb_find(const char *name) {
    for (size_t i = 0; i < VERB_COUNT; i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}

// Says what a word is that is not a verb, and how its name is written: a user who types the name of
// a thing wants it shown.
static const char *kind_of(const char *text, char *name, size_t size) {
    bl_spec spec;
    const char *kind = NULL;
    snprintf(name, size, "%s", text);
    bl_source_kind source = bl_source_kind_of(name);
    if (source != BL_SOURCE_DEFINITION)
        return source == BL_SOURCE_PLUGIN    ? "a function"
               : source == BL_SOURCE_PROGRAM ? "a program"
                                             : "a file";
    for (char *letter = name; *letter && *letter != ':'; letter++)
        *letter = (char)tolower((unsigned char)*letter);
    if (bl_figure_find(name))
        return "a figure";
    if (bl_spec_parse(name, &spec, NULL) != BL_OK)
        return NULL;
    if (bl_noise_find(spec.name, BL_ISA_BASELINE))
        kind = "a noise";
    else if (bl_source_definition(spec.name, BL_ISA_BASELINE))
        kind = "a signal";
    else if (bl_filter_find(spec.name))
        kind = "a filter";
    else if (bl_view_find(spec.name))
        kind = "a view";
    bl_spec_free(&spec);
    return kind;
}

bl_status bl_verb_report_unknown(const char *name, bl_message *message) {
    const char *names[VERB_COUNT + 1] = {NULL};
    for (size_t i = 0; i < VERB_COUNT; i++)
        names[i] = registry[i]->name;
    char known[512];
    const char *near = bl_suggest(name, names), *kind = kind_of(name, known, sizeof known);
    if (kind)
        return bl_report(message, BL_USAGE, "'%s' is %s and no verb: try `bandlimit show %s`",
                         known, kind, known);
    return bl_report(message, BL_USAGE, "unknown verb '%s'%s%s%s`bandlimit help` lists all", name,
                     near ? "; did you mean '" : "", near ? near : "", near ? "'? " : "; ");
}
