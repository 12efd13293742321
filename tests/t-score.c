// SPDX-License-Identifier: MIT
//
// The scorecard: its contract, that good noises keep what they claim, that broken signals are
// caught by the right property, and that the tests of a correct signal fail as often as they say.
#include "tests/test.h"

#include <omp.h>
#include <stdatomic.h>

#include "noises/noise.h"
#include "sources/source.h"
#include "score/score.h"
#include "spectra/psd.h"
#include "tests/broken.h"
#include "tests/test_signals.h"
#include "tests/sources.h"

// The settings of a property, with its share of alpha.
static bl_score_settings quick(double alpha) {
    bl_score_settings settings = bl_score_default_settings();
    settings.size = BL_QUICK;
    settings.alpha = alpha;
    settings.threads = 1; // a busy machine makes many threads slow
    return settings;
}

static bl_score_property measure_subject(const char *name, const bl_score_subject *subject,
                                         const bl_score_settings *settings) {
    bl_score_property result = {.verdict = BL_VERDICT_NOT_RUN};
    bl_message message = {""};
    const bl_property *property = bl_property_find(name);
    assert_non_null(property);
    if (property->measure(subject, settings, &result, &message) != BL_OK)
        fail_msg("%s of %s: %s", name, subject->signal->text, message.text);
    return result;
}

static bl_score_property measure(const char *name, const bl_signal *signal) {
    bl_score_settings settings = quick(1e-9);
    return measure_subject(name, &(bl_score_subject){.signal = signal}, &settings);
}

static void expect(const bl_score_property *result, const char *what, bl_verdict verdict,
                   const char *says) {
    if (result->verdict != verdict || !strstr(result->reason, says))
        fail_msg("%s: %s, '%s'; expected %s and '%s'", what, bl_verdict_word(result->verdict),
                 result->reason, bl_verdict_word(verdict), says);
}

// --- the contract ---

static void test_every_property_has_a_name_and_fills_its_result(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("gnoise");
    bl_score_subject subject = {.signal = signal};
    bl_score_settings settings = quick(1e-6);
    bl_score score;
    bl_message message = {""};
    uint64_t all = (UINT64_C(1) << bl_property_count()) - 1;
    assert_int_equal(bl_score_measure(&subject, &settings, all, &score, &message), BL_OK);
    for (size_t i = 0; i < bl_property_count(); i++) {
        const bl_property *property = bl_property_at(i);
        const bl_score_property *result = &score.properties[i];
        assert_ptr_equal(bl_property_find(property->name), property);
        assert_string_equal(property->title, property->name); // one word for one thing
        assert_true(property->question[0] && property->entry[0]);
        if (!result->reason[0] || strcmp(result->reason, BL_SCORE_NOT_ASKED) == 0)
            fail_msg("%s gives no reason", property->name);
        for (size_t k = 0; k < result->count; k++)
            assert_ptr_equal(bl_score_find(result, result->numbers[k].name), &result->numbers[k]);
    }
    assert_null(bl_property_at(bl_property_count()));
    assert_int_equal(bl_score_measure(&subject, &settings, 0, &score, &message), BL_OK);
    assert_string_equal(score.properties[0].reason, BL_SCORE_NOT_ASKED);
    assert_int_equal(bl_score_verdict(&score, 1, 1), BL_VERDICT_PASS);
    bl_signal_free(signal);
}

static void test_the_status_counts_claims_and_with_strict_the_ideal(void **state) {
    (void)state;
    bl_score score = {0};
    score.properties[0].verdict = BL_VERDICT_FAIL;
    score.properties[0].against = BL_AGAINST_IDEAL;
    assert_int_equal(bl_score_verdict(&score, 1, 0), BL_VERDICT_PASS);
    assert_int_equal(bl_score_verdict(&score, 1, 1), BL_VERDICT_FAIL);
    score.properties[1].verdict = BL_VERDICT_INCONCLUSIVE;
    score.properties[1].against = BL_AGAINST_CLAIM;
    assert_int_equal(bl_score_verdict(&score, 1, 0), BL_VERDICT_INCONCLUSIVE);
    assert_int_equal(bl_verdict_worse(BL_VERDICT_NOT_RUN, BL_VERDICT_PASS), BL_VERDICT_PASS);
    assert_int_equal(bl_verdict_worse(BL_VERDICT_FAIL, BL_VERDICT_INCONCLUSIVE), BL_VERDICT_FAIL);
}

