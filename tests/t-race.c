// SPDX-License-Identifier: MIT
//
// Races between threads are found by the property `repeatable`, and nothing else is taken for one.
//
// Error rates. A race is not found with certainty: each function here was seen to fail in every of
// some hundred runs, on one processor as on two, so that missing it thrice in a row is no chance.
// Functions without a race cannot fail.
#include "tests/test.h"

#include "score/properties/race.h"
#include "tests/scores.h"
#include "sources/source.h"

#ifdef __SANITIZE_THREAD__ // which ends the program at the races that are here on purpose
#define SKIP_RACES() skip()
#else
#define SKIP_RACES() (void)0
#endif

static bl_signal *open_function(const char *name) {
    char text[4096];
    bl_signal *signal;
    bl_message message = {""};
    const char *build = getenv("BL_BUILD");
    snprintf(text, sizeof text, "%s/tests/plugins/races.so:%s", build ? build : "build", name);
    if (bl_source_open(text, BL_ISA_BEST, &signal, &message) != BL_OK)
        fail_msg("%s", message.text);
    return signal;
}

// With one thread asked for, which the search does not keep to.
static bl_score_property measure(const bl_signal *signal) {
    bl_score_settings settings = bl_score_default_settings();
    settings.size = BL_QUICK;
    settings.threads = 1;
    return bl_test_score_with(&(bl_score_subject){.signal = signal}, "repeatable", &settings);
}

static int is_raced(const char *name, bl_race *race) {
    bl_signal *signal = open_function(name);
    for (int turn = 0; turn < 3; turn++) {
        assert_true(bl_race_find(signal, (uint64_t)turn, 0.4, race));
        if (race->is_found)
            break;
    }
    bl_signal_free(signal);
    return race->is_found;
}

static void test_a_race_is_found_in_what_is_kept_between_two_lines(void **state) {
    (void)state;
    SKIP_RACES();
    static const char *const names[] = {"race_place", "race_seed", "race_cell", "race_rows"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        bl_race race;
        if (!is_raced(names[i], &race))
            fail_msg("%s: no race was found", names[i]);
        assert_true(race.alone != race.together);
        if (strcmp(names[i], "race_rows") == 0)
            assert_string_equal(race.what, "a row");
    }
}

static void test_the_verdict_names_the_race_and_a_place(void **state) {
    (void)state;
    SKIP_RACES();
    bl_signal *signal = open_function("race_seed");
    bl_score_property result = measure(signal);
    assert_int_equal(result.verdict, BL_VERDICT_FAIL);
    assert_int_equal(result.against, BL_AGAINST_CLAIM);
    assert_string_equal(result.cell, "differs");
    assert_non_null(strstr(result.reason, "threads"));
    assert_non_null(strstr(result.reason, "at ("));
    bl_signal_free(signal);
}

static void test_functions_that_keep_to_themselves_pass(void **state) {
    (void)state;
    static const char *const names[] = {"own_place", "locked_place", "once_first_call"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        bl_signal *signal = open_function(names[i]);
        bl_score_property result = measure(signal);
        if (result.verdict != BL_VERDICT_PASS)
            fail_msg("%s: %s", names[i], result.reason);
        assert_non_null(strstr(result.reason, "more threads than processors"));
        bl_signal_free(signal);
    }
}

static void test_a_function_that_is_called_one_by_one_is_not_raced(void **state) {
    (void)state;
    bl_signal *signal = open_function("serial_place");
    bl_signal *fresh = bl_signal_reseed(signal, 5);
    bl_score_property result = measure(signal);
    assert_true(signal->is_serial && fresh->is_serial);
    assert_int_equal(result.verdict, BL_VERDICT_PASS);
    assert_non_null(strstr(result.reason, "one call at a time"));
    bl_signal_free(fresh);
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_race_is_found_in_what_is_kept_between_two_lines),
        cmocka_unit_test(test_the_verdict_names_the_race_and_a_place),
        cmocka_unit_test(test_functions_that_keep_to_themselves_pass),
        cmocka_unit_test(test_a_function_that_is_called_one_by_one_is_not_raced),
    };
    return bl_run_tests(tests);
}
