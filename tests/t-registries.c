// SPDX-License-Identifier: MIT
//
// A walk over all registries: whatever is listed is shown and completed, names are distinct within
// a kind and for `show`, and the nearest word is found for a slip of one letter.
#include "tests/test.h"

#include <jansson.h>

#include "aliasing/method.h"
#include "filters/primitive.h"
#include "reports/figure.h"
#include "score/score.h"
#include "score/trade.h"
#include "sources/source.h"
#include "tests/program.h"
#include "tests/temporary.h"
#include "textures/texture.h"

// The program's own list has the verbs besides.
static const bl_registry *const registries[] = {
    &bl_noises,  &bl_primitives, &bl_filters,    &bl_textures, &bl_sources, &bl_views,
    &bl_methods, &bl_trades,     &bl_properties, &bl_figures,  NULL};

static void test_the_program_lists_every_registry(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("list", "--json");
    json_t *object = json_loads(ran.out, 0, NULL);
    for (size_t r = 0; registries[r]; r++) {
        const json_t *list = json_object_get(object, registries[r]->kinds);
        assert_int_equal(json_array_size(list), registries[r]->count);
        for (size_t i = 0; i < registries[r]->count; i++)
            assert_string_equal(json_string_value(json_object_get(json_array_get(list, i), "name")),
                                bl_registry_entry(registries[r], i)->name);
    }
    assert_true(json_array_size(json_object_get(object, "verbs")) > 10);
    json_decref(object);
    bl_ran_free(&ran);
}

static void expect_text(const json_t *object, const char *key, const char *name) {
    const char *text = json_string_value(json_object_get(object, key));
    if (!text || !*text)
        fail_msg("`show %s` has no %s", name, key);
}

static void test_everything_listed_is_shown(void **state) {
    (void)state;
    bl_ran list = bl_run_program("list", "--json");
    json_t *all = json_loads(list.out, 0, NULL), *things, *thing;
    const char *kinds;
    size_t index;
    json_object_foreach(all, kinds, things) json_array_foreach(things, index, thing) {
        const char *name = json_string_value(json_object_get(thing, "name"));
        if (!name)
            continue; // the arguments
        bl_ran text = bl_run_program("show", name), ran = bl_run_program("show", name, "--json");
        json_t *object = json_loads(ran.out, 0, NULL);
        if (text.status || !strstr(text.out, "\nsource ") || !strstr(text.out, "\nexample "))
            fail_msg("`show %s`: status %d, without a source or an example: %s%s", name,
                     text.status, text.out, text.err);
        expect_text(object, "title", name);
        assert_string_equal(json_string_value(json_object_get(object, "paper")),
                            json_string_value(json_object_get(thing, "paper")));
        expect_text(object, "example", name);
        const char *kind = json_string_value(json_object_get(object, "kind"));
        if (strncmp(kind, kinds, strlen(kind) - 1) != 0) // property, properties
            fail_msg("`show %s` shows a %s, and `list %s` has it", name, kind, kinds);
        json_decref(object);
        bl_ran_free(&text);
        bl_ran_free(&ran);
    }
    json_decref(all);
    bl_ran_free(&list);
}

// Runs "bandlimit VERB ..." as `show` prints it, quickly, with what it writes in the test's folder.
// No word of it is quoted.
static void run_example(const char *name, const char *example) {
    enum { WORDS_MOST = 16 };
    const char *words[WORDS_MOST] = {NULL};
    char *copy = strdup(example), *rest = NULL;
    size_t count = 0;
    assert_non_null(copy);
    assert_string_equal(strtok_r(copy, " ", &rest), "bandlimit");
    for (char *word; (word = strtok_r(NULL, " ", &rest)) && count < WORDS_MOST - 4;) {
        const char *before = count ? words[count - 1] : "";
        int writes = strcmp(before, "-o") == 0 || strcmp(before, "--plot") == 0;
        words[count++] = writes ? bl_temporary_path(word) : word;
    }
    if (strcmp(words[0], "reproduce") == 0) {
        words[count++] = "-o";
        words[count++] = bl_temporary_path("figures");
    }
    words[count++] = "--quick";
    bl_ran ran = bl_run_words(NULL, words);
    if (ran.status > 2) // a verdict that is inconclusive or fails is one
        fail_msg("the example of `show %s`, `%s`: status %d: %s", name, example, ran.status,
                 ran.err);
    bl_ran_free(&ran);
    free(copy);
}

// Those of the sources name a file of the user's and are not run. With SCALE below 1 every
// eighth of the others is.
static void test_every_example_runs(void **state) {
    (void)state;
    size_t index = 0;
    for (size_t r = 0; registries[r]; r++)
        for (size_t i = 0; i < registries[r]->count && registries[r] != &bl_sources; i++) {
            const char *name = bl_registry_entry(registries[r], i)->name;
            if (!bl_test_walk(bl_test_scaled(8, 0) >= 8 || index++ % 8 == 0))
                continue;
            bl_ran ran = bl_run_program("show", name, "--json");
            json_t *object = json_loads(ran.out, 0, NULL);
            run_example(name, json_string_value(json_object_get(object, "example")));
            json_decref(object);
            bl_ran_free(&ran);
        }
}

