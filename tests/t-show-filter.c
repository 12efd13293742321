// SPDX-License-Identifier: MIT
//
// `show` of a filter: its numbers and samples are those of the library, and its picture is written
// whole or not at all.
#include "tests/json.h"
#include "tests/program.h"
#include "tests/temporary.h"
#include "tests/test.h"

#include <unistd.h>

#include "filters/response.h"

static void expect_number(const json_t *object, const char *key, double expected) {
    double got = bl_number_of(object, key);
    if (isfinite(expected))
        assert_near(got, expected, 1e-12 * fabs(expected));
    else
        assert_true(isnan(got));
}

static void test_json_has_numbers_and_samples(void **state) {
    (void)state;
    for (size_t f = 0; f < bl_filter_count(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        bl_ran ran = bl_run_program("show", filter->name, "--json");
        assert_int_equal(ran.status, 0);
        json_t *object = json_loads(ran.out, 0, NULL);
        assert_non_null(object);
        assert_string_equal(json_string_value(json_object_get(object, "name")), filter->name);
        bl_filter_numbers n = bl_filter_measure(filter);
        const json_t *numbers = json_object_get(object, "numbers");
        expect_number(numbers, "half_power_cycles_per_width", n.half_power);
        expect_number(numbers, "first_zero_cycles_per_width", n.first_zero);
        expect_number(numbers, "side_lobe_db", 20 * log10(fabs(n.lobe)));
        expect_number(numbers, "overshoot", n.overshoot);
        const json_t *samples = json_object_get(object, "samples");
        const json_t *place = json_object_get(samples, "place");
        assert_true(json_array_size(place) > 100);
        for (size_t i = 0; i < json_array_size(place); i += 7) {
            double x = json_number_value(json_array_get(place, i));
            const char *const keys[] = {"kernel", "step", "ramp", "response"};
            double (*const functions[])(double) = {filter->kernel, filter->step, filter->ramp,
                                                   filter->response};
            for (int k = 0; k < 4; k++) {
                const json_t *list = json_object_get(samples, keys[k]);
                assert_int_equal(json_array_size(list), json_array_size(place));
                assert_near(json_number_value(json_array_get(list, i)), functions[k](x), 1e-15);
            }
        }
        json_decref(object);
        bl_ran_free(&ran);
    }
}

static void test_text_has_the_numbers(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("show", "catmull-rom");
    assert_int_equal(ran.status, 0);
    const char *const said[] = {"-3 dB at         0.404486", "first zero       1\n",
                                "overshoot        0.0417 at 1 widths",
                                "0.50   0.562500   0.919271"}; // 9/16 and 353/384
    for (size_t i = 0; i < sizeof said / sizeof *said; i++)
        if (!strstr(ran.out, said[i]))
            fail_msg("show catmull-rom does not say '%s' but:\n%s", said[i], ran.out);
    bl_ran_free(&ran);
    ran = bl_run_program("show", "gaussian");
    assert_non_null(strstr(ran.out, "without an end"));
    assert_non_null(strstr(ran.out, "first zero       none"));
    bl_ran_free(&ran);
}

static void expect_picture(const char *name, const char *mark) {
    const char *path = bl_temporary_path(name);
    bl_ran ran = bl_run_program("show", "mitchell", "--plot", path);
    if (ran.status != 0)
        fail_msg("%s", ran.err);
    bl_ran_free(&ran);
    FILE *stream = fopen(path, "rb");
    char head[512] = {0};
    assert_non_null(stream);
    size_t got = fread(head, 1, sizeof head - 1, stream);
    fclose(stream);
    assert_true(got > 100);
    assert_non_null(memmem(head, got, mark, strlen(mark)));
}

static void test_the_picture_is_written(void **state) {
    (void)state;
    expect_picture("mitchell.svg", "<svg");
    expect_picture("mitchell.png", "PNG");
    assert_int_equal(bl_temporary_files(), 2);
}

static void test_bad_plots_are_refused(void **state) {
    (void)state;
    size_t before = bl_temporary_files();
    const char *const bad[][2] = {{"gnoise", "x.svg"}, {"box", "x.tif"}, {"bix", "x.svg"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        bl_ran ran = bl_run_program("show", bad[i][0], "--plot", bl_temporary_path(bad[i][1]));
        assert_int_equal(ran.status, 64);
        assert_true(*ran.err);
        bl_ran_free(&ran);
    }
    bl_ran ran = bl_run_program("show", "box", "--plot", bl_temporary_path("none/x.svg"));
    assert_int_equal(ran.status, 4);
    bl_ran_free(&ran);
    assert_int_equal(bl_temporary_files(), before);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_json_has_numbers_and_samples),
        cmocka_unit_test(test_text_has_the_numbers),
        cmocka_unit_test(test_the_picture_is_written),
        cmocka_unit_test(test_bad_plots_are_refused),
    };
    return bl_run_tests(tests);
}
