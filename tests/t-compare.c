// SPDX-License-Identifier: MIT
//
// The verb `compare`: every figure of the comparison for signals of different kinds, numbers that
// agree with those of the other verbs, and what it refuses.
#include "tests/test.h"

#include <jansson.h>
#include <unistd.h>

#include "tests/program.h"
#include "tests/temporary.h"

static json_t *run_json(const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    json_error_t error;
    json_t *object = json_loads(ran.out, 0, &error);
    if (ran.status != 0 || !object)
        fail_msg("status %d, %s: %s", ran.status, error.text, ran.err);
    bl_ran_free(&ran);
    return object;
}
#define RUN_JSON(...) run_json((const char *const[]){__VA_ARGS__, NULL})

// The number in a column of the row of a CSV file that begins with `word`.
static double csv_number(const char *path, const char *word, const char *column) {
    char *text = bl_temporary_read(path, NULL), *rest = text, *line;
    double value = NAN;
    size_t wanted = 0;
    assert_non_null(text);
    while ((line = strsep(&rest, "\n"))) {
        if (*line == '#' || !*line)
            continue;
        int head = strncmp(line, "signal,", 7) == 0;
        if (!head && strncmp(line, word, strlen(word)) != 0)
            continue;
        char *field;
        for (size_t n = 0; (field = strsep(&line, ",")); n++) {
            if (head && strcmp(field, column) == 0)
                wanted = n;
            if (!head && n == wanted)
                value = atof(field);
        }
    }
    free(text);
    return value;
}

static void test_all_figures_are_made_for_noises_and_images(void **state) {
    (void)state;
    char image[300], folder[300], path[400];
    snprintf(image, sizeof image, "%s", bl_temporary_path("tile.exr"));
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("compared"));
    bl_ran made =
        bl_run_program("render", "vnoise", "--width", "128", "--scale", "16", "-o", image);
    assert_int_equal(made.status, 0);
    bl_ran_free(&made);
    json_t *object = RUN_JSON("compare", "gnoise", "vnoise:interp=linear", image, "--quick", "-o",
                              folder, "--json");
    json_t *figures = json_object_get(object, "figures");
    assert_int_equal(json_array_size(figures), 4);
    size_t index, n;
    json_t *figure, *file;
    json_array_foreach(figures, index, figure) {
        json_t *files = json_object_get(figure, "files");
        assert_true(json_array_size(files) >= 4);
        json_array_foreach(files, n, file) {
            snprintf(path, sizeof path, "%s/%s",
                     json_string_value(json_object_get(figure, "folder")), json_string_value(file));
            if (access(path, R_OK) != 0)
                fail_msg("%s is missing", path);
        }
    }
    json_decref(object);
    snprintf(path, sizeof path, "%s/index.html", folder);
    assert_int_equal(access(path, R_OK), 0);
}

static void test_its_numbers_are_those_of_the_other_verbs(void **state) {
    (void)state;
    char folder[300], path[400];
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("numbers"));
    json_t *whole = RUN_JSON("compare", "gnoise", "--quick", "-o", folder, "--json");
    json_t *warnings = json_object_get(whole, "warnings");
    assert_true(json_is_array(warnings) && json_array_size(warnings) == 0);
    json_decref(whole);
    snprintf(path, sizeof path, "%s/compare-spectrum/shares.csv", folder);
    double share = csv_number(path, "gnoise", "above_1");
    json_t *object =
        RUN_JSON("spectrum", "gnoise", "--average", "192", "--band", "1:inf", "--json");
    json_t *band = json_array_get(json_object_get(object, "bands"), 0);
    double other = json_real_value(json_object_get(band, "fraction"));
    json_decref(object);
    assert_near(share, other, 1e-7);
    snprintf(path, sizeof path, "%s/compare-histogram/histograms.csv", folder);
    double lower = csv_number(path, "gnoise", "bound_lower");
    double minimum = csv_number(path, "gnoise", "minimum");
    assert_true(lower <= minimum && minimum < -0.5);
    // Slices: x to the right, y downwards.
    snprintf(path, sizeof path, "%s/compare-slice/gnoise-between.exr", folder);
    object = RUN_JSON("eval", path, "3.25", "1.5", "--json");
    json_t *value =
        RUN_JSON("eval", "gnoise:seed=1", "3.25", "1.5", "0.381966", "0.618034", "--json");
    assert_near(json_real_value(json_array_get(json_object_get(object, "values"), 0)),
                json_real_value(json_array_get(json_object_get(value, "values"), 0)), 1e-7);
    json_decref(object);
    json_decref(value);
}

static void test_a_program_gets_the_seed_where_its_words_have_it(void **state) {
    (void)state;
    char folder[300], text[400];
    const char *build = getenv("BL_BUILD");
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("program"));
    snprintf(text, sizeof text, "cmd:%s/tests/plugins/child saw {seed}", build ? build : "build");
    json_decref(RUN_JSON("compare", text, "--quick", "--seed", "4", "-o", folder, "--json"));
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("program/compare-line/graphs.csv"));
    char *graphs = bl_temporary_read(folder, NULL);
    assert_non_null(graphs);
    assert_non_null(strstr(graphs, "cmd,seed=4:")); // the setting
    assert_null(strstr(graphs, "seed=4,"));         // of which the words know nothing
    free(graphs);
}

