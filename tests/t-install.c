// SPDX-License-Identifier: MIT
//
// What `make install` leaves: programs of users, in C and C++, shared and static, are compiled and
// run against the installed files alone; nothing but the public functions is exported, and nothing
// but what runs is there.
#include "tests/test.h"

#include <unistd.h>

#include "tests/temporary.h"

enum { NAMES_MOST = 200, NAME_SIZE = 80 };

static const char *environment(const char *name, const char *otherwise) {
    const char *value = getenv(name);
    return value && *value ? value : otherwise;
}

// Runs a command of the shell in which $D stands for the root of the installation, $L for the
// folder of its libraries; what it says on standard output goes into `says`, if there is room.
static void run(char *says, size_t size, const char *format, ...) {
    char command[4096], line[4096];
    size_t length = 0;
    va_list arguments;
    int start = snprintf(
        command, sizeof command,
        "D='%s/root'; mkdir -p $D; L=$(dirname \"$(find $D -name libbandlimit.so)\"); exec 2>&1; ",
        bl_temporary_folder());
    va_start(arguments, format);
    vsnprintf(command + start, sizeof command - (size_t)start, format, arguments);
    va_end(arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    char *into = says ? says : line;
    const size_t room = says ? size : sizeof line;
    while (length + 1 < room && fgets(into + length, (int)(room - length), pipe))
        length += strlen(into + length);
    into[length] = '\0';
    if (pclose(pipe) != 0)
        fail_msg("%s\n%s", command + start, into);
}

// --- the installation ---

static int install(void **state) {
    (void)state;
    unsetenv("MAKEFLAGS"); // of a make around this test
    unsetenv("MAKELEVEL");
    run(NULL, 0, "make --no-print-directory V=1 BUILD='%s' SANITIZE='%s' DESTDIR=$D install",
        environment("BL_BUILD", "build"), environment("BL_SANITIZE", ""));
    return 0;
}

// How a program is compiled with the flags that the installed .pc file gives.
#define PKG                                                                                        \
    "pkg-config --define-variable=prefix=$(dirname $(dirname $(find "                              \
    "$D -name bandlimit.h)))"
#define STRICT "-Wall -Wextra -pedantic -Werror -O1"

static void test_a_program_in_c_compiles_and_runs(void **state) {
    (void)state;
    run(NULL, 0,
        "PKG_CONFIG_PATH=$L/pkgconfig; export PKG_CONFIG_PATH; %s -std=c17 " STRICT
        " tests/users/user.c $(" PKG
        " --cflags --libs bandlimit) %s -lm -o $D/user && "
        "LD_LIBRARY_PATH=$L $D/user $D",
        environment("CC", "cc"), environment("BL_SANITIZE", ""));
}

static void test_a_program_in_cpp_compiles_and_runs(void **state) {
    (void)state;
    run(NULL, 0,
        "PKG_CONFIG_PATH=$L/pkgconfig; export PKG_CONFIG_PATH; %s -x c++ -std=c++17 " STRICT
        " tests/users/user.c -x none $(" PKG
        " --cflags --libs bandlimit) %s -o $D/user++ && "
        "LD_LIBRARY_PATH=$L $D/user++ $D",
        environment("CXX", "c++"), environment("BL_SANITIZE", ""));
}

// Without the shared library the linker takes the static one; images are found through the
// environment, as this root is no place that a program of its own could know of.
static void test_a_program_with_the_static_library_runs(void **state) {
    (void)state;
    run(NULL, 0,
        "PKG_CONFIG_PATH=$L/pkgconfig; export PKG_CONFIG_PATH; mkdir -p $D/static && "
        "cp $L/libbandlimit.a $D/static && %s -std=c17 " STRICT " tests/users/user.c $(" PKG
        " --cflags bandlimit) -L$D/static $(" PKG
        " --static --libs bandlimit | sed \"s|-L$L||\") %s -o $D/user-static && "
        "! ldd $D/user-static | grep bandlimit && "
        "BANDLIMIT_IMAGES=$L/bandlimit/bandlimit-images.so $D/user-static $D",
        environment("CC", "cc"), environment("BL_SANITIZE", ""));
}

// With the installed .pc alone: to compile needs the packages of no other library.
static void test_a_plugin_compiles_with_the_flags_of_pkg_config(void **state) {
    (void)state;
    run(NULL, 0,
        "PKG_CONFIG_LIBDIR=$L/pkgconfig; export PKG_CONFIG_LIBDIR; cd $D && cp "
        "\"$OLDPWD/examples/plugin/mynoise.c\" . && cc -fPIC -shared $(" PKG
        " --cflags bandlimit) mynoise.c -o mynoise.so -lm && "
        "$(find $D -name bandlimit -type f -perm -1) eval ./mynoise.so:waves 1 2 3");
}

static void test_the_example_measures(void **state) {
    (void)state;
    char says[2048];
    run(says, sizeof says,
        "PKG_CONFIG_PATH=$L/pkgconfig; export PKG_CONFIG_PATH; %s -std=c17 " STRICT
        " examples/library/measure.c $(" PKG
        " --cflags --libs bandlimit) %s -o $D/measure && "
        "LD_LIBRARY_PATH=$L $D/measure gnoise:seed=7",
        environment("CC", "cc"), environment("BL_SANITIZE", ""));
    assert_non_null(strstr(says, "values "));
    assert_non_null(strstr(says, ": pass"));
}

static void test_the_header_compiles_alone(void **state) {
    (void)state;
    run(NULL, 0,
        "for h in $(find $D -name '*.h'); do cc -x c -std=c17 " STRICT
        " -fsyntax-only $h && c++ -x c++ -std=c++17 " STRICT " -fsyntax-only $h || exit 1; done");
    char headers[1024];
    run(headers, sizeof headers, "find $D -name '*.h' | wc -l");
    assert_int_equal(atoi(headers), 2);
}

// --- what is exported ---

// The functions that the header declares: a name before a parenthesis, in a line of code.
static size_t read_header(char names[NAMES_MOST][NAME_SIZE]) {
    size_t size, count = 0;
    char *text = bl_temporary_read("include/bandlimit.h", &size);
    for (char *at = text, *line = text; at && (at = strstr(at, "bandlimit_"));) {
        size_t length = strspn(at, "abcdefghijklmnopqrstuvwxyz_");
        for (char *c = line; c < at; c++)
            line = *c == '\n' ? c + 1 : line;
        if (at[length] == '(' && !memchr(line, '/', (size_t)(at - line))) {
            assert_true(count < NAMES_MOST && length < NAME_SIZE);
            snprintf(names[count++], NAME_SIZE, "%.*s", (int)length, at);
        }
        at += length;
    }
    free(text);
    return count;
}

static void check_exports(const char *command) {
    static char names[NAMES_MOST][NAME_SIZE];
    char says[16384];
    size_t count = read_header(names), lines = 0;
    assert_in_range(count, 30, NAMES_MOST);
    run(says, sizeof says, "%s | sed -n 's/.* [A-Z] //p'", command);
    for (const char *c = says; *c; c++)
        lines += *c == '\n';
    for (size_t i = 0; i < count; i++) {
        char line[NAME_SIZE + 2];
        snprintf(line, sizeof line, "%s\n", names[i]);
        if (!strstr(says, line))
            fail_msg("%s is not exported", names[i]);
    }
    if (lines != count)
        fail_msg("%zu names are exported, and the header has %zu:\n%s", lines, count, says);
}

static void test_the_public_functions_are_exported_and_nothing_else(void **state) {
    (void)state;
    check_exports("nm -D --defined-only $L/libbandlimit.so");
    check_exports("nm -g --defined-only $L/libbandlimit.a");
}

static void test_what_is_installed_is_stripped(void **state) {
    (void)state;
    char says[1024];
    run(NULL, 0,
        "for f in $D/*/*/bin/bandlimit $L/libbandlimit.so $L/libbandlimit.a "
        "$L/bandlimit/bandlimit-images.so; do ! readelf -S $f | grep debug_info || exit 1; done");
    run(says, sizeof says, "$(find $D -name bandlimit -type f -perm -1) --version");
    assert_non_null(strstr(says, "bandlimit"));
}

static void test_the_installed_program_finds_its_images(void **state) {
    (void)state;
    run(NULL, 0,
        "cd / && $(find $D -name bandlimit -type f -perm -1) render gnoise --quick -o "
        "$D/picture.png && test -s $D/picture.png");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_program_in_c_compiles_and_runs),
        cmocka_unit_test(test_a_program_in_cpp_compiles_and_runs),
        cmocka_unit_test(test_a_program_with_the_static_library_runs),
        cmocka_unit_test(test_a_plugin_compiles_with_the_flags_of_pkg_config),
        cmocka_unit_test(test_the_example_measures),
        cmocka_unit_test(test_the_header_compiles_alone),
        cmocka_unit_test(test_the_public_functions_are_exported_and_nothing_else),
        cmocka_unit_test(test_what_is_installed_is_stripped),
        cmocka_unit_test(test_the_installed_program_finds_its_images),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, install, NULL);
}
