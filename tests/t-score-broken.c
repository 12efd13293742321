// SPDX-License-Identifier: MIT
//
// The properties of the scorecard that look at places: each noise that is broken on purpose is
// caught by the property that it breaks and by no other, no noise of the registry fails a claim,
// and good noises fail no more often than alpha says.
//
// Error rates. A table of one correct signal fails anything with probability alpha = 1e-6, so all
// that is measured here fails by chance with less than 1e-4. The test of alpha itself fails with
// the probability 1e-6 that it states.
#include "tests/test.h"

#include <gsl/gsl_cdf.h>

#include "core/statistics.h"
#include "tests/scores.h"
#include "tests/broken.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

// The properties of this file.
static const char *const names[] = {"period",     "symmetry", "stationarity", "isotropy",
                                    "continuity", "seeds",    "far",          "gradient"};
enum { COUNT = sizeof names / sizeof *names };

static bl_score_property measure(const bl_signal *signal, const char *name, bl_size size,
                                 uint64_t seed, double alpha, int threads) {
    bl_score_settings settings = bl_score_default_settings();
    settings.size = size;
    settings.seed = seed;
    settings.alpha = alpha;
    settings.threads = threads;
    return bl_test_score_with(&(bl_score_subject){.signal = signal}, name, &settings);
}

static bl_score_property quick(const bl_signal *signal, const char *name) {
    return measure(signal, name, BL_QUICK, 1, 1e-6, 0);
}

// With SCALE below 1 a walk over signals takes one property of each, the next of the next.
static int takes(int property, int signal) {
    return bl_test_walk(bl_test_scaled(COUNT, 0) >= COUNT || property == signal % COUNT);
}

// --- broken noises ------------------------------------------------------------------------------

static int is_here(const char *name) {
    for (int i = 0; i < COUNT; i++)
        if (name && strcmp(name, names[i]) == 0)
            return 1;
    return 0;
}

static void test_each_broken_noise_is_found_by_its_property(void **state) {
    (void)state;
    for (int which = 0; which < BL_BROKEN_COUNT; which++) {
        const char *name = bl_broken_property(which);
        if (!is_here(name))
            continue;
        bl_signal *signal = bl_broken_signal(which);
        bl_score_property found = quick(signal, name);
        if (found.verdict != BL_VERDICT_FAIL)
            found = measure(signal, name, BL_NORMAL, 1, 1e-6, 0);
        if (found.verdict != BL_VERDICT_FAIL)
            fail_msg("%s: %s says %s: %s", bl_broken_name(which), name,
                     bl_verdict_word(found.verdict), found.reason);
        bl_signal_free(signal);
    }
}

// The others say of it what they say of the noise inside: they may blame that for not being ideal.
static void test_a_broken_noise_is_found_by_no_other_property(void **state) {
    (void)state;
    for (int which = 0; which < BL_BROKEN_COUNT; which++) {
        bl_signal *signal = bl_broken_signal(which);
        bl_signal *inner = bl_test_open(bl_broken_inner(which), BL_ISA_BEST);
        for (int i = 0; i < COUNT; i++) {
            const char *name = bl_broken_property(which), *also = bl_broken_also(which);
            if ((name && strcmp(name, names[i]) == 0) || (also && strcmp(also, names[i]) == 0) ||
                !takes(i, which))
                continue;
            bl_score_property found = quick(signal, names[i]);
            if (found.verdict == BL_VERDICT_FAIL &&
                (found.against == BL_AGAINST_CLAIM ||
                 quick(inner, names[i]).verdict != BL_VERDICT_FAIL))
                fail_msg("%s: %s fails: %s", bl_broken_name(which), names[i], found.reason);
        }
        bl_signal_free(inner);
        bl_signal_free(signal);
    }
}

// --- good noises --------------------------------------------------------------------------------

static void check_claims(const char *text, int index) {
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    for (int i = 0; i < COUNT; i++) {
        if (!takes(i, index))
            continue;
        bl_score_property found = quick(signal, names[i]);
        if (found.verdict == BL_VERDICT_FAIL && found.against == BL_AGAINST_CLAIM)
            fail_msg("%s: %s: %s", text, names[i], found.reason);
        for (size_t k = 0; k < found.count; k++) {
            const bl_estimate *e = &found.numbers[k].estimate;
            if (e->lower > e->value || e->upper < e->value)
                fail_msg("%s: %s: %s is outside of its interval", text, names[i],
                         found.numbers[k].name);
        }
    }
    bl_signal_free(signal);
}

