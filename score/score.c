// SPDX-License-Identifier: MIT
//
// What properties fill their results with.
#include "score/score.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bl_score_settings bl_score_default_settings(void) {
    return (bl_score_settings){
        .alpha = 1e-6, .table = 1, .size = BL_NORMAL, .seed = 1, .level = 0.95};
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
