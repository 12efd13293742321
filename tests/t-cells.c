// SPDX-License-Identifier: MIT
//
// The cell of a column says what its sentence says: the same number for the same quantity, and the
// fault where there is one. Nothing here is random beyond the rates of the properties themselves.
#include "tests/test.h"

#include "tests/scores.h"
#include "tests/sources.h"

static bl_score_property measure(const char *text, const char *name) {
    bl_signal *signal = bl_test_open_source(text);
    bl_score_property found = bl_test_score(signal, name, BL_QUICK, 1);
    bl_signal_free(signal);
    return found;
}

static void expect(const char *text, const char *name, const char *cell, const char *reason) {
    bl_score_property result = measure(text, name);
    if (!strstr(result.cell, cell) || !strstr(result.reason, reason))
        fail_msg("%s of %s: '%s', '%s'; expected '%s', '%s'", name, text, result.cell,
                 result.reason, cell, reason);
}

static void test_a_spectral_line_stands_in_the_cell(void **state) {
    (void)state;
    expect("turbulence", "period", "line 2", "a spectral line of 2 cycles");
}

static void test_the_moment_that_differs_stands_in_the_cell(void **state) {
    (void)state;
    expect("turbulence", "stationarity", "mean", "the mean at a vertex");
    expect("midpoint", "stationarity", "variance, region", "the variance in region");
    expect("vnoise", "stationarity", " dB", "the variance at the centre");
    expect("scnoise", "stationarity", " dB", "are the same");
}

// The number of the cell stands in the sentence, and names what it is of.
static void test_the_ratio_of_isotropy_is_one_number(void **state) {
    (void)state;
    static const char *const texts[] = {"perlin2002", "gnoise", "vcnoise", "fourier"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_score_property result = measure(texts[i], "isotropy");
        int is_lags = strncmp(result.cell, "lags ", 5) == 0;
        const char *number = result.cell + (is_lags ? 5 : 0);
        const char *found = strstr(result.reason, number);
        if (!found)
            fail_msg("%s: '%s' is not in '%s'", texts[i], number, result.reason);
        assert_int_equal(!is_lags, strstr(result.reason, "above 1 cycle a cell") != NULL);
    }
}

static void test_the_class_is_that_of_the_sentence(void **state) {
    (void)state;
    static const char *const texts[] = {"wood", "gnoise", "marble", "perlin2002"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_score_property result = measure(texts[i], "continuity");
        char sentence[64];
        snprintf(sentence, sizeof sentence, "up to derivative %c ", result.cell[1]);
        assert_int_equal(result.verdict, BL_VERDICT_PASS);
        if (!strstr(result.reason, sentence))
            fail_msg("%s: '%s', '%s'", texts[i], result.cell, result.reason);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_spectral_line_stands_in_the_cell),
        cmocka_unit_test(test_the_moment_that_differs_stands_in_the_cell),
        cmocka_unit_test(test_the_ratio_of_isotropy_is_one_number),
        cmocka_unit_test(test_the_class_is_that_of_the_sentence),
    };
    return bl_run_tests(tests);
}