static void test_no_noise_of_the_registry_fails_a_claim(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++)
        check_claims(bl_noise_at(i, BL_ISA_BEST)->name, (int)i);
    static const char *const more[] = {"vnoise:interp=linear", "vnoise:interp=bspline3",
                                       "gnoise:lattice=perm256", "vcnoise:kernel=table:100",
                                       "scnoise:impulses=1"};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++)
        check_claims(more[i], (int)i);
}

// A property is held against the claim where there is one: that of its own kind.
static void test_each_property_looks_at_its_own_claim(void **state) {
    (void)state;
    static const struct {
        const char *text, *property;
        bl_score_against against;
    } cases[] = {{"scnoise", "isotropy", BL_AGAINST_CLAIM},
                 {"scnoise", "stationarity", BL_AGAINST_CLAIM},
                 {"gnoise", "isotropy", BL_AGAINST_IDEAL},
                 {"gnoise", "stationarity", BL_AGAINST_IDEAL},
                 {"simplex", "isotropy", BL_AGAINST_CLAIM},
                 {"simplex", "stationarity", BL_AGAINST_IDEAL},
                 {"spot:stretch=3", "isotropy", BL_AGAINST_IDEAL},
                 {"spot:stretch=3", "stationarity", BL_AGAINST_CLAIM},
                 {"gnoise", "continuity", BL_AGAINST_CLAIM},
                 {"gnoise", "period", BL_AGAINST_CLAIM},
                 {"gnoise", "far", BL_AGAINST_CLAIM},
                 {"gnoise", "seeds", BL_AGAINST_IDEAL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        bl_score_property found = quick(signal, cases[i].property);
        if (found.against != cases[i].against)
            fail_msg("%s: %s is against the %s", cases[i].text, cases[i].property,
                     bl_score_against_word(found.against));
        bl_signal_free(signal);
    }
}

// Second moments of the cubic B-spline hardly differ between directions; its tail does, by
// sinc^8 of the frequencies, of which one is small near an axis.
static void test_a_cross_in_the_tail_is_found(void **state) {
    (void)state;
    bl_signal *cross = bl_test_open("vnoise:interp=bspline3", BL_ISA_BEST),
              *round = bl_test_open("scnoise", BL_ISA_BEST);
    bl_score_property found = quick(cross, "isotropy");
    assert_int_equal(found.verdict, BL_VERDICT_FAIL);
    assert_non_null(strstr(found.reason, "above 1 cycle a cell"));
    assert_true(bl_score_find(&found, "tail_axes_to_diagonals_db")->estimate.lower > 10);
    found = quick(round, "isotropy");
    const bl_estimate tail = bl_score_find(&found, "tail_axes_to_diagonals_db")->estimate;
    assert_true(tail.lower < 0.5 && tail.upper > -0.5);
    bl_signal_free(cross);
    bl_signal_free(round);
}

static void test_the_class_of_continuity_is_found(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int expected;
    } cases[] = {{"vcnoise:kernel=table:100", -1},
                 {"vnoise:interp=linear", 0},
                 {"gnoise:fade=linear", 0},
                 {"vnoise", 1},
                 {"gnoise", 1},
                 {"hermite", 1},
                 {"vcnoise", 1},
                 {"vnoise:interp=bspline3", 2},
                 {"gnoise:fade=quintic", 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        bl_score_property found = quick(signal, "continuity");
        double class = bl_score_find(&found, "class")->estimate.value;
        if (class != cases[i].expected)
            fail_msg("%s: found class %g, and it has class %d", cases[i].text, class,
                     cases[i].expected);
        bl_signal_free(signal);
    }
}

// The places of the two planes that jump are known to the last digit.
static void test_a_jump_is_found_with_its_place_and_size(void **state) {
    (void)state;
    bl_signal *signal = bl_broken_signal(BL_BROKEN_JUMP_ONCE);
    bl_score_property found = quick(signal, "continuity");
    double range = signal->facts.upper - signal->facts.lower;
    assert_near(bl_score_find(&found, "jump_at_x")->estimate.value, 3, 1e-9);
    assert_near(bl_score_find(&found, "largest_jump")->estimate.value, 0.001 * range, 1e-9);
    bl_signal_free(signal);
}

// With alpha of 5 % a property, each of a good noise fails at most so often; beyond the upper
// 1e-6 quantile of the binomial distribution this fails.
static void check_rate(const char *text, const char *name, unsigned trials) {
    const double alpha = 0.05;
    unsigned failures = 0, limit = 0;
    double probability = pow(1 - alpha, trials), below = probability;
    for (; below < 1 - 1e-6; limit++) {
        probability *= (double)(trials - limit) / (limit + 1) * alpha / (1 - alpha);
        below += probability;
    }
    for (unsigned trial = 0; trial < trials; trial++) {
        char seeded[96];
        snprintf(seeded, sizeof seeded, "%s:seed=%u", text, 100 + trial);
        bl_signal *signal = bl_test_open(seeded, BL_ISA_BEST);
        bl_score_property found =
            measure(signal, name, BL_QUICK, 500 + trial, alpha * (double)bl_property_count(), 0);
        const bl_score_number *line = bl_score_find(&found, "line_to_limit_db");
        failures += found.verdict == BL_VERDICT_FAIL || (line && line->estimate.value > 0);
        bl_signal_free(signal);
    }
    if (failures > limit)
        fail_msg("%s of %s: %u of %u good ones fail; the limit is %u", name, text, failures, trials,
                 limit);
}

static void test_good_noises_fail_as_rarely_as_alpha_says(void **state) {
    (void)state;
    check_rate("gnoise", "period", (unsigned)bl_test_scaled(200, 10));
    check_rate("vnoise", "period", (unsigned)bl_test_scaled(100, 5));
    check_rate("gnoise", "seeds", (unsigned)bl_test_scaled(100, 5));
    check_rate("gnoise", "far", (unsigned)bl_test_scaled(40, 4));
    check_rate("scnoise", "stationarity", (unsigned)bl_test_scaled(20, 2));
    check_rate("scnoise", "isotropy", (unsigned)bl_test_scaled(20, 2));
}

// --- limits -------------------------------------------------------------------------------------

static double number_of(const bl_score_property *found, const char *name) {
    const bl_score_number *number = bl_score_find(found, name);
    assert_non_null(number);
    return number->estimate.value;
}

// The limit on deviates is that of Student's t at the share of alpha of one of some hundred tests,
// and it is what decides.
static void test_the_limit_of_deviates_is_students(void **state) {
    (void)state;
    const double share = 1e-6 / (double)bl_property_count();
    static const char *const texts[] = {"scnoise", "gnoise", "spot"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_signal *signal = bl_test_open(texts[i], BL_ISA_BEST);
        bl_score_property found = quick(signal, "stationarity");
        double limit = number_of(&found, "limit_deviate"), batches = 384;
        double tests = share / (2 * gsl_cdf_tdist_Q(limit, batches - 1));
        if (!(tests >= 10 && tests <= 1000))
            fail_msg("%s: a limit of %g is that of %g tests", texts[i], limit, tests);
        assert_near(tests, round(tests), 1e-4 * tests);
        assert_true((found.verdict == BL_VERDICT_FAIL) ==
                    (fabs(number_of(&found, "largest_deviate")) > limit));
        bl_signal_free(signal);
    }
}

// A bin over the mean of its 128 neighbours, which are worth 48, is a number of Fisher's F with 2
// and 96 degrees of freedom in white noise; each of the 2^13 bins of each axis has an equal share
// of alpha. About half a cycle the limit is twice as large.
static void test_the_limit_of_lines_is_fishers(void **state) {
    (void)state;
    static const char *const texts[] = {"gnoise", "scnoise", "vcnoise"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_signal *signal = bl_test_open(texts[i], BL_ISA_BEST);
        bl_score_property found = quick(signal, "period");
        double share = 1e-6 / (double)bl_property_count() / signal->dimensions / 8192;
        double limit = pow(
            10,
            (number_of(&found, "strongest_line_db") - number_of(&found, "line_to_limit_db")) / 10);
        double one = gsl_cdf_fdist_Q(limit, 2, 96) / share,
               half = gsl_cdf_fdist_Q(0.5 * limit, 2, 96) / share;
        if (!(fabs(one - 1) < 1e-6 || fabs(half - 1) < 1e-6))
            fail_msg("%s: a limit of %g has %g or %g of its share", texts[i], limit, one, half);
        bl_signal_free(signal);
    }
}

// A smooth wave with roofs along y = k + 0.6, up and down: its slope jumps by `jump` there.
typedef struct roof {
    const bl_signal *inner;
    double jump;
} roof;

static double roof_value(const void *parameters, const double at[BL_AXES]) {
    const roof *r = parameters;
    double y = (at[1] - 0.6) / 2;
    return bl_signal_value(r->inner, at) + r->jump * fabs(y - round(y)); // slopes of +-jump/2
}

static void roof_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                        float *out) {
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = (float)roof_value(parameters, place);
    }
}

