// SPDX-License-Identifier: MIT
//
// The verbs trade and advise: what they print, their JSON, their files, their exit status.
#include "tests/test.h"

#include "tests/json.h"
#include "tests/program.h"
#include "tests/temporary.h"

#define RUN_JSON(status, ...)                                                                      \
    bl_run_json(status, (const char *const[]){__VA_ARGS__, "--json", "--quick", NULL})

static void test_trade_reports_every_alternative_with_its_intervals(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "trade", "bias");
    json_t *trades = json_object_get(object, "trades");
    assert_string_equal(bl_text_of(object, "schema"), "bandlimit.trade/1");
    assert_int_equal(json_array_size(trades), 1);
    json_t *rows = json_object_get(json_array_get(trades, 0), "alternatives");
    assert_string_equal(bl_text_of(json_array_get(trades, 0), "trade"), "curve-form");
    assert_int_equal(json_array_size(rows), 2);
    for (size_t i = 0; i < json_array_size(rows); i++) {
        const json_t *row = json_array_get(rows, i);
        assert_true(bl_number_of(row, "error_lower") <= bl_number_of(row, "error"));
        assert_true(bl_number_of(row, "error") <= bl_number_of(row, "error_upper"));
        assert_true(bl_number_of(row, "ns_per_sample_lower") <= bl_number_of(row, "ns_per_sample"));
        assert_true(json_is_boolean(json_object_get(row, "front")));
    }
    json_decref(object);
}

static void test_trade_shows_all_that_apply_or_the_one_asked_for(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("trade", "vnoise", "--quick");
    assert_int_equal(ran.status, 0);
    assert_non_null(strstr(ran.out, "\ninterpolation: "));
    assert_non_null(strstr(ran.out, "\nprecision: "));
    assert_non_null(strstr(ran.out, "\n* "));
    bl_ran_free(&ran);
    ran = bl_run_program("trade", "vnoise", "--quick", "--trade", "precision");
    assert_int_equal(ran.status, 0);
    assert_null(strstr(ran.out, "interpolation: "));
    bl_ran_free(&ran);
}

static void test_trade_takes_the_word_spectrum(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "trade", "spectrum");
    assert_string_equal(bl_text_of(json_array_get(json_object_get(object, "trades"), 0), "trade"),
                        "averages");
    json_decref(object);
}

