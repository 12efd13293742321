// SPDX-License-Identifier: MIT
//
// Bad input: each is refused with the right exit status and a message that says what is wrong, and
// leaves no file behind.
#include "tests/test.h"

#include <sys/stat.h>
#include <unistd.h>

#include "tests/program.h"
#include "tests/temporary.h"

enum { MOST_WORDS = 12 };

typedef struct bad_input {
    int status;
    const char *says; // in the message
    const char *words[MOST_WORDS];
} bad_input;

// The message stands on the last line; an image library may have said something of its own before.
static int says(const char *err, const char *word) {
    const char *message = strstr(err, "bandlimit");
    while (message && message != err && message[-1] != '\n')
        message = strstr(message + 1, "bandlimit");
    return message && strstr(message, word);
}

static void expect(const bl_streams *streams, const bad_input *bad) {
    bl_ran ran = bl_run_words(streams, bad->words);
    if (ran.status != bad->status || !says(ran.err, bad->says))
        fail_msg("%s %s %s: expected status %d and '%s', got status %d and '%s'", bad->words[0],
                 bad->words[1] ? bad->words[1] : "", bad->words[2] ? bad->words[2] : "",
                 bad->status, bad->says, ran.status, ran.err);
    bl_ran_free(&ran);
}

static void expect_all(const bad_input *bad, size_t count) {
    for (size_t i = 0; i < count; i++)
        expect(NULL, &bad[i]);
}
#define EXPECT_ALL(list) expect_all(list, sizeof(list) / sizeof *(list))

static void test_unknown_words_name_the_nearest(void **state) {
    (void)state;
    const bad_input list[] = {
        {64, "'spectrum'", {"spectrun", "gnoise"}},
        {64, "unknown verb 'xyzzy'", {"xyzzy"}},
        {64, "'gnoise'", {"eval", "gnose", "1"}},
        {64, "'seed'", {"eval", "gnoise:sed=3", "1"}},
        {64, "column 8", {"eval", "gnoise:sed=3", "1"}},
        {64, "'--window'", {"spectrum", "gnoise", "--windw", "hann"}},
        {64, "'hann'", {"spectrum", "gnoise", "--window", "han"}},
        {64, "'lattice'", {"spectrum", "gnoise", "--place", "latice"}},
        {64, "'noises'", {"list", "noise"}},
        {64, "'gnoise'", {"show", "gnoize"}},
        {64, "peachey", {"reproduce", "peachey-2.77"}},
        {64, "unknown option '-z'", {"list", "-z"}},
        {64, "'render'", {"help", "rendr"}},
        {64, "baseline", {"eval", "gnoise", "1", "--isa", "v9"}},
    };
    EXPECT_ALL(list);
}

static void test_missing_and_surplus_words_are_named(void **state) {
    (void)state;
    const bad_input list[] = {
        {64, "SIGNAL", {"eval"}},
        {64, "SIGNAL", {"spectrum"}},
        {64, "-o FILE", {"render", "gnoise"}},
        {64, "'5'", {"eval", "gnoise", "1", "2", "3", "4", "5"}},
        {64, "'more'", {"list", "noises", "more"}},
        {64, "PATH", {"list", "-o"}},
        {64, "needs a value", {"list", "-o", "--json"}},
        {64, "N", {"eval", "gnoise", "1", "--seed"}},
        {64, "takes no value", {"list", "--json=yes"}},
        {64, "exclude", {"list", "--quick", "--full"}},
        {64, "no name", {"eval", "", "1"}},
        {64, "key=value", {"eval", "gnoise:", "1"}},
        {64, "key=value", {"eval", "gnoise:seed", "1"}},
        {64, "empty", {"list", "--output="}},
    };
    EXPECT_ALL(list);
    bl_ran ran = bl_run_words(NULL, (const char *const[]){NULL});
    assert_int_equal(ran.status, 64);
    assert_non_null(strstr(ran.err, "usage:"));
    bl_ran_free(&ran);
}

