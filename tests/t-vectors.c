// SPDX-License-Identifier: MIT
//
// Repeats across the axes, and repeats of functions of float coordinates, are found; fields without
// them have none. There is no chance in it.
#include "tests/test.h"

#include "tests/scores.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

// The field repeats by the vector: whole vectors are taken off until the last of its parts that is
// not 0 is within one of them.
static double vector[BL_AXES];

static double repeated(const bl_signal *inner, const double at[BL_AXES]) {
    double place[BL_AXES];
    int last = 0;
    for (int a = 0; a < BL_AXES; a++)
        last = vector[a] != 0 ? a : last;
    double times = floor(at[last] / vector[last]);
    for (int a = 0; a < BL_AXES; a++)
        place[a] = at[a] - times * vector[a];
    return bl_signal_value(inner, place);
}

static void check_vector(const bl_signal *inner, const double by[3], const char *told) {
    for (int a = 0; a < 3; a++)
        vector[a] = by[a];
    bl_signal *signal = bl_test_seen_through(inner, repeated);
    bl_score_property found = bl_test_score(signal, "period", BL_QUICK, 1);
    if (found.verdict != BL_VERDICT_FAIL || !strstr(found.reason, told))
        fail_msg("%s: %s: '%s' does not tell it", told, bl_verdict_word(found.verdict),
                 found.reason);
    bl_signal_free(signal);
}

static void test_a_repeat_by_a_vector_is_found(void **state) {
    (void)state;
    static const struct {
        double by[3];
        const char *told;
    } cases[] = {{{57, -1, 0}, "(-57, 1, 0)"},
                 {{1, 1, 0}, "(1, 1, 0)"},
                 {{-211, 180, 0}, "(-211, 180, 0)"},
                 {{3, -5, 7}, "(3, -5, 7)"},
                 {{0, 255, 256}, "(0, 255, 256)"},
                 {{-256, -256, 256}, "(-256, -256, 256)"},
                 {{128, 0, 1}, "(128, 0, 1)"},
                 {{4096, 4096, 0}, "(4096, 4096, 0)"},
                 {{0, -65536, 65536}, "(0, -65536, 65536)"}};
    static const char *const texts[] = {"gnoise:seed=5", "vnoise:seed=5", "scnoise:seed=5"};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        bl_signal *inner = bl_test_open(texts[t], BL_ISA_BEST);
        for (size_t i = t; i < sizeof cases / sizeof *cases; i += t ? 3 : 1)
            check_vector(inner, cases[i].by, cases[i].told);
        bl_signal_free(inner);
    }
}

// --- float coordinates --------------------------------------------------------------------------

static double period;

static double of_floats(const bl_signal *inner, const double at[BL_AXES]) {
    double place[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        place[a] = (double)(float)at[a];
    place[1] = period > 0 ? place[1] - period * floor(place[1] / period) : place[1];
    return bl_signal_value(inner, place);
}

static void test_a_period_of_a_function_of_floats_is_found(void **state) {
    (void)state;
    bl_signal *inner = bl_test_open("gnoise:seed=5", BL_ISA_BEST);
    for (int k = 14; k <= 21; k++) {
        char told[64];
        period = ldexp(1, k);
        snprintf(told, sizeof told, "repeats after %.0f along y", period);
        bl_signal *signal = bl_test_seen_through(inner, of_floats);
        bl_score_property found = bl_test_score(signal, "period", BL_QUICK, 1);
        if (found.verdict != BL_VERDICT_FAIL || !strstr(found.reason, told))
            fail_msg("'%s' does not tell '%s'", found.reason, told);
        bl_signal_free(signal);
    }
    bl_signal_free(inner);
}

// Without a period it has none, and the reason tells how far it has values of its own: eighths of a
// cell are distinct floats up to 2^21, and half of them up to 2^22.
static void test_coinciding_floats_are_no_period(void **state) {
    (void)state;
    bl_signal *inner = bl_test_open("gnoise:seed=5", BL_ISA_BEST);
    period = 0;
    bl_signal *signal = bl_test_seen_through(inner, of_floats);
    bl_score_property found = bl_test_score(signal, "period", BL_QUICK, 1);
    assert_int_equal(found.verdict, BL_VERDICT_PASS);
    if (!strstr(found.reason, "up to 2.1e+06 units, where") &&
        !strstr(found.reason, "up to 1.05e+06 units, where"))
        fail_msg("%s", found.reason);
    bl_signal_free(signal);
    bl_signal_free(inner);
}

static void test_no_noise_of_the_registry_repeats_by_a_vector(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        bl_signal *signal = bl_test_open(bl_noise_at(i, BL_ISA_BEST)->name, BL_ISA_BEST);
        bl_score_property found = bl_test_score(signal, "period", BL_QUICK, 1);
        if (strstr(found.reason, "vector"))
            fail_msg("%s: %s", signal->text, found.reason);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_repeat_by_a_vector_is_found),
        cmocka_unit_test(test_a_period_of_a_function_of_floats_is_found),
        cmocka_unit_test(test_coinciding_floats_are_no_period),
        cmocka_unit_test(test_no_noise_of_the_registry_repeats_by_a_vector),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
