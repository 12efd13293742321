// SPDX-License-Identifier: MIT
//
// Closed-form spectra: lines, slices and shares against integrals of the volume density.
#include "tests/test.h"

#include "core/quadrature.h"
#include "spectra/theory.h"
#include "tests/term_signals.h"

static const double x_axis[BL_AXES] = {1}, y_axis[BL_AXES] = {0, 1}, z_axis[BL_AXES] = {0, 0, 1};

static void test_quadrature_is_exact_to_degree_31(void **state) {
    (void)state;
    for (int degree = 0; degree < 32; degree++) {
        double sum = 0;
        for (int n = 0; n < BL_QUADRATURE_NODES; n++)
            sum += bl_quadrature_weight[n] * pow(bl_quadrature_node[n], degree);
        assert_near(sum, degree & 1 ? 0 : 2.0 / (degree + 1), 1e-15);
    }
}

static void test_directions_are_orthonormal(void **state) {
    (void)state;
    const double axes[][3] = {{1, 0, 0},
                              {0, 1, 0},
                              {0, 0, -3},
                              {1, 1, 1},
                              {-2, 5, 1},
                              {1e-9, 1, 0},
                              {1e300, 1e300, -1e300}};
    for (size_t i = 0; i < sizeof axes / sizeof *axes; i++)
        for (unsigned dims = 1; dims <= 3; dims++) {
            double d[3][BL_AXES];
            assert_true(bl_directions(dims, axes[i], d));
            for (unsigned j = 0; j < dims; j++)
                for (unsigned k = 0; k <= j; k++) {
                    double dot = 0;
                    for (int a = 0; a < BL_AXES; a++)
                        dot += d[j][a] * d[k][a];
                    assert_near(dot, j == k, 1e-15);
                }
            for (unsigned j = 0; dims == 2 && j < 2; j++) // normal to the axis
                assert_near(d[j][0] * (axes[i][0] / 5) + d[j][1] * (axes[i][1] / 5) +
                                d[j][2] * (axes[i][2] / 5),
                            0, 1e-15 * fabs(axes[i][0] + axes[i][1] + axes[i][2]) + 1e-15);
        }
    double d[3][BL_AXES];
    assert_true(bl_directions(2, (double[]){0, 0, 1}, d));
    assert_memory_equal(d[0], x_axis, sizeof x_axis);
    assert_memory_equal(d[1], y_axis, sizeof y_axis);
    assert_false(bl_directions(1, (double[]){0, 0, 0}, d));
    assert_false(bl_directions(2, (double[]){1, NAN, 0}, d));
    assert_false(bl_directions(2, (double[]){1, INFINITY, 0}, d));
}

// --- lines and slices ----------------------------------------------------------------------------

// Along an axis and in an axis plane a lattice term factors.
static double product_form(const bl_terms *terms, int axes, const double f[3]) {
    double sum = 0;
    for (int i = 0; i < terms->count; i++) {
        double product = terms->term[i].variance;
        for (int a = 0; a < 3; a++) {
            double k = bl_kernel_transform(terms->term[i].kernel[a], f[a]);
            product *= a < axes ? k * k : bl_kernel_correlation(terms->term[i].kernel[a], 0);
        }
        sum += product;
    }
    return sum;
}

static void test_axis_lines_and_slices_are_products(void **state) {
    (void)state;
    for (int which = 0; which < RADIAL; which++) {
        bl_signal *signal = make_signal(which);
        double variance = variance_of(signal);
        for (double f = 0; f <= 64; f = 1.7 * f + 0.1)
            assert_near(bl_theory_line(signal, x_axis, f) / variance,
                        product_form(signal->parameters, 1, (double[]){f, 0, 0}) / variance, 2e-14);
        for (double f = 0; f < 4; f = 2 * f + 0.3)
            assert_near(bl_theory_slice(signal, x_axis, y_axis, f, 0.4) / variance,
                        product_form(signal->parameters, 2, (double[]){f, 0.4, 0}) / variance,
                        1e-10);
        bl_signal_free(signal);
    }
}

// The integral of the density over the plane or line of frequencies left out. P3 is the transform
// of a function that vanishes beyond `far`, so the sum over a grid of spacing below 1/far repeats R
// without overlap and is exact except for the frequencies cut off at `limit`.
static double integral_of_density(const bl_signal *signal, const double base[BL_AXES],
                                  const double *u, const double *v, double limit) {
    double step = 1.0 / 7.5, sum = 0;
    long most = (long)(limit / step);
    for (long i = -most; i <= most; i++)
        for (long j = v ? -most : 0; j <= (v ? most : 0); j++) {
            double f[BL_AXES] = {0};
            for (int a = 0; a < 3; a++)
                f[a] = base[a] + (double)i * step * u[a] + (v ? (double)j * step * v[a] : 0);
            sum += bl_theory_volume(signal, f);
        }
    return sum * step * (v ? step : 1);
}