static void test_scores_do_not_depend_on_the_threads(void **state) {
    (void)state;
    static const char *const names[] = {"repeatable", "range", "band"};
    bl_signal *signal = bl_test_open_source("gnoise");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        bl_score_settings settings = quick(1e-9);
        bl_score_property one =
            measure_subject(names[i], &(bl_score_subject){.signal = signal}, &settings);
        settings.threads = 3;
        bl_score_property three =
            measure_subject(names[i], &(bl_score_subject){.signal = signal}, &settings);
        assert_int_equal(one.count, three.count);
        assert_string_equal(one.reason, three.reason);
        for (size_t k = 0; k < one.count; k++)
            if (memcmp(&one.numbers[k].estimate, &three.numbers[k].estimate, sizeof(bl_estimate)))
                fail_msg("%s of %s depends on the threads", one.numbers[k].name, names[i]);
    }
    bl_signal_free(signal);
}

// --- good signals ---

// At 1e-9 a test, none of a few hundred fails by chance.
static void test_noises_keep_their_claims(void **state) {
    (void)state;
    static const char *const names[] = {"repeatable", "range", "band"};
    for (size_t n = 0; n < bl_noise_count(); n++) {
        bl_signal *signal = bl_test_open_source(bl_noise_at(n, BL_ISA_BEST)->name);
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            bl_score_property result = measure(names[i], signal);
            if (result.verdict == BL_VERDICT_FAIL && result.against == BL_AGAINST_CLAIM)
                fail_msg("%s of %s: %s", names[i], signal->text, result.reason);
        }
        bl_signal_free(signal);
    }
}

static void test_climbing_finds_more_than_samples_do(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("gnoise");
    bl_score_property result = measure("range", signal);
    double high = bl_score_find(&result, "maximum")->estimate.value, at[BL_AXES] = {0};
    assert_true(high > bl_score_find(&result, "maximum_of_samples")->estimate.value);
    assert_true(bl_score_find(&result, "minimum")->estimate.value <
                bl_score_find(&result, "minimum_of_samples")->estimate.value);
    // The place and the seed that are told have the value that is told.
    static const char *const axes[] = {"maximum_x", "maximum_y", "maximum_z"};
    for (int a = 0; a < 3; a++)
        at[a] = bl_score_find(&result, axes[a])->estimate.value;
    bl_signal *there =
        bl_signal_reseed(signal, (uint64_t)bl_score_find(&result, "maximum_seed")->estimate.value);
    assert_near(bl_signal_value(there, at), high, 0);
    bl_signal_free(there);
    bl_signal_free(signal);
}

static void test_cost_is_told_and_not_judged(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("gnoise");
    bl_score_property result = measure("cost", signal);
    assert_int_equal(result.verdict, BL_VERDICT_NOT_RUN);
    assert_true(bl_score_find(&result, "row_ns")->estimate.value > 0);
    assert_true(bl_score_find(&result, "points_ns")->estimate.value > 0);
    for (int i = 0; i < 2; i++) { // six minima that the clock told apart are never all equal
        bl_estimate e = bl_score_find(&result, i ? "points_ns" : "row_ns")->estimate;
        assert_true(e.lower <= e.value && e.value < e.upper && isfinite(e.upper));
        assert_near(e.level, 1 - 2 * pow(0.5, 6), 0);
    }
    bl_signal_free(signal);
}

// --- broken signals: a good noise with one fault ---

typedef enum fault { SOUND, CALL_ORDER, BATCH, THREAD, ROWS, REFERENCE } fault;

typedef struct faulty {
    const bl_signal *noise;
    fault fault;
    float step; // of ROWS and REFERENCE
} faulty;

static atomic_uint calls;

static void spoil(const faulty *f, int is_row, size_t count, float *out) {
    unsigned call = atomic_fetch_add(&calls, 1);
    if (f->fault == CALL_ORDER && call % 5 == 4)
        out[count / 2] += 1e-3f;
    if (f->fault == BATCH && count > 10)
        out[10] += 1e-3f;
    if (f->fault == THREAD && omp_get_thread_num() == 1)
        out[0] += 1e-3f;
    for (size_t i = 0; f->fault == ROWS && is_row && i < count; i++)
        out[i] += f->step;
}

static void faulty_row(const void *parameters, const double start[BL_AXES],
                       const double step[BL_AXES], size_t count, float *out) {
    const faulty *f = parameters;
    bl_signal_row(f->noise, start, step, count, out);
    spoil(f, 1, count, out);
}

static void faulty_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                          float *out) {
    const faulty *f = parameters;
    bl_signal_points(f->noise, at, count, out);
    spoil(f, 0, count, out);
}

static double faulty_value(const void *parameters, const double at[BL_AXES]) {
    const faulty *f = parameters;
    return bl_signal_value(f->noise, at) + (f->fault == REFERENCE ? (double)f->step : 0);
}

static const bl_signal_functions faulty_functions = {
    .row = faulty_row, .points = faulty_points, .value = faulty_value};

