// SPDX-License-Identifier: MIT
#include "core/verdict.h"

const char *bl_verdict_word(bl_verdict verdict) {
    static const char *const words[] = {"pass", "inconclusive", "fail", "not-run"};
    return words[verdict];
}

bl_status bl_verdict_status(bl_verdict verdict) {
    static const bl_status statuses[] = {BL_OK, BL_INCONCLUSIVE, BL_FAIL, BL_OK};
    return statuses[verdict];
}

bl_verdict bl_verdict_worse(bl_verdict a, bl_verdict b) {
    static const int badness[] = {1, 2, 3, 0};
    return badness[a] >= badness[b] ? a : b;
}
