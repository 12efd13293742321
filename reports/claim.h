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

typedef enum bl_verdict {
    BL_HOLDS,     // the interval lies within the expectation
    BL_UNDECIDED, // it straddles a limit
    BL_REFUTED,   // it lies outside; the claim is a paper's: a finding, the run goes on
    BL_BROKEN,    // it lies outside; the claim is our own: the run fails
    BL_NOT_RUN
} bl_verdict;

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

// Fills the verdict from expected, measured and whether the source is "bandlimit".
void bl_claim_judge(bl_claim *claim);
const char *
bl_verdict_word(bl_verdict verdict); // "holds", "undecided", "refuted", "broken", "not run"

#endif