static bl_signal *make_faulty(const bl_signal *noise, fault which, float step) {
    faulty f = {noise, which, step};
    bl_signal *signal = bl_signal_new(&faulty_functions, &f, sizeof f, "faulty");
    assert_non_null(signal);
    signal->dimensions = noise->dimensions;
    signal->facts = noise->facts;
    return signal;
}

static void test_what_cannot_be_repeated_is_caught(void **state) {
    (void)state;
    static const struct {
        fault fault;
        bl_verdict verdict;
        const char *says;
    } faults[] = {{SOUND, BL_VERDICT_PASS, "the same bits"},
                  {CALL_ORDER, BL_VERDICT_FAIL, "then"},
                  {BATCH, BL_VERDICT_FAIL, "backwards"},
                  {THREAD, BL_VERDICT_FAIL, "several threads"},
                  {ROWS, BL_VERDICT_FAIL, "a row and the same places as points"},
                  {REFERENCE, BL_VERDICT_FAIL, "double reference"}};
    bl_signal *noise = bl_test_open_source("gnoise");
    size_t count = sizeof faults / sizeof *faults;
    for (size_t k = 0; k < 2 * count; k++) {
        size_t i = k % count;
        // Twice what is allowed, and also where no bound is stated: then 1e-5 of the range,
        // about 2.
        bl_signal *signal = make_faulty(noise, faults[i].fault, k < count ? 4e-6f : 4e-5f);
        if (k >= count)
            signal->facts.lower = signal->facts.upper = NAN;
        bl_score_property result = measure("repeatable", signal);
        expect(&result, "repeatable", faults[i].verdict, faults[i].says);
        bl_signal_free(signal);
    }
    bl_signal_free(noise);
}

static void test_another_instruction_set_with_other_bits_is_caught(void **state) {
    (void)state;
    bl_signal *noise = bl_test_open_source("gnoise"), *same = bl_test_open_source("gnoise"),
              *other = bl_test_open_source("gnoise:seed=1");
    bl_score_settings settings = quick(1e-9);
    bl_score_subject subject = {
        .signal = noise, .variants = {same}, .variant_names = {"twin"}, .variant_count = 1};
    bl_score_property result = measure_subject("repeatable", &subject, &settings);
    expect(&result, "the same", BL_VERDICT_PASS, "2 instruction sets");
    subject.variants[0] = other;
    result = measure_subject("repeatable", &subject, &settings);
    expect(&result, "another", BL_VERDICT_FAIL, "instruction set twin");
    bl_signal_free(noise), bl_signal_free(same), bl_signal_free(other);
}

// The verdict of one of the claims of a property.
static bl_verdict claim_of(const bl_score_property *result, const char *name) {
    for (size_t i = 0; i < result->claim_count; i++)
        if (strcmp(result->claims[i].name, name) == 0)
            return result->claims[i].verdict;
    fail_msg("no claim '%s'", name);
    return BL_VERDICT_NOT_RUN;
}

static void test_a_wrong_range_mean_and_variance_are_caught(void **state) {
    (void)state;
    bl_signal *noise = bl_test_open_source("gnoise"), *signal = make_faulty(noise, SOUND, 0);
    bl_score_property result = measure("range", signal);
    assert_int_equal(result.verdict, BL_VERDICT_PASS);
    // Between what samples show and what climbing finds.
    double samples = bl_score_find(&result, "maximum_of_samples")->estimate.value;
    double climbed = bl_score_find(&result, "maximum")->estimate.value;
    signal->facts.upper = 0.5 * (samples + climbed);
    result = measure("range", signal);
    assert_int_equal(claim_of(&result, "range"), BL_VERDICT_FAIL);
    assert_int_equal(claim_of(&result, "mean"), BL_VERDICT_PASS);
    assert_int_equal(result.verdict, BL_VERDICT_FAIL);
    samples = bl_score_find(&result, "minimum_of_samples")->estimate.value;
    climbed = bl_score_find(&result, "minimum")->estimate.value;
    signal->facts = noise->facts;
    signal->facts.lower = 0.5 * (samples + climbed);
    result = measure("range", signal);
    assert_int_equal(claim_of(&result, "range"), BL_VERDICT_FAIL);
    signal->facts = noise->facts;
    signal->facts.mean = 0.05 * sqrt(noise->facts.variance);
    result = measure("range", signal);
    assert_int_equal(claim_of(&result, "mean"), BL_VERDICT_FAIL);
    assert_int_equal(claim_of(&result, "range"), BL_VERDICT_PASS);
    signal->facts = noise->facts;
    signal->facts.variance *= 1.1;
    result = measure("range", signal);
    assert_int_equal(claim_of(&result, "variance"), BL_VERDICT_FAIL);
    assert_int_equal(claim_of(&result, "mean"), BL_VERDICT_PASS);
    // Without a claim, against the ideal: gnoise keeps to [-1, 1], normal numbers do not.
    signal->facts = bl_facts_unknown();
    result = measure("range", signal);
    assert_int_equal(result.against, BL_AGAINST_IDEAL);
    expect(&result, "gnoise", BL_VERDICT_PASS, "no range is stated");
    bl_signal_free(signal), bl_signal_free(noise);
    signal = bl_test_white(1);
    signal->facts = bl_facts_unknown();
    result = measure("range", signal);
    expect(&result, "white", BL_VERDICT_FAIL, "no range is stated");
    bl_signal_free(signal);
    signal = bl_test_broken();
    result = measure("range", signal);
    expect(&result, "not finite", BL_VERDICT_FAIL, "not finite");
    assert_int_equal(result.against, BL_AGAINST_CLAIM); // of being a signal
    bl_signal_free(signal);
}

