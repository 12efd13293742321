// SPDX-License-Identifier: MIT
#include "score/score.h"

bl_status bl_score_subject_open(const bl_signal *signal, const char *text, bl_isa isa,
                                bl_score_subject *subject, bl_message *message) {
    const bl_isa own = isa == BL_ISA_BEST ? bl_isa_best() : isa;
    *subject = (bl_score_subject){.signal = signal};
    if (!bl_noise_find(signal->name, BL_ISA_BASELINE))
        return BL_OK;
    for (int other = 0; other < BL_ISA_COUNT && subject->variant_count < BL_SCORE_VARIANTS;
         other++) {
        bl_signal *variant;
        if (other == (int)own || !bl_isa_runs_here((bl_isa)other))
            continue;
        bl_status status = bl_noise_open(text, (bl_isa)other, &variant, message);
        if (status != BL_OK) {
            bl_score_subject_close(subject);
            return status;
        }
        subject->variants[subject->variant_count] = variant;
        subject->variant_names[subject->variant_count++] = bl_isa_name((bl_isa)other);
    }
    return BL_OK;
}

// The variants are constant for those who measure; here they end.
void bl_score_subject_close(bl_score_subject *subject) {
    for (size_t v = 0; v < subject->variant_count; v++)
        bl_signal_free((bl_signal *)subject->variants[v]);
    subject->variant_count = 0;
}
