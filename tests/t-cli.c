// SPDX-License-Identifier: MIT
//
// The verbs: what they print, their JSON, their files, their exit status.
#include "tests/test.h"

#include "spectra/theory.h"

#include <unistd.h>

#include "noises/noise.h"
#include "tests/json.h"
#include "tests/program.h"
#include "tests/temporary.h"

#define RUN_JSON(status, ...)                                                                      \
    bl_run_json(status, (const char *const[]){__VA_ARGS__, "--json", NULL})

static double item_of(const json_t *object, const char *key, size_t index) {
    return json_number_value(json_array_get(json_object_get(object, key), index));
}

static size_t size_of(const json_t *object, const char *key) {
    return json_array_size(json_object_get(object, key));
}

static void expect_head(const json_t *object, const char *schema, const char *first) {
    void *iterator = json_object_iter((json_t *)object);
    const char *const keys[] = {"schema", "version", "arguments"};
    for (int i = 0; i < 3; i++) {
        assert_string_equal(json_object_iter_key(iterator), keys[i]);
        iterator = json_object_iter_next((json_t *)object, iterator);
    }
    assert_string_equal(bl_text_of(object, "schema"), schema);
    assert_string_equal(json_string_value(json_array_get(json_object_get(object, "arguments"), 0)),
                        first);
}

static void test_every_object_starts_with_schema_version_and_arguments(void **state) {
    (void)state;
    static const char *const calls[][4] = {
        {"list"},
        {"show", "gnoise"},
        {"show", "peachey-2.37"},
        {"eval", "gnoise", "1"},
        {"spectrum", "gnoise", "--quick"},
        {"histogram", "gnoise", "--quick"},
        {"help"},
        {"version"},
    };
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        const char *words[6] = {calls[i][0], "--json"};
        for (size_t k = 1; k < 4 && calls[i][k]; k++)
            words[k + 1] = calls[i][k];
        json_t *object = bl_run_json(0, words);
        char schema[64];
        snprintf(schema, sizeof schema, "bandlimit.%s/1", calls[i][0]);
        expect_head(object, schema, calls[i][0]);
        json_decref(object);
    }
}

static void test_an_error_is_an_object_too(void **state) {
    (void)state;
    json_t *object = RUN_JSON(64, "eval", "gnose", "1");
    expect_head(object, "bandlimit.error/1", "eval");
    json_t *error = json_object_get(object, "error");
    assert_int_equal(bl_number_of(error, "status"), 64);
    assert_non_null(strstr(bl_text_of(error, "message"), "gnoise"));
    json_decref(object);
    object = RUN_JSON(4, "eval", "missing.exr", "1");
    assert_int_equal(bl_number_of(json_object_get(object, "error"), "status"), 4);
    json_decref(object);
}

static void test_arguments_that_are_not_text_do_not_break_json(void **state) {
    (void)state;
    json_t *object = RUN_JSON(64, "eval", "\xff\xfe\"\n", "1");
    expect_head(object, "bandlimit.error/1", "eval");
    json_decref(object);
}

static void test_list_has_the_whole_registry(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "list");
    assert_int_equal(size_of(object, "noises"), bl_noise_count());
    json_decref(object);
    bl_ran ran = bl_run_program("list", "noises", "--names");
    char *rest = NULL, *line = strtok_r(ran.out, "\n", &rest);
    for (size_t i = 0; i < bl_noise_count(); i++, line = strtok_r(NULL, "\n", &rest))
        assert_string_equal(line, bl_noise_at(i, BL_ISA_BASELINE)->name);
    assert_null(line);
    bl_ran_free(&ran);
}

static void test_every_noise_can_be_shown_and_evaluated(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        const bl_noise *noise = bl_noise_at(i, BL_ISA_BASELINE);
        json_t *object = RUN_JSON(0, "show", noise->name);
        assert_string_equal(bl_text_of(object, "formula"), noise->formula);
        assert_true(size_of(object, "parameters") > 0);
        json_decref(object);
        object = RUN_JSON(0, "eval", noise->name, "0.3", "-1.7", "12.25");
        assert_near(item_of(object, "values", 0), item_of(object, "reference", 0), 1e-5);
        json_decref(object);
    }
}

