// SPDX-License-Identifier: MIT
#include "tests/test.h"

#include "reports/claim.h"

static bl_outcome judge(const char *source, double lower, double upper, double from, double to) {
    bl_claim claim = {.sentence = "",
                      .source = source,
                      .expected_lower = lower,
                      .expected_upper = upper,
                      .measured = {(from + to) / 2, from, to, 0.95, 10}};
    bl_claim_judge(&claim);
    return bl_claim_outcome(&claim);
}

static void test_a_claim_holds_when_its_interval_lies_within_the_expectation(void **state) {
    (void)state;
    assert_int_equal(judge("peachey2003, p. 1", 0, 1, 0.2, 0.8), BL_HOLDS);
    assert_int_equal(judge("peachey2003, p. 1", 0, 1, 0, 1), BL_HOLDS);
    assert_int_equal(judge("bandlimit", -INFINITY, 1, -1e300, 0.5), BL_HOLDS);
    assert_int_equal(judge("bandlimit", 0.5, INFINITY, 0.5, INFINITY), BL_HOLDS);
}

static void test_a_claim_is_undecided_when_its_interval_straddles_a_limit(void **state) {
    (void)state;
    assert_int_equal(judge("peachey2003, p. 1", 0, 1, 0.9, 1.1), BL_UNDECIDED);
    assert_int_equal(judge("bandlimit", 0, 1, -0.1, 0.1), BL_UNDECIDED);
    assert_int_equal(judge("bandlimit", 0, 1, -1, 2), BL_UNDECIDED);
}

static void test_a_false_claim_of_a_paper_is_refuted_and_one_of_ours_is_broken(void **state) {
    (void)state;
    assert_int_equal(judge("peachey2003, p. 1", 0, 1, 1.1, 1.2), BL_REFUTED);
    assert_int_equal(judge("bandlimit", 0, 1, 1.1, 1.2), BL_BROKEN);
    assert_int_equal(judge("bandlimit", 0, INFINITY, -2, -1), BL_BROKEN);
}

static void test_a_claim_without_a_number_was_not_run(void **state) {
    (void)state;
    assert_int_equal(judge("bandlimit", 0, 1, NAN, NAN), BL_NOT_RUN);
    assert_int_equal(judge("bandlimit", 0, 1, 0.1, NAN), BL_NOT_RUN);
}

static void test_every_outcome_has_a_word_of_its_own(void **state) {
    (void)state;
    for (int a = 0; a <= BL_NOT_RUN; a++)
        for (int b = 0; b < a; b++)
            assert_string_not_equal(bl_outcome_word((bl_outcome)a), bl_outcome_word((bl_outcome)b));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_claim_holds_when_its_interval_lies_within_the_expectation),
        cmocka_unit_test(test_a_claim_is_undecided_when_its_interval_straddles_a_limit),
        cmocka_unit_test(test_a_false_claim_of_a_paper_is_refuted_and_one_of_ours_is_broken),
        cmocka_unit_test(test_a_claim_without_a_number_was_not_run),
        cmocka_unit_test(test_every_outcome_has_a_word_of_its_own),
    };
    return bl_run_tests(tests);
}
