// SPDX-License-Identifier: MIT
//
// What the program loads when it starts, and what it waits for images with: OpenImageIO and its
// some 250 libraries are none of a verb's business that reads and writes no image.
#include "tests/test.h"

#include <omp.h>
#include <unistd.h>

#include "core/image.h"
#include "tests/program.h"
#include "tests/temporary.h"

enum { LIBRARIES_MOST = 20, THREADS = 8 };

// --- what is loaded ---

static bl_ran run_traced(const char *variable, const char *value, const char *const *words) {
    setenv(variable, value, 1);
    bl_ran ran = bl_run_words(NULL, words);
    unsetenv(variable);
    return ran;
}

static int maps_the_image_library(const char *const *words) {
    bl_ran ran = run_traced("LD_DEBUG", "files", words);
    int found = strstr(ran.err, "OpenImageIO") != NULL;
    assert_int_equal(ran.status, 0);
    assert_non_null(strstr(ran.err, "libfftw3")); // the linker did tell
    bl_ran_free(&ran);
    return found;
}

#define MAPS(...) maps_the_image_library((const char *const[]){__VA_ARGS__, NULL})

static void test_only_images_load_the_image_library(void **state) {
    (void)state;
    assert_false(MAPS("list"));
    assert_false(MAPS("--help"));
    assert_false(MAPS("show", "gnoise"));
    assert_false(MAPS("show", "brick"));
    assert_false(MAPS("eval", "gnoise", "1", "2", "3"));
    assert_false(MAPS("spectrum", "gnoise", "--quick"));
    assert_true(MAPS("render", "gnoise", "--quick", "-o", bl_temporary_path("loaded.png")));
    assert_true(MAPS("eval", "image", "0.1", "0.2"));
}

static void test_the_program_needs_few_libraries(void **state) {
    (void)state;
    bl_ran ran = run_traced("LD_TRACE_LOADED_OBJECTS", "1", (const char *const[]){"list", NULL});
    int lines = 0;
    for (const char *c = ran.out; *c; c++)
        lines += *c == '\n';
    assert_non_null(strstr(ran.out, "libc.so"));
    assert_in_range(lines, 2, LIBRARIES_MOST);
    bl_ran_free(&ran);
}

// --- what is missing ---

static void check_refusal(const char *path, const char *why, const char *remedy) {
    bl_ran ran = run_traced("BANDLIMIT_IMAGES", path,
                            (const char *const[]){"render", "gnoise", "--quick", "-o",
                                                  bl_temporary_path("never.png"), NULL});
    assert_int_equal(ran.status, BL_DEVICE);
    if (!strstr(ran.err, path) || !strstr(ran.err, why) || !strstr(ran.err, remedy))
        fail_msg("%s", ran.err);
    assert_int_not_equal(access(bl_temporary_path("never.png"), F_OK), 0);
    bl_ran_free(&ran);
}

static void test_a_missing_image_library_is_told(void **state) {
    (void)state;
    const char *text = bl_temporary_path("text.so");
    bl_temporary_write(text, "no library", 10);
    check_refusal("/nowhere/images.so", "No such file", "install OpenImageIO");
    check_refusal(text, "does not load", "install OpenImageIO");
    // A library, but none of ours.
    check_refusal("libm.so.6", "version unknown", "from one build");
}

// Away from its build tree the program says where it looked; nothing is told if an installed one
// is found there.
static void test_a_program_on_its_own_says_where_it_looked(void **state) {
    (void)state;
    const char *program = getenv("BL_PROGRAM");
    const char *const copy[] = {"cp", program, bl_temporary_path("alone"), NULL};
    char kept[4096];
    snprintf(kept, sizeof kept, "%s", program);
    assert_int_equal(bl_temporary_run(NULL, copy), 0);
    setenv("BL_PROGRAM", bl_temporary_path("alone"), 1);
    bl_ran ran = bl_run_program("eval", "image", "0.1", "0.2");
    bl_ran listed = bl_run_program("list");
    setenv("BL_PROGRAM", kept, 1);
    if (ran.status != 0) {
        assert_int_equal(ran.status, BL_DEVICE);
        assert_non_null(strstr(ran.err, bl_temporary_folder()));
        assert_non_null(strstr(ran.err, "BANDLIMIT_IMAGES"));
    }
    assert_int_equal(listed.status, 0);
    bl_ran_free(&ran);
    bl_ran_free(&listed);
}

// --- the first use, from many threads at once: nothing before it in this process ---

static void test_the_first_use_is_safe_from_many_threads(void **state) {
    (void)state;
    static const float values[] = {0, 1, 2, 3};
    const bl_image image = {.width = 2, .height = 2, .values = values};
    char paths[THREADS][64];
    for (int i = 0; i < THREADS; i++)
        snprintf(paths[i], sizeof paths[i], "%s/first%d.exr", bl_temporary_folder(), i);
    int failures = 0;
#pragma omp parallel for num_threads(THREADS) schedule(static, 1) reduction(+ : failures)
    for (int i = 0; i < THREADS; i++) {
        bl_message message = {""};
        failures += bl_image_write(paths[i], &image, &message) != BL_OK;
    }
    assert_int_equal(failures, 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(access(paths[i], R_OK), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_first_use_is_safe_from_many_threads),
        cmocka_unit_test(test_only_images_load_the_image_library),
        cmocka_unit_test(test_the_program_needs_few_libraries),
        cmocka_unit_test(test_a_missing_image_library_is_told),
        cmocka_unit_test(test_a_program_on_its_own_says_where_it_looked),
    };
    return bl_run_tests(tests);
}
