// SPDX-License-Identifier: MIT
//
// The verb `trade`: what every alternative of a choice costs, and what it gets wrong.
#include "score/trade.h"

#include <string.h>

#include "cli/json.h"
#include "core/plain.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "filters/primitive.h"
#include "reports/trade_files.h"
#include "sources/source.h"
#include "textures/texture.h"

enum { TRADES_MOST = 32 };

typedef struct trade_options {
    const char *trade, *view;
} trade_options;

static const char the_word[] = "spectrum";

// The subject: a signal, or a word that is none.
typedef struct trade_subject {
    bl_signal *signal;
    const char *text;
} trade_subject;

// --- what is traded -----------------------------------------------------------------------------

// All names, with commas between them.
static const char *names_of(char *text, size_t size) {
    text[0] = '\0';
    for (size_t i = 0; i < bl_trade_count(); i++)
        snprintf(text + strlen(text), size - strlen(text), "%s%s", i ? ", " : "",
                 bl_trade_at(i)->name);
    return text;
}

static bl_status report_unknown(bl_call *call, const char *name) {
    char trades[256], all[sizeof trades + 96];
    for (size_t i = 0; i < bl_trade_count(); i++)
        if (strcmp(bl_trade_at(i)->name, name) == 0)
            return bl_report(&call->message, BL_USAGE,
                             "'%s' is a trade, and what is traded comes first: `bandlimit trade "
                             "SUBJECT --trade %s`",
                             name, name);
    snprintf(all, sizeof all, "`bandlimit list` shows signals; or the word %s, for the trades %s",
             the_word, names_of(trades, sizeof trades));
    const bl_unknown unknown = {
        .what = "subject",
        .word = name,
        .words = (const char *const[]){the_word, NULL},
        .registries = (const bl_registry *const[]){&bl_noises, &bl_primitives, &bl_textures, NULL},
        .all = all};
    return bl_report_unknown(&unknown, &call->message);
}

static bl_status open_subject(bl_call *call, trade_subject *subject) {
    const char *text = call->operands.words[0];
    char name[64];
    *subject = (trade_subject){NULL, text};
    if (strcmp(text, the_word) == 0)
        return BL_OK;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ":"), text);
    if (!bl_source_of(text) && !bl_source_definition(name, call->isa))
        return report_unknown(call, name);
    bl_status status = bl_call_open(call, text, &subject->signal);
    if (status == BL_OK)
        subject->text = subject->signal->text;
    return status;
}

static int applies(const bl_trade *trade, const trade_subject *subject) {
    return trade->applies(subject->signal, subject->signal ? NULL : subject->text);
}

static bl_status choose(bl_call *call, const trade_subject *subject, const bl_trade **chosen,
                        size_t *count) {
    const trade_options *options = call->settings;
    char trades[256];
    *count = 0;
    for (size_t i = 0; i < bl_trade_count() && *count < TRADES_MOST; i++)
        if (applies(bl_trade_at(i), subject) &&
            (!options->trade || strcmp(options->trade, bl_trade_at(i)->name) == 0))
            chosen[(*count)++] = bl_trade_at(i);
    if (*count)
        return BL_OK;
    const bl_trade *asked = options->trade ? bl_trade_find(options->trade) : NULL;
    if (options->trade && !asked)
        return bl_registry_report(&bl_trades, options->trade, " of --trade", &call->message);
    if (asked)
        return bl_report(&call->message, BL_MISMATCH,
                         "'%.200s' has no choice that '%s' trades (%s); without --trade all that "
                         "apply are shown",
                         subject->text, asked->name, asked->title);
    return bl_report(&call->message, BL_MISMATCH,
                     "'%.200s' has no choice that is traded; the trades are %s, as of vcnoise, "
                     "vnoise, scnoise, fractalsum, bias, step, brick and %s",
                     subject->text, names_of(trades, sizeof trades), the_word);
}

// --- reports ------------------------------------------------------------------------------------

#define AT(member) .offset = offsetof(bl_trade, member)
static const bl_field head_fields[] = {{"trade", NULL, BL_CELL_WORD, AT(name)},
                                       {"title", NULL, BL_CELL_WORD, AT(title)},
                                       {"question", NULL, BL_CELL_WORD, AT(question)},
                                       {"paper", NULL, BL_CELL_WORD, AT(paper)},
                                       {"error", NULL, BL_CELL_WORD, AT(error_name)},
                                       {"error_unit", NULL, BL_CELL_WORD, AT(error_unit)},
                                       {"sample", NULL, BL_CELL_WORD, AT(sample)},
                                       {0}};
