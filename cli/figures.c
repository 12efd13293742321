// SPDX-License-Identifier: MIT
//
// Runs figures and tells what came of them: what `reproduce` and `compare` share.
#include "cli/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/json.h"
#include "core/plain.h"
#include "reports/figure.h"
#include "reports/reproduce.h"

static void show_progress(void *user, size_t done, size_t total, const char *figure,
                          const char *step) {
    bl_progress(user, "%zu of %zu: %s: %s", done + 1, total, figure, step ? step : "");
}

// The words of the call after the verb, for the page; the caller frees it.
static char *joined_arguments(const bl_call *call) {
    size_t size = 1;
    for (int i = 0; i < call->argument_count; i++)
        size += strlen(call->arguments[i]) + 1;
    char *text = calloc(1, size);
    for (int i = 0; text && i < call->argument_count; i++) {
        strcat(text, i ? " " : "");
        strcat(text, call->arguments[i]);
    }
    return text;
}

static void find_outcome(const bl_table *table, size_t row, bl_cell *cell) {
    cell->word = bl_outcome_word(bl_claim_outcome((const bl_claim *)table->rows + row));
}

// clang-format off
#define AT(member) .offset = offsetof(bl_claim, member)
static const bl_field claim_fields[] = {
    {"sentence", NULL, BL_CELL_WORD, AT(sentence)},
    {"source", NULL, BL_CELL_WORD, AT(source)},
    {"reading", NULL, BL_CELL_WORD, AT(reading)},
    {"unit", NULL, BL_CELL_WORD, AT(unit)},
    {"expected_lower", NULL, BL_CELL_REAL, AT(expected_lower)},
    {"expected_upper", NULL, BL_CELL_REAL, AT(expected_upper)},
    {"measured", NULL, BL_CELL_ESTIMATE, AT(measured)},
    {"verdict", NULL, BL_CELL_WORD, .find = find_outcome},
    {0}};
#undef AT
// clang-format on

static json_t *outcomes_json(const size_t *outcomes) {
    json_t *object = json_object();
    for (int v = 0; v <= BL_NOT_RUN; v++)
        bl_json_set_count(object, bl_outcome_word((bl_outcome)v), outcomes[v]);
    return object;
}

static json_t *figure_json(const bl_figure_result *result) {
    json_t *object = json_object();
    bl_json_set_text(object, "name", result->figure->name);
    bl_json_set_text(object, "paper", result->figure->paper);
    bl_json_set_text(object, "folder", result->folder);
    json_object_set_new(object, "files", bl_json_texts(result->files, result->file_count));
    json_object_set_new(
        object, "claims",
        bl_table_json(&BL_TABLE(claim_fields, result->claims, result->claim_count)));
    json_object_set_new(object, "verdicts", outcomes_json(result->outcomes));
    bl_json_set_number(object, "seconds", result->seconds);
    return object;
}

static void report_json(json_t *object, const bl_reproduction *result) {
    json_t *figures = json_array();
    bl_json_set_text(object, "verdict", bl_verdict_word(result->verdict));
    bl_json_set_count(object, "exit_status", (uint64_t)bl_verdict_status(result->verdict));
    bl_json_set_text(object, "page", result->page);
    json_object_set_new(object, "verdicts", outcomes_json(result->outcomes));
    for (size_t i = 0; i < result->count; i++)
        json_array_append_new(figures, figure_json(&result->figures[i]));
    json_object_set_new(object, "figures", figures);
    bl_json_set_number(object, "seconds", result->seconds);
}