static void test_numbers_are_whole_words_in_range(void **state) {
    (void)state;
    const bad_input list[] = {
        {64, "18446744073709551615", {"eval", "gnoise", "1", "--seed", "18446744073709551616"}},
        {64, "--seed -1", {"eval", "gnoise", "1", "--seed", "-1"}},
        {64, "--seed 1.5", {"eval", "gnoise", "1", "--seed", "1.5"}},
        {64, "--seed 3x", {"eval", "gnoise", "1", "--seed", "3x"}},
        {64, "seed", {"eval", "gnoise:seed=18446744073709551616", "1"}},
        {64, "out of range", {"list", "--threads", "0"}},
        {64, "whole number", {"list", "--threads", "two"}},
        {64, "out of range", {"spectrum", "gnoise", "--dims", "4"}},
        {64, "out of range", {"spectrum", "gnoise", "--size", "0"}},
        {64, "out of range", {"spectrum", "gnoise", "--size", "1"}},
        {64, "out of range", {"spectrum", "gnoise", "--rate", "-1"}},
        {64, "not a finite number", {"spectrum", "gnoise", "--rate", "nan"}},
        {64, "out of range", {"spectrum", "gnoise", "--level", "1"}},
        {64, "FROM:TO", {"spectrum", "gnoise", "--band", "0.5"}},
        {64, "smaller", {"spectrum", "gnoise", "--band", "1:0.5"}},
        {64, "start at 0", {"check", "gnoise", "--band", "-1:1"}},
        {64, "FROM:TO", {"check", "gnoise", "--band", "inf:inf"}},
        {64, "out of range", {"check", "gnoise", "--leak", "3"}},
        {64, "not an axis", {"spectrum", "gnoise", "--axis", "q"}},
        {64, "not zero", {"spectrum", "gnoise", "--axis", "0,0,0"}},
        {64, "not finite", {"spectrum", "gnoise", "--axis", "nan,0,1"}},
        {64, "out of range", {"histogram", "gnoise", "--bins", "0"}},
        {64, "out of range", {"histogram", "gnoise", "--samples", "0"}},
        {64, "out of range", {"render", "gnoise", "--width", "0", "-o", "/tmp/never.png"}},
        {64, "bits", {"render", "gnoise", "--bits", "9", "-o", "/tmp/never.png"}},
    };
    EXPECT_ALL(list);
}

static void test_coordinates_are_finite_and_not_too_large(void **state) {
    (void)state;
    const bad_input list[] = {
        {64, "X: 'nan' is not finite", {"eval", "gnoise", "nan"}},
        {64, "Y: 'inf' is not finite", {"eval", "gnoise", "0", "inf"}},
        {64, "Z: '-inf' is not finite", {"eval", "gnoise", "0", "0", "-inf"}},
        {64, "1e999", {"eval", "gnoise", "1e999"}},
        {64, "too large", {"eval", "gnoise", "1e300"}},
        {64, "too large", {"eval", "gnoise", "-1e300"}},
        {64, "not a number", {"eval", "gnoise", "1.2.3"}},
        {64, "not a number", {"eval", "gnoise", "x"}},
        {64, "not a number", {"eval", "gnoise", ""}},
        {64, "not finite", {"render", "gnoise", "--at", "0,nan", "-o", "/tmp/never.png"}},
        {64, "too large", {"render", "gnoise", "--at", "1e300", "-o", "/tmp/never.png"}},
        {64, "more than 4", {"render", "gnoise", "--at", "1,2,3,4,5", "-o", "/tmp/never.png"}},
    };
    EXPECT_ALL(list);
}