static void test_show_tells_the_dimensions_of_the_settings(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "show", "gnoise:dims=4");
    assert_int_equal(json_integer_value(json_object_get(object, "dimensions")), 4);
    json_decref(object);
    object = RUN_JSON(0, "show", "gnoise");
    assert_int_equal(json_integer_value(json_object_get(object, "dimensions")), 3);
    json_decref(object);
}

static void test_points_from_words_and_from_lines_are_the_same(void **state) {
    (void)state;
    const bl_streams streams = {.input = "# a comment\n0.3 1.5 -2\n\n 0.3, 1.5, -2 # again\n1/4"};
    bl_ran words = bl_run_program("eval", "gnoise", "0.3", "1.5", "-2");
    bl_ran quarter = bl_run_program("eval", "gnoise", "0.25");
    bl_ran lines = bl_run_words(&streams, (const char *const[]){"eval", "gnoise", NULL});
    char expected[256];
    snprintf(expected, sizeof expected, "%s%s%s", words.out, words.out, quarter.out);
    assert_string_equal(lines.out, expected);
    assert_int_equal(lines.status, 0);
    bl_ran_free(&words);
    bl_ran_free(&quarter);
    bl_ran_free(&lines);
}

static void test_eval_of_nothing_is_nothing(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("eval", "gnoise");
    assert_int_equal(ran.status, 0);
    assert_string_equal(ran.out, "");
    bl_ran_free(&ran);
}

static void test_seed_replaces_the_seed_of_the_signal(void **state) {
    (void)state;
    bl_ran option = bl_run_program("eval", "gnoise", "0.3", "--seed", "18446744073709551615");
    bl_ran key = bl_run_program("eval", "gnoise:seed=18446744073709551615", "0.3");
    bl_ran plain = bl_run_program("eval", "gnoise", "0.3");
    assert_string_equal(option.out, key.out);
    assert_string_not_equal(option.out, plain.out);
    bl_ran_free(&option);
    bl_ran_free(&key);
    bl_ran_free(&plain);
}

static void test_threads_and_instruction_sets_give_the_same_bits(void **state) {
    (void)state;
    static const char *const sets[] = {"baseline", "v3", "v4"};
    json_t *first =
        RUN_JSON(0, "spectrum", "gnoise", "--quick", "--threads", "1", "--isa", "baseline");
    for (int i = 0; i < BL_ISA_COUNT; i++) {
        if (!bl_isa_runs_here((bl_isa)i))
            continue;
        json_t *other =
            RUN_JSON(0, "spectrum", "gnoise", "--quick", "--threads", "3", "--isa", sets[i]);
        assert_true(json_equal(json_object_get(first, "psd"), json_object_get(other, "psd")));
        json_decref(other);
    }
    json_decref(first);
}

// Of a volume of wide bins: what the window makes of a share, and the share itself, which t-theory
// holds against sums over the density.
static void test_shares_have_an_exact_theory_beside_the_windowed_one(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "spectrum", "gnoise", "--dims", "3", "--size", "32", "--average",
                              "4", "--band", "0.3:0.7");
    const json_t *band = json_array_get(json_object_get(object, "bands"), 0);
    bl_signal *noise = NULL;
    assert_int_equal(bl_noise_open("gnoise", BL_ISA_BEST, &noise, NULL), BL_OK);
    double axes[3][BL_AXES] = {{1}, {0, 1}, {0, 0, 1}};
    double exact = bl_theory_band(noise, 3, (const double(*)[BL_AXES])axes, 0.3, 0.7);
    assert_near(bl_number_of(band, "theory_exact"), exact, 1e-12);
    assert_less(bl_number_of(band, "theory"), exact - 0.02);
    json_decref(object);
    object = RUN_JSON(0, "spectrum", "gnoise", "--quick", "--place", "lattice");
    band = json_array_get(json_object_get(object, "bands"), 0);
    assert_true(json_is_null(json_object_get(band, "theory_exact")));
    json_decref(object);
    bl_signal_free(noise);
}

