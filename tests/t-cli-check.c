// SPDX-License-Identifier: MIT
//
// What the program refuses to judge, what it records of a seed, and what it says where a number is
// not known.
#include "tests/test.h"

#include <jansson.h>
#include <unistd.h>

#include "tests/program.h"
#include "tests/temporary.h"

// Fails unless the program ends so and says that.
static void expect(int status, const char *says, const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    if (ran.status != status || !(strstr(ran.err, says) || strstr(ran.out, says)))
        fail_msg("%s %s %s: status %d, expected %d and '%s': %s%s", words[0],
                 words[1] ? words[1] : "", words[1] && words[2] ? words[2] : "", ran.status, status,
                 says, ran.err, ran.out);
    bl_ran_free(&ran);
}
#define EXPECT(status, says, ...) expect(status, says, (const char *const[]){__VA_ARGS__, NULL})

// Makes an image of the noise, 64 x 32 pixels with 8 to a unit; the path is of a static buffer.
static const char *make_image(const char *name) {
    const char *path = bl_temporary_path(name);
    EXPECT(0, "64 x 32", "render", "gnoise", "--width", "64", "--height", "32", "--scale", "8",
           "-o", path);
    return path;
}

static void test_check_refuses_where_there_is_nothing_to_judge(void **state) {
    (void)state;
    const char *image = make_image("judge.exr");
    char coarse[300];
    snprintf(coarse, sizeof coarse, "%s:spacing=1", image);
    EXPECT(3, "nothing is left", "check", coarse);
    EXPECT(3, "nothing is left", "check", "gnoise", "--quick", "--rate", "2");
    EXPECT(3, "nothing is left", "check", "gnoise", "--quick", "--band", "0:inf");
    EXPECT(3, "nothing is left", "check", "gnoise", "--quick", "--band", "0.001:inf");
    EXPECT(3, "nothing is left", "check", "gnoise", "--quick", "--guard", "100");
    EXPECT(3, "begins beyond", "check", "gnoise", "--quick", "--band", "9:10");
    EXPECT(2, "fail", "check", "gnoise", "--quick", "--band", "3:100");
    EXPECT(3, "nothing is left", "check", "gnoise", "--quick", "--rate", "2", "--json");
    unlink(image);
}

static void test_a_constant_has_no_verdict_and_no_nan(void **state) {
    (void)state;
    // A coordinate takes the nearest pixel, so a slice within one pixel is constant.
    const char *image = make_image("source.exr"), *flat = bl_temporary_path("flat.exr");
    EXPECT(0, "64 x 64", "render", image, "--width", "64", "--height", "64", "--scale", "0.01",
           "--at", "4,2", "-o", flat);
    EXPECT(3, "constant", "check", flat);
    bl_ran ran = bl_run_program("histogram", flat);
    assert_int_equal(ran.status, 0);
    assert_non_null(strstr(ran.out, "skewness  not known"));
    assert_null(strstr(ran.out, "nan"));
    assert_null(strstr(ran.out, "inf"));
    bl_ran_free(&ran);
    EXPECT(0, "\"skewness\": null", "histogram", flat, "--json");
    unlink(image), unlink(flat);
}

static void test_a_seed_is_recorded_and_a_second_one_refused(void **state) {
    (void)state;
    EXPECT(64, "contradict", "eval", "gnoise:seed=7", "0.3", "--seed", "8");
    EXPECT(64, "contradict", "eval", "gnoise:seed=0", "0.3", "--seed", "8");
    EXPECT(64, "contradict", "render", "gnoise:seed=7", "--seed", "8", "-o", "/tmp/never.exr");
    EXPECT(0, "\"gnoise:seed=7\"", "eval", "gnoise:seed=0x7", "0.3", "--seed", "7", "--json");
    EXPECT(0, "\"signal\": \"gnoise:seed=8\"", "eval", "gnoise", "0.3", "--seed", "8", "--json");
    EXPECT(0, "fade=quintic", "eval", "gnoise:fade=quintic", "0.3", "--seed", "8", "--json");
    EXPECT(0, "\"signal\": \"gnoise\"", "eval", "gnoise", "0.3", "--seed", "0", "--json");
}

static void test_an_image_says_what_of_it_was_measured(void **state) {
    (void)state;
    const char *image = make_image("rows.exr");
    EXPECT(0, "all 32 rows of the image", "spectrum", image);
    EXPECT(0, "all 64 columns of the image", "spectrum", image, "--axis", "y");
    EXPECT(0, "5 of the 32 rows of the image", "spectrum", image, "--average", "5");
    EXPECT(0, "--average 1000 is more than there is", "spectrum", image, "--average", "1000");
    EXPECT(0, "up to 4 cycles per unit", "spectrum", image);
    EXPECT(0, "beyond what was measured", "spectrum", image, "--band", "5:6");
    EXPECT(3, "--place", "spectrum", image, "--place", "random");
    EXPECT(0, "\"place\": \"grid\"", "spectrum", image, "--json");
    EXPECT(3, "outside", "render", image, "--at", "100,100", "-o", bl_temporary_path("none.png"));
    assert_true(access(bl_temporary_path("none.png"), F_OK) != 0);
    unlink(image);
}

