// SPDX-License-Identifier: MIT
//
// The instruction sets.
#include "noises/noise.h"

#include <string.h>

static const char *const isa_names[] = {"baseline", "v3", "v4", NULL};

const char *bl_isa_name(bl_isa isa) {
    return isa_names[isa == BL_ISA_BEST ? bl_isa_best() : isa];
}

int bl_isa_runs_here(bl_isa isa) {
    switch (isa) {
    case BL_ISA_V4:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && bl_isa_runs_here(BL_ISA_V3);
    case BL_ISA_V3:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
               __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
    default:
        return 1;
    }
}

bl_isa bl_isa_best(void) {
    return bl_isa_runs_here(BL_ISA_V4)   ? BL_ISA_V4
           : bl_isa_runs_here(BL_ISA_V3) ? BL_ISA_V3
                                         : BL_ISA_BASELINE;
}

bl_status bl_isa_read(const char *word, bl_isa *isa, bl_message *message) {
    for (int i = 0; i < BL_ISA_COUNT; i++) {
        if (strcmp(word, isa_names[i]) != 0)
            continue;
        if (!bl_isa_runs_here((bl_isa)i))
            return bl_report(message, BL_MISMATCH,
                             "--isa %s: this processor lacks it; the best here is %s", word,
                             bl_isa_name(BL_ISA_BEST));
        *isa = (bl_isa)i;
        return BL_OK;
    }
    const bl_unknown unknown = {.what = "value", .word = word, .key = "--isa", .words = isa_names};
    return bl_report_unknown(&unknown, message);
}
