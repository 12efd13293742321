// SPDX-License-Identifier: MIT
//
// The program among pipes: it answers before its input ends, and goes quietly with its reader.
#include "tests/test.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

typedef struct child {
    pid_t id;
    int to, from; // our ends of its stdin and stdout
    FILE *err;
} child;

static child start(char *const *words) {
    int in[2], out[2];
    assert_int_equal(pipe2(in, O_CLOEXEC), 0);
    assert_int_equal(pipe2(out, O_CLOEXEC), 0);
    child started = {.to = in[1], .from = out[0], .err = tmpfile()};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(started.err), STDERR_FILENO);
    posix_spawnattr_t attributes;
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const char *program = getenv("BL_PROGRAM");
    assert_int_equal(posix_spawn(&started.id, program ? program : "build/bandlimit", &actions,
                                 &attributes, words, environ),
                     0);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]);
    close(out[1]);
    return started;
}

static void expect_answer(const child *program, const char *line) {
    char answer[64];
    struct pollfd ready = {.fd = program->from, .events = POLLIN};
    assert_int_equal(write(program->to, line, strlen(line)), strlen(line));
    assert_int_equal(poll(&ready, 1, 30000), 1);
    ssize_t got = read(program->from, answer, sizeof answer);
    assert_true(got > 1 && answer[got - 1] == '\n');
}

static void test_eval_answers_each_line_before_the_next(void **state) {
    (void)state;
    char *words[] = {(char[]){"bandlimit"}, (char[]){"eval"}, (char[]){"gnoise"}, NULL};
    child program = start(words);
    for (int i = 0; i < 5; i++)
        expect_answer(&program, "0.25 0.5 0.75\n");
    close(program.to);
    int status;
    waitpid(program.id, &status, 0);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    close(program.from);
    fclose(program.err);
}

// The program answers only what it is asked, so that it cannot be done before the reader has gone.
static void test_a_reader_that_goes_ends_the_program_quietly(void **state) {
    (void)state;
    char *words[] = {(char[]){"bandlimit"}, (char[]){"eval"}, (char[]){"gnoise"}, NULL};
    child program = start(words);
    expect_answer(&program, "0.25 0.5 0.75\n");
    close(program.from);
    assert_int_equal(write(program.to, "1 2 3\n", 6), 6);
    int status;
    waitpid(program.id, &status, 0);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE);
    fseek(program.err, 0, SEEK_END);
    assert_int_equal(ftell(program.err), 0);
    close(program.to);
    fclose(program.err);
}

int main(void) {
    signal(SIGPIPE, SIG_IGN);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_eval_answers_each_line_before_the_next),
        cmocka_unit_test(test_a_reader_that_goes_ends_the_program_quietly),
    };
    return bl_run_tests(tests);
}