static void test_a_bad_line_of_points_is_told_by_its_number(void **state) {
    (void)state;
    static const struct {
        const char *input, *says;
    } list[] = {
        {"1 2 3\n# comment\n\n4 five 6\n", "line 4: 'five'"},
        {"1 2 3 4 5\n", "line 1: more than four"},
        {"1\nnan\n", "line 2: 'nan' is not finite"},
        {"1e400", "line 1"},
        {"\xff\xfe\x01", "line 1"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const bl_streams streams = {.input = list[i].input};
        const bad_input bad = {64, list[i].says, {"eval", "gnoise"}};
        const bad_input bad_json = {64, list[i].says, {"eval", "gnoise", "--json"}};
        expect(&streams, &bad);
        expect(&streams, &bad_json);
    }
}

static void test_a_line_without_end_is_refused(void **state) {
    (void)state;
    char *input = malloc(200001);
    memset(input, '1', 200000);
    input[200000] = '\0';
    const bl_streams streams = {.input = input};
    const bad_input bad = {64, "longer than", {"eval", "gnoise"}};
    expect(&streams, &bad);
    free(input);
}

static void test_outputs_that_cannot_be_written(void **state) {
    (void)state;
    const char *folder = bl_temporary_folder(), *csv = bl_temporary_path("missing/a.csv");
    const char *exr = bl_temporary_path("missing/a.exr");
    const bad_input list[] = {
        {4, "missing/a.csv", {"list", "-o", csv}},
        {4, "missing/a.csv", {"spectrum", "gnoise", "--quick", "--size", "64", "-o", csv}},
        {4, "missing/a.csv", {"histogram", "gnoise", "--quick", "-o", csv}},
        {4, "a.exr", {"render", "gnoise", "--width", "8", "-o", exr}},
        {4, "folder", {"list", "-o", folder}},
        {4, "folder", {"spectrum", "gnoise", "--quick", "--size", "64", "-o", folder}},
        {64, "ending", {"render", "gnoise", "--width", "8", "-o", folder}},
        {64, "ending", {"render", "gnoise", "--width", "8", "-o", "a.jpg"}},
        {4, "No space left", {"list", "-o", "/dev/full"}},
        {4, "No space left", {"eval", "gnoise", "1", "-o", "/dev/full"}},
        {4, "No space left", {"spectrum", "gnoise", "--quick", "--size", "64", "-o", "/dev/full"}},
        {4, "No space left", {"histogram", "gnoise", "--quick", "-o", "/dev/full"}},
    };
    EXPECT_ALL(list);
    assert_int_equal(bl_temporary_files(), 0);
}

// A file system that fills up half way: no file can be longer than this. The program says so,
// leaves no part of a file, and an earlier file of that name stays as it was.
static void fill_up(size_t most_bytes, const char *path, const bad_input *bad) {
    const bl_streams full = {.most_bytes = most_bytes};
    for (int earlier = 0; earlier < 2; earlier++) {
        if (earlier)
            bl_temporary_write(path, "earlier", 7);
        expect(&full, bad);
        char *text = bl_temporary_read(path, NULL);
        assert_true(earlier ? text && strcmp(text, "earlier") == 0 : !text);
        free(text);
        unlink(path);
        assert_int_equal(bl_temporary_files(), 0);
    }
}

// The thread sanitizer keeps its own memory in a file, and dies with the bound on the size of files
// that stands for a full disk here.
#ifdef __has_feature
#define FILES_MAY_NOT_BE_BOUNDED __has_feature(thread_sanitizer)
#else
#define FILES_MAY_NOT_BE_BOUNDED 0
#endif

static void test_a_disk_that_fills_up_leaves_nothing(void **state) {
    (void)state;
    if (FILES_MAY_NOT_BE_BOUNDED)
        skip();
    static const char *const images[] = {"a.png", "a.exr", "a.tif"};
    for (int i = 0; i < 3; i++) {
        const char *path = bl_temporary_path(images[i]);
        const bad_input bad = {4, "File too large", {"render", "gnoise", "-o", path}};
        fill_up(4096, path, &bad);
    }
    const char *csv = bl_temporary_path("a.csv"), *json = bl_temporary_path("a.json");
    const bad_input table = {
        4, "File too large", {"spectrum", "gnoise", "--size", "1024", "--average", "2", "-o", csv}};
    fill_up(6000, csv, &table);
    const bad_input object = {4, "File too large", {"list", "noises", "--json", "-o", json}};
    fill_up(100, json, &object);
}

static void test_figures_on_a_full_disk_leave_no_part(void **state) {
    (void)state;
    if (FILES_MAY_NOT_BE_BOUNDED)
        skip();
    const char *out = bl_temporary_path("out");
    const bl_streams full = {.most_bytes = 4096};
    const bad_input bad = {
        4, "File too large", {"reproduce", "peachey-2.35", "--quick", "-o", out}};
    expect(&full, &bad);
    char command[512];
    snprintf(command, sizeof command, "test -z \"$(find '%s' -type f)\" && rm -r '%s'", out, out);
    assert_int_equal(system(command), 0);
}

static void test_a_folder_named_like_an_image_is_refused(void **state) {
    (void)state;
    const char *path = bl_temporary_path("folder.exr");
    assert_int_equal(mkdir(path, 0777), 0);
    const bad_input list[] = {
        {4, "folder", {"render", "gnoise", "--width", "8", "-o", path}},
        {4, "folder", {"eval", path, "0"}},
    };
    EXPECT_ALL(list);
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(bl_temporary_files(), 0);
}

static void test_a_folder_without_permission_is_refused(void **state) {
    (void)state;
    if (!bl_can_be_nobody())
        skip(); // nothing is closed to root, who may not be another here
    const bl_streams nobody = {.as_nobody = 1};
    const char *path = bl_temporary_path("locked"), *file = bl_temporary_path("locked/a.txt");
    const char *image = bl_temporary_path("locked/a.png");
    assert_int_equal(mkdir(path, 0777), 0);
    assert_int_equal(chmod(bl_temporary_folder(), 0755),
                     0); // so that only `path` can be the reason
    assert_int_equal(chmod(path, 0777), 0);
    bl_ran ran = bl_run_words(&nobody, (const char *const[]){"list", "-o", file, NULL});
    assert_int_equal(ran.status, 0);
    bl_ran_free(&ran);
    assert_int_equal(unlink(file), 0);
    assert_int_equal(chmod(path, 0555), 0);
    const bad_input list[] = {
        {4, "ermission", {"list", "-o", file}},
        {4, "ermission", {"render", "gnoise", "--width", "8", "-o", image}},
    };
    for (size_t i = 0; i < 2; i++)
        expect(&nobody, &list[i]);
    assert_int_equal(rmdir(path), 0); // and it is empty
}

static void test_a_full_standard_output_is_noticed(void **state) {
    (void)state;
    const bl_streams full = {.output = "/dev/full"}, closed = {.close_output = 1};
    const bad_input list[] = {
        {4, "standard output", {"list"}},
        {4, "standard output", {"list", "--json"}},
        {4, "standard output", {"help"}},
        {4, "standard output", {"version"}},
        {4, "standard output", {"show", "gnoise"}},
        {4, "standard output", {"eval", "gnoise", "1"}},
        {4, "standard output", {"spectrum", "gnoise", "--quick", "--size", "64"}},
        {4, "standard output", {"check", "gnoise", "--quick", "--size", "64", "--json"}},
        {4, "standard output", {"histogram", "gnoise", "--quick"}},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        expect(&full, &list[i]);
        expect(&closed, &list[i]);
    }
    const bl_streams full_in = {.output = "/dev/full", .input = "1 2 3\n4 5 6\n"};
    const bad_input points = {4, "standard output", {"eval", "gnoise"}};
    expect(&full_in, &points);
}

static void test_sizes_beyond_memory_are_refused_with_the_bytes(void **state) {
    (void)state;
    const char *png = bl_temporary_path("a.png");
    const bad_input list[] = {
        {3,
         "8.0 EB of memory",
         {"render", "gnoise", "--width", "1000000000", "--height", "1000000000", "-o", png}},
        {3, "bytes", {"spectrum", "gnoise", "--dims", "2", "--size", "1000000"}},
        {3, "bytes", {"spectrum", "gnoise", "--dims", "3", "--size", "100000"}},
        {3, "bytes", {"spectrum", "gnoise", "--size", "1000000000000"}},
        {3, "bytes", {"histogram", "gnoise", "--samples", "1000000000000"}},
    };
    EXPECT_ALL(list);
    assert_int_equal(bl_temporary_files(), 0);
}

// Every way in which a file is not an image.
static void test_broken_images_are_refused(void **state) {
    (void)state;
    const char *good = bl_temporary_path("good.exr"), *empty = bl_temporary_path("empty.exr"),
               *cut = bl_temporary_path("cut.exr"), *garbage = bl_temporary_path("garbage.png"),
               *missing = bl_temporary_path("missing.exr");
    bl_ran ran = bl_run_program("render", "gnoise", "--width", "31", "-o", good);
    assert_int_equal(ran.status, 0);
    bl_ran_free(&ran);
    struct stat info;
    assert_int_equal(stat(good, &info), 0);
    char *bytes = malloc((size_t)info.st_size);
    FILE *stream = fopen(good, "r");
    assert_int_equal(fread(bytes, 1, (size_t)info.st_size, stream), info.st_size);
    fclose(stream);
    bl_temporary_write(empty, "", 0);
    bl_temporary_write(cut, bytes, (size_t)info.st_size / 2);
    bl_temporary_write(garbage, "\x89PNG\r\n\x1a\nthis is not an image", 28);
    const char *const broken[] = {empty, cut, garbage, missing};
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        const bad_input list[] = {
            {4, strrchr(broken[i], '/') + 1, {"spectrum", broken[i], "--size", "8"}},
            {4, strrchr(broken[i], '/') + 1, {"histogram", broken[i]}},
            {4, strrchr(broken[i], '/') + 1, {"eval", broken[i], "0", "0"}},
            {4, strrchr(broken[i], '/') + 1, {"show", broken[i]}},
        };
        EXPECT_ALL(list);
    }
    size_t step = (size_t)info.st_size / bl_test_scaled(12, 3); // a run is 0.1 s
    for (size_t cut_at = 1; cut_at < (size_t)info.st_size; cut_at += step) {
        bl_temporary_write(cut, bytes, cut_at);
        const bad_input bad = {4, "cut.exr", {"eval", cut, "0", "0"}};
        expect(NULL, &bad);
    }
    free(bytes);
    unlink(good), unlink(empty), unlink(cut), unlink(garbage);
    assert_int_equal(bl_temporary_files(), 0);
}

