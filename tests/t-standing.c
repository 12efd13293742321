// SPDX-License-Identifier: MIT
//
// The property `stationarity`, at places that are fixed for all seeds: octaves that meet at the
// origin, and a variance that changes from cell to cell with any wave.
//
// Error rates: a table of good signals fails with 1e-6. With 384 seeds a wave of 25 % in the
// amplitude stands 15 standard errors out, and the variance at the origin of octaves that meet,
// 2.65 times that elsewhere, 8; the limit is 7.
#include "tests/test.h"

#include "noises/noise.h"
#include "tests/scores.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

static void expect(const bl_signal *signal, bl_size size, bl_verdict verdict, const char *told) {
    bl_score_property found = bl_test_score(signal, "stationarity", size, 1);
    if (found.verdict != verdict || !strstr(found.reason, told))
        fail_msg("%s: %s: '%s' does not tell '%s'", signal->text, bl_verdict_word(found.verdict),
                 found.reason, told);
}

// A basis that is stationary to begin with; the sums that state it are judged by it.
static void test_octaves_of_one_seed_meet_at_the_origin(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bl_verdict verdict;
        const char *told;
    } cases[] = {
        {"fractalsum:basis=scnoise", BL_VERDICT_FAIL, "at the origin"},
        {"fbm:basis=scnoise,seeds=same", BL_VERDICT_FAIL, "at the origin"},
        {"fractalsum:basis=scnoise,seeds=fresh", BL_VERDICT_PASS, ""},
        {"turbulence:basis=scnoise,seeds=fresh", BL_VERDICT_PASS, ""},
        {"ridged:basis=scnoise,seeds=fresh", BL_VERDICT_PASS, ""},
        {"fbm:basis=scnoise", BL_VERDICT_PASS, ""},
        {"fbm:basis=scnoise,seeds=same,shift=random", BL_VERDICT_PASS, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!bl_test_walk(bl_test_scaled(8, 0) >= 8 || i % 3 == 0))
            continue;
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        expect(signal, BL_QUICK, cases[i].verdict, cases[i].told);
        bl_signal_free(signal);
    }
}

// With one seed the sum at the origin is its basis times the sum of the amplitudes, exactly; and no
// sum states that it is stationary then.
static void test_the_sum_at_the_origin_is_the_basis_times_the_amplitudes(void **state) {
    (void)state;
    static const double origin[BL_AXES] = {0};
    for (unsigned seed = 1; seed <= 5; seed++) {
        char text[96];
        snprintf(text, sizeof text, "scnoise:seed=%u", seed);
        bl_signal *basis = bl_test_open(text, BL_ISA_BEST);
        snprintf(text, sizeof text, "fractalsum:basis=scnoise,seed=%u", seed);
        bl_signal *sum = bl_test_open(text, BL_ISA_BEST);
        snprintf(text, sizeof text, "fractalsum:basis=scnoise,seeds=fresh,seed=%u", seed);
        bl_signal *fresh = bl_test_open(text, BL_ISA_BEST);
        double expected = 1.875 * bl_signal_value(basis, origin);
        assert_near(bl_signal_value(sum, origin), expected, 1e-12);
        assert_true(fabs(bl_signal_value(fresh, origin) - expected) > 1e-6);
        assert_true(sum->facts.stationary == 0 && fresh->facts.stationary == 1);
        bl_signal_free(basis);
        bl_signal_free(sum);
        bl_signal_free(fresh);
    }
}

// --- waves --------------------------------------------------------------------------------------

// scnoise whose amplitude has a wave in space.
typedef struct block {
    uint64_t seed;
    double frequency[3], depth;
    bl_signal *inner;
} block;

static double gain(const block *b, double x, double y, double z) {
    return 1 +
           b->depth * cos(2 * M_PI *
                          (b->frequency[0] * x + b->frequency[1] * y + b->frequency[2] * z + 0.1));
}

static double value(const void *parameters, const double at[BL_AXES]) {
    const block *b = parameters;
    return gain(b, at[0], at[1], at[2]) * bl_signal_value(b->inner, at);
}

static void points(const void *parameters, const double *const at[BL_AXES], size_t count,
                   float *out) {
    const block *b = parameters;
    bl_signal_points(b->inner, at, count, out);
    for (size_t i = 0; i < count; i++)
        out[i] = (float)(gain(b, at[0][i], at[1][i], at[2][i]) * (double)out[i]);
}

static bl_status build(void *parameters, bl_opener *open, bl_message *message) {
    block *b = parameters;
    char text[64];
    (void)open;
    snprintf(text, sizeof text, "scnoise:seed=%llu", (unsigned long long)b->seed);
    return bl_noise_open(text, BL_ISA_BEST, &b->inner, message);
}

static void release(void *parameters) {
    bl_signal_free(((block *)parameters)->inner);
}

static void test_a_variance_that_changes_from_cell_to_cell_is_found(void **state) {
    (void)state;
    static const bl_signal_functions functions = {
        .points = points, .value = value, .build = build, .release = release};
    // The waves and their lengths along the axis on which they are shortest.
    static const struct {
        double frequency[3], length;
    } waves[] = {{{1.0 / 3, 0, 0}, 3},         {{0, 0.5, 0}, 2},      {{0.4, 0.4, 0}, 2.5},
                 {{0, 0, 1.0 / 7}, 7},         {{0.2, -0.2, 0.2}, 5}, {{0, 5.0 / 11, 0}, 2.2},
                 {{1.0 / 16, 1.0 / 16, 0}, 16}};
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        block b = {.seed = 3, .depth = 0.25};
        if (!bl_test_walk(bl_test_scaled(8, 0) >= 8 || i % 3 == 0))
            continue;
        memcpy(b.frequency, waves[i].frequency, sizeof b.frequency);
        bl_signal *signal = bl_test_built(&functions, &b, sizeof b, offsetof(block, seed), "wave");
        signal->facts.stationary = 1;
        bl_score_property found = bl_test_score(signal, "stationarity", BL_QUICK, 1);
        // 128 cells hold no whole number of some waves: the nearest is told.
        const char *told = strstr(found.reason, "a wave of ");
        double length = told ? strtod(told + strlen("a wave of "), NULL) : 0;
        int is_region = strstr(found.reason, "region") != NULL; // which long waves are too
        if (found.verdict != BL_VERDICT_FAIL ||
            !(is_region || fabs(length / waves[i].length - 1) <= 0.07))
            fail_msg("wave %zu: %s: '%s'", i, bl_verdict_word(found.verdict), found.reason);
        assert_int_equal(found.against, BL_AGAINST_CLAIM);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_octaves_of_one_seed_meet_at_the_origin),
        cmocka_unit_test(test_the_sum_at_the_origin_is_the_basis_times_the_amplitudes),
        cmocka_unit_test(test_a_variance_that_changes_from_cell_to_cell_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
