// SPDX-License-Identifier: MIT
//
// The documents say what is so: the generated table of noises is that of the registry, every file
// that the documents link to exists, and so does every verb that they tell to run.
#include "tests/test.h"

#include <unistd.h>

#include "tests/program.h"
#include "tests/temporary.h"

static void test_the_table_of_noises_is_that_of_the_program(void **state) {
    (void)state;
    char command[512];
    const char *made = bl_temporary_path("noises.md"), *program = getenv("BL_PROGRAM");
    snprintf(command, sizeof command, "sh docs/tables.sh %s noises > %s",
             program ? program : "build/bandlimit", made);
    assert_int_equal(system(command), 0);
    char *expected = bl_temporary_read(made, NULL),
         *found = bl_temporary_read("docs/noises.md", NULL);
    assert_non_null(expected);
    assert_non_null(found);
    if (strcmp(expected, found) != 0)
        fail_msg("docs/noises.md is not what the program says; run make docs");
    free(expected);
    free(found);
}

static const char *const documents[] = {"README.md",     "CONTRIBUTING.md",  "CHANGELOG.md",
                                        "REFERENCES.md", "docs/findings.md", "examples/README.md"};
enum { DOCUMENTS = sizeof documents / sizeof *documents };

static void test_links_lead_to_files(void **state) {
    (void)state;
    for (size_t d = 0; d < DOCUMENTS; d++) {
        char *text = bl_temporary_read(documents[d], NULL), path[512], target[256];
        assert_non_null(text);
        const char *slash = strrchr(documents[d], '/');
        for (char *at = text; (at = strstr(at, "](")); at++) {
            if (sscanf(at, "](%255[^)]", target) != 1 || strstr(target, "://"))
                continue;
            snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - documents[d] + 1) : 0,
                     documents[d], target);
            if (access(path, R_OK) != 0)
                fail_msg("%s links to %s, which is missing", documents[d], target);
        }
        free(text);
    }
}

static void test_commands_begin_with_a_verb(void **state) {
    (void)state;
    size_t count = 0;
    for (size_t d = 0; d < DOCUMENTS; d++) {
        char *text = bl_temporary_read(documents[d], NULL), verb[32];
        assert_non_null(text);
        for (char *at = text; (at = strstr(at, "build/bandlimit ")); at++, count++) {
            if (sscanf(at, "build/bandlimit %31[a-z]", verb) != 1)
                continue;
            bl_ran ran = bl_run_program("help", verb);
            if (ran.status != 0)
                fail_msg("%s runs bandlimit %s, which is no verb", documents[d], verb);
            bl_ran_free(&ran);
        }
        free(text);
    }
    assert_true(count > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_table_of_noises_is_that_of_the_program),
        cmocka_unit_test(test_links_lead_to_files),
        cmocka_unit_test(test_commands_begin_with_a_verb),
    };
    return bl_run_tests(tests);
}