static void test_an_output_is_tried_before_measuring(void **state) {
    (void)state;
    const char *folder = bl_temporary_folder(), *missing = bl_temporary_path("no/such/folder.csv");
    static const char *const verbs[] = {"spectrum", "histogram", "check", "bench"};
    for (size_t i = 0; i < sizeof verbs / sizeof *verbs; i++) {
        // --full would take hours.
        EXPECT(4, "it is a folder", verbs[i], "gnoise", "--full", "-o", folder);
        EXPECT(4, "cannot write", verbs[i], "gnoise", "--full", "-o", missing);
    }
    EXPECT(4, "no/such", "render", "gnoise", "-o", bl_temporary_path("no/such/folder.png"));
    assert_int_equal(bl_temporary_files(), 0);
}

static void test_a_dash_is_standard_output(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("histogram", "gnoise", "--quick", "-o", "-");
    assert_int_equal(ran.status, 0);
    assert_true(strncmp(ran.out, "# bandlimit histogram", 21) == 0);
    assert_null(strstr(ran.out, "skewness"));
    bl_ran_free(&ran);
    EXPECT(0, "gnoise", "list", "-o", "-");
    EXPECT(64, "-o -", "render", "gnoise", "-o", "-");
    EXPECT(64, "-o -", "reproduce", "-o", "-");
    EXPECT(64, "leave one out", "histogram", "gnoise", "-o", "-", "--json");
    assert_true(access("-", F_OK) != 0);
}

static void test_points_have_one_comma_between_them(void **state) {
    (void)state;
    static const char *const bad[] = {".5,,.2\n", ",1\n", "1,\n", "1;2\n", "1 , , 2\n", ",\n"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const bl_streams streams = {.input = bad[i]};
        bl_ran ran = bl_run_words(&streams, (const char *const[]){"eval", "gnoise", NULL});
        if (ran.status != 64 || !strstr(ran.err, "line 1"))
            fail_msg("'%s': status %d: %s", bad[i], ran.status, ran.err);
        bl_ran_free(&ran);
    }
}

static void test_errors_hold_no_control_bytes(void **state) {
    (void)state;
    bl_ran ran = bl_run_program("eval", "gnoise", "\x1b[31m\x9b\xc2\x9b\x7f\xc3\xa9");
    assert_int_equal(ran.status, 64);
    assert_non_null(strstr(ran.err, "\\x1b[31m\\x9b\\xc2\\x9b\\x7f\xc3\xa9"));
    bl_ran_free(&ran);
}

static void test_a_name_typed_as_a_verb_is_shown_the_way(void **state) {
    (void)state;
    EXPECT(64, "`bandlimit show gnoise`", "gnoise");
    EXPECT(64, "`bandlimit show gnoise:seed=3`", "GNOISE:seed=3");
    EXPECT(64, "did you mean 'spectrum'?", "SPECTRUM");
    EXPECT(64, "'--bits 12'", "render", "gnoise", "--bits", "12", "-o", "/tmp/never.png");
}

static void test_the_autocorrelation_starts_with_the_variance(void **state) {
    (void)state;
    bl_ran ran =
        bl_run_program("spectrum", "gnoise", "--quick", "--autocorrelation", "2", "--json");
    json_t *object = json_loads(ran.out, 0, NULL), *part;
    bl_ran_free(&ran);
    part = json_object_get(object, "autocorrelation");
    const char *const arrays[] = {"lag", "covariance", "lower", "upper", "theory"};
    double first[5], last[5];
    for (int i = 0; i < 5; i++) {
        const json_t *array = json_object_get(part, arrays[i]);
        assert_int_equal(json_array_size(array), 33); // lags 0 to 2 at 16 a unit
        first[i] = json_number_value(json_array_get(array, 0));
        last[i] = json_number_value(json_array_get(array, 32));
    }
    assert_near(first[0], 0, 0);
    assert_near(last[0], 2, 0);
    assert_true(first[2] <= first[1] && first[1] <= first[3]);
    // The closed form at lag 0 is the variance; two cells away there is none.
    assert_near(first[4], json_number_value(json_object_get(object, "variance_theory")), 1e-9);
    assert_near(last[4], 0, 0);
    json_decref(object);
    EXPECT(0, "lag, units", "spectrum", "gnoise", "--quick", "--autocorrelation", "2");
    EXPECT(64, "along a line", "spectrum", "gnoise", "--dims", "2", "--autocorrelation", "2");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_check_refuses_where_there_is_nothing_to_judge),
        cmocka_unit_test(test_a_constant_has_no_verdict_and_no_nan),
        cmocka_unit_test(test_a_seed_is_recorded_and_a_second_one_refused),
        cmocka_unit_test(test_an_image_says_what_of_it_was_measured),
        cmocka_unit_test(test_an_output_is_tried_before_measuring),
        cmocka_unit_test(test_a_dash_is_standard_output),
        cmocka_unit_test(test_points_have_one_comma_between_them),
        cmocka_unit_test(test_errors_hold_no_control_bytes),
        cmocka_unit_test(test_a_name_typed_as_a_verb_is_shown_the_way),
        cmocka_unit_test(test_the_autocorrelation_starts_with_the_variance),
    };
    return bl_run_tests(tests);
}
