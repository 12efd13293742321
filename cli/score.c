// SPDX-License-Identifier: MIT
//
// The verb `score`: signals against the properties of an ideal noise, a row a signal and a column a
// property.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/score_table.h"
#include "cli/scorecard.h"
#include "cli/words.h"
#include "reports/score_page.h"

typedef struct score_settings {
    double alpha;
    const char *only, *skip;
    int all, strict;
} score_settings;

// --- which properties ---

static bl_status report_unknown(bl_call *call, const char *option, const char *word) {
    char where[32];
    snprintf(where, sizeof where, " of --%s", option);
    return bl_registry_report(&bl_properties, word, where, &call->message);
}

// Reads "range,band" into bits.
static bl_status read_names(bl_call *call, const char *option, const char *list, uint64_t *bits) {
    char *copy = strdup(list), *rest = NULL;
    bl_status status = BL_OK;
    *bits = 0;
    if (!copy)
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    for (char *word = strtok_r(copy, ",", &rest); word && status == BL_OK;
         word = strtok_r(NULL, ",", &rest)) {
        size_t i = bl_property_index(word);
        if (i == bl_property_count())
            status = report_unknown(call, option, word);
        else
            *bits |= UINT64_C(1) << i;
    }
    free(copy);
    return status;
}

static bl_status read_wanted(bl_call *call, uint64_t *wanted) {
    const score_settings *settings = call->settings;
    uint64_t skipped = 0;
    bl_status status = BL_OK;
    *wanted = (UINT64_C(1) << bl_property_count()) - 1;
    if (settings->only)
        status = read_names(call, "only", settings->only, wanted);
    if (status == BL_OK && settings->skip)
        status = read_names(call, "skip", settings->skip, &skipped);
    *wanted &= ~skipped;
    if (status == BL_OK && !*wanted)
        return bl_report(&call->message, BL_USAGE, "--only and --skip leave no property to score");
    return status;
}

// --- which signals ---

static bl_status read_texts(bl_call *call, bl_words *texts) {
    const score_settings *settings = call->settings;
    int fits = 1;
    if (!settings->all && call->operands.count == 0)
        return bl_report(&call->message, BL_USAGE,
                         "score needs signals: bandlimit score gnoise vnoise, or --all for all "
                         "noises");
    for (size_t i = 0; settings->all && i < bl_noise_count(); i++)
        fits &= bl_words_add(texts, bl_noise_at(i, BL_ISA_BASELINE)->name);
    for (size_t i = 0; i < call->operands.count; i++)
        fits &= bl_words_add(texts, call->operands.words[i]);
    return fits ? BL_OK : bl_report(&call->message, BL_DEVICE, "out of memory");
}

// --- reports ---

static void report_json(bl_call *call, const bl_scorecard *cards, size_t count,
                        const bl_score_settings *used, bl_verdict verdict) {
    const score_settings *settings = call->settings;
    json_t *rows = json_array();
    bl_json_set_text(call->json, "verdict", bl_verdict_word(verdict));
    bl_json_set_count(call->json, "exit_status", (uint64_t)bl_verdict_status(verdict));
    bl_json_set_number(call->json, "alpha", used->alpha);
    bl_json_set_number(call->json, "level", used->level);
    bl_json_set_text(call->json, "size", bl_size_word(used->size));
    bl_json_set_count(call->json, "seed", used->seed);
    json_object_set_new(call->json, "strict", json_boolean(settings->strict));
    for (size_t s = 0; s < count; s++) {
        json_t *row = json_object(), *properties = json_object();
        bl_json_set_text(row, "signal", cards[s].signal->text);
        for (size_t i = 0; i < bl_property_count(); i++)
            json_object_set_new(properties, bl_property_at(i)->name,
                                bl_scorecard_json(&cards[s].score.properties[i]));
        json_object_set_new(row, "properties", properties);
        json_array_append_new(rows, row);
    }
    json_object_set_new(call->json, "rows", rows);
}

// A line of the data file: a number of a property, or a property that has none.
typedef struct score_line {
    const char *signal, *property, *against, *number, *reason;
    bl_verdict verdict;
    double value, lower, upper, level, samples;
} score_line;

