// SPDX-License-Identifier: MIT
//
// Views: their derivatives against finite differences, what they do not see, and what they refuse.
#include "tests/test.h"

#include "aliasing/view.h"
#include "core/random.h"
#include "tests/sources.h"

enum { SIZE = 64 };

// Places around (x, y) that are all seen, and where no angle jumps by a whole turn.
static int look_around(const bl_view *view, double x, double y, double h, bl_sight out[3][3]) {
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            if (!bl_view_see(view, x + h * (i - 1), y + h * (j - 1), &out[j][i]))
                return 0;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 9; i++)
            if (fabs(out[i / 3][i % 3].at[a] - out[1][1].at[a]) >
                1 + 10 * h * (fabs(out[1][1].across[a]) + fabs(out[1][1].down[a])))
                return 0;
    return 1;
}

// Central differences are off by h^2/6 of the third derivative: a second step of half the length
// says by how much, and rounding takes at most a few 2^-53 of the value over h (or h^2).
static void check_number(const char *text, double exact, double coarse, double fine,
                         double rounding) {
    double tolerance = 2 * fabs(coarse - fine) + rounding;
    if (!(fabs(exact - fine) <= tolerance))
        fail_msg("%s: %.17g, by differences %.17g and %.17g", text, exact, coarse, fine);
}

static void check_place(const bl_view *view, double x, double y, size_t *count) {
    const double h = 0x1p-8;
    bl_sight c[3][3], f[3][3];
    if (!look_around(view, x, y, h, c) || !look_around(view, x, y, 0.5 * h, f))
        return;
    (*count)++;
    for (int a = 0; a < BL_AXES; a++) {
        double size = 0;
        for (int i = 0; i < 9; i++)
            size = fmax(size, fabs(c[i / 3][i % 3].at[a]));
        // The torus is found to 1e-13 of a unit, its coordinates are up to `scale` of them.
        double rounding = 1e-11 * (1 + size);
        const bl_sight *s = &c[1][1];
        check_number(view->text, s->across[a], (c[1][2].at[a] - c[1][0].at[a]) / (2 * h),
                     (f[1][2].at[a] - f[1][0].at[a]) / h, rounding / h);
        check_number(view->text, s->down[a], (c[2][1].at[a] - c[0][1].at[a]) / (2 * h),
                     (f[2][1].at[a] - f[0][1].at[a]) / h, rounding / h);
        // Second derivatives by differences of the first, which were just held to the values.
        check_number(view->text, s->second[a][0], (c[1][2].across[a] - c[1][0].across[a]) / (2 * h),
                     (f[1][2].across[a] - f[1][0].across[a]) / h, rounding / h);
        check_number(view->text, s->second[a][1], (c[2][1].across[a] - c[0][1].across[a]) / (2 * h),
                     (f[2][1].across[a] - f[0][1].across[a]) / h, rounding / h);
        check_number(view->text, s->second[a][2], (c[2][1].down[a] - c[0][1].down[a]) / (2 * h),
                     (f[2][1].down[a] - f[0][1].down[a]) / h, rounding / h);
    }
}

static void check_derivatives(const char *text) {
    for (int zoomed = 0; zoomed < 2; zoomed++) {
        bl_view view = bl_test_open_view(text, SIZE);
        bl_random random = bl_random_seed(7, bl_test_stream(text));
        size_t count = 0;
        if (zoomed) {
            view.zoom = 1.5;
            view.pan[0] = 0.25;
        }
        for (int i = 0; i < 400; i++)
            check_place(&view, SIZE * bl_random_unit(&random), SIZE * bl_random_unit(&random),
                        &count);
        if (count <= 50)
            fail_msg("%s: sees too little of the texture", text);
        bl_view_close(&view);
    }
}

static void test_derivatives_of_views_are_those_of_their_coordinates(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_view_count(); i++) {
        const bl_view_kind *kind = bl_view_at(i);
        check_derivatives(kind->name);
        for (const char *const *example = kind->examples; example && *example; example++) {
            char text[256];
            snprintf(text, sizeof text, "%s:%s", kind->name, *example);
            check_derivatives(text);
        }
    }
}