#undef AT

static json_t *trade_json(const bl_trade *trade, const bl_alternatives *alternatives) {
    const bl_table head = BL_RECORD(head_fields, trade), rows = bl_trade_table(alternatives);
    json_t *object = json_object();
    bl_record_json(object, &head, 0);
    json_object_set_new(object, "alternatives", bl_table_json(&rows));
    return object;
}

static void print_head(FILE *out, const trade_subject *subject) {
    fputs("cost against error of ", out);
    bl_plain_text(out, subject->text);
    fputs("; * nothing is both cheaper and better\n", out);
}

static void print_trade(FILE *out, const bl_trade *trade, const bl_alternatives *alternatives) {
    const bl_table rows = bl_trade_table(alternatives);
    fprintf(out, "\n%s: %s\nerror: %s, %s\ntime: nanoseconds for %s\n\n", trade->name,
            trade->question, trade->error_name, trade->error_unit, trade->sample);
    bl_table_print(&rows, out);
}

static bl_status run_one(bl_call *call, const trade_subject *subject, const bl_trade *trade,
                         int is_first, json_t *list) {
    const trade_options *options = call->settings;
    const bl_trade_settings settings = {.seed = call->common.seed,
                                        .threads = bl_call_threads(call),
                                        .size = call->size,
                                        .view = options->view};
    bl_alternatives alternatives;
    bl_progress(call, "trading %s of %s ...", trade->title, subject->text);
    bl_status status =
        bl_trade_run(trade, subject->signal, &settings, &alternatives, &call->message);
    bl_progress(call, NULL);
    if (status != BL_OK)
        return status;
    if (call->path)
        status =
            bl_trade_files_write(trade, subject->text, &alternatives, call->path, &call->message);
    if (status == BL_OK && list)
        json_array_append_new(list, trade_json(trade, &alternatives));
    else if (status == BL_OK && !call->common.quiet) {
        if (is_first)
            print_head(call->out, subject);
        print_trade(call->out, trade, &alternatives);
    }
    bl_trade_close(trade, &alternatives);
    return status;
}

static bl_status run_trade(bl_call *call) {
    const bl_trade *chosen[TRADES_MOST];
    trade_subject subject;
    size_t count = 0;
    bl_status status = open_subject(call, &subject);
    if (status == BL_OK)
        status = choose(call, &subject, chosen, &count);
    json_t *object = status == BL_OK ? bl_json_start(call) : NULL, *list = NULL;
    if (object) {
        bl_json_set_text(object, "subject", subject.text);
        bl_json_set_count(object, "seed", call->common.seed);
        list = json_array();
        json_object_set_new(object, "trades", list);
    }
    for (size_t i = 0; i < count && status == BL_OK; i++)
        status = run_one(call, &subject, chosen[i], i == 0, list);
    bl_signal_free(subject.signal);
    return status;
}

static const bl_option options[] = {
    {"trade", BL_OPTION_WORD, offsetof(trade_options, trade), "NAME",
     .help = "this trade alone (default: all that apply)"},
    {"view", BL_OPTION_WORD, offsetof(trade_options, view), "VIEW",
     .help = "the view under which a texture is sampled (default: plane)"},
    {0}};

const bl_verb bl_verb_trade = {
    .name = "trade",
    .operands = "SUBJECT",
    .summary = "cost against error of every alternative",
    .text =
        "SUBJECT is a noise, a primitive, a texture, or the word spectrum. For every choice that "
        "it leaves (the table of a kernel, the precision, the octaves, the method of sampling), "
        "each alternative is compared with the most exact one and timed, all by turns until the "
        "spread is known. A star marks an alternative if nothing else is both cheaper and better, "
        "as far as the intervals tell.",
    .least = 1,
    .most = 1,
    .output = BL_OUTPUT_FOLDER,
    .output_help =
        "the folder to write into: of each trade its table as CSV, and cost against "
        "error as a plot",
    .options = options,
    .settings_size = sizeof(trade_options),
    .run = run_trade,
};