static void test_a_spectrum_keeps_its_sums(void **state) {
    (void)state;
    const char *csv = bl_temporary_path("spectrum.csv");
    json_t *object = RUN_JSON(0, "spectrum", "gnoise", "--quick", "--band", "0:inf", "--band",
                              "0.5:1", "-o", csv);
    size_t count = size_of(object, "frequency"), rows = 0, headers = 0;
    const char *const arrays[] = {"psd", "lower", "upper", "dof_per_bin"};
    for (int i = 0; i < 4; i++)
        assert_int_equal(size_of(object, arrays[i]), count);
    for (size_t i = 1; i < count; i++)
        assert_true(item_of(object, "lower", i) <= item_of(object, "psd", i) &&
                    item_of(object, "psd", i) <= item_of(object, "upper", i));
    assert_less(bl_number_of(object, "parseval_residual"), 1e-12);
    json_t *bands = json_object_get(object, "bands");
    assert_int_equal(json_array_size(bands), 2);
    assert_near(bl_number_of(json_array_get(bands, 0), "fraction"), 1, 1e-9);
    assert_true(json_is_null(json_object_get(json_array_get(bands, 0), "to")));
    char *text = bl_temporary_read(csv, NULL), *rest = NULL;
    assert_non_null(text);
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        headers += strncmp(line, "frequency,psd,lower,upper,theory", 32) == 0;
        rows += *line >= '0' && *line <= '9';
    }
    assert_int_equal(headers, 1);
    assert_int_equal(rows, count);
    free(text);
    json_decref(object);
    unlink(csv);
}

static void test_slices_and_volumes_have_rings(void **state) {
    (void)state;
    static const char *const dims[] = {"2", "3"};
    for (int i = 0; i < 2; i++) {
        json_t *object =
            RUN_JSON(0, "spectrum", "gnoise", "--dims", dims[i], "--size", "32", "--average", "3");
        assert_int_equal(size_of(object, "anisotropy_db"), size_of(object, "frequency"));
        json_decref(object);
    }
}

static void test_the_verdict_is_the_exit_status(void **state) {
    (void)state;
    json_t *pass = RUN_JSON(0, "check", "gnoise", "--quick", "--band", "0:2", "--leak", "-3");
    json_t *fail = RUN_JSON(2, "check", "gnoise", "--quick", "--band", "3:4", "--leak", "-20");
    assert_string_equal(bl_text_of(pass, "verdict"), "pass");
    assert_string_equal(bl_text_of(fail, "verdict"), "fail");
    assert_int_equal(bl_number_of(fail, "exit_status"), 2);
    char limit[32];
    snprintf(limit, sizeof limit, "%.6f", bl_number_of(pass, "leak_db"));
    json_t *between = RUN_JSON(1, "check", "gnoise", "--quick", "--band", "0:2", "--leak", limit);
    assert_string_equal(bl_text_of(between, "verdict"), "inconclusive");
    assert_true(bl_number_of(between, "lower_db") < bl_number_of(between, "limit_db") &&
                bl_number_of(between, "limit_db") < bl_number_of(between, "upper_db"));
    // One of the two is what settles it.
    assert_true((bl_number_of(between, "needed_averages") > 0) !=
                (bl_number_of(between, "needed_size") > 0));
    json_decref(pass);
    json_decref(fail);
    json_decref(between);
}

static void test_a_histogram_counts_every_sample(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "histogram", "gnoise", "--quick", "--bins", "10");
    json_t *narrow = RUN_JSON(0, "histogram", "gnoise", "--quick", "--range", "0:0.1");
    json_t *const both[] = {object, narrow};
    assert_int_equal(size_of(object, "counts"), 10);
    for (int i = 0; i < 2; i++) {
        double sum = bl_number_of(both[i], "outside");
        for (size_t k = 0; k < size_of(both[i], "counts"); k++)
            sum += item_of(both[i], "counts", k);
        assert_true(sum == bl_number_of(both[i], "samples"));
        assert_int_equal(size_of(both[i], "bins"), size_of(both[i], "counts") + 1);
    }
    assert_true(bl_number_of(object, "min") < bl_number_of(object, "max"));
    assert_true(bl_number_of(narrow, "outside") > 0);
    json_decref(object);
    json_decref(narrow);
}