// 1e-9 is too little to be told by so many digits of 1.
static void test_the_level_of_a_refuted_mean_is_told_by_what_it_misses(void **state) {
    (void)state;
    bl_signal *noise = bl_test_open_source("gnoise");
    noise->facts.mean = 0.1;
    bl_score_property result = measure("range", noise);
    expect(&result, "mean", BL_VERDICT_FAIL, "at the level 1 - 5e-10");
    bl_signal_free(noise);
}

// 1 - 1e-20 is 1, whose interval holds everything: a property works with what its tests miss.
static void test_a_share_of_alpha_below_the_digits_of_1_still_fails(void **state) {
    (void)state;
    const bl_score_settings tiny = quick(1e-20);
    bl_signal *noise = bl_test_open_source("gnoise"), *far = bl_broken_signal(BL_BROKEN_FAR_GAIN),
              *image = bl_test_white_image(1, 96, 64, 0.125);
    const bl_score_subject of_noise = {.signal = noise}, of_far = {.signal = far},
                           of_image = {.signal = image};
    noise->facts.leak_db -= 20;
    bl_score_property result = measure_subject("band", &of_noise, &tiny);
    expect(&result, "leak", BL_VERDICT_FAIL, "the claim");
    noise->facts.mean = 0.3;
    result = measure_subject("range", &of_noise, &tiny);
    assert_int_equal(claim_of(&result, "mean"), BL_VERDICT_FAIL);
    noise->facts.mean = 0;
    noise->facts.variance *= 3;
    result = measure_subject("range", &of_noise, &tiny);
    assert_int_equal(claim_of(&result, "mean"), BL_VERDICT_PASS);
    assert_int_equal(claim_of(&result, "variance"), BL_VERDICT_FAIL);
    result = measure_subject("far", &of_far, &tiny);
    expect(&result, "far", BL_VERDICT_FAIL, "the variance near 1e6");
    image->facts.mean = 1;
    result = measure_subject("range", &of_image, &tiny);
    expect(&result, "image", BL_VERDICT_FAIL, "is not the stated");
    image->facts.mean = 0;
    result = measure_subject("range", &of_image, &tiny);
    assert_int_not_equal(claim_of(&result, "mean"), BL_VERDICT_FAIL);
    bl_signal_free(noise), bl_signal_free(far), bl_signal_free(image);
}

// The ideal range is [-1, 1] to rounding, on both sides.
static void test_the_ideal_range_ends_at_one(void **state) {
    (void)state;
    static const struct {
        double mean, amplitude;
        bl_verdict verdict;
    } cases[] = {{0, 1, BL_VERDICT_PASS},
                 {0, 1.01, BL_VERDICT_FAIL},
                 {0.5, 0.52, BL_VERDICT_FAIL},
                 {-0.5, 0.52, BL_VERDICT_FAIL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *cosine =
            bl_test_cosine(cases[i].mean, cases[i].amplitude, (const double[]){0.37, 0.2, 0.1});
        cosine->facts = bl_facts_unknown();
        bl_score_property result = measure("range", cosine);
        expect(&result, "a cosine", cases[i].verdict, "no range is stated");
        // Mean square about a mean that is not stated: 64 blocks of 1024, an error of 0.5 %.
        assert_near(bl_score_find(&result, "variance")->estimate.value,
                    0.5 * cases[i].amplitude * cases[i].amplitude, 0.02);
        bl_signal_free(cosine);
    }
}

// White noise of variance 8 for one seed in eight and 0 for the others: 256 blocks tell too little
// to agree with any number, even the right one.
typedef struct rare {
    uint64_t seed;
    bl_signal *white; // not owned
} rare;

static double rare_gain(const rare *r) {
    return (r->seed * UINT64_C(0x9E3779B97F4A7C15)) >> 61 ? 0 : sqrt(8);
}

static void rare_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                        float *out) {
    const rare *r = parameters;
    bl_signal_points(r->white, at, count, out);
    for (size_t i = 0; i < count; i++)
        out[i] *= (float)rare_gain(r);
}

