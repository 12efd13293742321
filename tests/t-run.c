// SPDX-License-Identifier: MIT
//
// tests/run.sh and tests/summary.sh, which judge all other tests: fed with this very program, which
// misbehaves as BL_RUN says.
#include "tests/test.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/temporary.h"

// --- what they are fed ---------------------------------------------------------------------------

static void test_that_passes(void **state) {
    (void)state;
}

static void test_that_fails(void **state) {
    (void)state;
    assert_int_equal(1, 2);
}

static void test_that_is_skipped(void **state) {
    (void)state;
    skip();
}

static void test_that_dies(void **state) {
    (void)state;
    signal(SIGABRT, SIG_DFL);
    abort();
}

static void test_that_hangs(void **state) {
    (void)state;
    sleep(60);
}

static int misbehave(const char *how) {
    const struct CMUnitTest good[] = {cmocka_unit_test(test_that_passes)};
    const struct CMUnitTest failing[] = {cmocka_unit_test(test_that_passes),
                                         cmocka_unit_test(test_that_fails),
                                         cmocka_unit_test(test_that_is_skipped)};
    const struct CMUnitTest skipping[] = {cmocka_unit_test(test_that_passes),
                                          cmocka_unit_test(test_that_is_skipped)};
    const struct CMUnitTest dying[] = {cmocka_unit_test(test_that_passes),
                                       cmocka_unit_test(test_that_dies)};
    const struct CMUnitTest hanging[] = {cmocka_unit_test(test_that_hangs)};
    if (strcmp(how, "fail") == 0)
        return bl_run_tests(failing);
    if (strcmp(how, "skip") == 0)
        return bl_run_tests(skipping);
    if (strcmp(how, "die") == 0)
        return bl_run_tests(dying);
    if (strcmp(how, "walk") == 0)
        bl_test_walk(1), bl_test_walk(0), bl_test_walk(0);
    if (strcmp(how, "hang") == 0)
        return bl_run_tests(hanging);
    return bl_run_tests(good);
}

// --- what they say -------------------------------------------------------------------------------

typedef struct said {
    int status;
    char text[4096];
} said;

static said run_shell(const char *command) {
    said result = {0};
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    result.text[fread(result.text, 1, sizeof result.text - 1, pipe)] = '\0';
    result.status = WEXITSTATUS(pclose(pipe));
    return result;
}

// One run of this program that misbehaves, with a word for T, and then the summary of its log.
static said run_one(const char *how, const char *word) {
    char self[1024], command[4096];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    assert_true(length > 0);
    self[length] = '\0';
    snprintf(command, sizeof command,
             "BL_RUN=%s T='%s' REPEAT='make check SCALE=3' TIMEOUT=1 sh tests/run.sh %s %s 2>&1",
             how, word, self, bl_temporary_path("log"));
    return run_shell(command);
}

static said sum_up(const char *word) {
    char command[1024];
    snprintf(command, sizeof command, "T='%s' sh tests/summary.sh %s 2>&1", word,
             bl_temporary_path("log"));
    return run_shell(command);
}

static void assert_ends_with(const char *text, const char *end) {
    size_t length = strlen(text), most = strlen(end);
    if (length < most || strcmp(text + length - most, end) != 0)
        fail_msg("'%s' does not end with '%s'", text, end);
}

static void test_what_passes_is_counted(void **state) {
    (void)state;
    said run = run_one("pass", ""), sum = sum_up("");
    assert_non_null(strstr(run.text, " 1 passed\n"));
    assert_string_equal(sum.text, "1 passed, 0 failed\n");
    assert_int_equal(sum.status, 0);
}

static void test_a_failure_says_what_it_was_and_last_how_to_repeat_it(void **state) {
    (void)state;
    said run = run_one("fail", ""), sum = sum_up("");
    assert_non_null(strstr(run.text, "FAILED (1 passed, 1 failed, exit 1)"));
    assert_non_null(strstr(run.text, "0x1 != 0x2"));
    assert_ends_with(run.text, "\nrepeat: make check SCALE=3 T=test_that_fails\n");
    assert_string_equal(sum.text,
                        "repeat: make check SCALE=3 T=test_that_fails\n"
                        "1 passed, 1 failed, 1 skipped\n");
    assert_int_equal(sum.status, 1);
}

static void test_the_command_repeats_the_failed_test_alone(void **state) {
    (void)state;
    said run = run_one("fail", "test_that_fails"), sum = sum_up("test_that_fails");
    assert_non_null(strstr(run.text, "FAILED (0 passed, 1 failed, exit 1)"));
    assert_ends_with(sum.text, "0 passed, 1 failed\n");
}

static void test_a_skip_is_neither_passed_nor_failed(void **state) {
    (void)state;
    said run = run_one("skip", ""), sum = sum_up("");
    assert_non_null(strstr(run.text, "1 passed, 1 skipped"));
    assert_string_equal(sum.text, "1 passed, 0 failed, 1 skipped\n");
    assert_int_equal(sum.status, 0);
}

static void test_what_a_walk_leaves_out_is_said(void **state) {
    (void)state;
    said run = run_one("walk", "");
    assert_non_null(strstr(run.text, " 1 passed; 1 of 3 settings are walked\n"));
}

// A crash leaves no line of the test it was in, so the whole program is repeated.
static void test_a_crash_is_a_failure(void **state) {
    (void)state;
    said run = run_one("die", ""), sum = sum_up("");
    assert_non_null(strstr(run.text, "exit 134"));
    assert_ends_with(run.text, "\nrepeat: make check SCALE=3 T=t-run\n");
    assert_ends_with(sum.text, "1 failed\n");
    assert_int_equal(sum.status, 1);
}

static void test_what_does_not_end_is_stopped_and_has_failed(void **state) {
    (void)state;
    said run = run_one("hang", ""), sum = sum_up("");
    assert_non_null(strstr(run.text, "stopped: it did not end within 1 seconds"));
    assert_ends_with(run.text, "\nrepeat: make check SCALE=3 T=t-run\n");
    assert_ends_with(sum.text, "0 passed, 1 failed\n");
    assert_int_equal(sum.status, 1);
}

static void test_a_word_that_nothing_has_is_a_failure(void **state) {
    (void)state;
    said run = run_one("pass", "nowhere"), sum = sum_up("nowhere");
    assert_string_equal(run.text, "");
    assert_non_null(strstr(sum.text, "0 passed, 0 failed\n"));
    assert_non_null(strstr(sum.text, "no test or test program has 'nowhere' in its name\n"));
    assert_int_equal(sum.status, 1);
    said none = run_shell("T=nowhere sh tests/summary.sh 2>&1"); // and with no log at all
    assert_non_null(strstr(none.text, "'nowhere'"));
    assert_int_equal(none.status, 1);
}

int main(void) {
    const char *how = getenv("BL_RUN");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_passes_is_counted),
        cmocka_unit_test(test_a_failure_says_what_it_was_and_last_how_to_repeat_it),
        cmocka_unit_test(test_the_command_repeats_the_failed_test_alone),
        cmocka_unit_test(test_a_skip_is_neither_passed_nor_failed),
        cmocka_unit_test(test_what_a_walk_leaves_out_is_said),
        cmocka_unit_test(test_a_crash_is_a_failure),
        cmocka_unit_test(test_what_does_not_end_is_stopped_and_has_failed),
        cmocka_unit_test(test_a_word_that_nothing_has_is_a_failure),
    };
    return how ? misbehave(how) : bl_run_tests(tests);
}
