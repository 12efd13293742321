// SPDX-License-Identifier: MIT
//
// Advice: the choice among made-up errors and times, what a view shows against its closed form, and
// that the whole keeps its word on bricks.
#include "tests/test.h"

#include "score/advise.h"
#include "aliasing/usual_methods.h"
#include "noises/noise.h"
#include "textures/texture.h"
#include "tests/sources.h"

// --- the choice ---------------------------------------------------------------------------------

enum { ROWS = 4 };

typedef struct made_up {
    double ns[ROWS], error[ROWS], half; // half widths of the errors
    double tolerance;
    bl_verdict verdict;
    size_t chosen, cheaper;
} made_up;

static void test_the_cheapest_within_the_tolerance_is_chosen(void **state) {
    (void)state;
    static const made_up cases[] = {
        {{10, 20, 30, 40}, {8, 4, 2, 1}, 0, 2, BL_VERDICT_PASS, 2, 1}, // the limit itself is within
        {{10, 20, 30, 40}, {8, 4, 2, 1}, 0, 9, BL_VERDICT_PASS, 0, SIZE_MAX}, // nothing is cheaper
        {{40, 10, 30, 20}, {1, 8, 2, 1.5}, 0, 2, BL_VERDICT_PASS, 3, 1}, // by time, not by order
        {{10, 20, 30, 40}, {8, 4, 2, 1}, 0.5, 2, BL_VERDICT_PASS, 3, 2}, // 2 is not surely within
        {{10, 20, 30, 40}, {8, 4, 2, 1}, 0.5, 0.9, BL_VERDICT_INCONCLUSIVE, 3, 2},
        {{10, 20, 30, 40}, {8, 4, 2, 1}, 0.5, 0.4, BL_VERDICT_FAIL, 3, 2},
        {{40, 30, 20, 10}, {8, 4, 2, 1}, 0, 0.1, BL_VERDICT_FAIL, 3, SIZE_MAX},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        bl_alias_row rows[ROWS] = {{0}};
        bl_estimate errors[ROWS];
        bl_advice advice = {.alias = {.count = ROWS, .rows = rows}, .error = errors};
        for (int i = 0; i < ROWS; i++) {
            double e = cases[c].error[i], half = cases[c].half;
            rows[i].ns_per_sample = cases[c].ns[i];
            errors[i] = (bl_estimate){e, e - half, e + half, 0.95, 10};
        }
        bl_advice_choose(&advice, cases[c].tolerance);
        if (advice.verdict != cases[c].verdict || advice.chosen != cases[c].chosen ||
            advice.cheaper != cases[c].cheaper)
            fail_msg("case %zu: verdict %d, chosen %zu, cheaper %zu", c, (int)advice.verdict,
                     advice.chosen, advice.cheaper);
    }
}

// --- what the scene needs -----------------------------------------------------------------------

// 4 units in 16 pixels: one width everywhere; turned, the larger derivative along an axis is its
// cosine.
static void test_a_flat_view_has_one_width_and_a_constant_depth(void **state) {
    (void)state;
    static const struct {
        const char *view;
        double width;
    } cases[] = {{"flat:scale=4", 0.25}, {"flat:scale=4,rotate=30", 0.25 * 0.866025403784439}};
    bl_signal *noise = bl_test_open_source("gnoise");
    for (int i = 0; i < 2; i++) {
        bl_view view = bl_test_open_view(cases[i].view, 16);
        bl_scene_needs needs = bl_scene_needs_find(noise, &view);
        assert_near(needs.least_width, cases[i].width, 1e-12);
        assert_near(needs.most_width, cases[i].width, 1e-12);
        assert_near(needs.highest_frequency, 0.5 / cases[i].width, 1e-11);
        assert_true(needs.varies[0] && needs.varies[1]);
        assert_false(needs.varies[2]);
        assert_int_equal(needs.octaves, 0);
        bl_view_close(&view);
    }
    bl_signal_free(noise);
}

// Octaves 1, 2, 4, ..., 32 under samples 1/10 apart, which show frequencies below 5.
static void test_octaves_beyond_the_finest_sample_are_not_seen(void **state) {
    (void)state;
    bl_signal *sum = bl_test_open_source("fractalsum:min=1,max=64");
    bl_view view = bl_test_open_view("flat:scale=1.6", 16);
    bl_scene_needs needs = bl_scene_needs_find(sum, &view);
    assert_int_equal(needs.octaves, 6);
    assert_int_equal(needs.octaves_seen, 3);
    bl_view_close(&view);
    bl_signal_free(sum);
}

