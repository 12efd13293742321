// SPDX-License-Identifier: MIT
#include "tests/scores.h"

#include "tests/test.h"

bl_score_property bl_test_score_with(const bl_score_subject *subject, const char *property,
                                     const bl_score_settings *settings) {
    bl_message message = {""};
    static bl_score score;
    const size_t index = bl_property_index(property);
    assert_true(index < bl_property_count());
    if (bl_score_measure(subject, settings, UINT64_C(1) << index, &score, &message) != BL_OK)
        fail_msg("%s of %s: %s", property, subject->signal->text, message.text);
    return score.properties[index];
}

bl_score_property bl_test_score(const bl_signal *signal, const char *property, bl_size size,
                                uint64_t seed) {
    bl_score_settings settings = bl_score_default_settings();
    settings.size = size;
    settings.seed = seed;
    return bl_test_score_with(&(bl_score_subject){.signal = signal}, property, &settings);
}
