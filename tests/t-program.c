// SPDX-License-Identifier: MIT
//
// Programs as signals: a good child gives what direct computation gives, whatever the threads; a
// bad one gives an error that says what it did, in bounded time, and leaves no process behind.
#include "tests/temporary.h"
#include "tests/test.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/grid.h"
#include "sources/command.h"
#include "sources/source.h"
#include "spectra/histogram.h"
#include "tests/program.h"
#include "tests/sources.h"

// cmd<settings>:<child> <words>
static const char *text_of(const char *settings, const char *words) {
    static char text[1024];
    const char *build = getenv("BL_BUILD");
    snprintf(text, sizeof text, "cmd%s:%s/tests/plugins/child %s", settings,
             build ? build : "build", words);
    return text;
}

static bl_signal *open_good(const char *settings, const char *words) {
    return bl_test_open_source(text_of(settings, words));
}

// No child of ours is left, as a zombie or alive.
static void expect_no_children(void) {
    errno = 0;
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static size_t open_files(void) {
    DIR *directory = opendir("/proc/self/fd");
    size_t count = 0;
    while (directory && readdir(directory))
        count++;
    if (directory)
        closedir(directory);
    return count;
}

// --- good children ---

static const double start[BL_AXES] = {-3, 0.25, 7, 1}, step[BL_AXES] = {0.1, -0.2, 3, 0.5};

static double expected_at(size_t index, unsigned dims, double seed) {
    static const double factor[] = {1, 10, 100, 1000};
    double sum = 0.25 * seed;
    for (unsigned a = 0; a < dims; a++)
        sum += factor[a] * (start[a] + (double)index * step[a]);
    return sum;
}

static void check_values(const bl_signal *signal, unsigned dims, double seed) {
    enum { COUNT = 10000 }; // more than one block
    static double places[BL_AXES][COUNT];
    static float row[COUNT], points[COUNT];
    for (int i = 0; i < COUNT; i++)
        for (int a = 0; a < BL_AXES; a++)
            places[a][i] = start[a] + i * step[a];
    const double *const at[BL_AXES] = {places[0], places[1], places[2], places[3]};
    bl_signal_row(signal, start, step, COUNT, row);
    bl_signal_points(signal, at, COUNT, points);
    for (size_t i = 0; i < COUNT; i++) {
        double expected = expected_at(i, dims, seed);
        assert_true(row[i] == (float)expected);
        assert_true(points[i] == (float)expected);
    }
    const double p[BL_AXES] = {places[0][77], places[1][77], places[2][77], places[3][77]};
    assert_near(bl_signal_value(signal, p), expected_at(77, dims, seed), 0);
    bl_message message;
    assert_int_equal(bl_signal_complaint(signal, &message), BL_OK);
}

static void test_a_good_child_gives_what_is_expected(void **state) {
    (void)state;
    static const char *const modes[] = {"good", "stream", "chatter"};
    size_t files = open_files();
    for (size_t m = 0; m < sizeof modes / sizeof *modes; m++) {
        bl_signal *signal = open_good("", modes[m]);
        assert_int_equal(signal->dimensions, 3);
        assert_string_equal(signal->name, "program");
        check_values(signal, 3, 0);
        bl_signal_free(signal);
    }
    bl_signal *four = open_good(",dims=4,seed=12", "'good' \"{seed}\"");
    check_values(four, 4, 12);
    bl_signal_free(four);
    expect_no_children();
    assert_int_equal(open_files(), files);
}

static void test_places_out_of_range_are_not_asked_for(void **state) {
    (void)state;
    bl_signal *signal = open_good(",dims=2", "good");
    const double x[4] = {1, NAN, 3, 0x1p63}, y[4] = {0, 0, INFINITY, 0}, zero[4] = {NAN};
    const double *const at[BL_AXES] = {x, y, zero, zero};
    float values[4];
    bl_signal_points(signal, at, 4, values);
    assert_true(values[0] == 1 && isnan(values[1]) && isnan(values[2]) && isnan(values[3]));
    assert_true(isnan(bl_signal_value(signal, (const double[BL_AXES]){NAN})));
    bl_message message;
    assert_int_equal(bl_signal_complaint(signal, &message), BL_OK);
    bl_signal_free(signal);
}

static void test_a_program_with_a_place_for_the_seed_can_be_reseeded(void **state) {
    (void)state;
    bl_signal *signal = open_good("", "good {seed}"), *fixed = open_good("", "good");
    bl_signal *other = bl_signal_reseed(signal, 40);
    assert_non_null(other);
    assert_null(bl_signal_reseed(fixed, 40));
    check_values(signal, 3, 0);
    check_values(other, 3, 40);
    bl_signal_free(signal); // what both share lives on
    check_values(other, 3, 40);
    bl_signal_free(other);
    bl_signal_free(fixed);
    bl_message message;
    char text[1024];
    snprintf(text, sizeof text, "%s", text_of(",dims=3", "good {seed}"));
    assert_int_equal(bl_source_open_seeded(text, 8, BL_ISA_BEST, &signal, &message), BL_OK);
    check_values(signal, 3, 8);
    bl_signal_free(signal);
    expect_no_children();
}

static void test_values_do_not_depend_on_the_threads(void **state) {
    (void)state;
    enum { SIZE = 100 };
    static float one[SIZE * SIZE], many[SIZE * SIZE];
    bl_signal *signal = open_good("", "good {seed}");
    const bl_grid grid = {.right = {0.3}, .down = {0, 0.7}, .width = SIZE, .height = SIZE};
    bl_grid_fill(signal, &grid, 1, one);
    bl_grid_fill(signal, &grid, 7, many);
    assert_memory_equal(one, many, sizeof one);
    bl_histogram_settings settings = bl_histogram_default_settings();
    bl_histogram histograms[2];
    bl_message message;
    settings.samples = 6 * 4096;
    for (int i = 0; i < 2; i++) {
        settings.threads = i ? 6 : 1;
        assert_int_equal(bl_histogram_measure(signal, &settings, &histograms[i], &message), BL_OK);
    }
    assert_near(histograms[0].mean.value, histograms[1].mean.value, 0);
    assert_near(histograms[0].variance.value, histograms[1].variance.value, 0);
    for (int i = 0; i < 2; i++)
        bl_histogram_free(&histograms[i]);
    bl_signal_free(signal);
    expect_no_children();
}

// --- bad children ---

static void test_what_is_wrong_at_once_is_told_on_opening(void **state) {
    (void)state;
    bl_test_refuse_source("cmd:no-such-program-anywhere", BL_DEVICE, "not in PATH");
    bl_test_refuse_source("cmd:./no-such-program", BL_DEVICE, "No such file");
    bl_test_refuse_source("cmd:./README.md", BL_DEVICE, "make it executable");
    bl_test_refuse_source("cmd:/tmp", BL_DEVICE, "cannot start");
    bl_test_refuse_source(text_of("", "0die"), BL_DEVICE, "exit status 7");
    bl_test_refuse_source(text_of("", "0crash"), BL_DEVICE, "signal 9");
    bl_test_refuse_source(text_of(",timeout=0.2", "0stall"), BL_DEVICE, "moved no byte for 0.2 s");
    bl_test_refuse_source(text_of(",timeout=0.2", "0little"), BL_DEVICE, "0 of 8");
    bl_test_refuse_source(text_of("", "0much"), BL_DEVICE, "more than it was asked");
    bl_test_refuse_source(text_of(",timeout=0.2", "0text"), BL_DEVICE, "looks like text");
    bl_test_refuse_source("cmd,timeout=0.2:sh -c 'sleep 300 & wait'", BL_DEVICE, "moved no byte");
    expect_no_children();
}

static void test_every_bad_text_is_refused_with_its_reason(void **state) {
    (void)state;
    bl_test_refuse_source("cmd:", BL_USAGE, "names no program");
    bl_test_refuse_source("cmd:   ", BL_USAGE, "names no program");
    bl_test_refuse_source("cmd:''", BL_USAGE, "names no program");
    bl_test_refuse_source("cmd:cat 'x", BL_USAGE, "column 9");
    bl_test_refuse_source("cmd,:cat", BL_USAGE, "expected key=value");
    bl_test_refuse_source("cmd,dims=0:cat", BL_USAGE, "dims=0");
    bl_test_refuse_source("cmd,dims=5:cat", BL_USAGE, "dims=5");
    bl_test_refuse_source("cmd,timeout=0:cat", BL_USAGE, "timeout=0");
    bl_test_refuse_source("cmd,time=3:cat", BL_USAGE, "did you mean");
    bl_test_refuse_source("cmd,seed=3:cat", BL_USAGE, "{seed}");
}

static double seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// From its second block on the child misbehaves: the measurement stops, the values of that block
// are NaN and so is all that follows, and the signal tells why. Threads do not change that.
static void expect_failure(const char *settings, const char *words, const char *word) {
    enum { COUNT = 1000 };
    float values[COUNT];
    bl_message message = {""};
    bl_signal *signal = open_good(settings, words);
    const double zero[BL_AXES] = {0};
    bl_signal_row(signal, start, step, COUNT, values);
    for (int i = 0; i < COUNT; i++)
        assert_true(isnan(values[i]));
    double before = seconds();
    for (int i = 0; i < 1000; i++)
        assert_true(isnan(bl_signal_value(signal, zero)));
    assert_less(seconds() - before, 60); // no child was waited for
    bl_status status = bl_signal_complaint(signal, &message);
    if (status != BL_DEVICE || !strstr(message.text, word))
        fail_msg("%s: status %d, '%s' should say '%s'", words, status, message.text, word);
    for (const char *c = message.text; *c; c++)
        assert_true((unsigned char)*c >= 0x20 && *c != 0x7F);
    bl_signal_free(signal);
    expect_no_children();
}

static void test_what_goes_wrong_later_is_told_by_the_signal(void **state) {
    (void)state;
    expect_failure("", "1die", "ended with exit status 7 after 0 of 8000 bytes");
    expect_failure("", "1crash", "signal 9");
    expect_failure("", "1half", "after 4000 of 8000 bytes");
    expect_failure("", "1close", "closed its standard output");
    expect_failure(",timeout=0.3", "1stall", "moved no byte for 0.3 s");
    expect_failure(",timeout=0.3", "1little", "7992 of 8000");
    expect_failure("", "1much", "more than it was asked");
    expect_failure(",timeout=0.3", "1text", "looks like text");
    expect_failure("", "1talk", "the \"last\" words\\x07");
}

static void test_many_threads_meet_one_failure(void **state) {
    (void)state;
    enum { SIZE = 64 };
    static float values[SIZE * SIZE];
    bl_message message;
    bl_signal *signal = open_good(",timeout=0.3", "1stall");
    const bl_grid grid = {.right = {0.3}, .down = {0, 0.7}, .width = SIZE, .height = SIZE};
    double before = seconds();
    bl_grid_fill(signal, &grid, 8, values);
    assert_less(seconds() - before, 60); // and not 64 rows in turn, nor a lock that nobody opens
    assert_int_equal(bl_signal_complaint(signal, &message), BL_DEVICE);
    bl_signal_free(signal);
    expect_no_children();
}

static void test_a_complaint_is_shared_with_copies(void **state) {
    (void)state;
    bl_message message = {""};
    bl_signal *signal = open_good("", "good {seed}");
    bl_signal *copy = bl_signal_copy(signal), *bad = open_good("", "1die {seed}");
    bl_signal *fresh = bl_signal_reseed(bad, 3);
    (void)bl_signal_value(fresh, (const double[BL_AXES]){0}); // its child's first block is good
    (void)bl_signal_value(fresh, (const double[BL_AXES]){0});
    bl_signal_free(fresh);
    assert_int_equal(bl_signal_complaint(bad, &message), BL_DEVICE);
    assert_int_equal(bl_signal_complaint(copy, &message), BL_OK);
    bl_signal_free(signal);
    bl_signal_free(copy);
    bl_signal_free(bad);
}

static void test_a_farewell_that_nobody_asked_for_is_told(void **state) {
    (void)state;
    bl_message message = {""};
    bl_signal *signal = open_good("", "late"), *copy = bl_signal_copy(signal);
    assert_int_equal(bl_signal_complaint(copy, &message), BL_OK);
    bl_signal_free(signal);
    assert_int_equal(bl_signal_complaint(copy, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "more than it was asked"));
    bl_signal_free(copy);
}

static void test_a_value_that_is_no_number_passes_and_is_remembered(void **state) {
    (void)state;
    float values[3];
    bl_message message = {""};
    bl_signal *signal = open_good("", "1nan");
    bl_signal_row(signal, start, step, 3, values);
    assert_true(values[1] == (float)expected_at(1, 3, 0));
    assert_true(isnan(values[2]));
    assert_int_equal(bl_signal_complaint(signal, &message), BL_MISMATCH);
    assert_non_null(strstr(message.text, "nan at (-2.8, -0.15, 13)"));
    assert_non_null(strstr(message.text, "log of -1"));
    bl_signal_free(signal);
}

static void test_a_failure_goes_before_a_value_that_is_no_number(void **state) {
    (void)state;
    const double zero[BL_AXES] = {0};
    bl_message message = {""};
    bl_signal *signal = open_good("", "1worse");
    assert_true(isnan(bl_signal_value(signal, zero)));
    assert_int_equal(bl_signal_complaint(signal, &message), BL_MISMATCH);
    assert_true(isnan(bl_signal_value(signal, zero)));
    assert_int_equal(bl_signal_complaint(signal, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "exit status 7"));
    bl_signal_free(signal);
}

// Opening asks for a value at a place that may have none, and that nobody wanted to know.
static void test_no_value_at_the_origin_is_no_complaint(void **state) {
    (void)state;
    bl_message message = {""};
    bl_signal *signal = open_good("", "0nan");
    assert_int_equal(bl_signal_complaint(signal, &message), BL_OK);
    bl_signal_free(signal);
}

// The time is that without a byte: eight answers 60 ms apart are in time for 0.3 s.
static void test_a_slow_child_that_moves_is_waited_for(void **state) {
    (void)state;
    float row[8];
    bl_message message = {""};
    bl_signal *signal = open_good(",timeout=0.3", "1slow");
    bl_signal_row(signal, start, step, 8, row);
    for (size_t i = 0; i < 8; i++)
        assert_true(row[i] == (float)expected_at(i, 3, 0));
    assert_int_equal(bl_signal_complaint(signal, &message), BL_OK);
    bl_signal_free(signal);
}

// An answer too many that comes when nobody asks must not become the answer of the next question.
static void test_an_answer_twice_is_not_taken_for_the_next(void **state) {
    (void)state;
    const struct timespec pause = {0, 350000000};
    bl_message message = {""};
    bl_signal *signal = open_good("", "1again");
    (void)bl_signal_value(signal, (const double[BL_AXES]){1});
    nanosleep(&pause, NULL);
    double second = bl_signal_value(signal, (const double[BL_AXES]){2});
    assert_true(isnan(second));
    assert_int_equal(bl_signal_complaint(signal, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "more than it was asked"));
    bl_signal_free(signal);
}

// The last 480 bytes of standard error are quoted, from whole letters on, also what was said in
// pieces.
static void test_the_end_of_what_a_child_says_is_quoted(void **state) {
    (void)state;
    bl_test_refuse_source(
        "cmd:sh -c 'printf \"%01000d\" 0 >&2; sleep 0.1; printf \"%050d\" 1 >&2; exit 3'",
        BL_DEVICE, "00000000000000000000000000000000000000000000000000000000000000000001");
    bl_signal *signal = NULL;
    bl_message message = {""};
    const char *letters =
        "cmd:sh -c 'for i in $(seq 300); do printf \"\\303\\251\"; done >&2; "
        "printf x >&2; exit 3'";
    assert_int_equal(bl_source_open(letters, BL_ISA_BEST, &signal, &message), BL_DEVICE);
    const char *quoted = strstr(message.text, "ends with: ");
    assert_non_null(quoted);
    assert_non_null(strstr(quoted, "\303\251\303\251x"));
    assert_int_equal((unsigned char)quoted[strlen("ends with: ")], 0xC3);
}

// --- what a child is given ---

// A child ends with all that it started: whoever holds a pipe open is still there.
static void test_what_a_child_started_ends_with_it(void **state) {
    (void)state;
    char text[512], byte;
    char *pipe = strdup(bl_temporary_path("alive"));
    assert_int_equal(mkfifo(pipe, 0700), 0);
    int file = open(pipe, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    assert_true(file >= 0);
    snprintf(text, sizeof text, "cmd,timeout=1:sh -c '(echo; exec sleep 300) >%s & wait'", pipe);
    bl_test_refuse_source(text, BL_DEVICE, "moved no byte");
    assert_int_equal(read(file, &byte, 1), 1); // it was there
    struct pollfd waited = {file, POLLIN, 0};
    assert_int_equal(poll(&waited, 1, 5000), 1);
    assert_int_equal(read(file, &byte, 1), 0); // and has ended
    close(file);
    unlink(pipe);
    free(pipe);
}

static void test_a_script_without_a_first_line_is_told(void **state) {
    (void)state;
    char text[512];
    bl_temporary_write(bl_temporary_path("script"), "exit 3\n", 7);
    assert_int_equal(chmod(bl_temporary_path("script"), 0700), 0);
    snprintf(text, sizeof text, "cmd:%s", bl_temporary_path("script"));
    bl_test_refuse_source(text, BL_DEVICE, "needs a first line");
}

// "seed=" among the words of the program is its own matter.
static void test_a_seed_among_the_words_is_no_setting(void **state) {
    (void)state;
    bl_signal *signal = open_good(",dims=2", "good seed=3");
    check_values(signal, 2, 0);
    bl_signal_free(signal);
}

// A child with a file of ours, or without the default meaning of SIGPIPE, would exit with 1.
static void test_a_child_starts_fresh(void **state) {
    (void)state;
    int leaked = open("/dev/null", O_RDONLY); // without O_CLOEXEC
    struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
    sigaction(SIGPIPE, &ignore, &before);
    // ls has its standard streams and the folder open.
    bl_test_refuse_source("cmd:sh -c 'test $(ls /proc/self/fd | wc -l) = 4 && exit 5; exit 1'",
                          BL_DEVICE, "exit status 5");
    bl_test_refuse_source("cmd:sh -c 'kill -PIPE $$; exit 1'", BL_DEVICE, "signal 13");
    sigaction(SIGPIPE, &before, NULL);
    close(leaked);
}

// With the default meaning of SIGPIPE here, a child that goes away must not end us.
static void test_a_broken_pipe_does_not_end_the_program(void **state) {
    (void)state;
    struct sigaction usual = {.sa_handler = SIG_DFL}, before;
    sigaction(SIGPIPE, &usual, &before);
    for (int i = 0; i < 10; i++)
        bl_test_refuse_source("cmd:sh -c 'exec <&-; sleep 0.02; exit 4'", BL_DEVICE,
                              "exit status 4");
    sigaction(SIGPIPE, &before, NULL);
}

static void check_words(const char *command, size_t count, const char *const *expected) {
    char **words = NULL;
    bl_message message = {""};
    assert_int_equal(bl_command_read(command, command, &words, &message), BL_OK);
    for (size_t i = 0; i < count; i++)
        assert_string_equal(words[i], expected[i]);
    assert_null(words[count]);
    bl_command_free(words);
}

static void test_words_are_split_as_a_shell_does(void **state) {
    (void)state;
    check_words("  a\tb  ", 2, (const char *const[]){"a", "b"});
    check_words("a b c d e", 5, (const char *const[]){"a", "b", "c", "d", "e"});
    check_words("a 'b c' \"d e\"", 3, (const char *const[]){"a", "b c", "d e"});
    check_words("a b\\ c '' x'y'\"z\"", 4, (const char *const[]){"a", "b c", "", "xyz"});
    check_words("a 'b\\c' \"b\\c\\\"\\\\\"", 3, (const char *const[]){"a", "b\\c", "b\\c\"\\"});
    check_words("a $HOME *;|", 3, (const char *const[]){"a", "$HOME", "*;|"});
    char one[] = "{seed}", two[] = "-{seed}-{seed}", none[] = "{see}";
    char *words[] = {one, two, none, NULL};
    char **seeded = bl_command_with_seed(words, UINT64_MAX);
    assert_string_equal(seeded[0], "18446744073709551615");
    assert_string_equal(seeded[1], "-18446744073709551615-18446744073709551615");
    assert_string_equal(seeded[2], "{see}");
    bl_command_free(seeded);
}

// --- the verbs ---

static void expect_run(bl_ran ran, int status, const char *word) {
    if (ran.status != status || !strstr(ran.err, word))
        fail_msg("status %d, expected %d; '%s' should say '%s'", ran.status, status, ran.err, word);
    bl_ran_free(&ran);
}

static void test_no_verb_takes_a_dead_child_for_good(void **state) {
    (void)state;
    char die[1024], nan[1024], late[1024], picture[1024];
    snprintf(die, sizeof die, "%s", text_of("", "3die"));
    snprintf(nan, sizeof nan, "%s", text_of("", "1nan"));
    snprintf(late, sizeof late, "%s", text_of("", "late"));
    snprintf(picture, sizeof picture, "%s", bl_temporary_path("picture.exr"));
    expect_run(bl_run_program("spectrum", die, "--quick"), BL_DEVICE, "exit status 7");
    expect_run(bl_run_program("histogram", die, "--quick"), BL_DEVICE, "exit status 7");
    expect_run(bl_run_program("check", die, "--quick"), BL_DEVICE, "exit status 7");
    expect_run(bl_run_program("render", die, "-o", picture), BL_DEVICE, "exit status 7");
    assert_int_equal(access(picture, F_OK), -1);
    expect_run(bl_run_program("histogram", nan, "--quick"), BL_MISMATCH, "log of -1");
    snprintf(nan, sizeof nan, "%s", text_of("", "0nan"));
    expect_run(bl_run_program("eval", nan, "1"), BL_MISMATCH, "log of -1");
    expect_run(bl_run_program("eval", late, "1"), BL_DEVICE, "more than it was asked");
    const bl_streams streams = {.input = "1\n2\n3\n4\n5\n"};
    bl_ran ran = bl_run_words(&streams, (const char *const[]){"eval", die, "--threads", "1", NULL});
    assert_int_equal(ran.status, BL_DEVICE);
    assert_string_equal(ran.out, "1\n2\n");
    bl_ran_free(&ran);
}

static void test_show_and_seed_know_programs(void **state) {
    (void)state;
    char good[1024];
    snprintf(good, sizeof good, "%s", text_of("", "good {seed}"));
    bl_ran ran = bl_run_program("show", good);
    assert_int_equal(ran.status, 0);
    assert_non_null(strstr(ran.out, "a program"));
    bl_ran_free(&ran);
    ran = bl_run_program("eval", good, "2", "--seed", "4");
    assert_string_equal(ran.out, "3\n");
    bl_ran_free(&ran);
    expect_run(bl_run_program("eval", text_of("", "good"), "2", "--seed", "4"), BL_MISMATCH,
               "{seed}");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_good_child_gives_what_is_expected),
        cmocka_unit_test(test_places_out_of_range_are_not_asked_for),
        cmocka_unit_test(test_a_program_with_a_place_for_the_seed_can_be_reseeded),
        cmocka_unit_test(test_values_do_not_depend_on_the_threads),
        cmocka_unit_test(test_what_is_wrong_at_once_is_told_on_opening),
        cmocka_unit_test(test_every_bad_text_is_refused_with_its_reason),
        cmocka_unit_test(test_what_goes_wrong_later_is_told_by_the_signal),
        cmocka_unit_test(test_many_threads_meet_one_failure),
        cmocka_unit_test(test_a_complaint_is_shared_with_copies),
        cmocka_unit_test(test_a_farewell_that_nobody_asked_for_is_told),
        cmocka_unit_test(test_a_value_that_is_no_number_passes_and_is_remembered),
        cmocka_unit_test(test_a_failure_goes_before_a_value_that_is_no_number),
        cmocka_unit_test(test_no_value_at_the_origin_is_no_complaint),
        cmocka_unit_test(test_a_slow_child_that_moves_is_waited_for),
        cmocka_unit_test(test_an_answer_twice_is_not_taken_for_the_next),
        cmocka_unit_test(test_the_end_of_what_a_child_says_is_quoted),
        cmocka_unit_test(test_what_a_child_started_ends_with_it),
        cmocka_unit_test(test_a_script_without_a_first_line_is_told),
        cmocka_unit_test(test_a_seed_among_the_words_is_no_setting),
        cmocka_unit_test(test_a_child_starts_fresh),
        cmocka_unit_test(test_a_broken_pipe_does_not_end_the_program),
        cmocka_unit_test(test_words_are_split_as_a_shell_does),
        cmocka_unit_test(test_no_verb_takes_a_dead_child_for_good),
        cmocka_unit_test(test_show_and_seed_know_programs),
    };
    return bl_run_tests(tests);
}