// The plane: samples get wider towards the horizon, and the nearest row has the least width.
static void test_a_plane_needs_a_range_of_widths(void **state) {
    (void)state;
    bl_signal *noise = bl_test_open_source("gnoise");
    bl_view view = bl_test_open_view("plane", 32);
    bl_scene_needs needs = bl_scene_needs_find(noise, &view);
    bl_sight nearest;
    assert_true(bl_view_see(&view, 16.5, 31.5, &nearest));
    assert_true(needs.most_width > 10 * needs.least_width);
    double across = fmax(fabs(nearest.across[0]), fabs(nearest.down[0]));
    double down = fmax(fabs(nearest.across[1]), fabs(nearest.down[1]));
    assert_true(needs.least_width <= fmin(across, down) * (1 + 1e-12));
    bl_view_close(&view);
    bl_signal_free(noise);
}

// --- the whole ----------------------------------------------------------------------------------

static bl_advise_settings quick(double tolerance, int largest) {
    bl_advise_settings settings = {tolerance, largest, bl_alias_default_settings()};
    settings.alias.replicates = 2;
    settings.alias.frames = 0;
    settings.alias.rounds = 5;
    settings.alias.turn_seconds = 2e-4;
    settings.alias.most_samples = 256;
    return settings;
}

static bl_advice advise(const bl_signal *signal, const bl_view *view,
                        const bl_advise_settings *settings) {
    const char *methods[BL_METHODS_MOST];
    size_t count = bl_usual_methods(signal, methods);
    bl_advice advice;
    bl_message message;
    if (bl_advise(signal, view, methods, count, settings, &advice, &message) != BL_OK)
        fail_msg("%s", message.text);
    return advice;
}

static bl_signal *open_brick(void) {
    bl_spec spec;
    bl_signal *signal = NULL;
    bl_message message;
    assert_int_equal(bl_spec_parse("brick", &spec, &message), BL_OK);
    assert_int_equal(
        bl_definition_open(bl_texture_find("brick"), &spec, "brick", NULL, &signal, &message),
        BL_OK);
    bl_spec_free(&spec);
    return signal;
}

// Whatever the times are: the advice is within, everything cheaper is not surely so, and the worst
// pixel has the largest error of the image.
static void test_the_advice_keeps_its_word(void **state) {
    (void)state;
    bl_signal *brick = open_brick();
    bl_view view = bl_test_open_view("plane", 24);
    for (int largest = 0; largest < 2; largest++) {
        const bl_advise_settings settings = quick(largest ? 0.3 : 0.04, largest);
        bl_advice advice = advise(brick, &view, &settings);
        assert_int_equal(advice.verdict, BL_VERDICT_PASS);
        assert_true(advice.error[advice.chosen].upper <= settings.tolerance);
        for (size_t i = 0; i < advice.alias.count; i++) {
            const bl_alias_row *row = &advice.alias.rows[i];
            assert_near(fabs(advice.worst[i].error), row->max_error, 1e-12);
            if (row->ns_per_sample < advice.alias.rows[advice.chosen].ns_per_sample)
                assert_true(advice.error[i].upper > settings.tolerance);
        }
        bl_advice_free(&advice);
    }
    bl_view_close(&view);
    bl_signal_free(brick);
}

static void test_no_way_is_good_enough_for_a_tiny_tolerance(void **state) {
    (void)state;
    bl_signal *brick = open_brick();
    bl_view view = bl_test_open_view("flat:scale=0.9,rotate=20", 24);
    const bl_advise_settings settings = quick(1e-9, 0);
    bl_advice advice = advise(brick, &view, &settings);
    assert_int_not_equal(advice.verdict, BL_VERDICT_PASS);
    for (size_t i = 0; i < advice.alias.count; i++)
        assert_true(advice.error[i].value >= advice.error[advice.chosen].value);
    bl_advice_free(&advice);
    bl_view_close(&view);
    bl_signal_free(brick);
}

static void test_a_bad_tolerance_is_refused(void **state) {
    (void)state;
    static const double bad[] = {0, -1, NAN};
    static const char *const methods[] = {"point"};
    bl_signal *brick = open_brick();
    bl_view view = bl_test_open_view("flat", 16);
    for (int i = 0; i < 3; i++) {
        const bl_advise_settings settings = quick(bad[i], 0);
        bl_advice advice;
        bl_message message;
        assert_int_equal(bl_advise(brick, &view, methods, 1, &settings, &advice, &message),
                         BL_USAGE);
        assert_non_null(strstr(message.text, "tolerance"));
    }
    bl_view_close(&view);
    bl_signal_free(brick);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_cheapest_within_the_tolerance_is_chosen),
        cmocka_unit_test(test_a_flat_view_has_one_width_and_a_constant_depth),
        cmocka_unit_test(test_octaves_beyond_the_finest_sample_are_not_seen),
        cmocka_unit_test(test_a_plane_needs_a_range_of_widths),
        cmocka_unit_test(test_the_advice_keeps_its_word),
        cmocka_unit_test(test_no_way_is_good_enough_for_a_tiny_tolerance),
        cmocka_unit_test(test_a_bad_tolerance_is_refused),
    };
    return bl_run_tests(tests);
}
