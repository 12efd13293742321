// SPDX-License-Identifier: MIT
//
// The verb `alias`: its table, its JSON, its files, its cache, and what it refuses.
#include "tests/test.h"

#include <jansson.h>

#include "tests/program.h"
#include "tests/temporary.h"

static json_t *run_json(bl_ran *ran) {
    json_t *object = json_loads(ran->out, 0, NULL);
    if (!object)
        fail_msg("no JSON: %s%s", ran->out, ran->err);
    return object;
}

static double number_of(const json_t *object, const char *key) {
    return json_number_value(json_object_get(object, key));
}

static void test_json_has_a_row_for_each_method(void **state) {
    (void)state;
    static const char *const keys[] = {"alias",         "alias_lower",
                                       "alias_upper",   "blur",
                                       "mse",           "mse_upper",
                                       "psnr_db",       "ssim",
                                       "max_error",     "flicker",
                                       "flicker_lower", "ns_per_sample",
                                       "pops",          "ns_per_sample_lower"};
    bl_ran ran = bl_run_program("alias", "brick", "--view", "plane:height=1,fov=60", "--method",
                                "all", "--size", "24", "--quick", "--json");
    assert_int_equal(ran.status, 0);
    assert_string_equal(ran.err, "");
    json_t *object = run_json(&ran), *rows = json_object_get(object, "rows"), *row;
    assert_string_equal(json_string_value(json_object_get(object, "schema")), "bandlimit.alias/1");
    assert_string_equal(json_string_value(json_object_get(object, "view")), "plane");
    assert_true(json_array_size(rows) >= 4);
    size_t index;
    json_array_foreach(rows, index, row) {
        assert_true(json_is_string(json_object_get(row, "filter")));
        for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
            if (!json_is_number(json_object_get(row, keys[k])))
                fail_msg("row %zu has no number %s", index, keys[k]);
        assert_true(number_of(row, "alias_lower") <= number_of(row, "alias"));
        assert_true(number_of(row, "ns_per_sample") > 0);
    }
    double seen = number_of(object, "seen"); // the horizon is above the middle
    assert_true(seen > 0.5 && seen < 1);
    json_decref(object);
    bl_ran_free(&ran);
}

// The integral leaves less of everything than a point.
static void test_a_filter_is_better_than_none(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("alias", "brick", "--method", "point", "--method", "integral",
                                "--view", "flat:scale=4", "--size", "48x32", "--quick", "--json");
    json_t *object = run_json(&ran), *rows = json_object_get(object, "rows");
    static const char *const keys[] = {"alias", "mse", "flicker", "max_error"};
    for (size_t k = 0; k < 4; k++)
        assert_less(number_of(json_array_get(rows, 1), keys[k]),
                    number_of(json_array_get(rows, 0), keys[k]));
    assert_int_equal((int)number_of(object, "height_pixels"), 32);
    json_decref(object);
    bl_ran_free(&ran);
}

static void test_the_folder_has_images_and_a_table(void **state) {
    (void)state;
    static const char *const names[] = {"alias.csv",          "reference.exr", "reference.png",
                                        "integral.exr",       "integral.png",  "integral-error.exr",
                                        "integral-error.png", "point.exr"};
    char *folder = strdup(bl_temporary_path("pictures"));
    bl_ran ran = bl_run_program("alias", "brick", "--filter", "point", "--method", "integral",
                                "--size", "16", "--quick", "-o", folder); // two names, one list
    assert_int_equal(ran.status, 0);
    assert_non_null(strstr(ran.out, "ns_per_sample"));
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        char *bytes = bl_temporary_read(path, NULL);
        if (!bytes)
            fail_msg("%s is missing", names[i]);
        if (i == 0) {
            assert_non_null(strstr(bytes, "\nfilter,alias,"));
            assert_non_null(strstr(bytes, "\nintegral,"));
        }
        free(bytes);
    }
    bl_ran_free(&ran);
    free(folder);
}

static void test_the_cache_is_used_and_nothing_kept_without_it(void **state) {
    (void)state;
    char *folder = strdup(bl_temporary_path("cache"));
    for (int i = 0; i < 2; i++) {
        bl_ran ran = bl_run_program("alias", "brick", "--method", "point", "--size", "16",
                                    "--quick", "--cache", folder, "--json");
        json_t *object = run_json(&ran);
        assert_int_equal(json_is_true(json_object_get(object, "reference_from_cache")), i);
        json_decref(object);
        bl_ran_free(&ran);
    }
    free(folder);
}

// A file cannot be copied, and has values only within.
static void test_an_image_is_a_texture(void **state) {
    (void)state;
    char *image = strdup(bl_temporary_path("image.exr"));
    bl_ran drawn =
        bl_run_program("render", "gnoise", "--width", "32", "--scale", "8", "-o", image, "-q");
    assert_int_equal(drawn.status, 0);
    bl_ran inside = bl_run_program("alias", image, "--view", "flat:scale=4,x=4,y=4", "--quick",
                                   "--size", "16", "--json");
    json_t *object = run_json(&inside);
    assert_int_equal(inside.status, 0);
    assert_true(json_array_size(json_object_get(object, "rows")) >= 4);
    json_decref(object);
    bl_ran outside =
        bl_run_program("alias", image, "--view", "flat:scale=99", "--quick", "--size", "16");
    assert_int_equal(outside.status, 3);
    assert_non_null(strstr(outside.err, "not finite"));
    bl_ran_free(&drawn);
    bl_ran_free(&inside);
    bl_ran_free(&outside);
    free(image);
}

static void test_bad_words_are_refused_with_what_to_do(void **state) {
    (void)state;
    static const struct {
        const char *option, *word, *says;
        int status;
    } cases[] = {{"--view", "plain", "'plane'", 64},
                 {"--view", "plane:fov=200", "fov", 64},
                 {"--view", "plane:pitch=-80", "sees nothing", 3},
                 {"--method", "integrl", "'integral'", 64},
                 {"--method", "supersample:n=0", "n", 64},
                 {"--size", "0x9", "--size", 64},
                 {"--size", "big", "--size", 64},
                 {"--size", "9000", "4096", 64},
                 {"--pixel", "sinc", "--pixel", 64},
                 {"--cache", "/dev/null/x", "/dev/null", 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        // The last of two equal options wins, and --method gathers.
        bl_ran ran = bl_run_program("alias", "brick", "--size", "8", "--quick", "--method", "point",
                                    cases[i].option, cases[i].word);
        if (ran.status != cases[i].status || !strstr(ran.err, cases[i].says))
            fail_msg("%s %s: status %d, %s", cases[i].option, cases[i].word, ran.status, ran.err);
        assert_string_equal(ran.out, "");
        bl_ran_free(&ran);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_json_has_a_row_for_each_method),
        cmocka_unit_test(test_a_filter_is_better_than_none),
        cmocka_unit_test(test_the_folder_has_images_and_a_table),
        cmocka_unit_test(test_the_cache_is_used_and_nothing_kept_without_it),
        cmocka_unit_test(test_an_image_is_a_texture),
        cmocka_unit_test(test_bad_words_are_refused_with_what_to_do),
    };
    return bl_run_tests(tests);
}