static double rare_value(const void *parameters, const double at[BL_AXES]) {
    const rare *r = parameters;
    return rare_gain(r) * bl_signal_value(r->white, at);
}

static const bl_signal_functions rare_functions = {.points = rare_points, .value = rare_value};

static void test_what_is_known_too_coarsely_is_inconclusive(void **state) {
    (void)state;
    rare r = {.white = bl_test_white(3)};
    bl_signal *signal = bl_signal_new(&rare_functions, &r, sizeof r, "rare");
    assert_non_null(signal);
    signal->seed_offset = offsetof(rare, seed);
    signal->dimensions = 3;
    signal->facts.mean = 0;
    signal->facts.variance = 1;
    bl_score_property result = measure("range", signal);
    assert_int_equal(claim_of(&result, "mean"), BL_VERDICT_PASS);
    assert_int_equal(claim_of(&result, "variance"), BL_VERDICT_INCONCLUSIVE);
    assert_int_equal(result.verdict, BL_VERDICT_INCONCLUSIVE);
    bl_signal_free(signal);
    bl_signal_free(r.white);
}

// The rule of a claimed leak, from the limits that are told: it fails below the lower one, passes
// from 1 dB below the upper one on, and is inconclusive between. All three occur.
static void test_a_claimed_leak_is_judged_by_its_limits(void **state) {
    (void)state;
    static const double alphas[] = {1e-3, 1e-9, 1e-60, 1e-300};
    static const double offsets[] = {-3, -1.75, -1.5, -0.5, 0, 4};
    size_t seen[4] = {0}, close = 0;
    bl_signal *noise = bl_test_open_source("gnoise");
    const double stated = noise->facts.leak_db;
    for (size_t a = 0; a < sizeof alphas / sizeof *alphas; a++)
        for (size_t o = 0; o < sizeof offsets / sizeof *offsets; o++) {
            bl_score_settings settings = quick(alphas[a]);
            double value, from, to, lower, upper, claim = stated + offsets[o];
            noise->facts.leak_db = claim;
            bl_score_property result =
                measure_subject("band", &(bl_score_subject){.signal = noise}, &settings);
            int read = sscanf(result.reason,
                              "%lf dB of the variance outside of %lf to %lf cycles per unit along "
                              "x (%lf to %lf",
                              &value, &from, &to, &lower, &upper);
            assert_int_equal(read, 5);
            bl_verdict verdict = lower > claim        ? BL_VERDICT_FAIL
                                 : upper <= claim + 1 ? BL_VERDICT_PASS
                                                      : BL_VERDICT_INCONCLUSIVE;
            expect(&result, "gnoise", verdict, "the claim");
            seen[verdict]++;
            close += verdict == BL_VERDICT_INCONCLUSIVE && upper <= claim + 4;
        }
    assert_true(seen[BL_VERDICT_FAIL] && seen[BL_VERDICT_PASS] && close);
    bl_signal_free(noise);
}

// A line below the band that is claimed is outside of it, as one above it is.
static void test_a_claimed_band_has_two_ends(void **state) {
    (void)state;
    static const double lines[] = {0.2, 0.75, 1.5};
    for (int i = 0; i < 3; i++) {
        bl_signal *cosine = bl_test_cosine(0, 1, (const double[]){lines[i], 0, 0});
        cosine->facts.band_from = 0.5;
        cosine->facts.band_to = 1;
        cosine->facts.leak_db = -20;
        bl_score_property result = measure("band", cosine);
        expect(&result, "a cosine", i == 1 ? BL_VERDICT_PASS : BL_VERDICT_FAIL, "the claim");
        bl_signal_free(cosine);
    }
}

// A wave along z has 0.8/sqrt 3 = 0.46 cycles a unit along the diagonal of space.
static void test_the_diagonal_is_that_of_space(void **state) {
    (void)state;
    bl_signal *cosine = bl_test_cosine(0, 1, (const double[]){0, 0, 0.8});
    bl_score_property result = measure("band", cosine);
    const bl_score_number *share = bl_score_find(&result, "share_0_3_to_0_7_diagonal");
    assert_non_null(share);
    assert_near(share->estimate.value, 1, 1e-6);
    bl_signal_free(cosine);
}

