// SPDX-License-Identifier: MIT
//
// Trades: the front and the clock with made-up alternatives, and the errors of each trade against a
// law or a closed form of its own.
//
// Errors of the registry are measured with fixed seeds. Where a test compares one with a closed
// form it allows five standard errors, two and a half times the half width of its 95 % interval:
// a chance of 1e-6 each for normal means.
#include "tests/test.h"

#include <gsl/gsl_integration.h>

#include "core/setting.h"
#include "score/trade.h"
#include "score/trade_signals.h"
#include "core/random.h"
#include "filters/primitive.h"
#include "noises/noise.h"
#include "tests/texts.h"
#include "textures/texture.h"

enum { WIDE = 25 }; // tenths of the half width of an interval that a closed form may be off

static bl_signal *open_signal(const char *text) {
    bl_spec spec;
    bl_signal *signal = NULL;
    bl_message message;
    assert_int_equal(bl_spec_parse(text, &spec, &message), BL_OK);
    const bl_definition *definition = bl_noise_find(spec.name, BL_ISA_BEST);
    definition = definition ? definition : bl_primitive_find(spec.name);
    definition = definition ? definition : bl_texture_find(spec.name);
    assert_non_null(definition);
    if (bl_definition_open(definition, &spec, text, bl_noise_opener(BL_ISA_BEST), &signal,
                           &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    bl_spec_free(&spec);
    return signal;
}

// Opens the alternatives of a trade with the quick settings, and takes no time.
static bl_alternatives open_trade(const char *name, const char *subject) {
    static const bl_trade_settings settings = {.seed = 11, .threads = 1};
    bl_alternatives alternatives = {0};
    bl_message message;
    const bl_trade *trade = bl_trade_find(name);
    bl_signal *signal = subject ? open_signal(subject) : NULL;
    assert_non_null(trade);
    assert_true(trade->applies(signal, subject ? NULL : "spectrum"));
    if (trade->open(signal, &settings, &alternatives, &message) != BL_OK)
        fail_msg("%s: %s", name, message.text);
    bl_signal_free(signal);
    return alternatives;
}

static void close_trade(const char *name, bl_alternatives *alternatives) {
    bl_trade_close(bl_trade_find(name), alternatives);
}

static const bl_alternative *find(const bl_alternatives *alternatives, const char *name) {
    for (size_t i = 0; i < alternatives->count; i++)
        if (strcmp(alternatives->list[i].name, name) == 0)
            return &alternatives->list[i];
    fail_msg("there is no alternative '%s'", name);
    return NULL;
}

static void assert_in_interval(const bl_estimate *measured, double expected) {
    assert_near(measured->value, expected,
                0.1 * WIDE *
                    fmax(measured->upper - measured->value, measured->value - measured->lower));
}

// --- the front ----------------------------------------------------------------------------------

static bl_alternative made_up(double ns, double ns_half, double error, double error_half) {
    return (bl_alternative){.ns = ns,
                            .ns_lowest = ns - ns_half,
                            .ns_highest = ns + ns_half,
                            .error = {error, error - error_half, error + error_half, 0.95, 10}};
}

static void test_the_front_of_exact_numbers_is_that_of_pareto(void **state) {
    (void)state;
    bl_random random = bl_random_seed(5, 0);
    for (int round = 0; round < 200; round++) {
        enum { COUNT = 12 };
        bl_alternative list[COUNT];
        const bl_alternatives all = {.list = list, .count = COUNT};
        for (int i = 0; i < COUNT; i++) // few values, so that there are ties
            list[i] = made_up(floor(6 * bl_random_unit(&random)), 0,
                              floor(6 * bl_random_unit(&random)), 0);
        bl_alternatives_mark((bl_alternatives *)&all);
        for (int i = 0; i < COUNT; i++) {
            int dominated = 0;
            for (int k = 0; k < COUNT; k++)
                dominated |= list[k].ns <= list[i].ns &&
                             list[k].error.value <= list[i].error.value &&
                             (list[k].ns < list[i].ns || list[k].error.value < list[i].error.value);
            assert_int_equal(list[i].front, !dominated);
        }
    }
}

static void test_what_cannot_be_told_apart_stays_on_the_front(void **state) {
    (void)state;
    bl_alternative list[4] = {made_up(10, 2, 1, 0.2), made_up(11, 2, 1.1, 0.2),
                              made_up(20, 2, 1.1, 0.2), made_up(NAN, 0, 0.1, 0)};
    bl_alternatives all = {.list = list, .count = 4};
    bl_alternatives_mark(&all);
    assert_true(list[0].front);
    assert_true(list[1].front);  // dearer and worse, by less than either interval
    assert_false(list[2].front); // clearly dearer than the first, and no better
    assert_false(list[3].front); // never timed
}

static void test_wide_intervals_leave_someone_on_the_front(void **state) {
    (void)state;
    bl_random random = bl_random_seed(6, 0);
    for (int round = 0; round < 500; round++) {
        bl_alternative list[8];
        bl_alternatives all = {.list = list, .count = 8};
        int front = 0;
        for (int i = 0; i < 8; i++)
            list[i] = made_up(bl_random_unit(&random), bl_random_unit(&random),
                              bl_random_unit(&random), bl_random_unit(&random));
        bl_alternatives_mark(&all);
        for (int i = 0; i < 8; i++)
            front += list[i].front;
        assert_true(front > 0);
    }
}

// --- the clock ----------------------------------------------------------------------------------

// A chain of dependent steps, as many a sample as the state says.
static void spin(void *state, size_t count) {
    const size_t steps = *(const size_t *)state;
    uint64_t x = count;
    for (size_t i = 0; i < count * steps; i++)
        x = x * UINT64_C(6364136223846793005) + 1;
    __asm__ volatile("" : : "g"(x));
}

static void test_times_are_those_of_a_sample(void **state) {
    (void)state;
    size_t steps[3] = {50, 200, 50};
    bl_alternatives all = {0};
    for (int i = 0; i < 3; i++) {
        bl_alternative *added = bl_alternatives_add(&all, "spin");
        added->work = spin;
        added->state = &steps[i];
        added->batch = i < 2 ? 64 : 640; // the batch does not matter
    }
    bl_alternatives_add(&all, "timed elsewhere")->ns = 7;
    assert_int_equal(bl_alternatives_time(&all, 2e-4, NULL), BL_OK);
    for (int i = 0; i < 3; i++) {
        assert_true(all.list[i].ns_lowest <= all.list[i].ns);
        assert_true(all.list[i].ns <= all.list[i].ns_highest);
    }
    double fourfold = all.list[1].ns / all.list[0].ns, equal = all.list[2].ns / all.list[0].ns;
    if (!(fourfold > 2 && fourfold < 8 && equal > 0.5 && equal < 2))
        fail_msg("four times the work takes %.3g, the same in larger batches %.3g times as long",
                 fourfold, equal);
    assert_near(all.list[3].ns, 7, 0);
    bl_alternatives_free(&all);
}

// --- the registry -------------------------------------------------------------------------------

static void test_every_trade_is_complete_and_has_a_subject(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_trade_count(); i++) {
        const bl_trade *trade = bl_trade_at(i);
        assert_true(trade->name && trade->title && trade->question && trade->paper);
        assert_true(trade->error_name && trade->error_unit && trade->sample && trade->subject);
        assert_ptr_equal(bl_trade_find(trade->name), trade);
        bl_signal *signal =
            trade->applies(NULL, trade->subject) ? NULL : open_signal(trade->subject);
        if (signal && !trade->applies(signal, NULL))
            fail_msg("%s does not apply to its subject", trade->name);
        bl_signal_free(signal);
        assert_false(trade->applies(NULL, "nothing"));
    }
    assert_null(bl_trade_at(bl_trade_count()));
    assert_null(bl_trade_find("nothing"));
}

static void test_a_run_times_and_marks_and_its_intervals_hold_their_values(void **state) {
    (void)state;
    const bl_trade_settings settings = {.seed = 3, .threads = 1};
    const bl_trade *trade = bl_trade_find("curve-form");
    bl_signal *bias = open_signal("bias");
    bl_alternatives all;
    bl_message message;
    int front = 0;
    assert_int_equal(bl_trade_run(trade, bias, &settings, &all, &message), BL_OK);
    for (size_t i = 0; i < all.count; i++) {
        const bl_alternative *a = &all.list[i];
        assert_true(a->ns > 0 && a->ns_lowest <= a->ns && a->ns <= a->ns_highest);
        assert_true(a->error.lower <= a->error.value && a->error.value <= a->error.upper);
        front += a->front;
    }
    assert_true(front > 0);
    bl_trade_close(trade, &all);
    bl_signal_free(bias);
}

static void test_a_setting_replaces_what_the_text_says(void **state) {
    (void)state;
    static const char *const cases[][4] = {
        {"vcnoise:kernel=table:8,seed=3", "kernel", "table:64", "vcnoise:seed=3,kernel=table:64"},
        {"gnoise:period=4,8,16", "seed", "5", "gnoise:seed=5,period=4,8,16"},
        {"fbm:basis=vnoise,basis.interp=linear", "octaves", "3",
         "fbm:basis=vnoise,basis.interp=linear,octaves=3"},
        {"bias", "form", "schlick", "bias:form=schlick"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i][0]), *changed = NULL, *same;
        bl_message message;
        if (bl_signal_with_setting(signal, cases[i][1], cases[i][2], &changed, &message) != BL_OK)
            fail_msg("%s: %s", cases[i][0], message.text);
        same = open_signal(cases[i][3]);
        assert_string_equal(changed->text, same->text);
        bl_signal_free(signal);
        bl_signal_free(changed);
        bl_signal_free(same);
    }
    bl_signal *signal = open_signal("gnoise"), *changed;
    bl_message message;
    assert_int_equal(bl_signal_with_setting(signal, "kernal", "1", &changed, &message), BL_USAGE);
    assert_null(changed);
    bl_signal_free(signal);
}

