// SPDX-License-Identifier: MIT
//
// How the program's threads wait: quietly, unless the user says otherwise; and that nobody sees
// how that is done (cli/quiet_threads.c).
#include "tests/test.h"

#include "tests/program.h"
#include "tests/temporary.h"

extern char **environ;

// What libgomp says of itself in the program's process, with one variable set or none.
static bl_ran run_telling(const char *variable, const char *value) {
    unsetenv("OMP_WAIT_POLICY");
    unsetenv("GOMP_SPINCOUNT");
    setenv("OMP_DISPLAY_ENV", "VERBOSE", 1);
    if (variable)
        setenv(variable, value, 1);
    bl_ran ran = bl_run_program("list");
    if (variable)
        unsetenv(variable);
    unsetenv("OMP_DISPLAY_ENV");
    assert_int_equal(ran.status, 0);
    return ran;
}

static void check_telling(const char *variable, const char *value, const char *says) {
    bl_ran ran = run_telling(variable, value);
    int is_libgomp = strstr(ran.err, "GOMP_SPINCOUNT") != NULL, told = !!strstr(ran.err, says);
    bl_ran_free(&ran);
    if (!is_libgomp)
        skip(); // another OpenMP, which has ways of its own
    if (!told)
        fail_msg("%s=%s: libgomp does not say %s", variable ? variable : "nothing", value, says);
}

static void test_threads_wait_quietly(void **state) {
    (void)state;
    check_telling(NULL, "", "GOMP_SPINCOUNT = '0'"); // that of the passive policy
}

static void test_the_users_own_way_is_kept(void **state) {
    (void)state;
    check_telling("OMP_WAIT_POLICY", "ACTIVE", "OMP_WAIT_POLICY = 'ACTIVE'");
    check_telling("GOMP_SPINCOUNT", "1234", "GOMP_SPINCOUNT = '1234'");
}

// A program that the program starts keeps what it finds in its environment.
static void test_children_have_the_environment_of_the_user(void **state) {
    (void)state;
    char text[512];
    unsetenv("OMP_WAIT_POLICY");
    unsetenv("GOMP_SPINCOUNT");
    setenv("PWD", "/", 0);
    snprintf(text, sizeof text, "cmd:sh -c 'tr \"\\0\" \"\\n\" < /proc/self/environ > %s'",
             bl_temporary_path("environment"));
    bl_ran ran = bl_run_program("eval", text, "1");
    bl_ran_free(&ran);
    char *seen = bl_temporary_read(bl_temporary_path("environment"), NULL);
    assert_non_null(seen);
    assert_null(strstr(seen, "OMP_WAIT_POLICY"));
    for (char **entry = environ; *entry; entry++)
        if (strncmp(*entry, "_=", 2) != 0 && !strstr(seen, *entry)) // `_` is the shell's
            fail_msg("a child does not see %s", *entry);
    free(seen);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_threads_wait_quietly),
        cmocka_unit_test(test_the_users_own_way_is_kept),
        cmocka_unit_test(test_children_have_the_environment_of_the_user),
    };
    return bl_run_tests(tests);
}