static size_t rows_of(const char *text) {
    size_t rows = 0;
    for (const char *line = text; line && *line; rows++) {
        if (*line == '#')
            rows--;
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    return rows - 1; // the header line
}

static void test_trade_writes_its_table_and_its_plot(void **state) {
    (void)state;
    static const char *const files[] = {"curve-form.gp", "curve-form.svg", "curve-form.png"};
    bl_ran ran = bl_run_program("trade", "gain", "--quick", "-o", bl_temporary_path("gain"));
    assert_int_equal(ran.status, 0);
    bl_ran_free(&ran);
    char *table = bl_temporary_read(bl_temporary_path("gain/curve-form.csv"), NULL);
    char *front = bl_temporary_read(bl_temporary_path("gain/curve-form-front.csv"), NULL);
    assert_non_null(table);
    assert_non_null(front);
    assert_int_equal(rows_of(table), 2);
    assert_true(rows_of(front) >= 1 && rows_of(front) <= 2);
    assert_non_null(strstr(table, "alternative,error,error_lower,error_upper,"));
    free(table);
    free(front);
    for (int i = 0; i < 3; i++) {
        char name[64];
        snprintf(name, sizeof name, "gain/%s", files[i]);
        char *content = bl_temporary_read(bl_temporary_path(name), NULL);
        assert_non_null(content);
        free(content);
    }
}

static void expect_refusal(int status, const char *said, const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    if (ran.status != status || !strstr(ran.err, said) || ran.out_size)
        fail_msg("%s %s: status %d, expected %d with '%s': %s", words[0], words[1], ran.status,
                 status, said, ran.err);
    bl_ran_free(&ran);
}
#define EXPECT_REFUSAL(status, said, ...)                                                          \
    expect_refusal(status, said, (const char *const[]){__VA_ARGS__, NULL})

static void test_trade_refuses_what_it_cannot_trade_and_says_what_it_can(void **state) {
    (void)state;
    EXPECT_REFUSAL(64, "'spectrum'", "trade", "spectrun");
    EXPECT_REFUSAL(64, "vnoise", "trade", "vnoisy");
    EXPECT_REFUSAL(64, "kernel-table, interpolation", "trade", "vnoisy");
    EXPECT_REFUSAL(64, "did you mean 'octaves'", "trade", "vnoise", "--trade", "octave");
    EXPECT_REFUSAL(3, "number of impulses", "trade", "vnoise", "--trade", "impulses");
    EXPECT_REFUSAL(3, "no choice that is traded", "trade", "abs");
    EXPECT_REFUSAL(64, "view", "trade", "brick", "--quick", "--view", "plain");
}

static void test_advise_agrees_with_its_exit_status(void **state) {
    (void)state;
    static const struct {
        const char *tolerance, *verdict;
        int status;
    } cases[] = {{"0.9", "pass", 0}, {"1e-12", "fail", 2}};
    for (int i = 0; i < 2; i++) {
        // Seen straight ahead, 0.3 units a pixel, where every way has an error.
        json_t *object =
            RUN_JSON(cases[i].status, "advise", "checkerboard", "--tolerance", cases[i].tolerance,
                     "--size", "32", "--view", "flat:scale=9.6,rotate=20", "--method", "point",
                     "--method", "supersample:n=2");
        assert_string_equal(bl_text_of(object, "schema"), "bandlimit.advise/1");
        assert_string_equal(bl_text_of(object, "verdict"), cases[i].verdict);
        assert_near(bl_number_of(object, "exit_status"), cases[i].status, 0);
        assert_int_equal(json_is_null(json_object_get(object, "advice")), i);
        assert_int_equal(json_array_size(json_object_get(object, "rows")), 2);
        assert_near(bl_number_of(json_object_get(object, "needs"), "least_width"),
                    0.3 * cos(M_PI / 9), 1e-12);
        json_decref(object);
    }
}

static void test_advise_says_what_to_use_and_what_is_not_needed(void **state) {
    (void)state;
    bl_ran ran =
        bl_run_program("advise", "fractalsum:max=64", "--quick", "--size", "24", "--tolerance",
                       "1/2", "--method", "point", "--method", "mean", "--view", "flat:scale=2.4");
    assert_int_equal(ran.status, 0);
    assert_non_null(strstr(ran.out, "\nuse "));
    assert_non_null(strstr(ran.out, "octaves: 3 of 6"));
    assert_non_null(strstr(ran.out, "the dimension z"));
    bl_ran_free(&ran);
    EXPECT_REFUSAL(64, "--tolerance zero", "advise", "brick", "--tolerance", "zero");
    EXPECT_REFUSAL(64, "--tolerance 0", "advise", "brick", "--tolerance", "0");
    EXPECT_REFUSAL(64, "supersample", "advise", "brick", "--method", "supersampel");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trade_reports_every_alternative_with_its_intervals),
        cmocka_unit_test(test_trade_shows_all_that_apply_or_the_one_asked_for),
        cmocka_unit_test(test_trade_takes_the_word_spectrum),
        cmocka_unit_test(test_trade_writes_its_table_and_its_plot),
        cmocka_unit_test(test_trade_refuses_what_it_cannot_trade_and_says_what_it_can),
        cmocka_unit_test(test_advise_agrees_with_its_exit_status),
        cmocka_unit_test(test_advise_says_what_to_use_and_what_is_not_needed),
    };
    return bl_run_tests(tests);
}
