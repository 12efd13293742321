// SPDX-License-Identifier: MIT
//
// The property `scale`: the correlation length is that of the covariance, a lattice is found to its
// last digit and none is seen where there is none, and what does not vary fails.
//
// Error rates: r is a mean of 256 products, so that a length is held to a factor of 1.5; the
// lattice is a line that stands above its surroundings by chance in less than 1e-6 of all rows, and
// a cell that is found has all its digits.
#include "tests/test.h"

#include "core/hash.h"
#include "score/properties/scale.h"
#include "tests/scores.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

static bl_score_settings settings(void) {
    bl_score_settings own = bl_score_default_settings();
    own.size = BL_QUICK;
    return own;
}

static bl_score_scale scale_of(bl_signal *signal) {
    const bl_score_settings own = settings();
    signal->facts.cell = NAN; // so that the lattice is sought
    return bl_score_find_scale(signal, &own);
}

// A cosine of frequency f with a random phase has r(h) = 1 - cos(2 pi f h), averaged over h .. 2h
// 1/2 near h = 0.15/f. Three axes have three lengths, and the shortest is found.
static void test_the_correlation_length_is_that_of_the_covariance(void **state) {
    (void)state;
    static const double frequencies[][3] = {{1, 0.1, 0.01},     {0.3, 7, 0.002},
                                            {1e-5, 2e-6, 3e-4}, {123, 456, 789},
                                            {1e-3, 1e-3, 1e-3}, {0.02, 0.0004, 0.0001}};
    for (size_t i = 0; i < sizeof frequencies / sizeof *frequencies; i++) {
        double highest = fmax(frequencies[i][0], fmax(frequencies[i][1], frequencies[i][2]));
        bl_signal *signal = bl_test_cosine(0.5, 1, frequencies[i]);
        bl_score_scale scale = scale_of(signal);
        assert_int_equal(scale.variation, BL_VARIES);
        double expected = 1.5 * 0.14 / highest; // the mean distance where r is 1/2
        if (!(scale.length > expected / 2 && scale.length < expected * 2))
            fail_msg("case %zu: length %g, expected about %g", i, scale.length, expected);
        bl_signal_free(signal);
    }
}

static double stretch;

static double stretched(const bl_signal *inner, const double at[BL_AXES]) {
    return bl_signal_value(inner, (const double[BL_AXES]){at[0] / stretch, at[1] / stretch,
                                                          at[2] / stretch, at[3] / stretch});
}

static void test_a_lattice_is_found_to_its_last_digit(void **state) {
    (void)state;
    static const double cells[] = {1, 100, 0.01, 37, 1e6, 0.3, 2.5, 1024};
    static const char *const texts[] = {"vnoise:seed=3", "gnoise:seed=3", "gnoise:seed=3,dims=2"};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        bl_signal *inner = bl_test_open(texts[t], BL_ISA_BEST);
        for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
            stretch = cells[i];
            bl_signal *signal = bl_test_seen_through(inner, stretched);
            bl_score_scale scale = scale_of(signal);
            if (!(fabs(scale.lattice - cells[i]) <= 1e-12 * cells[i]))
                fail_msg("%s stretched %g times: lattice %.17g", texts[t], cells[i], scale.lattice);
            assert_near(bl_score_cell_of(&scale), scale.lattice, 0);
            bl_signal_free(signal);
        }
        bl_signal_free(inner);
    }
}

static void test_no_lattice_is_seen_where_there_is_none(void **state) {
    (void)state;
    static const char *const texts[] = {"scnoise", "simplex", "fourier",
                                        "spot",    "gabor",   "cellular"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_signal *signal = bl_test_open(texts[i], BL_ISA_BEST);
        bl_score_scale scale = scale_of(signal);
        assert_int_equal(scale.variation, BL_VARIES);
        if (scale.lattice != 0)
            fail_msg("%s: a lattice of %g", texts[i], scale.lattice);
        double cell = bl_score_cell_of(&scale); // a power of two within a factor of 2
        assert_near(log2(cell), round(log2(cell)), 0);
        assert_true(cell <= 2 * scale.length && cell > scale.length);
        bl_signal_free(signal);
    }
}

// Every noise that states a cell states one that agrees with its values.
static void test_no_noise_of_the_registry_states_a_wrong_cell(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        bl_signal *signal = bl_test_open(bl_noise_at(i, BL_ISA_BEST)->name, BL_ISA_BEST);
        bl_score_property found = bl_test_score(signal, "scale", BL_QUICK, 1);
        if (found.verdict == BL_VERDICT_FAIL && found.against == BL_AGAINST_CLAIM)
            fail_msg("%s: %s", signal->text, found.reason);
        bl_signal_free(signal);
    }
}