static void roof_row(const void *parameters, const double start[BL_AXES],
                     const double step[BL_AXES], size_t count, float *out) {
    for (size_t i = 0; i < count; i++) {
        double place[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            place[a] = start[a] + (double)i * step[a];
        out[i] = (float)roof_value(parameters, place);
    }
}

// From 10^-3 of the deviation a cell on a jump of the slope counts.
static void test_the_smallest_kink_that_counts_is_found(void **state) {
    (void)state;
    static const bl_signal_functions functions = {
        .row = roof_row, .points = roof_points, .value = roof_value};
    static const double jumps[] = {0.5e-3, 2e-3};
    bl_signal *inner = bl_test_cosine(0, 1, (const double[]){0.11, 0.07, 0.03});
    for (int i = 0; i < 2; i++) {
        roof r = {inner, jumps[i] * M_SQRT1_2};
        bl_signal *signal = bl_signal_new(&functions, &r, sizeof r, "roof");
        assert_non_null(signal);
        signal->dimensions = inner->dimensions;
        signal->facts = bl_facts_unknown();
        signal->facts.cell = 1; // by which slopes are measured
        bl_score_property found = quick(signal, "continuity");
        assert_near(number_of(&found, "class"), i == 0 ? 2 : 0, 0);
        bl_signal_free(signal);
    }
    bl_signal_free(inner);
}

// --- what cannot be judged ----------------------------------------------------------------------

static void check_not_run(bl_signal *signal) {
    for (int i = 0; i < COUNT; i++) {
        bl_score_property found = quick(signal, names[i]);
        if (found.verdict != BL_VERDICT_NOT_RUN || !*found.reason)
            fail_msg("%s: %s says %s", signal->text, names[i], bl_verdict_word(found.verdict));
    }
    bl_signal_free(signal);
}

static void test_what_cannot_be_judged_is_not_run(void **state) {
    (void)state;
    check_not_run(bl_test_constant(0.25));
    check_not_run(bl_test_broken());
    check_not_run(bl_test_white_image(1, 64, 64, 0.25));
}

// gnoise that has no values beyond a coordinate.
typedef struct fenced {
    const bl_signal *inner;
    double fence;
} fenced;

static double fenced_value(const void *parameters, const double at[BL_AXES]) {
    const fenced *f = parameters;
    return at[0] > f->fence ? NAN : bl_signal_value(f->inner, at);
}

static void fenced_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                          float *out) {
    const fenced *f = parameters;
    bl_signal_points(f->inner, at, count, out);
    for (size_t i = 0; i < count; i++)
        out[i] = at[0][i] > f->fence ? NAN : out[i];
}