// Pixel (i, j) of a slice stands at the centre plus (i - (w-1)/2, j - (h-1)/2) spacings.
static void test_a_rendered_image_holds_the_values(void **state) {
    (void)state;
    const char *path = bl_temporary_path("slice.exr");
    json_t *object = RUN_JSON(0, "render", "gnoise", "--width", "8", "--height", "6", "--scale",
                              "4", "--at", "0.3,0.4,0.5", "-o", path);
    assert_near(bl_number_of(object, "spacing_units"), 0.5, 0);
    json_decref(object);
    json_t *pixel = RUN_JSON(0, "eval", path, "0.5", "1");
    json_t *value = RUN_JSON(0, "eval", "gnoise", "-0.95", "0.15", "0.5");
    assert_near(item_of(pixel, "values", 0), item_of(value, "values", 0), 1e-6);
    json_decref(pixel);
    json_decref(value);
    bl_ran ran = bl_run_program("eval", path, "-5", "0");
    assert_string_equal(ran.out, "nan\n");
    bl_ran_free(&ran);
    unlink(path);
    assert_int_equal(bl_temporary_files(), 0);
}

// Black and white as a PNG takes them when nobody says. The bounds are those the noises state: a
// distance and a sum of sizes begin at 0, gabor's bound is a hundred times its values.
static void test_a_png_spans_what_the_signal_states(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double black, white;
    } cases[] = {{"gnoise", -1, 1},
                 {"vnoise", -1, 1},
                 {"rayshade", 0, 1},
                 {"cellular", 0, 1.7320508075688772},
                 {"gabor", -4 * 0.49953, 4 * 0.49953}};
    const char *path = bl_temporary_path("span.png");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        json_t *object =
            RUN_JSON(0, "render", cases[i].text, "--width", "64", "--scale", "16", "-o", path);
        assert_near(item_of(object, "range", 0), cases[i].black, 1e-3);
        assert_near(item_of(object, "range", 1), cases[i].white, 1e-3);
        // Four deviations leave out few, and so do the crests of a spline beyond 1; the range is
        // used.
        assert_less(bl_number_of(object, "clipped"), 64 * 64 * 0.02);
        double span = item_of(object, "range", 1) - item_of(object, "range", 0);
        assert_true(bl_number_of(object, "max") - bl_number_of(object, "min") > 0.35 * span);
        json_decref(object);
    }
    json_t *given = RUN_JSON(0, "render", "rayshade", "--width", "8", "--range=-2:3", "-o", path);
    assert_near(item_of(given, "range", 0), -2, 0);
    json_decref(given);
    // What was rendered is an image of 0 to 1 itself, and an EXR of a noise keeps its signs.
    json_t *again =
        RUN_JSON(0, "render", path, "--width", "8", "-o", bl_temporary_path("again.png"));
    assert_near(item_of(again, "range", 0), 0, 0);
    assert_near(item_of(again, "range", 1), 1, 0);
    json_decref(again);
    json_decref(
        RUN_JSON(0, "render", "gnoise", "--width", "32", "-o", bl_temporary_path("signs.exr")));
    json_t *signs = RUN_JSON(0, "render", bl_temporary_path("signs.exr"), "-o", path);
    assert_near(item_of(signs, "range", 0), -1, 0);
    json_decref(signs);
    unlink(path), unlink(bl_temporary_path("again.png")), unlink(bl_temporary_path("signs.exr"));
}

static double channel_at(const char *path, const char *channel) {
    char text[512];
    snprintf(text, sizeof text, "%s:spacing=1%s%s", path, *channel ? ",channel=" : "", channel);
    json_t *pixel = RUN_JSON(0, "eval", text, "0", "0");
    double value = item_of(pixel, "values", 0);
    json_decref(pixel);
    return value;
}

// One pixel in the middle of a brick: linear in EXR, by the curve of sRGB in PNG, and a value as
// any other if a component is named.
static void test_a_texture_is_rendered_in_colour(void **state) {
    (void)state;
    static const struct {
        const char *signal, *file, *channel;
        double expected;
    } cases[] = {{"brick", "b.exr", "R", 0.5},
                 {"brick", "b.exr", "B", 0.14},
                 {"brick", "b.png", "R", 0.735357}, // 1.055 * 0.5^(1/2.4) - 0.055
                 {"brick", "b.png", "G", 0.424697}, // of 0.15
                 {"brick:component=blue", "b.exr", "", 0.14},
                 {"brick:component=blue", "b.png", "", 0.14},
                 {"brick:width=1e6,filter=exact", "b.exr", "G", 0.5 - 0.35 * 0.25 * 0.08 / 0.0234}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *path = bl_temporary_path(cases[i].file);
        json_t *object = RUN_JSON(0, "render", cases[i].signal, "--width", "1", "--at",
                                  "0.13,0.045", "-o", path);
        assert_string_equal(bl_text_of(object, "colour"),
                            *cases[i].channel ? "linear sRGB" : "none");
        json_decref(object);
        assert_near(channel_at(path, cases[i].channel), cases[i].expected, 0.0021);
        unlink(path);
    }
    bl_ran ran =
        bl_run_program("render", "brick", "--components", "3", "-o", bl_temporary_path("b.exr"));
    assert_int_equal(ran.status, 3);
    bl_ran_free(&ran);
    assert_int_equal(bl_temporary_files(), 0);
}

