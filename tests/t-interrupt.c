// SPDX-License-Identifier: MIT
//
// A signal that ends the program ends the programs that it asked, too, and removes the files that
// it had not finished.
#include "tests/test.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "tests/program.h"
#include "tests/temporary.h"

enum { PATIENCE_MS = 20000 };

static void wait_a_moment(void) {
    const struct timespec moment = {0, 5000000};
    nanosleep(&moment, NULL);
}

// Starts the program with the signals as a shell in front of it leaves them. `ignored`: as nohup.
static pid_t start(const char *const *words, int ignored) {
    const char *program = getenv("BL_PROGRAM");
    pid_t child = fork();
    assert_true(child >= 0);
    if (child > 0)
        return child;
    int null = open("/dev/null", O_RDWR);
    for (int i = 0; i < 3; i++)
        dup2(null, i);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, ignored == SIGHUP ? SIG_IGN : SIG_DFL);
    execv(program && *program ? program : "build/bandlimit", (char *const *)words);
    _exit(127);
}

static pid_t read_number(const char *path) {
    for (int i = 0; i < PATIENCE_MS / 5; i++, wait_a_moment()) {
        char *text = bl_temporary_read(path, NULL);
        long number = text && strchr(text, '\n') ? atol(text) : 0;
        free(text);
        if (number > 0)
            return (pid_t)number;
    }
    fail_msg("%s was not written", path);
    return 0;
}

// Whether a process runs; one that ended and that nobody waited for does not.
static int runs(pid_t process) {
    char path[64];
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    char *text = bl_temporary_read(path, NULL), *state = text ? strrchr(text, ')') : NULL;
    int found = state && state[2] != 'Z' && state[2] != 'X';
    free(text);
    return found;
}

static int ends(pid_t process) {
    for (int i = 0; i < PATIENCE_MS / 5; i++, wait_a_moment())
        if (!runs(process))
            return 1;
    kill(process, SIGKILL);
    return 0;
}

// A program that starts another one, which does not read, so that no closed pipe ends it.
static void check_children_end(int number) {
    char text[600], path[300];
    snprintf(path, sizeof path, "%s", bl_temporary_path("number"));
    unlink(path);
    snprintf(text, sizeof text, "cmd,timeout=100:sh -c 'sleep 77 & echo $! >%s; wait'", path);
    pid_t program = start((const char *const[]){"bandlimit", "eval", text, "1", NULL}, 0);
    pid_t grandchild = read_number(path);
    assert_true(runs(grandchild));
    int status;
    kill(program, number);
    assert_int_equal(waitpid(program, &status, 0), program);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == number);
    assert_true(ends(grandchild));
}

static void test_children_end_with_the_program(void **state) {
    (void)state;
    check_children_end(SIGINT);
    check_children_end(SIGTERM);
    check_children_end(SIGHUP);
}

static void test_an_ignored_signal_stays_ignored(void **state) {
    (void)state;
    char text[600], path[300];
    int status;
    snprintf(path, sizeof path, "%s", bl_temporary_path("number"));
    unlink(path);
    snprintf(text, sizeof text, "cmd,timeout=100:sh -c 'echo $$ >%s; exec sleep 77'", path);
    pid_t program = start((const char *const[]){"bandlimit", "eval", text, "1", NULL}, SIGHUP);
    pid_t child = read_number(path);
    kill(program, SIGHUP);
    for (int i = 0; i < 20; i++)
        wait_a_moment();
    assert_int_equal(waitpid(program, &status, WNOHANG), 0);
    assert_true(runs(child));
    kill(program, SIGTERM);
    assert_int_equal(waitpid(program, &status, 0), program);
    assert_true(ends(child));
}

// -o makes its hidden file before the program is asked.
static void test_unfinished_files_are_removed(void **state) {
    (void)state;
    char text[600], path[300], out[300];
    int status;
    snprintf(path, sizeof path, "%s", bl_temporary_path("number"));
    snprintf(out, sizeof out, "%s", bl_temporary_path("report.json"));
    unlink(path);
    size_t before = bl_temporary_files();
    snprintf(text, sizeof text, "cmd,timeout=100:sh -c 'echo $$ >%s; exec sleep 77'", path);
    pid_t program =
        start((const char *const[]){"bandlimit", "eval", text, "1", "-o", out, NULL}, 0);
    pid_t child = read_number(path);
    assert_int_equal(bl_temporary_files(), before + 2); // the number and the hidden file
    kill(program, SIGTERM);
    assert_int_equal(waitpid(program, &status, 0), program);
    assert_true(ends(child));
    assert_int_equal(bl_temporary_files(), before + 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_children_end_with_the_program),
        cmocka_unit_test(test_an_ignored_signal_stays_ignored),
        cmocka_unit_test(test_unfinished_files_are_removed),
    };
    return bl_run_tests(tests);
}