static void fenced_row(const void *parameters, const double start[BL_AXES],
                       const double step[BL_AXES], size_t count, float *out) {
    const fenced *f = parameters;
    bl_signal_row(f->inner, start, step, count, out);
    for (size_t i = 0; i < count; i++)
        out[i] = start[0] + (double)i * step[0] > f->fence ? NAN : out[i];
}

static const bl_signal_functions fenced_functions = {
    .row = fenced_row, .points = fenced_points, .value = fenced_value};

static void check_fence(const bl_signal *inner, double fence, bl_verdict verdict,
                        const char *reach) {
    bl_signal *signal =
        bl_signal_new(&fenced_functions, &(fenced){inner, fence}, sizeof(fenced), "fenced");
    assert_non_null(signal);
    signal->dimensions = inner->dimensions;
    signal->facts = bl_facts_unknown();
    bl_score_property found = quick(signal, "far");
    if (found.verdict != verdict || strcmp(found.cell, reach) != 0 || !strstr(found.reason, reach))
        fail_msg("fence at %g: %s, reach %s, '%s'; expected %s", fence,
                 bl_verdict_word(found.verdict), found.cell, found.reason, reach);
    bl_signal_free(signal);
}

// The entry of the table and the reason tell one number. Nothing is stated, so that a noise without
// numbers below 2^32 fails the ideal, and one that has them there does not.
static void test_the_reach_ends_where_numbers_end(void **state) {
    (void)state;
    bl_signal *inner = bl_test_open("gnoise", BL_ISA_BEST);
    check_fence(inner, 2e10, BL_VERDICT_PASS, "1e+10");
    check_fence(inner, 1e9, BL_VERDICT_FAIL, "1e+08");
    check_fence(inner, 5e7, BL_VERDICT_FAIL, "1e+07");
    check_fence(inner, 2e4, BL_VERDICT_FAIL, "1e+04");
    check_fence(inner, INFINITY, BL_VERDICT_PASS, "1e+15");
    bl_signal_free(inner);
}