static void test_oblique_lines_are_integrals_over_planes(void **state) {
    (void)state;
    double d[3][BL_AXES], n[3][BL_AXES];
    const double axes[2][3] = {{1, 1, 1}, {3, -1, 0.5}};
    for (int which = 0; which < SIGNALS; which++) {
        bl_signal *signal = make_signal(which);
        // |k^|^2 falls as f^-4 for LINEAR, f^-6 and faster for the others.
        double tolerance = which == LINEAR ? 2e-4 : 1e-5;
        for (int i = 0; i < 2; i++) {
            bl_directions(1, axes[i], d);
            bl_directions(2, axes[i], n);
            for (double f = 0.15; f < 1.2; f += 0.6) {
                const double base[BL_AXES] = {f * d[0][0], f * d[0][1], f * d[0][2]};
                double expected = integral_of_density(signal, base, n[0], n[1], 8);
                assert_near(bl_theory_line(signal, d[0], f) / variance_of(signal),
                            expected / variance_of(signal), tolerance);
            }
        }
        bl_signal_free(signal);
    }
}

static void test_slices_are_integrals_over_lines(void **state) {
    (void)state;
    double d[3][BL_AXES], n[3][BL_AXES];
    const double axes[2][3] = {{0, 0, 1}, {3, -1, 0.5}};
    for (int which = 0; which < SIGNALS; which++) {
        bl_signal *signal = make_signal(which);
        for (int i = 0; i < 2; i++) {
            bl_directions(1, axes[i], n);
            bl_directions(2, axes[i], d);
            for (double f = 0.2; f < 1.5; f += 0.6) {
                double base[BL_AXES] = {0};
                for (int a = 0; a < 3; a++)
                    base[a] = f * d[0][a] - 0.3 * d[1][a];
                double expected = integral_of_density(signal, base, n[0], NULL, 40);
                assert_near(bl_theory_slice(signal, d[0], d[1], f, -0.3) / variance_of(signal),
                            expected / variance_of(signal), 1e-6);
            }
        }
        bl_signal_free(signal);
    }
}

// For a radial density, P1(f) = 2 pi int_f q P3(q) dq in any direction.
static void test_radial_lines_are_the_same_in_all_directions(void **state) {
    (void)state;
    bl_signal *signal = make_signal(RADIAL);
    double d[3][BL_AXES];
    bl_directions(1, (double[]){1, 2, -0.3}, d);
    for (double f = 0; f < 3; f += 0.37) {
        double sum = 0, half = 1.0 / 16;
        for (double left = f; left < 60; left += 2 * half)
            for (int n = 0; n < BL_QUADRATURE_NODES; n++) {
                double q = left + half * (1 + bl_quadrature_node[n]);
                sum += half * bl_quadrature_weight[n] * 2 * M_PI * q *
                       bl_theory_volume(signal, (double[BL_AXES]){0, 0, q});
            }
        double variance = variance_of(signal);
        assert_near(bl_theory_line(signal, x_axis, f) / variance, sum / variance, 1e-9);
        assert_near(bl_theory_line(signal, d[0], f) / variance, sum / variance, 1e-9);
    }
    bl_signal_free(signal);
}

// --- shares --------------------------------------------------------------------------------------

static void test_line_shares_are_integrals_of_the_line(void **state) {
    (void)state;
    double d[3][BL_AXES];
    bl_directions(1, (double[]){1, 1, 1}, d);
    for (int which = 0; which < SIGNALS; which++) {
        bl_signal *signal = make_signal(which);
        double sum = 0, half = (0.7 - 0.3) / 2;
        for (int n = 0; n < BL_QUADRATURE_NODES; n++)
            sum += 2 * half * bl_quadrature_weight[n] *
                   bl_theory_line(signal, d[0], 0.3 + half * (1 + bl_quadrature_node[n]));
        assert_near(bl_theory_band(signal, 1, d, 0.3, 0.7), sum / variance_of(signal), 1e-13);
        double x[3][BL_AXES] = {{1}};
        assert_near(bl_theory_band(signal, 1, x, 1, INFINITY),
                    bl_terms_share_above(signal->parameters, 1), 1e-14);
        assert_near(bl_theory_band(signal, 1, x, 0, INFINITY), 1, 0);
        bl_signal_free(signal);
    }
}

// int over the disc or ball of radius b by quadrature in polar coordinates over the densities. They
// are band-limited: a lag of 4 sqrt 3 turns 7 b times along a radius and needs a rule of more than
// 2 pi 7 b points around a circle.
enum { PANELS = 3, RADII = PANELS * BL_QUADRATURE_NODES, TURN = 96 };

