// SPDX-License-Identifier: MIT
//
// The documents say what is so: every command that they show is run and must print what they show,
// the generated table of noises is that of the registry, and every file that they link to exists.
//
// Commands are read from the documents alone. In a block between ``` lines a line "$ command" is
// run, with what follows as its output: a line "..." stands for any lines, and what stands in a
// column "ns" is a time and not compared. A program in C is written to a file, and a block without
// "$ " is not run; a comment that readers do not see stands before them: <!-- file: mine.c -->,
// <!-- not run: why -->. In the man page every line of EXAMPLES is run, and the commands of the
// workflow's `run:` lines are.
#include "tests/test.h"

#include <limits.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/program.h"
#include "tests/temporary.h"

enum { LINE = 1024, SECONDS_MOST = 60 };

// --- running ---

static char here[PATH_MAX], build[PATH_MAX];

// A fresh folder with what a user has there: the build, and copies of the rest.
static const char *fresh_folder(const char *name) {
    char command[8 * PATH_MAX];
    const char *folder = bl_temporary_path(name);
    snprintf(
        command, sizeof command,
        "mkdir '%s' && cd '%s' && ln -s '%s' build && for f in include docs man README.md; do "
        "ln -s \"%s/$f\" .; done && cp -r '%s/examples' . && make -s -C examples/plugin clean && "
        "make -s -C examples/program clean && cp examples/program/noise.py "
        "examples/plugin/mynoise.c include/bandlimit_plugin.h .",
        folder, folder, build, here, here);
    assert_int_equal(system(command), 0);
    return folder;
}

// What a command of the shell says on both streams, for the caller to free.
static char *run(const char *folder, const char *text, int *status) {
    char path[PATH_MAX], *command, *says;
    FILE *script;
    snprintf(path, sizeof path, "%s/.command", folder);
    assert_non_null(script = fopen(path, "w"));
    fprintf(script, "%s\n", text);
    fclose(script);
    assert_true(asprintf(&command,
                         "cd '%s' && PATH='%s':$PATH timeout %d sh .command </dev/null >.says 2>&1",
                         folder, build, SECONDS_MOST) > 0);
    int ended = system(command);
    *status = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128;
    free(command);
    snprintf(path, sizeof path, "%s/.says", folder);
    says = bl_temporary_read(path, NULL);
    assert_non_null(says);
    return says;
}

// The next line of a text, without its end; 0 if there is none.
static int next_line(const char **at, char line[LINE]) {
    size_t length = strcspn(*at, "\n");
    if (!**at)
        return 0;
    assert_true(length < LINE);
    snprintf(line, LINE, "%.*s", (int)length, *at);
    *at += length + ((*at)[length] == '\n');
    return 1;
}

// --- comparing ---

// Columns are two blanks apart: where one ends, and where the next begins.
static size_t column_size(const char *at) {
    size_t size = 0;
    while (at[size] && strncmp(at + size, "  ", 2) != 0)
        size++;
    return size;
}

static const char *next_column(const char *at) {
    at += column_size(at);
    return at + strspn(at, " ");
}

// The column of a heading that holds nanoseconds; -1 if none.
static int column_of_times(const char *line) {
    int column = 0;
    for (const char *at = line + strspn(line, " "); *at; at = next_column(at), column++)
        if (column_size(at) == 2 && memcmp(at, "ns", 2) == 0)
            return column;
    return -1;
}

// Whether two lines have the same columns, where widths and the column `times` may differ.
static int same_line(const char *a, const char *b, int times) {
    a += strspn(a, " ");
    b += strspn(b, " ");
    for (int column = 0; *a || *b; column++, a = next_column(a), b = next_column(b)) {
        size_t size = column_size(a);
        if (column != times && (size != column_size(b) || memcmp(a, b, size) != 0))
            return 0;
    }
    return 1;
}

