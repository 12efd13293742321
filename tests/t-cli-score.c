// SPDX-License-Identifier: MIT
//
// The verb `score` and `check --claims`: their tables, JSON, files and exit status.
#include "tests/test.h"

#include <unistd.h>

#include "score/score.h"
#include "tests/json.h"
#include "tests/program.h"
#include "tests/temporary.h"

// Fails unless the program ends so and says that.
static void expect(int status, const char *says, const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    if (ran.status != status || !(strstr(ran.err, says) || strstr(ran.out, says)))
        fail_msg("%s %s: status %d, expected %d and '%s': %s%s", words[0], words[1], ran.status,
                 status, says, ran.err, ran.out);
    bl_ran_free(&ran);
}
#define EXPECT(status, says, ...) expect(status, says, (const char *const[]){__VA_ARGS__, NULL})

// The object that the program prints, whose exit_status must be the program's.
static json_t *run_json(const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    json_t *object = json_loads(ran.out, 0, NULL);
    if (!object)
        fail_msg("%s %s prints no JSON: %s%s", words[0], words[1], ran.err, ran.out);
    assert_int_equal(json_integer_value(json_object_get(object, "exit_status")), ran.status);
    bl_ran_free(&ran);
    return object;
}
#define RUN_JSON(...) run_json((const char *const[]){__VA_ARGS__, "--json", NULL})

static int is_one_of(const char *word, const char *const *words) {
    for (; *words; words++)
        if (strcmp(word, *words) == 0)
            return 1;
    return 0;
}

static void check_property(const char *name, const json_t *property) {
    static const char *const verdicts[] = {"pass", "fail", "inconclusive", "not-run", NULL};
    static const char *const against[] = {"claim", "ideal", NULL};
    const char *key;
    json_t *number;
    if (!is_one_of(bl_text_of(property, "verdict"), verdicts) ||
        !is_one_of(bl_text_of(property, "against"), against) || !*bl_text_of(property, "reason"))
        fail_msg("%s: verdict '%s' against '%s': '%s'", name, bl_text_of(property, "verdict"),
                 bl_text_of(property, "against"), bl_text_of(property, "reason"));
    assert_true(json_is_string(json_object_get(property, "cell")));
    json_object_foreach(json_object_get(property, "numbers"), key, number) {
        static const char *const keys[] = {"value", "lower", "upper", "level", "samples"};
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
            if (!json_object_get(number, keys[i]))
                fail_msg("%s.%s has no '%s'", name, key, keys[i]);
    }
}

static void test_the_object_has_a_row_a_signal_and_a_key_a_property(void **state) {
    (void)state;
    static const char *const own[] = {"repeatable", "range", "band", "cost"};
    json_t *object = RUN_JSON("score", "gnoise", "vnoise:seed=3", "--quick", "--strict");
    assert_string_equal(bl_text_of(object, "schema"), "bandlimit.score/1");
    const json_t *rows = json_object_get(object, "rows");
    assert_int_equal(json_array_size(rows), 2);
    assert_string_equal(bl_text_of(json_array_get(rows, 1), "signal"), "vnoise:seed=3");
    for (size_t r = 0; r < 2; r++) {
        json_t *properties = json_object_get(json_array_get(rows, r), "properties"), *property;
        const char *name;
        for (size_t i = 0; i < sizeof own / sizeof *own; i++)
            assert_non_null(json_object_get(properties, own[i]));
        json_object_foreach(properties, name, property) check_property(name, property);
    }
    json_decref(object);
}