// --- the errors of each trade -------------------------------------------------------------------

// The nearest entry of a table in r^2 is off by up to half a step: the error is as the step.
static void test_a_kernel_table_errs_as_its_step(void **state) {
    (void)state;
    static const char *const subjects[] = {"vcnoise", "scnoise"};
    for (int s = 0; s < 2; s++) {
        bl_alternatives all = open_trade("kernel-table", subjects[s]);
        double at_64 = find(&all, "table:64")->error.value;
        assert_near(find(&all, "table:1024")->error.value / at_64, 1.0 / 16, 0.1 / 16);
        assert_near(find(&all, "table:16")->error.value / at_64, 4, 0.4);
        assert_less(find(&all, "exact")->error.value, 1e-6);
        assert_less(find(&all, "exact (double)")->largest, 1e-6);
        close_trade("kernel-table", &all);
    }
}

// Rounding to a step s is off by s^2 / 12 in the mean square, along every axis by the slope.
static void test_fixed_point_errs_as_its_two_roundings(void **state) {
    (void)state;
    static const unsigned bits[] = {8, 12, 16};
    bl_signal *noise = open_signal("gnoise");
    bl_random random = bl_random_seed(21, 0);
    double slopes = 0;
    enum { PLACES = 20000 };
    for (int i = 0; i < PLACES; i++) {
        double at[BL_AXES], slope[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = 128 * bl_random_unit(&random) - 64;
        noise->functions->gradient(noise->parameters, at, slope);
        slopes += slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
    }
    bl_alternatives all = open_trade("precision", "gnoise");
    for (int b = 0; b < 3; b++) {
        char name[16];
        double place = ldexp(1, -(int)bits[b]);
        double value = (noise->facts.upper - noise->facts.lower) / (ldexp(1, (int)bits[b]) - 1);
        double square = (place * place * slopes / PLACES + value * value) / 12;
        snprintf(name, sizeof name, "fixed:%u", bits[b]);
        // 4096 places know a root mean square to 1 or 2 %.
        assert_near(find(&all, name)->error.value / sqrt(square / noise->facts.variance), 1, 0.06);
    }
    assert_less(find(&all, "float")->error.value, find(&all, "fixed:16")->error.value);
    assert_near(find(&all, "double")->error.value, 0, 0);
    close_trade("precision", &all);
    bl_signal_free(noise);
}

// The radial Catmull-Rom kernel, from its two cubics.
static double kernel(double r) {
    return r < 1 ? 1 + r * r * (-2.5 + 1.5 * r) : r < 2 ? 2 + r * (-4 + r * (2.5 - 0.5 * r)) : 0;
}

// Campbell's theorem: of impulses at random with a density N, the excess kurtosis is
// (E a^4 / (E a^2)^2) int K^4 / (N (int K^2)^2); a is uniform in (-1, 1).
static void test_the_kurtosis_of_impulses_is_that_of_campbell(void **state) {
    (void)state;
    double second = 0, fourth = 0;
    for (int i = 0; i < 2000; i++) {
        double r = (i + 0.5) / 1000, k = kernel(r), shell = 4 * M_PI * r * r / 1000;
        second += shell * k * k;
        fourth += shell * k * k * k * k;
    }
    bl_alternatives all = open_trade("impulses", "scnoise:count=poisson");
    for (size_t i = 0; i < all.count; i++)
        assert_in_interval(&all.list[i].error,
                           1.8 * fourth / (second * second) / atof(all.list[i].name));
    close_trade("impulses", &all);
}

// Octaves of amplitude 1/f are independent at random places: their variances add up.
static void test_lost_octaves_take_their_variance(void **state) {
    (void)state;
    static const char *const names[] = {"1", "2", "3", "4"};
    bl_alternatives all = open_trade("octaves", "fractalsum:min=1,max=16");
    double whole = 1 + 1.0 / 4 + 1.0 / 16 + 1.0 / 64, kept = 0;
    assert_int_equal(all.count, 4);
    for (int i = 0; i < 4; i++) {
        kept += ldexp(1, -2 * i);
        assert_string_equal(all.list[i].name, names[i]);
        assert_in_interval(&all.list[i].error, 1 - kept / whole);
    }
    close_trade("octaves", &all);
}

static void test_octaves_by_number_are_left_out_from_the_end(void **state) {
    (void)state;
    bl_alternatives all = open_trade("octaves", "fbm:octaves=3,lacunarity=3");
    assert_int_equal(all.count, 3);
    assert_true(all.list[0].error.value > all.list[1].error.value);
    assert_true(all.list[1].error.value > 0);
    assert_near(all.list[2].error.value, 0, 0);
    close_trade("octaves", &all);
}

static double schlick(double b, double x) {
    return x / ((1 / b - 2) * (1 - x) + 1);
}

static void test_schlicks_bias_is_off_as_its_formula_says(void **state) {
    (void)state;
    const double b = 0.8;
    double square = 0, largest = 0;
    for (int i = 0; i < 100000; i++) {
        double x = (i + 0.5) / 100000, error = fabs(schlick(b, x) - pow(x, log(b) / log(0.5)));
        square += error * error / 100000;
        largest = fmax(largest, error);
    }
    bl_alternatives all = open_trade("curve-form", "bias:b=0.8");
    const bl_alternative *form = find(&all, "schlick");
    assert_in_interval(&form->error, sqrt(square));
    assert_near(form->largest, largest, 1e-3 * largest + 1e-7); // 4096 places near a smooth top
    assert_less(find(&all, "power")->largest, 1e-7);
    close_trade("curve-form", &all);
}

// |H|^2 / (2 pi f)^2 over that of the bare step, 1/(2 pi^2) on this side, mapped to a finite range.
static double box_leak(double f, void *unused) {
    (void)unused;
    double h = sin(M_PI * f) / (M_PI * f);
    return h * h / (2 * f * f);
}

static void test_the_leak_of_filtered_steps(void **state) {
    (void)state;
    double box, error;
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(2000);
    gsl_function f = {.function = box_leak};
    gsl_integration_qag(&f, 0.5, 200, 1e-12, 1e-10, 2000, GSL_INTEG_GAUSS61, room, &box, &error);
    gsl_integration_workspace_free(room);
    bl_alternatives all = open_trade("step-filter", "step");
    assert_near(find(&all, "none")->error.value, 1, 0);
    assert_near(find(&all, "box")->error.value, box, 1e-8); // beyond 200: 1 / (12 pi^2 200^3)
    assert_near(find(&all, "sinc")->error.value, 0, 1e-12);
    for (size_t i = 0; i < all.count; i++)
        assert_true(all.list[i].error.lower <= all.list[i].error.upper &&
                    all.list[i].error.upper < all.list[i].error.lower + 1e-6);
    close_trade("step-filter", &all);
}

static void test_a_brick_that_integrates_is_better_than_a_point(void **state) {
    (void)state;
    bl_alternatives all = open_trade("texture-filter", "brick");
    assert_less(find(&all, "integral")->error.upper, find(&all, "point")->error.lower);
    assert_less(find(&all, "supersample:n=8")->error.upper, find(&all, "point")->error.lower);
    assert_true(find(&all, "point")->ns > 0);
    close_trade("texture-filter", &all);
}

// A bin of K independent lines is chi-square with 2K degrees of freedom; gradient noise, whose
// variance changes with the place in the cell, has fewer, and its interval is wider.
static void test_spectra_are_known_as_the_root_of_their_averages(void **state) {
    (void)state;
    bl_alternatives all = open_trade("averages", NULL);
    assert_near(find(&all, "256")->error.value / find(&all, "4096")->error.value, 4, 0.8);
    double white = 0.5 * (2 * 4096 / bl_chi_square_quantile(0.025, 2 * 4096) -
                          2 * 4096 / bl_chi_square_quantile(0.975, 2 * 4096));
    assert_true(find(&all, "4096")->error.value > 0.8 * white);
    assert_true(find(&all, "4096")->error.value < 2 * white);
    close_trade("averages", &all);
}

// The share of vnoise above 1 cycle a cell is the integral of the closed form, which the facts
// state as its leak.
static void test_interpolations_leak_as_they_state(void **state) {
    (void)state;
    bl_alternatives all = open_trade("interpolation", "vnoise");
    for (size_t i = 0; i < all.count; i++) {
        char text[64];
        snprintf(text, sizeof text, "vnoise:interp=%s", all.list[i].name);
        bl_signal *signal = open_signal(text);
        if (signal->facts.band_to == 1 && signal->facts.leak_db > -100)
            assert_in_interval(&all.list[i].error, pow(10, signal->facts.leak_db / 10));
        bl_signal_free(signal);
    }
    close_trade("interpolation", &all);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_front_of_exact_numbers_is_that_of_pareto),
        cmocka_unit_test(test_what_cannot_be_told_apart_stays_on_the_front),
        cmocka_unit_test(test_wide_intervals_leave_someone_on_the_front),
        cmocka_unit_test(test_times_are_those_of_a_sample),
        cmocka_unit_test(test_every_trade_is_complete_and_has_a_subject),
        cmocka_unit_test(test_a_run_times_and_marks_and_its_intervals_hold_their_values),
        cmocka_unit_test(test_a_setting_replaces_what_the_text_says),
        cmocka_unit_test(test_a_kernel_table_errs_as_its_step),
        cmocka_unit_test(test_fixed_point_errs_as_its_two_roundings),
        cmocka_unit_test(test_the_kurtosis_of_impulses_is_that_of_campbell),
        cmocka_unit_test(test_lost_octaves_take_their_variance),
        cmocka_unit_test(test_octaves_by_number_are_left_out_from_the_end),
        cmocka_unit_test(test_schlicks_bias_is_off_as_its_formula_says),
        cmocka_unit_test(test_the_leak_of_filtered_steps),
        cmocka_unit_test(test_a_brick_that_integrates_is_better_than_a_point),
        cmocka_unit_test(test_spectra_are_known_as_the_root_of_their_averages),
        cmocka_unit_test(test_interpolations_leak_as_they_state),
    };
    return bl_run_tests(tests);
}