#define AT(member) .offset = offsetof(score_line, member)
static const bl_field line_fields[] = {
    {"signal", NULL, BL_CELL_WORD, AT(signal)},      {"property", NULL, BL_CELL_WORD, AT(property)},
    {"verdict", NULL, BL_CELL_VERDICT, AT(verdict)}, {"against", NULL, BL_CELL_WORD, AT(against)},
    {"number", NULL, BL_CELL_WORD, AT(number)},      {"value", NULL, BL_CELL_REAL, AT(value)},
    {"lower", NULL, BL_CELL_REAL, AT(lower)},        {"upper", NULL, BL_CELL_REAL, AT(upper)},
    {"level", NULL, BL_CELL_REAL, AT(level)},        {"samples", NULL, BL_CELL_REAL, AT(samples)},
    {"reason", NULL, BL_CELL_WORD, AT(reason)},      {0}};
#undef AT

static score_line line_of(const bl_signal *signal, const bl_property *property,
                          const bl_score_property *result, const bl_score_number *number) {
    score_line line = {.signal = signal->text,
                       .property = property->name,
                       .against = bl_score_against_word(result->against),
                       .reason = result->reason,
                       .verdict = result->verdict,
                       .value = NAN,
                       .lower = NAN,
                       .upper = NAN,
                       .level = NAN,
                       .samples = NAN};
    if (!number)
        return line;
    int seen = number->estimate.level <= 0;
    line.number = number->name;
    line.value = number->estimate.value;
    line.lower = seen ? NAN : number->estimate.lower;
    line.upper = seen ? NAN : number->estimate.upper;
    line.level = number->estimate.level;
    line.samples = number->estimate.samples > 0 ? number->estimate.samples : NAN;
    return line;
}

// NULL out of memory; the caller frees it.
static score_line *lines_of(const bl_scorecard *cards, size_t count, size_t *found) {
    score_line *lines = malloc(count * bl_property_count() * BL_SCORE_NUMBERS * sizeof *lines);
    *found = 0;
    for (size_t s = 0; lines && s < count; s++)
        for (size_t i = 0; i < bl_property_count(); i++) {
            const bl_score_property *result = &cards[s].score.properties[i];
            for (size_t k = 0; k < (result->count ? result->count : 1); k++)
                lines[(*found)++] = line_of(cards[s].signal, bl_property_at(i), result,
                                            result->count ? &result->numbers[k] : NULL);
        }
    return lines;
}

static bl_status write_csv(bl_call *call, const bl_scorecard *cards, size_t count,
                           const bl_score_settings *used) {
    bl_file file;
    char text[128];
    size_t found;
    score_line *lines = lines_of(cards, count, &found);
    bl_status status =
        lines ? bl_csv_open(call, &file) : bl_report(&call->message, BL_DEVICE, "out of memory");
    if (status == BL_OK) {
        snprintf(text, sizeof text, "alpha %g, level %g, size %s, seed %llu", used->alpha,
                 used->level, bl_size_word(used->size), (unsigned long long)used->seed);
        bl_csv_comment(file.stream, "bandlimit score", BL_VERSION);
        bl_csv_comment(file.stream, "settings", text);
        bl_table_csv(&BL_TABLE(line_fields, lines, found), file.stream);
        status = bl_csv_close(call, &file);
    }
    free(lines);
    return status;
}

static bl_status write_page(bl_call *call, const bl_scorecard *cards, size_t count,
                            const bl_score_settings *used, bl_verdict verdict) {
    bl_score_view *views = calloc(count, sizeof *views);
    if (!views)
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    for (size_t s = 0; s < count; s++)
        views[s] = (bl_score_view){cards[s].signal, &cards[s].score};
    bl_status status = bl_score_page_write(call->path, views, count, used, verdict, &call->message);
    free(views);
    return status;
}

static bl_status report(bl_call *call, const bl_scorecard *cards, size_t count,
                        const bl_score_settings *used, bl_verdict verdict) {
    if (bl_json_start(call))
        report_json(call, cards, count, used, verdict);
    else if (!call->common.quiet)
        bl_score_table_print(call, cards, count, used);
    if (!call->path)
        return BL_OK;
    return bl_ends_with(call->path, ".html") ? write_page(call, cards, count, used, verdict)
                                             : write_csv(call, cards, count, used);
}

// --- the run ---

