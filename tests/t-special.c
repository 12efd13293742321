// SPDX-License-Identifier: MIT
//
// Special places of the scorecard: functions that are broken just there or far out are caught by
// the column that asks, sound ones that come near it are not, and the places are what they are
// said to be.
#include "tests/test.h"

#include "score/properties/special.h"
#include "tests/scores.h"
#include "tests/test_signals.h"

static double fraction(double x) {
    return x - floor(x);
}

static double sum(const double at[BL_AXES]) {
    return at[0] + at[1] + at[2];
}

// --- views of a wave, within [-1, 1] ---

#define INSIDE bl_signal_value(inner, at)
#define VIEW(name, expression)                                                                     \
    static double name(const bl_signal *inner, const double at[BL_AXES]) {                         \
        return expression;                                                                         \
    }
#define TURNED(name, condition) VIEW(name, (condition) ? -INSIDE : INSIDE)

TURNED(on_plane, at[0] == floor(at[0]))
TURNED(on_one_plane, at[0] == 0)
TURNED(on_negative_planes, at[1] < 0 && at[1] == floor(at[1]))
TURNED(on_half_planes, fraction(at[2]) == 0.5)
TURNED(on_diagonal, fraction(at[0]) == fraction(at[1]))
TURNED(on_one_diagonal, at[1] == at[2])
TURNED(on_triple, fraction(at[0]) == fraction(at[1]) && fraction(at[1]) == fraction(at[2]))
TURNED(on_antidiagonal, fraction(at[0] + at[2]) == 0)
TURNED(on_all_antidiagonals, fraction(sum(at)) == 0)
TURNED(on_sum, at[0] + at[1] == at[2])
TURNED(on_skewed, fraction(at[1] + sum(at) / 3) == 0)
VIEW(at_corner, INSIDE + (at[0] == 0 && at[1] == 0 && at[2] == 0 ? 0.01 : 0))
VIEW(at_negative_zero, INSIDE + (at[0] == 0 && signbit(at[0]) ? 0.01 : 0))
VIEW(step_far, 0.5 * INSIDE + (at[1] >= 65536 ? 0.1 : 0))
TURNED(turned_far, at[2] >= 0x1p31)
VIEW(no_number_on_half, fraction(at[0]) == 0.5 ? NAN : INSIDE)
VIEW(infinite_on_tie, fraction(at[1]) == fraction(at[2]) ? INFINITY : INSIDE)
VIEW(explodes_far, fabs(at[0]) > 2.2e9 ? 6.8e28 : INSIDE)
VIEW(no_number_far, at[1] <= -0x1p31 ? NAN : INSIDE)
VIEW(out_of_range_at_24, INSIDE + (at[0] == 0x1p24 ? 5 : 0))
VIEW(together_alone, fmin(at[0], fmin(at[1], at[2])) >= 0x1p32 ? 5 : INSIDE)
VIEW(whole_of_int, INSIDE + (at[0] < 0 ? at[0] - trunc(at[0]) : 0)) // mirrored about 0
VIEW(slow_plane, fmod(at[0], 100) == 0 ? -0.5 : INSIDE)

// Sound: the same field of float coordinates, small cells, kinks, and levels.
VIEW(same, INSIDE)
VIEW(kinked, fabs(INSIDE))
VIEW(sparse, fmax(INSIDE, 0.6) - 0.6)
VIEW(repeats, bl_signal_value(inner, (const double[BL_AXES]){at[0] - 256 * floor(at[0] / 256),
                                                             at[1], at[2]}))
VIEW(levels, floor(4 * INSIDE) / 4)

static double of_floats(const bl_signal *inner, const double at[BL_AXES]) {
    const double places[BL_AXES] = {(double)(float)at[0], (double)(float)at[1],
                                    (double)(float)at[2]};
    return (double)(float)bl_signal_value(inner, places);
}

typedef struct look {
    const char *name;
    bl_test_view *view;
    const char *property; // that fails; NULL: none does
    const char *says;
    double far; // stated; 0: not
    int continuity;
    double cell; // stated; 0: 1
} look;