// The places of a solid lie on the surface, and the nearer of all on the ray.
static void test_solids_are_seen_on_their_surface(void **state) {
    (void)state;
    bl_view sphere = bl_test_open_view("sphere:coordinates=solid,scale=1", SIZE);
    bl_view torus = bl_test_open_view("torus:coordinates=solid,scale=1", SIZE);
    bl_random random = bl_random_seed(9, 0);
    size_t seen[2] = {0, 0};
    for (int i = 0; i < 2000; i++) {
        bl_sight s;
        double x = SIZE * bl_random_unit(&random), y = SIZE * bl_random_unit(&random);
        if (bl_view_see(&sphere, x, y, &s)) {
            seen[0]++;
            assert_near(hypot(hypot(s.at[0], s.at[1]), s.at[2]), 1, 1e-12);
            assert_less(s.distance, 3); // the centre's
        }
        if (bl_view_see(&torus, x, y, &s)) {
            seen[1]++;
            assert_near(hypot(hypot(s.at[0], s.at[1]) - 1, s.at[2]), 0.4, 1e-11);
        }
    }
    assert_in_range(seen[0], 400, 1600);
    assert_in_range(seen[1], 200, 1600);
    bl_view_close(&sphere);
    bl_view_close(&torus);
}

// From the side, rays through the middle of the ring meet its near wall: 1 + tube before the
// centre; from above they pass through the hole.
static void test_the_torus_has_a_wall_and_a_hole(void **state) {
    (void)state;
    bl_sight s;
    bl_view side = bl_test_open_view("torus:tilt=0,distance=4", SIZE),
            above = bl_test_open_view("torus:tilt=90", SIZE);
    assert_true(bl_view_see(&side, 0.5 * SIZE, 0.5 * SIZE, &s));
    assert_near(s.distance, 4 - 1.4, 1e-12);
    assert_false(bl_view_see(&above, 0.5 * SIZE, 0.5 * SIZE, &s));
    bl_view_close(&side);
    bl_view_close(&above);
}

static void test_the_horizon_is_finite_and_the_sky_is_not_seen(void **state) {
    (void)state;
    bl_view view = bl_test_open_view("plane:pitch=0,height=1e9", SIZE);
    bl_sight s;
    memset(&s, 1, sizeof s);
    bl_sight before = s;
    assert_false(bl_view_see(&view, 3, 0.5 * SIZE, &s)); // the horizon itself
    assert_false(bl_view_see(&view, 3, 2, &s));
    assert_memory_equal(&s, &before, sizeof s);
    size_t seen = 0;
    for (double down = 1; down > 1e-12; down *= 0.9) {
        if (!bl_view_see(&view, 0, 0.5 * SIZE + down, &s))
            continue;
        seen++;
        for (int a = 0; a < BL_AXES; a++) {
            assert_true(isfinite(s.at[a]) && isfinite(s.across[a]) && isfinite(s.down[a]));
            for (int i = 0; i < 3; i++)
                assert_true(isfinite(s.second[a][i]) && fabs(s.second[a][i]) < 1e30);
        }
    }
    assert_true(seen > 50);
    assert_false(bl_view_see(&view, NAN, NAN, &s));
    bl_view_close(&view);
}

// A pixel of a plane seen from straight above is 2 height tan(fov/2) / width wide.
static void test_a_plane_from_above_is_flat(void **state) {
    (void)state;
    bl_view view = bl_test_open_view("plane:pitch=90,height=3,fov=90", SIZE);
    bl_sight s;
    assert_true(bl_view_see(&view, 5, 9, &s));
    assert_near(s.across[0], 6.0 / SIZE, 1e-12);
    assert_near(s.down[1], 6.0 / SIZE, 1e-12);
    assert_near(s.at[0], (5 - 0.5 * SIZE) * 6.0 / SIZE, 1e-12);
    assert_near(s.across[1], 0, 1e-15);
    bl_view_close(&view);
}

static void test_views_refuse_what_they_do_not_know(void **state) {
    (void)state;
    static const char *const bad[] = {"plain",
                                      "plane:fov=180",
                                      "plane:heigth=1",
                                      "torus:tube=2",
                                      "sphere:distance=0.5",
                                      "flat:scale=0",
                                      "plane:height=nan",
                                      "torus:distance=1"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        bl_view view;
        bl_message message = {""};
        assert_int_equal(bl_view_open(bad[i], 8, 8, &view, &message), BL_USAGE);
        assert_true(strlen(message.text) > 10);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_derivatives_of_views_are_those_of_their_coordinates),
        cmocka_unit_test(test_solids_are_seen_on_their_surface),
        cmocka_unit_test(test_the_torus_has_a_wall_and_a_hole),
        cmocka_unit_test(test_the_horizon_is_finite_and_the_sky_is_not_seen),
        cmocka_unit_test(test_a_plane_from_above_is_flat),
        cmocka_unit_test(test_views_refuse_what_they_do_not_know),
    };
    return bl_run_tests(tests);
}
