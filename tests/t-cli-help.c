// SPDX-License-Identifier: MIT
//
// Help, man page and completion say the same: they are held to the tables of the program.
#include "tests/test.h"

#include "tests/json.h"
#include "tests/program.h"
#include "tests/temporary.h"

static json_t *help;

static int read_help(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("help", "--json");
    help = json_loads(ran.out, 0, NULL);
    bl_ran_free(&ran);
    return help ? 0 : -1;
}

static int drop_help(void **state) {
    (void)state;
    json_decref(help);
    return 0;
}

// The part of a text from the line that starts with `start` to the next that starts with `end` or
// with `other_end`; the caller frees it. NULL if there is none.
static char *part_of(const char *text, const char *start, const char *end, const char *other_end) {
    char marks[3][64];
    const char *const words[] = {start, end, other_end};
    for (int i = 0; i < 3; i++)
        snprintf(marks[i], sizeof marks[i], "\n%s", words[i]);
    const char *from = strstr(text, marks[0]);
    if (!from)
        return NULL;
    const char *to = strstr(from + 1, marks[1]), *other = strstr(from + 1, marks[2]);
    if (!to || (other && other < to))
        to = other;
    return to ? strndup(from, (size_t)(to - from)) : strdup(from);
}

static size_t count_of(const char *text, const char *word) {
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, word)); at++)
        count++;
    return count;
}

// The man page writes a dash as \-.
static void man_name(const char *name, char *out, size_t size) {
    size_t used = (size_t)snprintf(out, size, "\\fB\\-\\-");
    for (; *name && used + 3 < size; name++) {
        if (*name == '-')
            out[used++] = '\\';
        out[used++] = *name;
    }
    snprintf(out + used, size - used, "\\fR");
}

static void expect_options_in_man(const char *part, const json_t *options, const char *where) {
    size_t index;
    json_t *option;
    json_array_foreach(options, index, option) {
        char name[96];
        man_name(bl_text_of(option, "name"), name, sizeof name);
        if (!strstr(part, name))
            fail_msg("man/bandlimit.1, %s: no entry for --%s", where, bl_text_of(option, "name"));
        snprintf(name, sizeof name, "\\-\\-%s is the same", bl_text_of(option, "also"));
        if (*bl_text_of(option, "also") && !strstr(part, name))
            fail_msg("man/bandlimit.1, %s: --%s is not told", where, bl_text_of(option, "also"));
    }
    if (count_of(part, "\\fB\\-\\-") != json_array_size(options))
        fail_msg("man/bandlimit.1, %s: %zu options, the program has %zu", where,
                 count_of(part, "\\fB\\-\\-"), json_array_size(options));
}

static void test_the_man_page_has_the_options_of_the_program(void **state) {
    (void)state;
    char *man = bl_temporary_read("man/bandlimit.1", NULL);
    assert_non_null(man);
    size_t index;
    json_t *verb;
    json_array_foreach(json_object_get(help, "verbs"), index, verb) {
        char start[64];
        snprintf(start, sizeof start, ".SS %s", bl_text_of(verb, "name"));
        char *part = part_of(man, start, ".SS", ".SH");
        if (!part)
            fail_msg("man/bandlimit.1 has no part '%s'", start);
        expect_options_in_man(part, json_object_get(verb, "options"), start);
        free(part);
    }
    char *common = part_of(man, ".SH COMMON OPTIONS", ".SH", ".SS");
    assert_non_null(common);
    expect_options_in_man(common, json_object_get(help, "common_options"), "COMMON OPTIONS");
    free(common);
    assert_int_equal(count_of(man, "\n.SS "), json_array_size(json_object_get(help, "verbs")));
    free(man);
}

static void test_the_help_of_a_verb_has_its_options(void **state) {
    (void)state;
    size_t index, k;
    json_t *verb, *option;
    json_array_foreach(json_object_get(help, "verbs"), index, verb) {
        bl_ran ran = bl_run_program(bl_text_of(verb, "name"), "--help");
        bl_ran same = bl_run_program("help", bl_text_of(verb, "name"));
        assert_int_equal(ran.status, 0);
        assert_string_equal(ran.out, same.out);
        assert_string_equal(ran.err, "");
        json_t *lists[] = {json_object_get(verb, "options"),
                           json_object_get(help, "common_options")};
        for (int l = 0; l < 2; l++)
            json_array_foreach(lists[l], k, option) {
                char name[96];
                snprintf(name, sizeof name, "--%s", bl_text_of(option, "name"));
                if (!strstr(ran.out, name))
                    fail_msg("the help of %s lacks %s", bl_text_of(verb, "name"), name);
            }
        bl_ran_free(&ran);
        bl_ran_free(&same);
    }
}

static void test_lines_of_help_fit_a_terminal(void **state) {
    (void)state;
    size_t index;
    json_t *verb;
    json_array_foreach(json_object_get(help, "verbs"), index, verb) {
        bl_ran ran = bl_run_program("help", bl_text_of(verb, "name"));
        for (char *rest = NULL, *line = strtok_r(ran.out, "\n", &rest); line;
             line = strtok_r(NULL, "\n", &rest))
            if (strlen(line) > 80)
                fail_msg("help of %s: '%s' is longer than 80", bl_text_of(verb, "name"), line);
        bl_ran_free(&ran);
    }
}

static void test_the_completion_knows_verbs_and_options(void **state) {
    (void)state;
    char *script = bl_temporary_read("completion/bandlimit.bash", NULL);
    assert_non_null(script);
    size_t index, k;
    json_t *verb, *option;
    json_array_foreach(json_object_get(help, "verbs"), index, verb) {
        char word[96];
        if (!strstr(script, bl_text_of(verb, "name")))
            fail_msg("completion lacks the verb %s", bl_text_of(verb, "name"));
        json_t *lists[] = {json_object_get(verb, "options"),
                           json_object_get(help, "common_options")};
        for (int l = 0; l < 2; l++)
            json_array_foreach(lists[l], k, option) {
                snprintf(word, sizeof word, "--%s", bl_text_of(option, "name"));
                if (!strstr(script, word))
                    fail_msg("completion lacks %s", word);
                snprintf(word, sizeof word, "--%s", bl_text_of(option, "also"));
                if (!strstr(script, word))
                    fail_msg("completion lacks %s", word);
            }
    }
    free(script);
}

static void test_bare_help_lists_every_verb(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("--help");
    assert_int_equal(ran.status, 0);
    size_t index;
    json_t *verb;
    json_array_foreach(json_object_get(help, "verbs"), index, verb)
        assert_non_null(strstr(ran.out, bl_text_of(verb, "summary")));
    bl_ran_free(&ran);
}

static void test_version_is_the_same_everywhere(void **state) {
    (void)state;
    bl_ran flag = bl_run_program("--version"), verb = bl_run_program("version");
    assert_int_equal(flag.status, 0);
    assert_string_equal(flag.out, verb.out);
    char expected[64];
    snprintf(expected, sizeof expected, "bandlimit %s\n", bl_text_of(help, "version"));
    assert_true(strncmp(flag.out, expected, strlen(expected)) == 0);
    bl_ran_free(&flag);
    bl_ran_free(&verb);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_man_page_has_the_options_of_the_program),
        cmocka_unit_test(test_the_help_of_a_verb_has_its_options),
        cmocka_unit_test(test_lines_of_help_fit_a_terminal),
        cmocka_unit_test(test_the_completion_knows_verbs_and_options),
        cmocka_unit_test(test_bare_help_lists_every_verb),
        cmocka_unit_test(test_version_is_the_same_everywhere),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, read_help, drop_help);
}