// `show` takes the names of all kinds, every other position those of fewer.
static void test_all_names_are_distinct(void **state) {
    (void)state;
    for (size_t r = 0; registries[r]; r++)
        for (size_t i = 0; i < registries[r]->count; i++) {
            const char *name = bl_registry_entry(registries[r], i)->name;
            assert_ptr_equal(bl_registry_find(registries[r], name),
                             bl_registry_at(registries[r], i));
            for (size_t q = 0; q < r; q++)
                if (bl_registry_find(registries[q], name))
                    fail_msg("%s is a %s and a %s", name, registries[r]->kind, registries[q]->kind);
        }
    assert_null(bl_registry_find(&bl_filters, "no such name"));
    assert_null(bl_registry_at(&bl_filters, bl_filters.count));
}

// Whether two words differ by one letter, another or one more: two names may be as near to a slip as
// each other, as gnoise and vnoise to qnoise.
static int is_one_letter_off(const char *a, const char *b) {
    while (*a && *a == *b) {
        a++;
        b++;
    }
    return (*a && *b && strcmp(a + 1, b + 1) == 0) || (*a && strcmp(a + 1, b) == 0) ||
           (*b && strcmp(a, b + 1) == 0);
}

static void test_a_slip_of_a_letter_is_answered(void **state) {
    (void)state;
    for (size_t r = 0; registries[r]; r++)
        for (size_t i = 0; i < registries[r]->count; i++) {
            const char *name = bl_registry_entry(registries[r], i)->name;
            size_t length = strlen(name);
            for (size_t at = 0; at < length; at++) {
                char slip[80], meant[80];
                bl_message message = {""};
                snprintf(slip, sizeof slip, "%s", name);
                slip[at] = slip[at] == 'q' ? 'k' : 'q';
                snprintf(meant, sizeof meant, "did you mean '%s'?", name);
                assert_int_equal(bl_registry_report(registries[r], slip, NULL, &message), BL_USAGE);
                char said[128];
                snprintf(said, sizeof said, "unknown %s '%s'; ", registries[r]->kind, slip);
                int answered = strstr(message.text, said) && strstr(message.text, meant);
                for (size_t k = 0; k < registries[r]->count && !answered; k++) {
                    const char *other = bl_registry_entry(registries[r], k)->name;
                    snprintf(meant, sizeof meant, "did you mean '%s'?", other);
                    answered = is_one_letter_off(slip, other) && strstr(message.text, meant);
                }
                if (!answered)
                    fail_msg("%s: %s", slip, message.text);
            }
        }
}

static void test_a_short_list_is_told_and_a_long_one_is_named(void **state) {
    (void)state;
    bl_message message;
    char expected[512] = "unknown view 'xyzzy' of --view; there are flat, plane, sphere, torus";
    assert_string_equal(bl_registry_entry(&bl_views, 3)->name, "torus");
    for (size_t i = 4; i < bl_views.count; i++) {
        size_t used = strlen(expected);
        snprintf(expected + used, sizeof expected - used, ", %s",
                 bl_registry_entry(&bl_views, i)->name);
    }
    bl_registry_report(&bl_views, "xyzzy", " of --view", &message);
    assert_string_equal(message.text, expected);
    bl_registry_report(&bl_figures, "xyzzy", NULL, &message);
    assert_string_equal(message.text, "unknown figure 'xyzzy'; `bandlimit list figures` shows all");
    static const char *const words[] = {"hann", "rectangle", NULL};
    const bl_unknown unknown = {.what = "value", .word = "HAN", .key = "--window", .words = words};
    assert_int_equal(bl_report_unknown(&unknown, &message), BL_USAGE);
    assert_string_equal(message.text,
                        "unknown value '--window HAN'; did you mean 'hann'? There "
                        "are hann, rectangle");
}

// The script takes its words from `list KIND --names`.
static void test_the_completion_asks_for_every_kind(void **state) {
    (void)state;
    char *script = bl_temporary_read("completion/bandlimit.bash", NULL);
    assert_non_null(script);
    assert_non_null(strstr(script, "list \"$1\" --names"));
    for (size_t r = 0; registries[r]; r++) {
        char word[64];
        snprintf(word, sizeof word, "%s", registries[r]->kinds);
        if (!strstr(script, word))
            fail_msg("completion lacks the %s", word);
    }
    free(script);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_program_lists_every_registry),
        cmocka_unit_test(test_everything_listed_is_shown),
        cmocka_unit_test(test_every_example_runs),
        cmocka_unit_test(test_all_names_are_distinct),
        cmocka_unit_test(test_a_slip_of_a_letter_is_answered),
        cmocka_unit_test(test_a_short_list_is_told_and_a_long_one_is_named),
        cmocka_unit_test(test_the_completion_asks_for_every_kind),
    };
    return bl_run_tests(tests);
}