static void test_a_band_claimed_too_strongly_is_caught(void **state) {
    (void)state;
    static const char *const noises[] = {"vnoise", "gnoise", "hermite"};
    for (size_t i = 0; i < sizeof noises / sizeof *noises; i++) {
        bl_signal *noise = bl_test_open_source(noises[i]);
        bl_score_property result = measure("band", noise);
        expect(&result, noises[i], BL_VERDICT_PASS, "the claim");
        noise->facts.leak_db -= 3;
        result = measure("band", noise);
        expect(&result, noises[i], BL_VERDICT_FAIL, "the claim");
        bl_signal_free(noise);
    }
    bl_signal *white = bl_test_white(1), *constant = bl_test_constant(0.5);
    bl_score_property result = measure("band", white);
    assert_int_equal(result.against, BL_AGAINST_IDEAL);
    expect(&result, "white", BL_VERDICT_FAIL, "the ideal");
    result = measure("band", constant);
    expect(&result, "constant", BL_VERDICT_NOT_RUN, "constant");
    bl_signal_free(white), bl_signal_free(constant);
}

static bl_score_property measure_band(bl_signal *signal, double from, double to, double leak_db) {
    signal->facts.band_from = from;
    signal->facts.band_to = to;
    signal->facts.leak_db = leak_db;
    bl_score_property result = measure("band", signal);
    assert_int_equal(result.against, BL_AGAINST_CLAIM);
    return result;
}

// Of a line at the very edge of the band all side lobes of the window on the other side are seen.
static void test_a_band_without_a_number_for_its_leak_is_judged(void **state) {
    (void)state;
    static const double inside[] = {0.3, 0.77, 0.999, 1};
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++) {
        bl_signal *cosine = bl_test_cosine(0, 1, (const double[]){inside[i], 0, 0});
        bl_score_property result = measure_band(cosine, 0, 1, -INFINITY);
        expect(&result, "no leak", BL_VERDICT_PASS, "no leak at all");
        result = measure_band(cosine, 0, 1, -150); // less than can be measured
        expect(&result, "little leak", BL_VERDICT_PASS, "floor");
        result = measure_band(cosine, 0, 1, NAN);
        expect(&result, "unknown leak", BL_VERDICT_PASS, "without a leak");
        result = measure_band(cosine, 0, 0.25, -INFINITY);
        expect(&result, "no leak", BL_VERDICT_FAIL, "no leak at all");
        result = measure_band(cosine, 0, 0.25, NAN);
        expect(&result, "unknown leak", BL_VERDICT_FAIL, "-30 dB");
        result = measure_band(cosine, 1.5, INFINITY, NAN); // a band without an end
        expect(&result, "from 1.5", BL_VERDICT_FAIL, "-30 dB");
        bl_signal_free(cosine);
    }
    // The kernel that reads fourier's tile leaves images of its band, some 51 dB down.
    bl_signal *fourier = bl_test_open_source("fourier");
    bl_score_property result = measure_band(fourier, 0, 1, -INFINITY);
    expect(&result, "fourier", BL_VERDICT_FAIL, "no leak at all");
    bl_signal_free(fourier);
}

// --- what is no noise at all ---

typedef struct odd {
    uint64_t seed;
    int which; // 0: NaN; 1: a number of the seed; 2: a wave whose phase the seed drowns
} odd;

static double odd_value(const void *parameters, const double at[BL_AXES]) {
    const odd *o = parameters;
    double drowned = 0.7 * 2 * M_PI * at[0] + (double)o->seed;
    return o->which == 0 ? NAN : o->which == 1 ? (double)(o->seed >> 11) * 0x1p-53 : sin(drowned);
}

static void odd_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                       float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = (float)odd_value(parameters, (const double[BL_AXES]){at[0][i], at[1][i]});
}

static void odd_row(const void *parameters, const double start[BL_AXES], const double step[BL_AXES],
                    size_t count, float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] =
            (float)odd_value(parameters, (const double[BL_AXES]){start[0] + (double)i * step[0]});
}

static const bl_signal_functions odd_functions = {
    .row = odd_row, .points = odd_points, .value = odd_value};

static bl_signal *make_odd(int which) {
    odd o = {3, which};
    bl_signal *signal = bl_signal_new(&odd_functions, &o, sizeof o, "odd");
    assert_non_null(signal);
    signal->dimensions = 3;
    signal->seed_offset = offsetof(odd, seed);
    signal->facts = bl_facts_unknown();
    return signal;
}

