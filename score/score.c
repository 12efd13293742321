// SPDX-License-Identifier: MIT
//
// The registry of the properties, and the running of them.
#include "score/score.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define BL_PROPERTY(stem) extern const bl_property bl_property_##stem;
#include "score/properties.def"
#undef BL_PROPERTY

static const bl_property *const registry[] = {
#define BL_PROPERTY(stem) &bl_property_##stem,
#include "score/properties.def"
#undef BL_PROPERTY
    NULL};

enum { COUNT = sizeof registry / sizeof *registry - 1 };
_Static_assert((int)COUNT <= (int)BL_SCORE_PROPERTIES, "a score holds every property");

size_t bl_property_count(void) {
    return COUNT;
}

const bl_property *bl_property_at(size_t index) {
    return index + 1 < sizeof registry / sizeof *registry ? registry[index] : NULL;
}

const bl_property *bl_property_find(const char *name) {
    for (size_t i = 0; registry[i]; i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}

bl_score_settings bl_score_default_settings(void) {
    return (bl_score_settings){
        .alpha = 1e-6, .table = 1, .size = BL_NORMAL, .seed = 1, .level = 0.95};
}

bl_status bl_score_measure(const bl_score_subject *subject, const bl_score_settings *settings,
                           uint64_t wanted, bl_score *score, bl_message *message) {
    bl_score_settings share = *settings;
    // Boole's inequality: the parts add up to alpha at most, whatever depends on what.
    share.alpha /= (double)(settings->table ? settings->table : 1) * (COUNT ? COUNT : 1);
    memset(score, 0, sizeof *score);
    for (size_t i = 0; registry[i]; i++) {
        bl_score_property *result = &score->properties[i];
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, BL_SCORE_NOT_ASKED);
        if (!(wanted >> i & 1))
            continue;
        bl_status status = registry[i]->measure(subject, &share, result, message);
        if (status != BL_OK)
            return status;
    }
    return BL_OK;
}

void bl_score_add(bl_score_property *result, const char *name, bl_estimate estimate) {
    assert(result->count < BL_SCORE_NUMBERS);
    if (result->count < BL_SCORE_NUMBERS)
        result->numbers[result->count++] = (bl_score_number){name, estimate};
}

static void add_point(bl_score_property *result, const char *name, double value, double level) {
    bl_estimate estimate = {.value = value, .lower = value, .upper = value, .level = level};
    bl_score_add(result, name, estimate);
}

void bl_score_add_exact(bl_score_property *result, const char *name, double value) {
    add_point(result, name, value, 1);
}

void bl_score_add_seen(bl_score_property *result, const char *name, double value) {
    add_point(result, name, value, 0);
}

const bl_score_number *bl_score_find(const bl_score_property *result, const char *name) {
    for (size_t i = 0; i < result->count; i++)
        if (strcmp(result->numbers[i].name, name) == 0)
            return &result->numbers[i];
    return NULL;
}

void bl_score_judge(bl_score_property *result, bl_verdict verdict, bl_score_against against,
                    const char *format, ...) {
    va_list arguments;
    result->verdict = verdict;
    result->against = against;
    va_start(arguments, format);
    vsnprintf(result->reason, sizeof result->reason, format, arguments);
    va_end(arguments);
}

void bl_score_add_claim(bl_score_property *result, const char *name, bl_verdict verdict,
                        const char *format, ...) {
    va_list arguments;
    assert(result->claim_count < BL_SCORE_CLAIMS);
    if (result->claim_count == BL_SCORE_CLAIMS)
        return;
    bl_score_claim *claim = &result->claims[result->claim_count++];
    claim->name = name;
    claim->verdict = verdict;
    va_start(arguments, format);
    vsnprintf(claim->reason, sizeof claim->reason, format, arguments);
    va_end(arguments);
}

const char *bl_score_against_word(bl_score_against against) {
    return against == BL_AGAINST_CLAIM ? "claim" : "ideal";
}

bl_verdict bl_score_verdict(const bl_score *scores, size_t count, int strict) {
    bl_verdict verdict = BL_VERDICT_PASS;
    for (size_t s = 0; s < count; s++)
        for (size_t i = 0; registry[i]; i++) {
            const bl_score_property *one = &scores[s].properties[i];
            if (one->against == BL_AGAINST_CLAIM || strict)
                verdict = bl_verdict_worse(verdict, one->verdict);
        }
    return verdict;
}
