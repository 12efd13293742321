// SPDX-License-Identifier: MIT
#include "reports/claim.h"

#include <math.h>
#include <string.h>

void bl_claim_judge(bl_claim *claim) {
    const bl_estimate *measured = &claim->measured;
    if (isnan(measured->value) || isnan(measured->lower) || isnan(measured->upper))
        claim->verdict = BL_NOT_RUN;
    else if (measured->lower >= claim->expected_lower && measured->upper <= claim->expected_upper)
        claim->verdict = BL_HOLDS;
    else if (measured->upper >= claim->expected_lower && measured->lower <= claim->expected_upper)
        claim->verdict = BL_UNDECIDED;
    else
        claim->verdict = strcmp(claim->source, "bandlimit") == 0 ? BL_BROKEN : BL_REFUTED;
}

const char *bl_verdict_word(bl_verdict verdict) {
    static const char *const words[] = {"holds", "undecided", "refuted", "broken", "not run"};
    return words[verdict];
}
