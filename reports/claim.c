// SPDX-License-Identifier: MIT
#include "reports/claim.h"

#include <math.h>
#include <string.h>

void bl_claim_judge(bl_claim *claim) {
    const bl_estimate *measured = &claim->measured;
    if (isnan(measured->value) || isnan(measured->lower) || isnan(measured->upper))
        claim->verdict = BL_VERDICT_NOT_RUN;
    else if (measured->lower >= claim->expected_lower && measured->upper <= claim->expected_upper)
        claim->verdict = BL_VERDICT_PASS;
    else if (measured->upper >= claim->expected_lower && measured->lower <= claim->expected_upper)
        claim->verdict = BL_VERDICT_INCONCLUSIVE;
    else
        claim->verdict = BL_VERDICT_FAIL;
}

int bl_claim_is_ours(const bl_claim *claim) {
    return strcmp(claim->source, "bandlimit") == 0;
}

bl_outcome bl_claim_outcome(const bl_claim *claim) {
    switch (claim->verdict) {
    case BL_VERDICT_PASS:
        return BL_HOLDS;
    case BL_VERDICT_INCONCLUSIVE:
        return BL_UNDECIDED;
    case BL_VERDICT_FAIL:
        return bl_claim_is_ours(claim) ? BL_BROKEN : BL_REFUTED;
    case BL_VERDICT_NOT_RUN:
        break;
    }
    return BL_NOT_RUN;
}

const char *bl_outcome_word(bl_outcome outcome) {
    static const char *const words[] = {"holds", "undecided", "refuted", "broken", "not run"};
    return words[outcome];
}