static double radius_of(int i, double b) {
    return b / PANELS *
           (i / BL_QUADRATURE_NODES + (1 + bl_quadrature_node[i % BL_QUADRATURE_NODES]) / 2);
}

static double radius_weight(int i, double b) {
    return b / PANELS / 2 * bl_quadrature_weight[i % BL_QUADRATURE_NODES];
}

static double disc_by_density(const bl_signal *signal, double b) {
    double sum = 0;
    for (int i = 0; i < RADII; i++)
        for (int j = 0; j < TURN; j++) {
            double r = radius_of(i, b), angle = 2 * M_PI * (j + 0.5) / TURN;
            const double f[3] = {r * cos(angle), r * sin(angle), 0};
            sum += radius_weight(i, b) * r * product_form(signal->parameters, 2, f);
        }
    return sum * 2 * M_PI / TURN;
}

static double ball_by_density(const bl_signal *signal, double b) {
    double sum = 0;
    for (int i = 0; i < RADII; i += 1)
        for (int k = 0; k < RADII; k++)          // the upper half, twice
            for (int j = 0; j < TURN / 4; j++) { // a quarter: all are even in x and y
                double r = radius_of(i, b), h = radius_of(k, 1);
                double angle = 2 * M_PI * (j + 0.5) / TURN, side = r * sqrt(1 - h * h);
                const double f[BL_AXES] = {side * cos(angle), side * sin(angle), r * h};
                sum += 8 * radius_weight(i, b) * radius_weight(k, 1) * r * r *
                       bl_theory_volume(signal, f);
            }
    return sum * 2 * M_PI / TURN;
}

static void test_slice_and_volume_shares_are_integrals_of_the_density(void **state) {
    (void)state;
    double d[3][BL_AXES], normal[3][BL_AXES], oblique[3][BL_AXES];
    bl_directions(3, (double[]){0, 0, 1}, d);
    bl_directions(2, (double[]){1, 2, 3}, oblique); // and its normal: space, turned
    bl_directions(1, (double[]){1, 2, 3}, normal);
    memcpy(oblique[2], normal[0], sizeof normal[0]);
    for (int which = 0; which < SIGNALS; which++) {
        bl_signal *signal = make_signal(which);
        double variance = variance_of(signal);
        for (double b = 0.4; b < 1.1; b += 0.6) {
            if (which != RADIAL)
                assert_near(bl_theory_band(signal, 2, d, 0, b),
                            disc_by_density(signal, b) / variance, 1e-8);
            if (b < 0.9 && which != GRADIENT)
                continue;
            double expected = ball_by_density(signal, b) / variance;
            assert_near(bl_theory_band(signal, 3, d, 0, b), expected, 1e-8);
            if (which == GRADIENT)
                assert_near(bl_theory_band(signal, 3, oblique, 0, b), expected, 1e-6);
        }
        // Bands add up to all.
        double low = bl_theory_band(signal, 2, d, 0, 0.5);
        double high = bl_theory_band(signal, 2, d, 0.5, INFINITY);
        assert_near(low + high, 1, 1e-12);
        bl_signal_free(signal);
    }
}

static void test_a_signal_without_closed_form_says_so(void **state) {
    (void)state;
    bl_signal *signal = make_signal(GRADIENT);
    signal->closed_form = 0;
    double out[64], d[3][BL_AXES] = {{1}};
    bl_message message;
    assert_int_equal(bl_theory_periodogram(signal, 1, d, 16, 64, BL_WINDOW_HANN, out, &message),
                     BL_MISMATCH);
    assert_non_null(strstr(message.text, "terms"));
    assert_true(isnan(bl_theory_line(signal, x_axis, 0.5)));
    assert_true(isnan(bl_theory_slice(signal, x_axis, z_axis, 0.5, 0)));
    assert_true(isnan(bl_theory_volume(signal, x_axis)));
    assert_true(isnan(bl_theory_band(signal, 1, d, 0, 1)));
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quadrature_is_exact_to_degree_31),
        cmocka_unit_test(test_directions_are_orthonormal),
        cmocka_unit_test(test_axis_lines_and_slices_are_products),
        cmocka_unit_test(test_oblique_lines_are_integrals_over_planes),
        cmocka_unit_test(test_slices_are_integrals_over_lines),
        cmocka_unit_test(test_radial_lines_are_the_same_in_all_directions),
        cmocka_unit_test(test_line_shares_are_integrals_of_the_line),
        cmocka_unit_test(test_slice_and_volume_shares_are_integrals_of_the_density),
        cmocka_unit_test(test_a_signal_without_closed_form_says_so),
    };
    return bl_run_tests(tests);
}
