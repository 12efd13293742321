// SPDX-License-Identifier: MIT
#include "cli/scorecard.h"

#include <math.h>
#include <stdlib.h>

#include "cli/json.h"
#include "core/plain.h"

bl_score_settings bl_scorecard_settings(const bl_call *call, double alpha, size_t table) {
    bl_score_settings settings = bl_score_default_settings();
    settings.alpha = alpha;
    settings.table = table;
    settings.size = call->size;
    settings.seed = call->common.seed;
    settings.threads = bl_call_threads(call);
    return settings;
}

// The values of a source that has failed are not numbers, and no property is to judge them.
static bl_status measure_each(bl_call *call, const char *doing, const bl_score_subject *subject,
                              const bl_score_settings *settings, uint64_t wanted, bl_score *score) {
    bl_score *one = malloc(sizeof *one);
    bl_status status = one ? bl_score_measure(subject, settings, 0, score, &call->message)
                           : bl_report(&call->message, BL_DEVICE, "out of memory");
    for (size_t i = 0; i < bl_property_count() && status == BL_OK; i++) {
        bl_message complaint;
        if (!(wanted >> i & 1))
            continue;
        bl_progress(call, "%s: %s ...", doing, bl_property_at(i)->name);
        status = bl_score_measure(subject, settings, UINT64_C(1) << i, one, &call->message);
        score->properties[i] = one->properties[i];
        if (bl_signal_complaint(subject->signal, &complaint) == BL_DEVICE)
            status = bl_report(&call->message, BL_DEVICE, "%s", complaint.text);
    }
    free(one);
    return status;
}

// A table has no rate of its own to choose: the verb that measures one spectrum has.
static void warn_of_detail(bl_call *call, const bl_scorecard *card) {
    bl_call_may_warn(call);
    for (size_t i = 0; i < bl_property_count(); i++) {
        const bl_score_detail *detail = &card->score.properties[i].detail;
        char remedy[640] = "no rate that was tried would do";
        if (!(detail->enough > detail->rate))
            continue;
        if (isfinite(detail->enough))
            snprintf(remedy, sizeof remedy,
                     "`bandlimit spectrum '%s' --dims %u --rate %.9g` would do", card->signal->text,
                     detail->dims, detail->enough);
        bl_call_warn(call,
                     "%s: %.4g samples a unit do not resolve '%s': %.2g of its variance or more "
                     "lies beyond Nyquist and folds back; %s",
                     bl_property_at(i)->name, detail->rate, card->signal->text, detail->beyond,
                     remedy);
    }
}

bl_status bl_scorecard_measure(bl_call *call, const char *text, const char *doing,
                               const bl_score_settings *settings, uint64_t wanted,
                               bl_scorecard *card) {
    bl_score_subject subject;
    bl_status status =
        bl_score_subject_open(card->signal, text, call->isa, &subject, &call->message);
    if (status == BL_OK) {
        bl_score_subject_scale(&subject, settings);
        status = measure_each(call, doing, &subject, settings, wanted, &card->score);
        warn_of_detail(call, card);
        bl_score_subject_close(&subject);
    }
    return status;
}

void bl_scorecard_free(bl_scorecard *card) {
    bl_signal_free(card->signal);
    card->signal = NULL;
}

static int has_interval(const void *number) {
    return ((const bl_score_number *)number)->estimate.level > 0;
}

static int is_counted(const void *number) {
    return ((const bl_score_number *)number)->estimate.samples > 0;
}

static void find_against(const bl_table *table, size_t row, bl_cell *cell) {
    cell->word = bl_score_against_word(((const bl_score_property *)table->rows)[row].against);
}

// clang-format off
#define AT(type, member) .offset = offsetof(type, member)
// A number without an interval has null limits and level 0; an exact one has level 1.
static const bl_field number_fields[] = {
    {"value", NULL, BL_CELL_REAL, AT(bl_score_number, estimate.value)},
    {"lower", NULL, BL_CELL_REAL, AT(bl_score_number, estimate.lower), .when = has_interval},
    {"upper", NULL, BL_CELL_REAL, AT(bl_score_number, estimate.upper), .when = has_interval},
    {"level", NULL, BL_CELL_REAL, AT(bl_score_number, estimate.level)},
    {"samples", NULL, BL_CELL_REAL, AT(bl_score_number, estimate.samples), .when = is_counted},
    {0}};

static const bl_field claim_fields[] = {
    {"name", NULL, BL_CELL_WORD, AT(bl_score_claim, name)},
    {"verdict", NULL, BL_CELL_VERDICT, AT(bl_score_claim, verdict)},
    {"reason", NULL, BL_CELL_LETTERS, AT(bl_score_claim, reason)},
    {0}};

static const bl_field property_fields[] = {
    {"verdict", NULL, BL_CELL_VERDICT, AT(bl_score_property, verdict)},
    {"against", NULL, BL_CELL_WORD, .find = find_against},
    {"reason", NULL, BL_CELL_LETTERS, AT(bl_score_property, reason)},
    {"cell", NULL, BL_CELL_LETTERS, AT(bl_score_property, cell)},
    {0}};
#undef AT
// clang-format on

json_t *bl_scorecard_json(const bl_score_property *property) {
    const bl_table numbers = BL_TABLE(number_fields, property->numbers, property->count);
    json_t *object = json_object(), *by_name = json_object();
    bl_record_json(object, &BL_RECORD(property_fields, property), 0);
    json_object_set_new(
        object, "claims",
        bl_table_json(&BL_TABLE(claim_fields, property->claims, property->claim_count)));
    for (size_t i = 0; i < property->count; i++) {
        json_t *number = json_object();
        bl_record_json(number, &numbers, i);
        json_object_set_new(by_name, property->numbers[i].name, number);
    }
    json_object_set_new(object, "numbers", by_name);
    return object;
}

const char *bl_scorecard_colour(const bl_call *call, bl_verdict verdict) {
    return bl_plain_colour(verdict, bl_call_coloured(call));
}