#define JUMPS "the value jumps"
static const look looks[] = {
    {"plane", on_plane, "continuity", JUMPS, 0, 2, 0},
    {"one plane", on_one_plane, "continuity", JUMPS, 0, 2, 0},
    {"negative planes", on_negative_planes, "continuity", JUMPS, 0, 2, 0},
    {"half planes", on_half_planes, "continuity", JUMPS, 0, 2, 0},
    {"diagonal", on_diagonal, "continuity", JUMPS, 0, 2, 0},
    {"one diagonal", on_one_diagonal, "continuity", JUMPS, 0, 2, 0},
    {"three fractions", on_triple, "continuity", JUMPS, 0, 2, 0},
    {"antidiagonal", on_antidiagonal, "continuity", JUMPS, 0, 2, 0},
    {"antidiagonals", on_all_antidiagonals, "continuity", JUMPS, 0, 2, 0},
    {"x + y = z", on_sum, "continuity", JUMPS, 0, 2, 0},
    {"skewed", on_skewed, "continuity", JUMPS, 0, 2, 0},
    {"corner", at_corner, "continuity", JUMPS, 0, 2, 0},
    {"-0.0", at_negative_zero, "continuity", JUMPS, 0, 2, 0},
    {"plane of 100", slow_plane, "continuity", JUMPS, 0, 2, 100},
    {"step", step_far, "continuity", JUMPS, 0, 2, 0},
    {"step", step_far, "far", "neighbours jump at 2^16", 0, 2, 0},
    {"turned", turned_far, "far", "neighbours jump at 2^31", 0, 2, 0},
    {"NaN on half", no_number_on_half, "range", "not finite", 0, 2, 0},
    {"infinite on tie", infinite_on_tie, "range", "not finite", 0, 2, 0},
    {"explodes", explodes_far, "range", "e+28 at", 0, 2, 0},
    {"explodes", explodes_far, "far", "the range breaks at 2^32: 6.8e+28", 0, 2, 0},
    {"NaN far", no_number_far, "range", "not finite", 0, 2, 0},
    {"NaN far", no_number_far, "far", "there is no number at 2^31", 0, 2, 0},
    {"one value at 2^24", out_of_range_at_24, "range", "16777216", 0, 2, 0},
    {"all axes", together_alone, "range", "4294967296", 0, 2, 0},
    {"int", whole_of_int, "range", "outside", 0, -1, 0},
    // What is broken where nothing is claimed is told, and fails nothing.
    {"NaN far", no_number_far, NULL, NULL, 1e6, 2, 0},
    {"turned", turned_far, NULL, NULL, 1e6, 2, 0},
    {"explodes", explodes_far, NULL, NULL, 1e9, 2, 0},
    {"same", same, NULL, NULL, 0, 2, 0},
    {"kinked", kinked, NULL, NULL, 0, 0, 0},
    {"sparse", sparse, NULL, NULL, 0, 0, 0},
    {"repeats", repeats, NULL, NULL, 0, -1, 0},
    {"levels", levels, NULL, NULL, 0, -1, 0},
    {"floats", of_floats, NULL, NULL, 1e4, 0, 0},
    {"floats", of_floats, NULL, NULL, 0, 0, 0}};

// The scale is stated, and not sought.
static bl_score_property measure(const bl_signal *signal, const char *property) {
    bl_score_settings settings = bl_score_default_settings();
    settings.size = BL_QUICK;
    settings.threads = 1;
    const bl_score_subject subject = {
        .signal = signal, .scale = {.variation = BL_VARIES, .stated = signal->facts.cell}};
    return bl_test_score_with(&subject, property, &settings);
}

static bl_signal *open_look(const bl_signal *inner, const look *l) {
    bl_signal *signal = bl_test_seen_through(inner, l->view);
    signal->facts.lower = -1;
    signal->facts.upper = 1;
    signal->facts.continuity = l->continuity;
    signal->facts.cell = l->cell > 0 ? l->cell : 1;
    signal->facts.far = l->far > 0 ? l->far : NAN;
    return signal;
}

static void test_what_breaks_at_special_places_is_found(void **state) {
    (void)state;
    bl_signal *wave = bl_test_cosine(0, 1, (const double[]){0.31, 0.27, 0.23});
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) {
        const look *l = &looks[i];
        bl_signal *signal = open_look(wave, l);
        if (l->property) {
            bl_score_property found = measure(signal, l->property);
            if (found.verdict != BL_VERDICT_FAIL || !strstr(found.reason, l->says))
                fail_msg("%s: %s: %s '%s'", l->name, l->property, bl_verdict_word(found.verdict),
                         found.reason);
        }
        bl_signal_free(signal);
    }
    bl_signal_free(wave);
}

static void test_what_is_sound_passes(void **state) {
    (void)state;
    static const char *const columns[] = {"repeatable", "range", "continuity"};
    bl_signal *wave = bl_test_cosine(0, 1, (const double[]){0.31, 0.27, 0.23});
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) {
        const look *l = &looks[i];
        bl_signal *signal = open_look(wave, l);
        for (int k = 0; k < 3 && !l->property; k++) {
            bl_score_property found = measure(signal, columns[k]);
            if (found.verdict == BL_VERDICT_FAIL)
                fail_msg("%s: %s: %s", l->name, columns[k], found.reason);
        }
        bl_signal_free(signal);
    }
    bl_signal_free(wave);
}

