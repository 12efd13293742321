// SPDX-License-Identifier: MIT
//
// What the verbs that show scores share: the settings of a call, the measurement of a signal by its
// text, and the forms of a property as JSON and as a word.
#ifndef BL_CLI_SCORECARD_H
#define BL_CLI_SCORECARD_H

#include "cli/verb.h"
#include "score/score.h"

// A signal of the table and what was found.
typedef struct bl_scorecard {
    bl_signal *signal; // owned
    bl_score score;
} bl_scorecard;

// The size, seed and threads of the call, for a table of so many signals that share `alpha`.
bl_score_settings bl_scorecard_settings(const bl_call *call, double alpha, size_t table);

// Measures the properties in `wanted` of the card's signal, which the caller has opened by this
// text (bl_call_open), beside the same noise for the other instruction sets that run here. Progress
// says `doing` and the property. Ends at the first property in which a source failed, with its
// error.
bl_status bl_scorecard_measure(bl_call *call, const char *text, const char *doing,
                               const bl_score_settings *settings, uint64_t wanted,
                               bl_scorecard *card);
void bl_scorecard_free(bl_scorecard *card);

// {"verdict": ..., "against": ..., "reason": ..., "cell": ..., "claims": [...], "numbers": {...}}
json_t *bl_scorecard_json(const bl_score_property *property);

// What starts the colour of a verdict; "" where nothing is to be coloured. Constant text.
const char *bl_scorecard_colour(const bl_call *call, bl_verdict verdict);

#endif