static void test_properties_are_chosen_by_name(void **state) {
    (void)state;
    json_t *object =
        RUN_JSON("score", "gnoise", "--quick", "--only", "range,cost", "--skip", "cost");
    json_t *properties =
        json_object_get(json_array_get(json_object_get(object, "rows"), 0), "properties");
    assert_string_equal(bl_text_of(json_object_get(properties, "range"), "verdict"), "pass");
    assert_string_equal(bl_text_of(json_object_get(properties, "cost"), "verdict"), "not-run");
    assert_string_equal(bl_text_of(json_object_get(properties, "band"), "reason"), "not asked for");
    json_decref(object);
    EXPECT(64, "did you mean 'range'", "score", "gnoise", "--only", "rnage");
    EXPECT(64, "leave no property", "score", "gnoise", "--only", "range", "--skip", "range");
    EXPECT(64, "score needs signals", "score");
    EXPECT(64, "unknown", "score", "scnoise", "gnoize", "--full"); // told before measuring
}

static void test_strict_counts_the_ideal(void **state) {
    (void)state;
    // 3.7 pixels to a cell that are said to be five: all frequencies are a third too high.
    const char *image = bl_temporary_path("strict.exr");
    char text[300];
    EXPECT(0, "256 x 256", "render", "vnoise:interp=linear", "--width", "256", "--height", "256",
           "--scale", "70", "-o", image);
    snprintf(text, sizeof text, "%s:spacing=0.2", image);
    EXPECT(0, "band: fail against the ideal", "score", text, "--quick", "--only", "band");
    EXPECT(2, "band: fail against the ideal", "score", text, "--quick", "--only", "band",
           "--strict");
    unlink(image);
}

// Runs a table of so many columns; no line is longer, unless a word is, and none ends with a blank.
static bl_ran run_table(int width, const char *const *words) {
    char columns[16];
    snprintf(columns, sizeof columns, "%d", width);
    assert_int_equal(width ? setenv("COLUMNS", columns, 1) : unsetenv("COLUMNS"), 0);
    bl_ran ran = bl_run_words(NULL, words);
    unsetenv("COLUMNS");
    char *copy = strdup(ran.out);
    for (char *rest = NULL, *line = strtok_r(copy, "\n", &rest); line;
         line = strtok_r(NULL, "\n", &rest)) {
        size_t length = strlen(line), most = width ? (size_t)width : 120;
        if (length > most && strspn(line, " ") + strcspn(line + strspn(line, " "), " ") < length)
            fail_msg("'%s' is longer than %zu", line, most);
        if (length && line[length - 1] == ' ')
            fail_msg("'%s' ends with a blank", line);
    }
    free(copy);
    assert_null(strchr(ran.out, '\033')); // no terminal, no colours
    return ran;
}
#define RUN_TABLE(width, ...) run_table(width, (const char *const[]){__VA_ARGS__, NULL})

static void test_the_table_fits_a_terminal(void **state) {
    (void)state;
    static const int widths[] = {0, 60, 80, 300};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        bl_ran ran =
            RUN_TABLE(widths[i], "score", "gnoise", "scnoise:impulses=3,seed=18446744073709551615",
                      "--quick", "--skip", "continuity");
        for (size_t k = 0; k < bl_property_count(); k++)
            if (strcmp(bl_property_at(k)->name, "continuity") != 0 &&
                strcmp(bl_property_at(k)->name, "seam") != 0)
                assert_non_null(strstr(ran.out, bl_property_at(k)->name));
        assert_null(strstr(ran.out, "seam")); // of pictures, and there is none
        bl_ran_free(&ran);
    }
}

static void test_columns_that_are_shown_are_explained(void **state) {
    (void)state;
    bl_ran ran = RUN_TABLE(0, "score", "gnoise", "--quick", "--only", "stationarity,far,period");
    static const char *const shown[] = {"stationarity", "far", "period"};
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
        char line[256];
        snprintf(line, sizeof line, "\n  %s: %s\n", shown[i], bl_property_find(shown[i])->entry);
        if (!strstr(ran.out, line))
            fail_msg("no line '%s' in %s", line, ran.out);
    }
    assert_null(strstr(ran.out, bl_property_find("band")->entry));
    assert_non_null(strstr(ran.out, "fail* inf dB")); // vertices, against the ideal
    assert_non_null(strstr(ran.out, "* against the ideal"));
    bl_ran_free(&ran);
    ran = RUN_TABLE(0, "score", "gnoise", "--quick", "--only", "range");
    assert_null(strchr(ran.out, '*')); // nothing that it would mark
    bl_ran_free(&ran);
}

