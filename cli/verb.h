// SPDX-License-Identifier: MIT
//
// The contract of a verb, the registry of verbs, and what a verb is given to run.
//
// A verb is one file of this folder, which ends with one descriptor, and one line in verbs.def. It
// reads its settings, measures through the library, and either prints to call->out or fills
// call->json; it never opens stdout and never exits.
#ifndef BL_CLI_VERB_H
#define BL_CLI_VERB_H

#include <jansson.h>
#include <stdio.h>

#include "cli/option.h"
#include "core/registry.h"
#include "core/signal.h"
#include "core/size.h"
#include "core/verdict.h"
#include "core/version.h"
#include "noises/noise.h"

typedef struct bl_verb bl_verb;

// The options that every verb takes.
typedef struct bl_common {
    int json, quick, full, quiet, help, version;
    const char *output;
    uint64_t seed;
    const char *seed_word; // NULL: not given
    uint64_t threads;      // 0: as many as OpenMP gives
    const char *isa;       // NULL: the best here
} bl_common;

typedef struct bl_call {
    const bl_verb *verb;
    const bl_registry *verbs;
    const bl_registry *const *registries; // all of them, ended by NULL (cli/registries.h)
    int argument_count;                   // as typed, for JSON
    char **arguments;
    bl_common common;
    void *settings;    // the verb's own block
    bl_words operands; // at least verb->least, at most verb->most
    bl_size size;      // of --quick and --full
    bl_isa isa;
    int every_isa;    // --isa all
    const char *path; // of the data file or folder (-o); NULL: none; "-": data to standard output
    FILE *out;        // the report: stdout, or the file of -o
    json_t *json;     // with --json: the verb's object; NULL until it is made
    json_t *warnings; // texts; NULL: the verb looks for nothing to warn of
    int is_hushed;    // --quiet was given
    bl_message message;
    bl_signal **watched; // copies of the signals whose source may fail
    size_t watched_count;
} bl_call;

// What -o means for a verb.
typedef enum bl_output {
    BL_OUTPUT_REPORT, // the report (or with --json the object) goes to the file
    BL_OUTPUT_DATA,   // the verb writes a data file beside its report
    BL_OUTPUT_FOLDER  // the verb writes into a folder
} bl_output;

struct bl_verb {
    BL_ENTRY(summary, text); // the summary is one line, the text the paragraphs of its help
    const char *operands;    // as in the usage line: "SIGNAL [X [Y [Z [W]]]]"
    unsigned least, most;    // operands
    bl_output output;
    const char *output_help;
    int takes_every_isa;      // --isa all
    const bl_option *options; // its own; ends with an empty one
    size_t settings_size;
    // Returns BL_OK, a verdict (1, 2) with call->message empty, or an error with it filled.
    bl_status (*run)(bl_call *call);
};

extern const bl_option bl_common_options[];
extern const bl_option bl_no_options[];

// Of verbs that measure: the confidence level, a double at an offset of the settings.
// clang-format off
#define BL_LEVEL_OPTION(offset)                                                                    \
    {"level", BL_OPTION_REAL, offset, "P", .fallback = "0.95", .minimum = 0.5,                     \
     .maximum = 0.999999, .help = "confidence level of the intervals"}
// clang-format on

// The list, for the program and not for verbs, which have call->registries.
BL_REGISTRY(bl_verb, bl_verb, bl_verbs)

// Writes the usage line, the text and the options of a verb, or with NULL those of the program.
void bl_help_print(FILE *out, const bl_registry *verbs, const bl_verb *verb);

// Whether a file can be written at `path` ('-': standard output); nothing is changed there.
bl_status bl_output_check(const char *path, bl_message *message);

// Opens the call's signal by its text, for the call's instruction set.
bl_status bl_call_open(bl_call *call, const char *text, bl_signal **signal);

// The status of the verb, unless a signal that it opened has failed meanwhile: then the message is
// the signal's own. bl_call_unwatch forgets these signals.
bl_status bl_call_complaints(bl_call *call, bl_status status);
void bl_call_unwatch(bl_call *call);

// Opens the call's first word with the seed of --seed, if that is given, as a part of its text.
// Errors: BL_USAGE if the text names another seed, BL_MISMATCH for a signal without one.
bl_status bl_call_open_seeded(bl_call *call, bl_signal **signal);

// Threads to use: what --threads says, or what OpenMP gives.
int bl_call_threads(const bl_call *call);

// Warns on standard error, unless --quiet is given, and in the member `warnings` of the JSON
// object. What was said already is not said again. bl_call_may_warn gives the object that member,
// which stays empty where all is well.
void bl_call_may_warn(bl_call *call);
void bl_call_warn(bl_call *call, const char *format, ...) __attribute__((format(printf, 2, 3)));

// One line of progress, overwritten by the next, to stderr when that is a terminal and --quiet is
// not given; NULL clears it.
void bl_progress(const bl_call *call, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Whether verdicts are coloured: the report goes to a terminal and NO_COLOR is not set.
int bl_call_coloured(const bl_call *call);
// The word of a verdict, coloured if they are. The result is constant text.
const char *bl_call_verdict(const bl_call *call, bl_verdict verdict);

#endif