static void test_an_image_of_many_parts_needs_one_chosen(void **state) {
    (void)state;
    if (system("command -v oiiotool >/dev/null 2>&1") != 0)
        skip(); // nothing here can make such a file
    const char *one = bl_temporary_path("one.exr"), *many = bl_temporary_path("many.exr");
    bl_ran ran = bl_run_program("render", "gnoise", "--width", "16", "-o", one);
    assert_int_equal(ran.status, 0);
    bl_ran_free(&ran);
    char command[1024];
    snprintf(command, sizeof command, "oiiotool %s %s --siappend -o %s", one, one, many);
    assert_int_equal(system(command), 0);
    const bad_input bad = {3, "part", {"eval", many, "0", "0"}};
    expect(NULL, &bad);
    snprintf(command, sizeof command, "%s:part=1", many);
    ran = bl_run_program("eval", command, "0", "0");
    assert_int_equal(ran.status, 0);
    bl_ran_free(&ran);
    unlink(one), unlink(many);
}

// Sizes that are odd, prime or too small for a spectrum either work or are refused in words.
static void test_images_of_awkward_sizes(void **state) {
    (void)state;
    static const char *const sizes[] = {"1", "3", "8", "13", "101"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const char *path = bl_temporary_path("awkward.exr");
        bl_ran ran = bl_run_program("render", "gnoise", "--width", sizes[i], "--height",
                                    sizes[sizeof sizes / sizeof *sizes - 1 - i], "--at",
                                    "0.3,0.4,0.5", "-o", path);
        assert_int_equal(ran.status, 0);
        bl_ran_free(&ran);
        static const char *const dims[] = {"1", "2", "3"};
        for (size_t d = 0; d < 3; d++) {
            ran = bl_run_program("spectrum", path, "--dims", dims[d]);
            if (ran.status != 0 && ran.status != 3 && ran.status != 64)
                fail_msg("size %s, dims %s: status %d, '%s'", sizes[i], dims[d], ran.status,
                         ran.err);
            assert_true((ran.status == 0) == (*ran.err == '\0'));
            bl_ran_free(&ran);
        }
        ran = bl_run_program("histogram", path);
        assert_true(ran.status == 0 || *ran.err);
        assert_true(ran.status < 128);
        bl_ran_free(&ran);
        unlink(path);
    }
}

