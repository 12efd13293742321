// SPDX-License-Identifier: MIT
//
// Classes of continuity in words, alone and as `show` prints them.
#include "tests/test.h"

#include <limits.h>

#include "core/continuity.h"
#include "tests/program.h"

static void check(int continuity, const char *expected) {
    char text[16];
    assert_string_equal(bl_continuity_text(continuity, text, sizeof text), expected);
}

static void test_classes_have_words(void **state) {
    (void)state;
    check(INT_MIN, "not stated");
    check(-2, "not stated");
    check(-1, "discontinuous");
    check(0, "C0");
    check(3, "C3");
    check(BL_CONTINUITY_ALL - 1, "C98");
    check(BL_CONTINUITY_ALL, "C-infinity");
    check(INT_MAX, "C-infinity");
}

static void test_show_prints_the_class(void **state) {
    (void)state;
    static const char *const shown[][2] = {{"gardner", "C-infinity"},
                                           {"gnoise", "C1"},
                                           {"white", "discontinuous"},
                                           {"cellular", "C0"}};
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
        char text[64], json[64];
        snprintf(text, sizeof text, "continuity   %s\n", shown[i][1]);
        snprintf(json, sizeof json, "\"continuity\": \"%s\"", shown[i][1]);
        bl_ran plain = bl_run_program("show", shown[i][0]);
        bl_ran object = bl_run_program("show", shown[i][0], "--json");
        if (!strstr(plain.out, text) || !strstr(object.out, json))
            fail_msg("show %s does not say %s", shown[i][0], shown[i][1]);
        bl_ran_free(&plain);
        bl_ran_free(&object);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_classes_have_words),
        cmocka_unit_test(test_show_prints_the_class),
    };
    return bl_run_tests(tests);
}