// White noise has a jump everywhere, and a cosine a line.
static void test_strange_signals_are_judged(void **state) {
    (void)state;
    bl_signal *white = bl_test_white(1), *cosine = bl_test_cosine(0, 1, (double[]){0.37, 0, 0});
    bl_score_property found = quick(white, "continuity");
    assert_int_equal(found.verdict, BL_VERDICT_FAIL);
    assert_int_equal(quick(white, "period").verdict, BL_VERDICT_PASS);
    assert_int_equal(quick(cosine, "period").verdict, BL_VERDICT_FAIL);
    assert_int_equal(quick(cosine, "continuity").verdict, BL_VERDICT_PASS);
    assert_int_equal(quick(cosine, "isotropy").verdict, BL_VERDICT_FAIL);
    bl_signal_free(white);
    bl_signal_free(cosine);
}

static void test_the_numbers_do_not_depend_on_the_threads(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open("vgnoise:seed=5", BL_ISA_BEST);
    for (int i = 0; i < COUNT; i++) {
        bl_score_property one = measure(signal, names[i], BL_QUICK, 3, 1e-6, 1);
        bl_score_property three = measure(signal, names[i], BL_QUICK, 3, 1e-6, 3);
        assert_int_equal(one.count, three.count);
        assert_string_equal(one.reason, three.reason);
        for (size_t k = 0; k < one.count; k++)
            assert_memory_equal(&one.numbers[k], &three.numbers[k], sizeof one.numbers[k]);
    }
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_broken_noise_is_found_by_its_property),
        cmocka_unit_test(test_a_broken_noise_is_found_by_no_other_property),
        cmocka_unit_test(test_no_noise_of_the_registry_fails_a_claim),
        cmocka_unit_test(test_each_property_looks_at_its_own_claim),
        cmocka_unit_test(test_a_cross_in_the_tail_is_found),
        cmocka_unit_test(test_the_class_of_continuity_is_found),
        cmocka_unit_test(test_a_jump_is_found_with_its_place_and_size),
        cmocka_unit_test(test_good_noises_fail_as_rarely_as_alpha_says),
        cmocka_unit_test(test_the_limit_of_deviates_is_students),
        cmocka_unit_test(test_the_limit_of_lines_is_fishers),
        cmocka_unit_test(test_the_smallest_kink_that_counts_is_found),
        cmocka_unit_test(test_what_cannot_be_judged_is_not_run),
        cmocka_unit_test(test_the_reach_ends_where_numbers_end),
        cmocka_unit_test(test_strange_signals_are_judged),
        cmocka_unit_test(test_the_numbers_do_not_depend_on_the_threads),
    };
    return bl_run_tests(tests);
}
