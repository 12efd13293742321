// SPDX-License-Identifier: MIT
//
// A claim: a sentence that can be measured, its source, what it leads us to expect, what was
// measured, and the verdict.
//
// An extreme of samples, or the largest of several deviations, has no interval: its limits are its
// value, its level is 0, and it is judged by the value alone.
#ifndef BL_REPORTS_CLAIM_H
#define BL_REPORTS_CLAIM_H

#include "core/statistics.h"
#include "core/verdict.h"

// How a claim tells its verdict.
typedef enum bl_outcome {
    BL_HOLDS,     // pass
    BL_UNDECIDED, // inconclusive
    BL_REFUTED,   // fail, and the claim is a paper's: a finding, the run goes on
    BL_BROKEN,    // fail, and the claim is our own: the run fails
    BL_NOT_RUN
} bl_outcome;

typedef struct bl_claim {
    const char *sentence; // our own words
    const char *source;   // "peachey2003, p. 72", or "bandlimit" for our own
    const char *reading;  // what was measured: "along a line at a random place", ...
    const char *unit;     // of expected and measured: "share of the variance", "dB", ""
    double expected_lower, expected_upper; // +-INFINITY for one-sided
    bl_estimate measured; // level 1: exact; level 0: seen, but without an interval (see below)
    const char *counted;  // what `measured.samples` counts: "averages"; NULL: not said
    bl_verdict verdict;
} bl_claim;

// Fills the verdict from expected and measured.
void bl_claim_judge(bl_claim *claim);

int bl_claim_is_ours(const bl_claim *claim); // its source is "bandlimit"
bl_outcome bl_claim_outcome(const bl_claim *claim);
const char *
bl_outcome_word(bl_outcome outcome); // "holds", "undecided", "refuted", "broken", "not run"

#endif