static bl_verdict find_verdict(const bl_scorecard *cards, size_t count, int strict) {
    bl_verdict verdict = BL_VERDICT_PASS;
    for (size_t s = 0; s < count; s++)
        verdict = bl_verdict_worse(verdict, bl_score_verdict(&cards[s].score, 1, strict));
    return verdict;
}

// All are opened before any is measured, so that a mistake in the last one is reported at once.
// Then one signal after another: each spreads its work over the threads, and nothing disturbs the
// clock of the cost, which is measured last. An error in one is an error of the call: nothing is
// written.
static bl_status measure_all(bl_call *call, const bl_words *texts, uint64_t wanted,
                             const bl_score_settings *used, bl_scorecard *cards) {
    bl_status status = BL_OK;
    for (size_t s = 0; s < texts->count && status == BL_OK; s++)
        status = bl_call_open(call, texts->words[s], &cards[s].signal);
    for (size_t s = 0; s < texts->count && status == BL_OK; s++) {
        char doing[256];
        snprintf(doing, sizeof doing, "scoring %s, %zu of %zu", texts->words[s], s + 1,
                 texts->count);
        status = bl_scorecard_measure(call, texts->words[s], doing, used, wanted, &cards[s]);
    }
    bl_progress(call, NULL);
    return status;
}

static bl_status run_score(bl_call *call) {
    const score_settings *settings = call->settings;
    bl_words texts = {0};
    uint64_t wanted;
    bl_scorecard *cards = NULL;
    bl_verdict verdict = BL_VERDICT_PASS;
    bl_status status = read_wanted(call, &wanted);
    if (status == BL_OK)
        status = read_texts(call, &texts);
    if (status == BL_OK && !(cards = calloc(texts.count, sizeof *cards)))
        status = bl_report(&call->message, BL_DEVICE, "out of memory");
    bl_score_settings used = bl_scorecard_settings(call, settings->alpha, texts.count);
    if (status == BL_OK)
        status = measure_all(call, &texts, wanted, &used, cards);
    if (status == BL_OK) {
        verdict = find_verdict(cards, texts.count, settings->strict);
        status = report(call, cards, texts.count, &used, verdict);
    }
    for (size_t s = 0; cards && s < texts.count; s++)
        bl_scorecard_free(&cards[s]);
    free(cards);
    bl_words_free(&texts);
    return status == BL_OK ? bl_verdict_status(verdict) : status;
}

static const bl_option options[] = {
    {"all", BL_OPTION_FLAG, offsetof(score_settings, all),
     .help = "all noises of the registry, before the signals named"},
    {"only", BL_OPTION_WORD, offsetof(score_settings, only), "NAMES",
     .help = "these properties alone, as range,band"},
    {"skip", BL_OPTION_WORD, offsetof(score_settings, skip), "NAMES",
     .help = "all properties but these"},
    {"strict", BL_OPTION_FLAG, offsetof(score_settings, strict),
     .help = "count what is judged against the ideal for the exit status too"},
    {"alpha", BL_OPTION_REAL, offsetof(score_settings, alpha), "P", .fallback = "1e-6",
     .minimum = 1e-12, .maximum = 0.5,
     .help = "probability that a table of signals whose facts are true shows a failure by "
             "chance"},
    {0}};

const bl_verb bl_verb_score = {
    .name = "score",
    .operands = "[SIGNAL...]",
    .summary = "the ideal-noise scorecard",
    .text =
        "Measures signals against the properties of an ideal noise: a repeatable function of a "
        "known range, limited to a band, without periods, stationary and isotropic; and against "
        "what they state of themselves. A row is a signal, a column a property: repeatable, scale, "
        "range, "
        "band, period, symmetry, seam (of pictures), stationarity, isotropy, continuity, seeds, "
        "far, gradient, cost. Each is "
        "judged against what the signal states or, where it states nothing, against the ideal. The "
        "exit status counts only what the signals state: 2 if something is false, else 1 if "
        "something is inconclusive, else 0. All tests of a table share one probability of a false "
        "alarm.",
    .most = 4096,
    .output = BL_OUTPUT_DATA,
    .output_help =
        "write the numbers as CSV to PATH (a page, if PATH ends in .html; the JSON "
        "object, if in .json)",
    .options = options,
    .settings_size = sizeof(score_settings),
    .run = run_score,
};
