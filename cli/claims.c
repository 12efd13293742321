// SPDX-License-Identifier: MIT
#include "cli/claims.h"

#include <string.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/scorecard.h"
#include "score/properties/sampling.h"

enum { MOST = BL_SCORE_PROPERTIES * BL_SCORE_CLAIMS };

// A claim, the property that judges it, and what was found.
typedef struct claim_line {
    const char *property, *name, *reason;
    bl_verdict verdict;
} claim_line;

#define AT(member) .offset = offsetof(claim_line, member)
static const bl_field claim_fields[] = {{"claim", "claim or fact", BL_CELL_WORD, AT(name)},
                                        {"property", NULL, BL_CELL_WORD, AT(property)},
                                        {"verdict", "verdict", BL_CELL_VERDICT, AT(verdict)},
                                        {"reason", "reason", BL_CELL_WORD, AT(reason)},
                                        {0}};
#undef AT

// Every claim of a property that has several, and every other property that is judged against what
// the signal states.
static size_t list_claims(const bl_score *score, claim_line lines[MOST]) {
    size_t count = 0;
    for (size_t i = 0; i < bl_property_count(); i++) {
        const bl_score_property *result = &score->properties[i];
        const char *name = bl_property_at(i)->name;
        for (size_t k = 0; k < result->claim_count && count < MOST; k++)
            lines[count++] = (claim_line){name, result->claims[k].name, result->claims[k].reason,
                                          result->claims[k].verdict};
        if (result->claim_count == 0 && result->against == BL_AGAINST_CLAIM && count < MOST)
            lines[count++] = (claim_line){name, name, result->reason, result->verdict};
    }
    return count;
}

static bl_status report_nothing(bl_call *call, const bl_signal *signal) {
    int is_program = strncmp(signal->text, "cmd:", 4) == 0;
    return bl_report(&call->message, BL_MISMATCH,
                     "'%s' states nothing that could be checked%s; `bandlimit score` measures it "
                     "against the ideal",
                     signal->text, is_program ? ": a program can state nothing" : "");
}

static bl_verdict verdict_of(const claim_line *lines, size_t count) {
    bl_verdict worst = BL_VERDICT_NOT_RUN;
    for (size_t i = 0; i < count; i++)
        worst = bl_verdict_worse(worst, lines[i].verdict);
    return worst;
}

static void report_json(json_t *object, const bl_scorecard *card, const claim_line *lines,
                        size_t count, double alpha) {
    bl_verdict verdict = verdict_of(lines, count);
    json_t *properties = json_object();
    bl_json_set_text(object, "verdict", bl_verdict_word(verdict));
    bl_json_set_count(object, "exit_status", (uint64_t)bl_verdict_status(verdict));
    bl_json_set_text(object, "signal", card->signal->text);
    bl_json_set_number(object, "alpha", alpha);
    json_object_set_new(object, "claims", bl_table_json(&BL_TABLE(claim_fields, lines, count)));
    for (size_t i = 0; i < bl_property_count(); i++)
        if (card->score.properties[i].against == BL_AGAINST_CLAIM)
            json_object_set_new(properties, bl_property_at(i)->name,
                                bl_scorecard_json(&card->score.properties[i]));
    json_object_set_new(object, "properties", properties);
}

static void report_text(bl_call *call, const bl_scorecard *card, const claim_line *lines,
                        size_t count) {
    FILE *out = call->out;
    bl_table table = BL_TABLE(claim_fields, lines, count);
    table.coloured = bl_call_coloured(call);
    bl_plain_text(out, card->signal->text);
    fprintf(out, ": %zu claim%s\n\n", count, bl_plural(count));
    bl_table_print(&table, out);
    fprintf(out, "%-14s %s\n", "verdict", bl_call_verdict(call, verdict_of(lines, count)));
}

static bl_status report(bl_call *call, const bl_scorecard *card, double alpha,
                        bl_verdict *verdict) {
    claim_line lines[MOST];
    size_t count = list_claims(&card->score, lines);
    *verdict = verdict_of(lines, count);
    if (bl_json_start(call))
        report_json(call->json, card, lines, count, alpha);
    else if (!call->common.quiet)
        report_text(call, card, lines, count);
    return call->path
               ? bl_csv_write(call, card->signal->text, NULL, &BL_TABLE(claim_fields, lines, count))
               : BL_OK;
}

bl_status bl_check_claims(bl_call *call, double alpha) {
    bl_scorecard card = {0};
    bl_score_settings settings = bl_scorecard_settings(call, alpha, 1);
    bl_verdict verdict = BL_VERDICT_PASS;
    uint64_t wanted = (UINT64_C(1) << bl_property_count()) - 1;
    const char *text = call->operands.words[0];
    char doing[256];
    snprintf(doing, sizeof doing, "checking the claims of %s", text);
    bl_status status = bl_call_open(call, text, &card.signal);
    if (status == BL_OK && !bl_score_states_something(card.signal))
        status = report_nothing(call, card.signal);
    if (status == BL_OK)
        status = bl_scorecard_measure(call, text, doing, &settings, wanted, &card);
    bl_progress(call, NULL);
    if (status == BL_OK)
        status = report(call, &card, alpha, &verdict);
    bl_scorecard_free(&card);
    return status == BL_OK ? bl_verdict_status(verdict) : status;
}
