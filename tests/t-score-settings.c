// SPDX-License-Identifier: MIT
//
// No setting of a noise that is right fails a claim: every choice, range end and example of every
// key of the registry, each with one of the properties that judge claims; all of them
// meet every noise at its defaults in t-score and t-score-broken.
//
// Error rate: each setting is a table of its own with alpha = 1e-7, of which a property has its
// share; the few hundred settings together fail by chance with less than 1e-4.
#include "tests/test.h"

#include "tests/scores.h"
#include "tests/texts.h"

#define ALPHA 1e-7

// The properties that judge a claim. Repeatable is held to more in t-rows and t-registry; cost
// claims nothing.
static const char *const names[] = {"range",    "band",       "period", "stationarity",
                                    "isotropy", "continuity", "far",    "gradient"};
enum { COUNT = sizeof names / sizeof *names };

// Returns the number of failing claims, which it prints.
static unsigned check(const char *text, const char *name) {
    bl_score_settings settings = bl_score_default_settings();
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    unsigned failures = 0;
    settings.size = BL_QUICK;
    settings.alpha = ALPHA;
    settings.threads = 1; // a busy machine makes many threads slow
    const bl_score_property result =
        bl_test_score_with(&(bl_score_subject){.signal = signal}, name, &settings);
    const bl_score_property *found = &result;
    for (size_t k = 0; k < found->claim_count; k++)
        if (found->claims[k].verdict == BL_VERDICT_FAIL) {
            print_error("%s: %s of %s: %s\n", text, found->claims[k].name, name,
                        found->claims[k].reason);
            failures++;
        }
    if (found->claim_count == 0 && found->verdict == BL_VERDICT_FAIL &&
        found->against == BL_AGAINST_CLAIM) {
        print_error("%s: %s: %s\n", text, name, found->reason);
        failures++;
    }
    for (size_t k = 0; k < found->count; k++) {
        const bl_estimate *e = &found->numbers[k].estimate;
        if (e->lower > e->value || e->upper < e->value) {
            print_error("%s: %s: %s is outside of its interval\n", text, name,
                        found->numbers[k].name);
            failures++;
        }
    }
    bl_signal_free(signal);
    return failures;
}

// One property of a setting, the next of the next. SCALE 8 takes all of them; below SCALE 1 every
// sixteenth setting is left.
static void test_no_setting_of_a_noise_fails_a_claim(void **state) {
    (void)state;
    const bl_texts *texts = bl_test_texts();
    size_t each = bl_test_scaled(1, 1), stride = bl_test_scaled(16, 0) >= 16 ? 1 : 16;
    unsigned failures = 0;
    for (size_t i = 0; i < texts->count; i++)
        for (size_t k = 0; k < COUNT; k++)
            if (bl_test_walk(i % stride == 0 && k < each))
                failures += check(texts->text[i], names[(i / stride + k) % COUNT]);
    assert_int_equal(failures, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_setting_of_a_noise_fails_a_claim),
    };
    return bl_run_tests(tests);
}
