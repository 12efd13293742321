// SPDX-License-Identifier: MIT
#include "tests/scores.h"

#include "tests/test.h"

bl_score_property bl_test_score(const bl_signal *signal, const char *property, bl_size size,
                                uint64_t seed) {
    bl_score_settings settings = bl_score_default_settings();
    bl_score_subject subject = {.signal = signal};
    bl_message message = {""};
    static bl_score score;
    const size_t index = bl_property_index(property);
    assert_true(index < bl_property_count());
    settings.size = size;
    settings.seed = seed;
    if (bl_score_measure(&subject, &settings, UINT64_C(1) << index, &score, &message) != BL_OK)
        fail_msg("%s of %s: %s", property, signal->text, message.text);
    return score.properties[index];
}