static void test_sizes_of_noise_that_are_odd_and_prime_work(void **state) {
    (void)state;
    static const char *const sizes[] = {"8", "9", "11", "13", "97", "255"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        bl_ran ran =
            bl_run_program("spectrum", "gnoise", "--size", sizes[i], "--average", "4", "--json");
        if (ran.status != 0)
            fail_msg("size %s: status %d, '%s'", sizes[i], ran.status, ran.err);
        bl_ran_free(&ran);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unknown_words_name_the_nearest),
        cmocka_unit_test(test_missing_and_surplus_words_are_named),
        cmocka_unit_test(test_numbers_are_whole_words_in_range),
        cmocka_unit_test(test_coordinates_are_finite_and_not_too_large),
        cmocka_unit_test(test_a_bad_line_of_points_is_told_by_its_number),
        cmocka_unit_test(test_a_line_without_end_is_refused),
        cmocka_unit_test(test_outputs_that_cannot_be_written),
        cmocka_unit_test(test_a_disk_that_fills_up_leaves_nothing),
        cmocka_unit_test(test_figures_on_a_full_disk_leave_no_part),
        cmocka_unit_test(test_a_folder_named_like_an_image_is_refused),
        cmocka_unit_test(test_a_folder_without_permission_is_refused),
        cmocka_unit_test(test_a_full_standard_output_is_noticed),
        cmocka_unit_test(test_sizes_beyond_memory_are_refused_with_the_bytes),
        cmocka_unit_test(test_broken_images_are_refused),
        cmocka_unit_test(test_an_image_of_many_parts_needs_one_chosen),
        cmocka_unit_test(test_images_of_awkward_sizes),
        cmocka_unit_test(test_sizes_of_noise_that_are_odd_and_prime_work),
    };
    return bl_run_tests(tests);
}