// A claim in several readings stands under its sentence once.
static void print_claim(FILE *out, const bl_claim *claim, const bl_claim *before) {
    if (!before || strcmp(before->sentence, claim->sentence) != 0)
        fprintf(out, "\n  %s (%s)\n", claim->sentence, claim->source);
    fprintf(out, "    %-9s  %s", bl_outcome_word(bl_claim_outcome(claim)),
            claim->reading ? claim->reading : "");
    if (claim->verdict == BL_VERDICT_NOT_RUN) {
        fputc('\n', out);
        return;
    }
    fprintf(out, ": %.4g", claim->measured.value);
    if (claim->measured.lower < claim->measured.upper)
        fprintf(out, " [%.4g, %.4g]", claim->measured.lower, claim->measured.upper);
    fputs(", expected ", out);
    if (isfinite(claim->expected_lower) && isfinite(claim->expected_upper))
        fprintf(out, "%.4g to %.4g", claim->expected_lower, claim->expected_upper);
    else if (isfinite(claim->expected_lower))
        fprintf(out, "at least %.4g", claim->expected_lower);
    else
        fprintf(out, "at most %.4g", claim->expected_upper);
    fprintf(out, "%s%s\n", claim->unit && *claim->unit ? " " : "", claim->unit ? claim->unit : "");
}

// "claims: 83 hold, 1 is refuted, 2 were not run".
static void print_counts(FILE *out, const size_t *outcomes) {
    static const struct {
        const char *one, *many;
    } words[] = {[BL_HOLDS] = {"holds", "hold"},
                 [BL_UNDECIDED] = {"is undecided", "are undecided"},
                 [BL_REFUTED] = {"is refuted", "are refuted"},
                 [BL_BROKEN] = {"is broken", "are broken"},
                 [BL_NOT_RUN] = {"was not run", "were not run"}};
    const char *between = "";
    fputs("claims: ", out);
    for (int v = 0; v <= BL_NOT_RUN; v++)
        if (outcomes[v]) {
            fprintf(out, "%s%zu %s", between, outcomes[v],
                    outcomes[v] == 1 ? words[v].one : words[v].many);
            between = ", ";
        }
    fputs(*between ? "\n" : "none\n", out);
}

static void report_text(bl_call *call, const bl_reproduction *result) {
    FILE *out = call->out;
    for (size_t f = 0; f < result->count; f++) {
        const bl_figure_result *figure = &result->figures[f];
        fprintf(out, "%s: %s (%s), %.1f s\n", figure->figure->name, figure->figure->title,
                figure->figure->paper, figure->seconds);
        for (size_t i = 0; i < figure->claim_count; i++)
            print_claim(out, &figure->claims[i], i ? &figure->claims[i - 1] : NULL);
        fputc('\n', out);
    }
    print_counts(out, result->outcomes);
    fprintf(out, "verdict: %s\npage: ", bl_call_verdict(call, result->verdict));
    bl_plain_text(out, result->page);
    fputc('\n', out);
}

static void report(bl_call *call, const bl_reproduction *result) {
    bl_call_may_warn(call);
    for (size_t f = 0; f < result->count; f++)
        for (size_t i = 0; i < result->figures[f].warning_count; i++)
            bl_call_warn(call, "%s: %s", result->figures[f].figure->name,
                         result->figures[f].warnings[i]);
    if (bl_json_start(call))
        report_json(call->json, result);
    else if (!call->common.quiet)
        report_text(call, result);
}

bl_status bl_figures_run(bl_call *call, const char *const *names, size_t count,
                         bl_reproduce_settings *settings) {
    char *arguments = joined_arguments(call);
    settings->arguments = arguments;
    settings->size = call->size;
    settings->isa = call->isa;
    settings->threads = bl_call_threads(call);
    settings->progress = show_progress;
    settings->user = call;
    if (call->path)
        settings->folder = call->path;
    if (call->common.seed_word)
        settings->seed = call->common.seed;
    bl_reproduction result;
    bl_status status = bl_reproduce(names, count, settings, &result, &call->message);
    free(arguments);
    if (status != BL_OK)
        return status;
    bl_progress(call, NULL);
    status = bl_verdict_status(result.verdict);
    call->message.text[0] = '\0';
    report(call, &result);
    bl_reproduction_free(&result);
    return status;
}