static double rare(const bl_signal *inner, const double at[BL_AXES]) {
    return bl_signal_value(inner, at) > 0.42 ? 1 : 0; // 2.3 deviations of gnoise
}
static double often(const bl_signal *inner, const double at[BL_AXES]) {
    return bl_signal_value(inner, at) > 0.2 ? 1 : 0; // 1.1 deviations
}
static double unrelated(const bl_signal *inner, const double at[BL_AXES]) {
    (void)inner;
    uint64_t bits, key = 0;
    for (int a = 0; a < 3; a++) {
        memcpy(&bits, &at[a], sizeof bits);
        key = bl_mix(key ^ bits);
    }
    return (double)(key >> 11) * 0x1p-53;
}
static double ramp(const bl_signal *inner, const double at[BL_AXES]) {
    (void)inner;
    return at[0] + 0.3 * at[1] - at[2];
}

static void test_what_does_not_vary_over_a_distance_fails(void **state) {
    (void)state;
    static const struct {
        bl_test_view *view;
        const char *cell;
        bl_verdict verdict;
    } cases[] = {{rare, "constant", BL_VERDICT_FAIL},
                 {often, "0.", BL_VERDICT_PASS},
                 {unrelated, "white", BL_VERDICT_FAIL},
                 {ramp, "none", BL_VERDICT_FAIL}};
    bl_signal *inner = bl_test_open("gnoise:seed=3", BL_ISA_BEST);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_seen_through(inner, cases[i].view);
        bl_score_property found = bl_test_score(signal, "scale", BL_QUICK, 1);
        if (found.verdict != cases[i].verdict || !strstr(found.cell, cases[i].cell))
            fail_msg("case %zu: %s: %s", i, found.cell, found.reason);
        bl_signal_free(signal);
    }
    bl_signal *constant = bl_test_constant(0.25); // it has a seed, and so it states that it varies
    bl_score_property found = bl_test_score(constant, "scale", BL_QUICK, 1);
    assert_int_equal(found.verdict, BL_VERDICT_FAIL);
    assert_int_equal(found.against, BL_AGAINST_CLAIM);
    assert_string_equal(found.cell, "constant");
    bl_signal_free(constant);
    bl_signal_free(inner);
}

static void test_a_stated_cell_that_is_wrong_fails(void **state) {
    (void)state;
    bl_signal *inner = bl_test_open("gnoise:seed=3", BL_ISA_BEST);
    stretch = 100;
    bl_signal *signal = bl_test_seen_through(inner, stretched);
    static const double stated[] = {1, 0.01, 1e5, 100, 50, 300};
    for (size_t i = 0; i < sizeof stated / sizeof *stated; i++) {
        signal->facts.cell = stated[i];
        bl_score_property found = bl_test_score(signal, "scale", BL_QUICK, 1);
        assert_int_equal(found.against, BL_AGAINST_CLAIM);
        assert_int_equal(found.verdict, i < 3 ? BL_VERDICT_FAIL : BL_VERDICT_PASS);
    }
    bl_signal_free(signal);
    bl_signal_free(inner);
}

// The verdicts of a signal that states no cell are those of one that states the right one.
static void test_verdicts_do_not_depend_on_the_cell_being_stated(void **state) {
    (void)state;
    static const char *const names[] = {"range",      "period", "symmetry", "stationarity",
                                        "continuity", "far",    "isotropy"};
    bl_signal *inner = bl_test_open("vnoise:seed=3", BL_ISA_BEST);
    stretch = 100;
    bl_signal *signal = bl_test_seen_through(inner, stretched);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        signal->facts.cell = NAN;
        bl_score_property found = bl_test_score(signal, names[i], BL_QUICK, 1);
        signal->facts.cell = stretch;
        bl_score_property right = bl_test_score(signal, names[i], BL_QUICK, 1);
        if (found.verdict != right.verdict || strcmp(found.cell, right.cell) != 0)
            fail_msg("%s: %s %s, and with the cell stated %s %s", names[i],
                     bl_verdict_word(found.verdict), found.cell, bl_verdict_word(right.verdict),
                     right.cell);
    }
    bl_signal_free(signal);
    bl_signal_free(inner);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_correlation_length_is_that_of_the_covariance),
        cmocka_unit_test(test_a_lattice_is_found_to_its_last_digit),
        cmocka_unit_test(test_no_lattice_is_seen_where_there_is_none),
        cmocka_unit_test(test_no_noise_of_the_registry_states_a_wrong_cell),
        cmocka_unit_test(test_what_does_not_vary_over_a_distance_fails),
        cmocka_unit_test(test_a_stated_cell_that_is_wrong_fails),
        cmocka_unit_test(test_verdicts_do_not_depend_on_the_cell_being_stated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