static const char *function(const char *name) {
    static char text[400];
    const char *build = getenv("BL_BUILD");
    snprintf(text, sizeof text, "%s/tests/plugins/functions.so:%s", build ? build : "build", name);
    return text;
}

// Fails unless a file of the folder has the words.
static void expect_in(const char *folder, const char *name, const char *words) {
    char path[400];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *text = bl_temporary_read(path, NULL);
    assert_non_null(text);
    if (!strstr(text, words))
        fail_msg("%s lacks '%s'", name, words);
    free(text);
}

static void test_a_constant_has_graphs_and_a_reason_for_what_it_lacks(void **state) {
    (void)state;
    static const char *const expected[] = {"no histogram of", "no spectrum along a line of",
                                           "no spectrum in a slice of", "it is constant"};
    char folder[300], path[400];
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("constant"));
    json_decref(RUN_JSON("compare", function("constant"), "--quick", "-o", folder, "--json"));
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        expect_in(folder, "index.html", expected[i]);
    expect_in(folder, "compare-line/graphs.gp", "set yrange [-0.899999999:1.1]");
    snprintf(path, sizeof path, "%s/compare-histogram/histograms.svg", folder);
    assert_int_not_equal(access(path, F_OK), 0); // no empty picture
}

static void test_the_legend_has_the_closed_form_that_a_later_panel_shows(void **state) {
    (void)state;
    char folder[300];
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("legend"));
    json_decref(RUN_JSON("compare", function("full"), "gnoise", "--quick", "-o", folder, "--json"));
    expect_in(folder, "compare-spectrum/spectra-line.gp", "closed form");
    expect_in(folder, "index.html", "closed form</span>");
}

static void test_what_is_no_number_is_told_before_anything_is_made(void **state) {
    (void)state;
    const char *folder = bl_temporary_path("nowhere");
    bl_ran ran = bl_run_program("compare", "gnoise", function("nowhere"), "--quick", "-o", folder);
    assert_int_equal(ran.status, 3);
    assert_non_null(strstr(ran.err, "functions.so:nowhere' gives nan at ("));
    assert_int_not_equal(access(folder, F_OK), 0);
    bl_ran_free(&ran);
}

static void test_bad_words_leave_nothing(void **state) {
    (void)state;
    const char *folder = bl_temporary_path("none");
    bl_ran ran = bl_run_program("compare", "gnoise", "gnoize", "--quick", "-o", folder);
    assert_int_equal(ran.status, 64);
    assert_non_null(strstr(ran.err, "gnoise"));
    bl_ran_free(&ran);
    ran = bl_run_program("compare");
    assert_int_equal(ran.status, 64);
    bl_ran_free(&ran);
    ran = bl_run_program("compare", "missing.exr", "--quick", "-o", folder);
    assert_int_equal(ran.status, 4);
    assert_int_not_equal(access(folder, F_OK), 0);
    bl_ran_free(&ran);
}

// In the program's words, in its object, in those of the figures and on the page.
static void test_a_signal_finer_than_the_figures_is_told(void **state) {
    (void)state;
    char folder[300], path[400];
    snprintf(folder, sizeof folder, "%s", bl_temporary_path("fine"));
    bl_ran ran = bl_run_program("compare", function("fine"), "--quick", "-o", folder, "--json");
    assert_int_equal(ran.status, 0);
    json_t *object = json_loads(ran.out, 0, NULL), *list = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(list), 4); // a line, a slice, and the spectra of both
    for (size_t i = 0; i < 4; i++)
        assert_non_null(strstr(ran.err, json_string_value(json_array_get(list, i))));
    assert_non_null(strstr(ran.err, "--dims 1 --rate 256` would do"));
    snprintf(path, sizeof path, "%s/index.html", folder);
    char *page = bl_temporary_read(path, NULL);
    assert_non_null(strstr(page, "<strong>Warning:</strong> 16 samples a unit do not resolve"));
    free(page);
    json_decref(object);
    bl_ran_free(&ran);
    // The slice of a texture that has an exact average is that.
    snprintf(path, sizeof path, "%s", bl_temporary_path("filtered"));
    json_decref(RUN_JSON("compare", "checkerboard:size=1/64", "--quick", "-o", path, "--json"));
    snprintf(path, sizeof path, "%s",
             bl_temporary_path("filtered/compare-slice/checkerboard-size-0-015625-plane.exr"));
    object = RUN_JSON("histogram", path, "--json");
    assert_less(json_real_value(json_object_get(object, "max")) -
                    json_real_value(json_object_get(object, "min")),
                1e-6);
    json_decref(object);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_figures_are_made_for_noises_and_images),
        cmocka_unit_test(test_its_numbers_are_those_of_the_other_verbs),
        cmocka_unit_test(test_a_program_gets_the_seed_where_its_words_have_it),
        cmocka_unit_test(test_a_constant_has_graphs_and_a_reason_for_what_it_lacks),
        cmocka_unit_test(test_the_legend_has_the_closed_form_that_a_later_panel_shows),
        cmocka_unit_test(test_what_is_no_number_is_told_before_anything_is_made),
        cmocka_unit_test(test_bad_words_leave_nothing),
        cmocka_unit_test(test_a_signal_finer_than_the_figures_is_told),
    };
    return bl_run_tests(tests);
}
