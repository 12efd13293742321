// SPDX-License-Identifier: MIT
//
// The property `symmetry`: a field that is its own image under a mirror, an exchange of axes or a
// turn is named with the map, and one that only seems to be is not. There is no chance in it.
#include "tests/test.h"

#include "tests/scores.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

static double at_place(const bl_signal *inner, double x, double y, double z) {
    return bl_signal_value(inner, (const double[BL_AXES]){x, y, z, 0});
}

// --- fields that are their own image ------------------------------------------------------------

static double mirror_x(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, fabs(p[0]), p[1], p[2]);
}
static double mirror_y_half(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], fabs(p[1] - 0.5), p[2]);
}
static double mirror_z_minus_13(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], fabs(p[2] + 13));
}
static double mirror_x_odd(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], p[2]) - at_place(inner, 6 - p[0], p[1], p[2]);
}
static double mirror_unsigned(const bl_signal *inner, const double p[BL_AXES]) {
    return 0.5 + at_place(inner, p[0], p[1], p[2]) - at_place(inner, p[0], p[1], -p[2]);
}
static double about_origin(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], p[2]) + at_place(inner, -p[0], -p[1], -p[2]);
}
static double about_origin_odd(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], p[2]) - at_place(inner, -p[0], -p[1], -p[2]);
}
static double two_axes(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], p[2]) + at_place(inner, p[0], -p[1], -p[2]);
}
static double exchange_xy(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, fmin(p[0], p[1]), fmax(p[0], p[1]), p[2]);
}
static double exchange_yz_shifted(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], fmin(p[1], p[2] + 5), fmax(p[1], p[2] + 5));
}
static double exchange_xz_falling(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, fmin(p[0], -p[2]), p[1], fmax(p[0], -p[2]));
}
static double turn_xyz(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], p[2]) + at_place(inner, p[1], p[2], p[0]) +
           at_place(inner, p[2], p[0], p[1]);
}
static double idle_x(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, 0.3, p[1], p[2]);
}
static double idle_z(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], 0.3);
}
static double sparse_mirror(const bl_signal *inner, const double p[BL_AXES]) {
    return fmax(0, at_place(inner, fabs(p[0]), p[1], p[2]) - 0.3);
}
static double two_valued_mirror(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, fabs(p[0]), p[1], p[2]) > 0;
}

static void test_a_field_that_is_its_own_image_is_named_with_the_map(void **state) {
    (void)state;
    static const struct {
        bl_test_view *view;
        const char *told; // in the reason
    } cases[] = {
        {mirror_x, "n(-x, y, z) = n(x, y, z)"},
        {mirror_y_half, "n(x, 1 - y, z) = n(x, y, z)"},
        {mirror_z_minus_13, "n(x, y, -26 - z) = n(x, y, z)"},
        {mirror_x_odd, "n(6 - x, y, z) = -n(x, y, z)"},
        {mirror_unsigned, "n(x, y, -z) = 1 - n(x, y, z)"},
        {about_origin, "n(-x, -y, -z) = n(x, y, z)"},
        {about_origin_odd, "n(-x, -y, -z) = -n(x, y, z)"},
        {two_axes, "n(x, -y, -z) = n(x, y, z)"},
        {exchange_xy, "n(y, x, z) = n(x, y, z)"},
        {exchange_yz_shifted, "n(x, 5 + z, -5 + y) = n(x, y, z)"},
        {exchange_xz_falling, "n(-z, y, -x) = n(x, y, z)"},
        {turn_xyz, " = n(x, y, z)"},
        {idle_x, "does not change along x"},
        {idle_z, "does not change along z"},
        {sparse_mirror, "n(-x, y, z) = n(x, y, z)"},
        {two_valued_mirror, "n(-x, y, z) = n(x, y, z)"},
    };
    bl_signal *inner = bl_test_open("gnoise:seed=5", BL_ISA_BEST);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_seen_through(inner, cases[i].view);
        bl_score_property found = bl_test_score(signal, "symmetry", BL_QUICK, 1);
        if (found.verdict != BL_VERDICT_FAIL || !strstr(found.reason, cases[i].told))
            fail_msg("case %zu: %s: '%s' does not tell '%s'", i, bl_verdict_word(found.verdict),
                     found.reason, cases[i].told);
        assert_int_equal(found.against, BL_AGAINST_IDEAL);
        bl_signal_free(signal);
    }
    bl_signal_free(inner);
}

// --- fields that are not ------------------------------------------------------------------------

// A mirror that holds on one side of a plane alone, or but for a thousandth of the range.
static double mirror_below_4(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[1] < 4 ? fabs(p[0]) : p[0], p[1], p[2]);
}
static double mirror_almost(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, fabs(p[0]), p[1], p[2]) + 1e-3 * at_place(inner, p[0], p[1], p[2]);
}
static double sparse(const bl_signal *inner, const double p[BL_AXES]) {
    return fmax(0, at_place(inner, p[0], p[1], p[2]) - 0.3);
}
static double two_valued(const bl_signal *inner, const double p[BL_AXES]) {
    return at_place(inner, p[0], p[1], p[2]) > 0;
}

static void test_a_field_that_is_not_its_own_image_passes(void **state) {
    (void)state;
    static bl_test_view *const views[] = {mirror_below_4, mirror_almost, sparse, two_valued};
    bl_signal *inner = bl_test_open("gnoise:seed=5", BL_ISA_BEST);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        bl_signal *signal = bl_test_seen_through(inner, views[i]);
        bl_score_property found = bl_test_score(signal, "symmetry", BL_QUICK, 1);
        if (found.verdict != BL_VERDICT_PASS)
            fail_msg("case %zu: %s", i, found.reason);
        bl_signal_free(signal);
    }
    bl_signal_free(inner);
}

static void test_no_noise_of_the_registry_is_its_own_image(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        bl_signal *signal = bl_test_open(bl_noise_at(i, BL_ISA_BEST)->name, BL_ISA_BEST);
        bl_score_property found = bl_test_score(signal, "symmetry", BL_QUICK, 1);
        if (found.verdict == BL_VERDICT_FAIL)
            fail_msg("%s: %s", signal->text, found.reason);
        bl_signal_free(signal);
    }
}

// Of one axis and of four, where the ways to exchange axes are counted by hand: the mirrors about
// half cells -64 .. 64 of each axis; two ways of each pair about -32 .. 32; and all signed
// exchanges but the identity, about two centres.
static void test_the_number_of_maps_is_that_of_the_group(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double pairs, axes, group;
    } cases[] = {{"gnoise:dims=1", 0, 1, 2},
                 {"gnoise:dims=2", 1, 2, 8},
                 {"gnoise:dims=3", 3, 3, 48},
                 {"gnoise:dims=4", 6, 4, 384}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        bl_score_property found = bl_test_score(signal, "symmetry", BL_QUICK, 1);
        const bl_score_number *maps = bl_score_find(&found, "maps");
        assert_non_null(maps);
        assert_near(maps->estimate.value,
                    129 * cases[i].axes + 130 * cases[i].pairs + 2 * (cases[i].group - 1), 0);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_field_that_is_its_own_image_is_named_with_the_map),
        cmocka_unit_test(test_a_field_that_is_not_its_own_image_passes),
        cmocka_unit_test(test_no_noise_of_the_registry_is_its_own_image),
        cmocka_unit_test(test_the_number_of_maps_is_that_of_the_group),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
