// SPDX-License-Identifier: MIT
#include "cli/scorecard.h"

#include <stdlib.h>

#include "cli/json.h"

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

bl_status bl_scorecard_measure(bl_call *call, const char *text, const char *doing,
                               const bl_score_settings *settings, uint64_t wanted,
                               bl_scorecard *card) {
    bl_score_subject subject;
    bl_status status =
        bl_score_subject_open(card->signal, text, call->isa, &subject, &call->message);
    if (status == BL_OK) {
        status = measure_each(call, doing, &subject, settings, wanted, &card->score);
        bl_score_subject_close(&subject);
    }
    return status;
}

void bl_scorecard_free(bl_scorecard *card) {
    bl_signal_free(card->signal);
    card->signal = NULL;
}

// A number without an interval has null limits and level 0; an exact one has level 1.
static json_t *number_json(const bl_estimate *estimate) {
    json_t *object = json_object();
    int seen = estimate->level <= 0;
    bl_json_set_number(object, "value", estimate->value);
    json_object_set_new(object, "lower", seen ? json_null() : bl_json_number(estimate->lower));
    json_object_set_new(object, "upper", seen ? json_null() : bl_json_number(estimate->upper));
    bl_json_set_number(object, "level", estimate->level);
    json_object_set_new(object, "samples",
                        estimate->samples > 0 ? bl_json_number(estimate->samples) : json_null());
    return object;
}

json_t *bl_scorecard_json(const bl_score_property *property) {
    json_t *object = json_object(), *claims = json_array(), *numbers = json_object();
    bl_json_set_text(object, "verdict", bl_verdict_word(property->verdict));
    bl_json_set_text(object, "against", bl_score_against_word(property->against));
    bl_json_set_text(object, "reason", property->reason);
    bl_json_set_text(object, "cell", property->cell);
    for (size_t i = 0; i < property->claim_count; i++) {
        json_t *claim = json_object();
        bl_json_set_text(claim, "name", property->claims[i].name);
        bl_json_set_text(claim, "verdict", bl_verdict_word(property->claims[i].verdict));
        bl_json_set_text(claim, "reason", property->claims[i].reason);
        json_array_append_new(claims, claim);
    }
    json_object_set_new(object, "claims", claims);
    for (size_t i = 0; i < property->count; i++)
        json_object_set_new(numbers, property->numbers[i].name,
                            number_json(&property->numbers[i].estimate));
    json_object_set_new(object, "numbers", numbers);
    return object;
}

const char *bl_scorecard_colour(const bl_call *call, bl_verdict verdict) {
    static const char *const colours[] = {"\033[32m", "\033[33m", "\033[31m", ""};
    // The word is coloured where colours may be.
    return *bl_call_verdict(call, BL_VERDICT_PASS) == '\033' ? colours[verdict] : "";
}