static void test_a_source_that_fails_is_an_error(void **state) {
    (void)state;
    const char *build = getenv("BL_BUILD"), *data = bl_temporary_path("failed.csv");
    char text[300];
    snprintf(text, sizeof text, "cmd:%s/tests/plugins/child 2die", build ? build : "build");
    EXPECT(4, text, "score", "gnoise", text, "--quick", "-o", data);
    assert_int_not_equal(access(data, F_OK), 0);
    // That a program states nothing is known before it is asked for anything.
    EXPECT(3, "a program can state nothing", "check", text, "--claims");
}

static void test_numbers_go_to_a_file_or_a_page(void **state) {
    (void)state;
    const char *data = bl_temporary_path("score.csv"), *page = bl_temporary_path("score.html");
    EXPECT(0, "", "score", "gnoise", "--quick", "--only", "range", "-o", data);
    char *text = bl_temporary_read(data, NULL);
    assert_non_null(strstr(text,
                           "\nsignal,property,verdict,against,number,value,lower,upper,"
                           "level,samples,reason\n"));
    assert_non_null(strstr(text, "\ngnoise,range,pass,claim,variance,0.03"));
    assert_non_null(strstr(text, "size quick,"));
    free(text);
    EXPECT(0, "", "score", "gnoise", "--quick", "--only", "range", "-o", page);
    text = bl_temporary_read(page, NULL);
    assert_non_null(strstr(text, "<!DOCTYPE html>"));
    assert_non_null(strstr(text, "used_of_bound"));
    assert_null(strstr(text, "<script"));
    assert_null(strstr(text, "http"));
    free(text);
    unlink(data), unlink(page);
    EXPECT(4, "cannot write", "score", "gnoise", "--full", "-o",
           bl_temporary_path("no/such/score.html"));
}

static void test_claims_are_checked_a_line_a_claim(void **state) {
    (void)state;
    json_t *object = RUN_JSON("check", "gnoise", "--claims", "--quick");
    static const char *const wanted[] = {"repeatable", "range", "mean", "variance", "band"};
    const json_t *claims = json_object_get(object, "claims");
    assert_string_equal(bl_text_of(object, "verdict"), "pass");
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        int found = 0;
        for (size_t k = 0; k < json_array_size(claims); k++)
            found |= strcmp(bl_text_of(json_array_get(claims, k), "claim"), wanted[i]) == 0;
        if (!found)
            fail_msg("no claim '%s'", wanted[i]);
    }
    json_decref(object);
    EXPECT(0, "variance       pass", "check", "gnoise", "--claims", "--quick");
    const char *data = bl_temporary_path("claims.csv");
    EXPECT(0, "", "check", "gnoise", "--claims", "--quick", "-o", data);
    char *text = bl_temporary_read(data, NULL);
    assert_non_null(strstr(text, "\nvariance,range,pass,"));
    free(text);
    unlink(data);
}

// cmd.so:function of the functions that t-plugin uses.
static const char *plugin(const char *function, char text[512]) {
    const char *build = getenv("BL_BUILD");
    snprintf(text, 512, "%s/tests/plugins/functions.so:%s", build ? build : "build", function);
    return text;
}