static int same_text(const char *shown, const char *said, int times) {
    char expected[LINE], found[LINE];
    const char *rest = said;
    if (!next_line(&shown, expected))
        return *said == '\0';
    if (strcmp(expected, "...") == 0) {
        do
            if (same_text(shown, rest, times))
                return 1;
        while (next_line(&rest, found));
        return 0;
    }
    if (!next_line(&rest, found))
        return 0;
    if (column_of_times(found) >= 0)
        times = column_of_times(found);
    return same_line(expected, found, times) && same_text(shown, rest, times);
}

// What measures for seconds is run at full scale only.
static int takes_long(const char *command) {
    static const char *const verbs[] = {" score ",  " compare ", " reproduce ",
                                        " advise ", " alias ",   " --claims"};
    for (size_t i = 0; i < sizeof verbs / sizeof *verbs; i++)
        if (strstr(command, verbs[i]))
            return 1;
    return 0;
}

static void expect_output(const char *document, const char *folder, const char *command,
                          const char *shown) {
    int status;
    if (!bl_test_walk(bl_test_scaled(8, 0) >= 8 || !takes_long(command)))
        return;
    char *says = run(folder, command, &status);
    if (status > 2 && !strstr(command, "||")) // a verdict that is inconclusive or fails is one
        fail_msg("%s: `%s` ends with status %d:\n%s", document, command, status, says);
    if (*shown && !same_text(shown, says, -1))
        fail_msg("%s: `%s` says\n%s\nand the document shows\n%s", document, command, says, shown);
    free(says);
}

// --- reading ---

// A block of a document: its lines, and the comment in the line before it.
typedef struct reader {
    const char *document, *folder, *at;
    char note[LINE];
    size_t commands;
} reader;

static void append(char **text, const char *line) {
    char *longer;
    assert_true(asprintf(&longer, "%s%s\n", *text, line) >= 0);
    free(*text);
    *text = longer;
}

static void run_block(reader *r, const char *block) {
    char line[LINE];
    int more = next_line(&block, line);
    while (more) {
        char *command = strdup(""), *shown = strdup("");
        assert_memory_equal(line, "$ ", 2);
        append(&command, line + 2);
        while (line[strlen(line) - 1] == '\\' && next_line(&block, line))
            append(&command, line);
        while ((more = next_line(&block, line)) && strncmp(line, "$ ", 2) != 0)
            append(&shown, line);
        expect_output(r->document, r->folder, command, shown);
        r->commands++;
        free(command);
        free(shown);
    }
}

static void take_block(reader *r, const char *block) {
    char name[128];
    if (strncmp(r->note, "<!-- not run: ", 14) == 0)
        return;
    if (sscanf(r->note, "<!-- file: %127s", name) == 1) {
        char path[PATH_MAX];
        snprintf(path, sizeof path, "%s/%s", r->folder, name);
        bl_temporary_write(path, block, strlen(block));
    } else if (strncmp(block, "$ ", 2) == 0) {
        run_block(r, block);
    } else {
        fail_msg("%s: a block is neither run nor said to be not run:\n%s", r->document, block);
    }
}

static size_t run_document(const char *document, const char *folder) {
    char *text = bl_temporary_read(document, NULL), line[LINE];
    assert_non_null(text);
    reader r = {.document = document, .folder = folder, .at = text};
    while (next_line(&r.at, line)) {
        if (strncmp(line, "```", 3) == 0) {
            char *block = strdup("");
            while (next_line(&r.at, line) && strcmp(line, "```") != 0)
                append(&block, line);
            take_block(&r, block);
            free(block);
        }
        if (strncmp(line, "    ", 4) == 0 && !*r.note)
            assert_null(strstr(line, "bandlimit ")); // an indented block would not be run
        snprintf(r.note, sizeof r.note, "%s", line);
    }
    free(text);
    return r.commands;
}

static void test_the_commands_of_the_readme_say_what_it_shows(void **state) {
    (void)state;
    assert_true(run_document("README.md", fresh_folder("readme")) > 15);
}