static void test_a_signal_without_numbers_fails(void **state) {
    (void)state;
    bl_signal *signal = make_odd(0);
    bl_score_settings settings = quick(1e-6);
    bl_message message = {""};
    bl_score score;
    uint64_t all = (UINT64_C(1) << bl_property_count()) - 1;
    bl_score_property result = measure("repeatable", signal);
    expect(&result, "NaN", BL_VERDICT_FAIL, "not finite");
    assert_int_equal(
        bl_score_measure(&(bl_score_subject){.signal = signal}, &settings, all, &score, &message),
        BL_OK);
    assert_int_equal(bl_score_verdict(&score, 1, 0), BL_VERDICT_FAIL);
    for (size_t i = 0; i < bl_property_count(); i++)
        if (score.properties[i].verdict == BL_VERDICT_PASS)
            fail_msg("%s passes without a number", bl_property_at(i)->name);
    bl_signal_free(signal);
}

static void test_what_is_constant_for_each_seed_is_not_judged(void **state) {
    (void)state;
    static const char *const names[] = {"band", "stationarity", "isotropy", "far"};
    for (int which = 1; which <= 2; which++) {
        bl_signal *signal = make_odd(which);
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            bl_score_property result = measure(names[i], signal);
            expect(&result, names[i], BL_VERDICT_NOT_RUN, "constant for each seed");
        }
        bl_signal_free(signal);
    }
}

// What is neither random nor alike far out has no deviates, and no digits to lose there.
static void test_a_function_without_a_seed_is_not_judged_as_random(void **state) {
    (void)state;
    static const char *const texts[] = {"step", "bias", "mod", "sine", "pulse:low=0.2,high=0.7"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_signal *signal = NULL;
        bl_message message = {""};
        if (bl_source_open(texts[i], BL_ISA_BEST, &signal, &message) != BL_OK)
            fail_msg("%s: %s", texts[i], message.text);
        bl_score_property result = measure("stationarity", signal);
        expect(&result, texts[i], BL_VERDICT_NOT_RUN, i < 2 ? "neither repeats" : "one function");
        result = measure("far", signal);
        expect(&result, texts[i], i < 2 ? BL_VERDICT_NOT_RUN : BL_VERDICT_PASS, "");
        result = measure("range", signal);
        expect(&result, texts[i], BL_VERDICT_PASS, "");
        bl_signal_free(signal);
    }
}

// A picture that no noise moves has a seed that does nothing, and the same texels in every cell.
static void test_a_seed_that_does_nothing_gives_words_and_no_infinite_deviate(void **state) {
    (void)state;
    bl_signal *signal = NULL;
    bl_message message = {""};
    assert_int_equal(bl_source_open("image:amount=0", BL_ISA_BEST, &signal, &message), BL_OK);
    bl_score_property result = measure("stationarity", signal);
    expect(&result, "image", BL_VERDICT_FAIL, "is the same number in every batch");
    bl_signal_free(signal);
}

static void test_the_edges_of_a_known_band_are_found(void **state) {
    (void)state;
    bl_signal *cosine = bl_test_cosine(0, 1, (const double[]){0.5, 0, 0});
    bl_score_property result = measure("band", cosine);
    double width = 0.05 + 4 / 128.0 + 0.01; // the smoothing and the main lobe of the window
    assert_near(bl_score_find(&result, "edge_30db_low_x")->estimate.value, 0.5, width);
    assert_near(bl_score_find(&result, "edge_30db_high_x")->estimate.value, 0.5, width);
    assert_near(bl_score_find(&result, "share_0_3_to_0_7_x")->estimate.value, 1, 1e-6);
    expect(&result, "cosine", BL_VERDICT_PASS, "the ideal");
    bl_signal_free(cosine);
}

// --- grids ---

static void test_a_grid_is_measured_on_its_samples(void **state) {
    (void)state;
    bl_signal *image = bl_test_white_image(1, 96, 64, 0.125);
    bl_score_property result = measure("repeatable", image);
    expect(&result, "repeatable", BL_VERDICT_PASS, "1 scale of");
    result = measure("range", image);
    assert_near(bl_score_find(&result, "samples")->estimate.value, 96 * 64, 0);
    result = measure("band", image);
    expect(&result, "band", BL_VERDICT_FAIL, "the ideal");
    assert_non_null(bl_score_find(&result, "leak_radial_db"));
    assert_null(bl_score_find(&result, "leak_diagonal_db"));
    bl_signal_free(image);
    image = bl_test_white_image(1, 96, 64, 1);
    result = measure("band", image);
    expect(&result, "coarse", BL_VERDICT_NOT_RUN, "nothing is left to judge");
    bl_signal_free(image);
}

// --- calibration ---

// A binomial count of `runs` trials passes this limit once in 1e5.
static double most_failures(size_t runs, double share) {
    return (double)runs * share + 4.3 * sqrt((double)runs * share * (1 - share)) + 1;
}