static void test_a_report_goes_to_the_file_and_to_nowhere_else(void **state) {
    (void)state;
    const char *text = bl_temporary_path("list.txt"), *json = bl_temporary_path("check.json");
    bl_ran plain = bl_run_program("list"), file = bl_run_program("list", "-o", text);
    char *read = bl_temporary_read(text, NULL);
    assert_string_equal(read, plain.out);
    assert_string_equal(file.out, "");
    bl_ran verdict = bl_run_program("check", "gnoise", "--quick", "--band", "3:4", "-o", json);
    assert_int_equal(verdict.status, 2);
    assert_string_equal(verdict.out, "");
    json_t *object = json_load_file(json, 0, NULL);
    assert_string_equal(bl_text_of(object, "verdict"), "fail");
    json_decref(object);
    free(read);
    bl_ran_free(&plain);
    bl_ran_free(&file);
    bl_ran_free(&verdict);
    unlink(text), unlink(json);
}

static void test_quiet_leaves_the_exit_status_alone(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("check", "gnoise", "--quick", "--band", "3:4", "--quiet");
    assert_int_equal(ran.status, 2);
    assert_string_equal(ran.out, "");
    assert_string_equal(ran.err, "");
    bl_ran_free(&ran);
}

static void test_the_benchmark_has_its_rows(void **state) {
    (void)state;
    json_t *object = RUN_JSON(0, "bench", "gnoise", "--quick"), *row;
    size_t index, along = 0, scattered = 0;
    json_array_foreach(json_object_get(object, "rows"), index, row) {
        if (strcmp(bl_text_of(row, "signal"), "gnoise") != 0)
            continue;
        along += strncmp(bl_text_of(row, "path"), "row-", 4) == 0;
        scattered += strcmp(bl_text_of(row, "path"), "points") == 0;
        assert_true(bl_number_of(row, "ns_per_sample") > 0);
        assert_true(bl_number_of(row, "ns_per_sample") <=
                    bl_number_of(row, "ns_per_sample_median"));
        assert_less(bl_number_of(row, "max_error"), 1e-5);
    }
    assert_int_equal(along, 6);
    assert_int_equal(scattered, 1);
    json_decref(object);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_object_starts_with_schema_version_and_arguments),
        cmocka_unit_test(test_an_error_is_an_object_too),
        cmocka_unit_test(test_arguments_that_are_not_text_do_not_break_json),
        cmocka_unit_test(test_list_has_the_whole_registry),
        cmocka_unit_test(test_every_noise_can_be_shown_and_evaluated),
        cmocka_unit_test(test_show_tells_the_dimensions_of_the_settings),
        cmocka_unit_test(test_points_from_words_and_from_lines_are_the_same),
        cmocka_unit_test(test_eval_of_nothing_is_nothing),
        cmocka_unit_test(test_seed_replaces_the_seed_of_the_signal),
        cmocka_unit_test(test_threads_and_instruction_sets_give_the_same_bits),
        cmocka_unit_test(test_shares_have_an_exact_theory_beside_the_windowed_one),
        cmocka_unit_test(test_a_spectrum_keeps_its_sums),
        cmocka_unit_test(test_slices_and_volumes_have_rings),
        cmocka_unit_test(test_the_verdict_is_the_exit_status),
        cmocka_unit_test(test_a_histogram_counts_every_sample),
        cmocka_unit_test(test_a_rendered_image_holds_the_values),
        cmocka_unit_test(test_a_png_spans_what_the_signal_states),
        cmocka_unit_test(test_a_texture_is_rendered_in_colour),
        cmocka_unit_test(test_a_report_goes_to_the_file_and_to_nowhere_else),
        cmocka_unit_test(test_quiet_leaves_the_exit_status_alone),
        cmocka_unit_test(test_the_benchmark_has_its_rows),
    };
    return bl_run_tests(tests);
}