static void test_the_commands_of_the_examples_say_what_is_shown(void **state) {
    (void)state;
    const char *folder = fresh_folder("examples");
    assert_true(run_document("examples/README.md", folder) >= 8);
    // The workflow's own commands; its other lines fetch and install.
    char *text = bl_temporary_read("examples/ci/bandlimit.yml", NULL), line[LINE];
    const char *at = text;
    size_t count = 0;
    expect_output("examples/ci", folder, "cp examples/plugin/mynoise.c .", "");
    while (next_line(&at, line)) {
        const char *command = strstr(line, "run: ");
        if (!command || strstr(command, "apt-get") || strcmp(command + 5, "|") == 0)
            continue;
        expect_output("examples/ci/bandlimit.yml", folder, command + 5, "");
        count++;
    }
    assert_int_equal(count, 3);
    free(text);
}

// A line of the man page as the reader sees it.
static void unescape(char *line) {
    char *to = line;
    for (const char *c = line; *c; c++)
        if (c[0] == '\\' && c[1] == 'e')
            *to++ = '\\', c++;
        else if (c[0] == '\\' && (c[1] == '-' || c[1] == '&'))
            c[1] == '-' ? *to++ = '-' : 0, c++;
        else
            *to++ = *c;
    *to = '\0';
}

static void test_the_examples_of_the_man_page_run(void **state) {
    (void)state;
    char *text = bl_temporary_read("man/bandlimit.1", NULL), line[LINE];
    const char *folder = fresh_folder("man"), *at = strstr(text, ".SH EXAMPLES\n");
    size_t count = 0;
    assert_non_null(at);
    at = strstr(at, ".nf\n") + strlen(".nf\n");
    for (; next_line(&at, line) && strcmp(line, ".fi") != 0; count++) {
        unescape(line);
        expect_output("man page", folder, line, "");
    }
    assert_true(count > 15);
    free(text);
}

// --- files and words ---

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

// Options within `code` of a document, after a verb: `bandlimit check --claims`.
static void test_verbs_and_options_that_are_named_exist(void **state) {
    (void)state;
    size_t count = 0;
    for (size_t d = 0; d < DOCUMENTS; d++) {
        char *text = bl_temporary_read(documents[d], NULL), verb[32], option[64];
        assert_non_null(text);
        for (char *at = text; (at = strstr(at, "bandlimit ")); at++) {
            if (at > text && !strchr("`/ ", at[-1]))
                continue;
            if (sscanf(at, "bandlimit %31[a-z]", verb) != 1 || !(at[-1] == '`' || at[-1] == '/'))
                continue;
            bl_ran ran = bl_run_program("help", verb);
            if (ran.status != 0)
                fail_msg("%s runs bandlimit %s, which is no verb", documents[d], verb);
            char *end = at + strcspn(at, "`\n|;");
            for (char *o = at; (o = strstr(o, " --")) && o < end; o++, count++) {
                snprintf(option, sizeof option, "%.*s", (int)strcspn(o + 1, " =`\n"), o + 1);
                if (!strstr(ran.out, option) && strcmp(option, "--version") != 0)
                    fail_msg("%s: bandlimit %s has no option %s", documents[d], verb, option);
            }
            bl_ran_free(&ran);
        }
        free(text);
    }
    assert_true(count > 10);
}

static int find_folders(void **state) {
    (void)state;
    const char *given = getenv("BL_BUILD");
    assert_non_null(getcwd(here, sizeof here));
    assert_non_null(realpath(given && *given ? given : "build", build));
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_commands_of_the_readme_say_what_it_shows),
        cmocka_unit_test(test_the_commands_of_the_examples_say_what_is_shown),
        cmocka_unit_test(test_the_examples_of_the_man_page_run),
        cmocka_unit_test(test_the_table_of_noises_is_that_of_the_program),
        cmocka_unit_test(test_links_lead_to_files),
        cmocka_unit_test(test_verbs_and_options_that_are_named_exist),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, find_folders, NULL);
}