// Mean 0 and variance 2/3 are exact: they may fail at the share of alpha, and not more often.
static void test_mean_and_variance_fail_as_often_as_alpha_says(void **state) {
    (void)state;
    size_t runs = bl_test_scaled(60, 20), failed = 0;
    bl_score_settings settings = quick(0.1);
    bl_signal *hat = bl_test_hat(1);
    hat->dimensions = 1;
    hat->facts.mean = 0;
    hat->facts.variance = 2.0 / 3;
    for (size_t i = 0; i < runs; i++) {
        settings.seed = 100 + i;
        bl_score_property result =
            measure_subject("range", &(bl_score_subject){.signal = hat}, &settings);
        failed += result.verdict == BL_VERDICT_FAIL;
    }
    assert_less((double)failed, most_failures(runs, 0.1));
    // Nor more seldom: with 1/2 shared by the two, at least a quarter of 60 runs fails except for a
    // probability of (3/4)^60 (1 + 20) = 7e-7 of one or none.
    settings = quick(0.5);
    failed = 0;
    for (size_t i = 0; i < 60; i++) {
        settings.seed = 100 + i;
        bl_score_property result =
            measure_subject("range", &(bl_score_subject){.signal = hat}, &settings);
        failed += claim_of(&result, "mean") == BL_VERDICT_FAIL;
    }
    assert_true(failed > 1);
    bl_signal_free(hat);
}

// The leak of the closed form.
static void test_a_true_leak_fails_as_often_as_alpha_says(void **state) {
    (void)state;
    size_t runs = bl_test_scaled(60, 20), failed = 0, passed = 0;
    bl_score_settings settings = quick(0.1);
    bl_signal *hat = bl_test_hat(1);
    hat->dimensions = 1;
    double inside = 0; // 3 int_0^1 sinc^4, by the midpoint rule
    for (int i = 0; i < 100000; i++) {
        double f = (i + 0.5) / 100000, sinc = sin(M_PI * f) / (M_PI * f);
        inside += 3 * pow(sinc, 4) / 100000;
    }
    hat->facts.band_from = 0;
    hat->facts.band_to = 1;
    hat->facts.leak_db = 10 * log10(1 - inside);
    for (size_t i = 0; i < runs; i++) {
        settings.seed = 100 + i;
        bl_score_property result =
            measure_subject("band", &(bl_score_subject){.signal = hat}, &settings);
        failed += result.verdict == BL_VERDICT_FAIL;
        passed += result.verdict == BL_VERDICT_PASS;
    }
    assert_less((double)failed, most_failures(runs, 0.1));
    assert_true(passed + failed == runs);
    bl_signal_free(hat);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_property_has_a_name_and_fills_its_result),
        cmocka_unit_test(test_the_status_counts_claims_and_with_strict_the_ideal),
        cmocka_unit_test(test_scores_do_not_depend_on_the_threads),
        cmocka_unit_test(test_noises_keep_their_claims),
        cmocka_unit_test(test_climbing_finds_more_than_samples_do),
        cmocka_unit_test(test_cost_is_told_and_not_judged),
        cmocka_unit_test(test_what_cannot_be_repeated_is_caught),
        cmocka_unit_test(test_another_instruction_set_with_other_bits_is_caught),
        cmocka_unit_test(test_a_wrong_range_mean_and_variance_are_caught),
        cmocka_unit_test(test_the_level_of_a_refuted_mean_is_told_by_what_it_misses),
        cmocka_unit_test(test_a_share_of_alpha_below_the_digits_of_1_still_fails),
        cmocka_unit_test(test_the_ideal_range_ends_at_one),
        cmocka_unit_test(test_what_is_known_too_coarsely_is_inconclusive),
        cmocka_unit_test(test_a_claimed_leak_is_judged_by_its_limits),
        cmocka_unit_test(test_a_claimed_band_has_two_ends),
        cmocka_unit_test(test_the_diagonal_is_that_of_space),
        cmocka_unit_test(test_a_band_claimed_too_strongly_is_caught),
        cmocka_unit_test(test_a_band_without_a_number_for_its_leak_is_judged),
        cmocka_unit_test(test_a_signal_without_numbers_fails),
        cmocka_unit_test(test_what_is_constant_for_each_seed_is_not_judged),
        cmocka_unit_test(test_a_function_without_a_seed_is_not_judged_as_random),
        cmocka_unit_test(test_a_seed_that_does_nothing_gives_words_and_no_infinite_deviate),
        cmocka_unit_test(test_the_edges_of_a_known_band_are_found),
        cmocka_unit_test(test_a_grid_is_measured_on_its_samples),
        cmocka_unit_test(test_mean_and_variance_fail_as_often_as_alpha_says),
        cmocka_unit_test(test_a_true_leak_fails_as_often_as_alpha_says),
    };
    return bl_run_tests(tests);
}
