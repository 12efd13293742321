// SPDX-License-Identifier: MIT
//
// A verdict: what a measurement says about a limit, a stated fact or a claim.
#ifndef BL_CORE_VERDICT_H
#define BL_CORE_VERDICT_H

#include "core/status.h"

typedef enum bl_verdict {
    BL_VERDICT_PASS,         // the whole interval lies within the limits
    BL_VERDICT_INCONCLUSIVE, // it straddles a limit
    BL_VERDICT_FAIL,         // it lies outside
    BL_VERDICT_NOT_RUN       // there was nothing to measure
} bl_verdict;

// "pass", "inconclusive", "fail", "not-run": in text, CSV and JSON alike.
const char *bl_verdict_word(bl_verdict verdict);

// The exit status: BL_OK, BL_INCONCLUSIVE, BL_FAIL. What was not run fails nothing: BL_OK.
bl_status bl_verdict_status(bl_verdict verdict);

// Of both together: fail before inconclusive before pass before not run.
bl_verdict bl_verdict_worse(bl_verdict a, bl_verdict b);

#endif