// 2 for a claim that fails and 1 for one that cannot be told, wherever the signal stands.
static void test_claims_decide_the_exit_status(void **state) {
    (void)state;
    char liar[512], seldom[512];
    plugin("liar", liar);
    plugin("seldom", seldom);
    EXPECT(2, "verdict        fail", "check", liar, "--claims", "--quick");
    EXPECT(1, "verdict        inconclusive", "check", seldom, "--claims", "--quick");
    json_t *object = RUN_JSON("check", liar, "--claims", "--quick");
    assert_string_equal(bl_text_of(object, "verdict"), "fail");
    json_decref(object);
    const char *const orders[][3] = {
        {liar, "gnoise", seldom}, {"gnoise", liar, seldom}, {seldom, "gnoise", liar}};
    for (int i = 0; i < 3; i++)
        EXPECT(2, "fail", "score", orders[i][0], orders[i][1], orders[i][2], "--quick", "--only",
               "range");
    EXPECT(1, "inconclusive", "score", seldom, "gnoise", "--quick", "--only", "range");
}

static double limit_of(const json_t *object) {
    const json_t *row = json_array_get(json_object_get(object, "rows"), 0);
    const json_t *property = json_object_get(json_object_get(row, "properties"), "isotropy");
    const json_t *number = json_object_get(json_object_get(property, "numbers"), "limit_deviate");
    return json_number_value(json_object_get(number, "value"));
}

// The signals of a table share its probability of a false alarm: the limit of two is that of one
// at half of it.
static void test_a_table_shares_its_alpha(void **state) {
    (void)state;
    json_t *one = RUN_JSON("score", "scnoise", "--quick", "--only", "isotropy", "--alpha", "0.001"),
           *two = RUN_JSON("score", "scnoise", "gnoise", "--quick", "--only", "isotropy", "--alpha",
                           "0.002"),
           *all = RUN_JSON("score", "scnoise", "--quick", "--only", "isotropy", "--alpha", "0.002");
    assert_true(limit_of(one) > 3 && limit_of(one) > limit_of(all));
    assert_near(limit_of(two), limit_of(one), 1e-9);
    json_decref(one), json_decref(two), json_decref(all);
}

static void test_a_signal_that_states_nothing_has_no_claims(void **state) {
    (void)state;
    const char *image = bl_temporary_path("claims.exr");
    EXPECT(0, "64 x 64", "render", "gnoise", "--width", "64", "--height", "64", "-o", image);
    EXPECT(3, "states nothing", "check", image, "--claims", "--quick");
    unlink(image);
}

static void test_claims_refuse_what_says_nothing_to_them(void **state) {
    (void)state;
    static const char *const refused[] = {
        "--band=0:1", "--leak=-20",  "--guard=0.1",   "--dims=2",    "--rate=8",      "--size=64",
        "--axis=y",   "--average=8", "--window=hann", "--level=0.9", "--place=random"};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        char says[64];
        snprintf(says, sizeof says, "%.*s says nothing to --claims", (int)strcspn(refused[i], "="),
                 refused[i]);
        EXPECT(64, says, "check", "gnoise", refused[i], "--claims", "--quick");
    }
    EXPECT(64, "--band says nothing", "check", "gnoise", "--claims", "--band", "0:1");
    EXPECT(0, "verdict", "check", "white", "--claims", "--quick", "--alpha", "1e-9", "--seed", "3",
           "--threads", "2", "--json");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_object_has_a_row_a_signal_and_a_key_a_property),
        cmocka_unit_test(test_properties_are_chosen_by_name),
        cmocka_unit_test(test_strict_counts_the_ideal),
        cmocka_unit_test(test_the_table_fits_a_terminal),
        cmocka_unit_test(test_columns_that_are_shown_are_explained),
        cmocka_unit_test(test_a_source_that_fails_is_an_error),
        cmocka_unit_test(test_numbers_go_to_a_file_or_a_page),
        cmocka_unit_test(test_claims_are_checked_a_line_a_claim),
        cmocka_unit_test(test_claims_decide_the_exit_status),
        cmocka_unit_test(test_a_table_shares_its_alpha),
        cmocka_unit_test(test_a_signal_that_states_nothing_has_no_claims),
        cmocka_unit_test(test_claims_refuse_what_says_nothing_to_them),
    };
    return bl_run_tests(tests);
}
