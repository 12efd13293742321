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

// Every order of the ends of two intervals, ends that meet included: the measured one and the
// expected one, whose limits may be one number. Said again in words: all of it within is a pass,
// nothing in common a fail, and what is left is undecided.
static void test_every_order_of_two_intervals_has_its_verdict(void **state) {
    (void)state;
    int seen[4] = {0};
    for (int from = 0; from < 6; from++)
        for (int to = from; to < 6; to++)
            for (int lower = 0; lower < 6; lower++)
                for (int upper = lower; upper < 6; upper++) {
                    int within = 0, all = to - from + 1;
                    for (int n = from; n <= to; n++) // whole numbers stand for the reals here
                        within += n >= lower && n <= upper;
                    int between = upper < from || lower > to ? 0 : 1;
                    bl_outcome expected = within == all ? BL_HOLDS
                                          : between     ? BL_UNDECIDED
                                                        : BL_BROKEN;
                    assert_int_equal(judge("bandlimit", lower, upper, from, to), expected);
                    seen[expected == BL_HOLDS ? 0 : expected == BL_UNDECIDED ? 1 : 2]++;
                }
    assert_true(seen[0] && seen[1] && seen[2]);
    // By the smallest step, on either side.
    double above = nextafter(1, 2), below = nextafter(0, -1);
    assert_int_equal(judge("bandlimit", 0, 1, 0.5, above), BL_UNDECIDED);
    assert_int_equal(judge("bandlimit", 0, 1, below, 0.5), BL_UNDECIDED);
    assert_int_equal(judge("bandlimit", 0, 1, above, 2), BL_BROKEN);
    assert_int_equal(judge("bandlimit", 0, 1, -2, below), BL_BROKEN);
    assert_int_equal(judge("bandlimit", 0, 1, 1, 2), BL_UNDECIDED);
    assert_int_equal(judge("bandlimit", 0, 1, -2, 0), BL_UNDECIDED);
}

static void test_verdicts_add_up_to_the_worst(void **state) {
    (void)state;
    static const bl_verdict by_badness[] = {BL_VERDICT_NOT_RUN, BL_VERDICT_PASS,
                                            BL_VERDICT_INCONCLUSIVE, BL_VERDICT_FAIL};
    static const bl_status status[] = {BL_OK, BL_OK, BL_INCONCLUSIVE, BL_FAIL};
    static const char *const word[] = {"not-run", "pass", "inconclusive", "fail"};
    for (int a = 0; a < 4; a++) {
        for (int b = 0; b < 4; b++)
            assert_int_equal(bl_verdict_worse(by_badness[a], by_badness[b]),
                             by_badness[a > b ? a : b]);
        assert_int_equal(bl_verdict_status(by_badness[a]), status[a]);
        assert_string_equal(bl_verdict_word(by_badness[a]), word[a]);
    }
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
        cmocka_unit_test(test_every_order_of_two_intervals_has_its_verdict),
        cmocka_unit_test(test_verdicts_add_up_to_the_worst),
        cmocka_unit_test(test_a_false_claim_of_a_paper_is_refuted_and_one_of_ours_is_broken),
        cmocka_unit_test(test_a_claim_without_a_number_was_not_run),
        cmocka_unit_test(test_every_outcome_has_a_word_of_its_own),
    };
    return bl_run_tests(tests);
}