// A stated reach bounds what is judged: beyond it the break is told.
static void test_what_breaks_beyond_the_stated_reach_is_told(void **state) {
    (void)state;
    bl_signal *wave = bl_test_cosine(0, 1, (const double[]){0.31, 0.27, 0.23});
    look l = {.view = no_number_far, .far = 1e9, .continuity = 2};
    bl_signal *signal = open_look(wave, &l);
    bl_score_property found = measure(signal, "far");
    assert_int_equal(found.verdict, BL_VERDICT_PASS);
    assert_non_null(strstr(found.reason, "there is no number at 2^31"));
    assert_true(bl_score_find(&found, "no_number_at")->estimate.value == 0x1p31);
    assert_true(isnan(bl_score_find(&found, "neighbours_jump_at")->estimate.value));
    signal->facts.far = 0x1p33;
    found = measure(signal, "far");
    assert_int_equal(found.verdict, BL_VERDICT_FAIL);
    assert_int_equal(found.against, BL_AGAINST_CLAIM);
    bl_signal_free(signal);
    bl_signal_free(wave);
}

// --- the routes ---

enum { IN_POINTS, IN_ROWS, IN_REFERENCE };

typedef struct route {
    const bl_signal *inner;
    int which;
} route;

static double on_tie(double x, double y) {
    return fraction(x) == fraction(y) ? 0.01 : 0;
}

static double route_value(const void *parameters, const double at[BL_AXES]) {
    const route *r = parameters;
    return bl_signal_value(r->inner, at) + (r->which == IN_REFERENCE ? on_tie(at[0], at[1]) : 0);
}

static void route_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                         float *out) {
    const route *r = parameters;
    bl_signal_points(r->inner, at, count, out);
    for (size_t i = 0; i < count && r->which == IN_POINTS; i++)
        out[i] += (float)on_tie(at[0][i], at[1][i]);
}

static void route_row(const void *parameters, const double start[BL_AXES],
                      const double step[BL_AXES], size_t count, float *out) {
    const route *r = parameters;
    bl_signal_row(r->inner, start, step, count, out);
    for (size_t i = 0; i < count && r->which == IN_ROWS; i++)
        out[i] += (float)on_tie(start[0] + (double)i * step[0], start[1] + (double)i * step[1]);
}

static void test_a_route_that_is_broken_on_ties_is_found(void **state) {
    (void)state;
    static const bl_signal_functions functions = {
        .row = route_row, .points = route_points, .value = route_value};
    bl_signal *inner = bl_test_cosine(0, 1, (const double[]){0.31, 0.27, 0.23});
    for (int which = IN_POINTS; which <= IN_REFERENCE; which++) {
        bl_signal *signal =
            bl_signal_new(&functions, &(route){inner, which}, sizeof(route), "route");
        assert_non_null(signal);
        signal->dimensions = 3;
        signal->facts = bl_facts_unknown();
        signal->facts.cell = 1;
        bl_score_property found = measure(signal, "repeatable");
        if (found.verdict != BL_VERDICT_FAIL)
            fail_msg("route %d: %s", which, found.reason);
        bl_signal_free(signal);
    }
    bl_signal_free(inner);
}

// --- the places themselves ---

static void test_places_are_what_they_are_said_to_be(void **state) {
    (void)state;
    static bl_special special;
    for (unsigned dimensions = 1; dimensions <= BL_AXES; dimensions++)
        for (int c = 0; c < 2; c++) {
            bl_random random = bl_random_seed(7, dimensions);
            size_t whole = 0, half = 0, negative = 0, ties = 0, sums = 0, zeros = 0;
            double cell = c ? 0.25 : 1;
            bl_special_fill(&special, dimensions, cell, &random);
            for (size_t i = 0; i < special.count; i++) {
                double x = special.at[0][i] / cell, y = special.at[1][i] / cell;
                for (unsigned a = dimensions; a < BL_AXES; a++)
                    assert_true(special.at[a][i] == 0);
                assert_true(fabs(x) <= 64);
                whole += fraction(x) == 0;
                half += fraction(x) == 0.5;
                negative += fraction(x) == 0 && x < 0;
                zeros += x == 0 && signbit(x);
                ties += fraction(x) == fraction(y) && fraction(x) != 0 && fraction(x) != 0.5;
                sums += fraction(x + y) == 0 && fraction(x) != 0;
            }
            assert_true(whole && half && negative && zeros);
            assert_true(dimensions < 2 || (ties && sums));
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_breaks_at_special_places_is_found),
        cmocka_unit_test(test_what_is_sound_passes),
        cmocka_unit_test(test_what_breaks_beyond_the_stated_reach_is_told),
        cmocka_unit_test(test_a_route_that_is_broken_on_ties_is_found),
        cmocka_unit_test(test_places_are_what_they_are_said_to_be),
    };
    return bl_run_tests(tests);
}
