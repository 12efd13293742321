// SPDX-License-Identifier: MIT
//
// Kernels: coefficients against the textbook formulas, transforms and correlations against GSL
// quadrature, continuity against one-sided derivatives, partition of unity, the radial kernel.
#include "tests/test.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "noises/lattice/kernel.h"

// --- the formulas, written a second time ---------------------------------------------------------

static double fade(double t) {
    return t * t * (3 - 2 * t);
}

static double fade5(double t) {
    return t * t * t * (t * (6 * t - 15) + 10);
}

static double power(double x, int n) { // max(x, 0)^n
    return x > 0 ? pow(x, n) : 0;
}

// The cardinal spline in Hermite form: value 1 at 0, 0 at the other knots, tangents half the
// difference of the neighbours: 0 at 0 and -1/2 at 1.
static double catmull_rom(double x) {
    double t = fabs(x), s = t - 1;
    if (t >= 2)
        return 0;
    return t < 1 ? 1 - fade(t) - 0.5 * t * t * (t - 1) : -0.5 * s * (1 - s) * (1 - s);
}

static double formula(bl_kernel kernel, double x) {
    double t = fabs(x);
    int inside = t < 1;
    switch (kernel) {
    case BL_KERNEL_CATMULL_ROM:
        return catmull_rom(x);
    case BL_KERNEL_LINEAR:
        return inside ? 1 - t : 0;
    case BL_KERNEL_SMOOTH:
        return inside ? 1 - fade(t) : 0;
    case BL_KERNEL_QUINTIC:
        return inside ? 1 - fade5(t) : 0;
    case BL_KERNEL_BSPLINE2: // sum (-1)^j binom(3, j) (x + 3/2 - j)_+^2 / 2!
        return (power(x + 1.5, 2) - 3 * power(x + 0.5, 2) + 3 * power(x - 0.5, 2) -
                power(x - 1.5, 2)) /
               2;
    case BL_KERNEL_BSPLINE3:
        return (power(x + 2, 3) - 4 * power(x + 1, 3) + 6 * power(x, 3) - 4 * power(x - 1, 3) +
                power(x - 2, 3)) /
               6;
    case BL_KERNEL_RAMP_LINEAR:
        return x * formula(BL_KERNEL_LINEAR, x);
    case BL_KERNEL_RAMP_SMOOTH:
        return x * formula(BL_KERNEL_SMOOTH, x);
    case BL_KERNEL_RAMP_QUINTIC:
        return x * formula(BL_KERNEL_QUINTIC, x);
    case BL_KERNEL_TANGENT:
        return inside ? x * (1 - t) * (1 - t) : 0;
    case BL_KERNEL_RADIAL:
        return x * catmull_rom(x);
    default:
        return NAN;
    }
}

static void test_kernels_are_the_formulas(void **state) {
    (void)state;
    for (int k = 0; k < BL_KERNEL_COUNT; k++)
        for (double x = -2.5; x <= 2.5; x += 1.0 / 64)
            assert_near(bl_kernel_value((bl_kernel)k, x), formula((bl_kernel)k, x), 1e-14);
    assert_true(isnan(bl_kernel_value(BL_KERNEL_LINEAR, NAN)));
}

// --- quadrature ----------------------------------------------------------------------------------

enum { WORKSPACE = 200 };

typedef struct integral {
    bl_kernel kernel;
    double f, lag;
} integral;

static double transform_integrand(double x, void *context) {
    const integral *in = context;
    double angle = 2 * M_PI * in->f * x;
    return formula(in->kernel, x) * (bl_kernel_is_odd(in->kernel) ? sin(angle) : cos(angle));
}

static double correlation_integrand(double x, void *context) {
    const integral *in = context;
    return formula(in->kernel, x) * formula(in->kernel, x + in->lag);
}

// Between all half integers shifted by 0 and by -lag.
static double quadrature(double (*f)(double, void *), integral *in, double support) {
    gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(WORKSPACE);
    gsl_function function = {f, in};
    double sum = 0, left = -support;
    while (left < support) {
        double next = (floor(2 * left + 1e-9) + 1) / 2;
        double shifted = (floor(2 * (left + in->lag) + 1e-9) + 1) / 2 - in->lag;
        double right = fmin(fmin(next, shifted), support), part, error;
        gsl_integration_qag(&function, left, right, 1e-15, 1e-13, WORKSPACE, GSL_INTEG_GAUSS61,
                            workspace, &part, &error);
        sum += part;
        left = right;
    }
    gsl_integration_workspace_free(workspace);
    return sum;
}

static void test_transforms_agree_with_quadrature(void **state) {
    (void)state;
    gsl_set_error_handler_off();
    const double frequencies[] = {0,    1e-9, 0.01, 0.3,  0.5,   1,    1.37, 1.999,
                                  2.01, 2.5,  3,    7.77, 15.02, 31.5, 64};
    for (int k = 0; k < BL_KERNEL_COUNT; k++)
        for (size_t i = 0; i < sizeof frequencies / sizeof *frequencies; i++) {
            integral in = {.kernel = (bl_kernel)k, .f = frequencies[i]};
            double expected = quadrature(transform_integrand, &in, 2);
            assert_near(bl_kernel_transform(in.kernel, in.f), expected, 2e-15);
            double mirrored = bl_kernel_is_odd(in.kernel) ? -expected : expected;
            assert_near(bl_kernel_transform(in.kernel, -in.f), mirrored, 2e-15);
        }
}

// Sum over jumps above 2, quadrature below: the two meet.
static void test_the_two_routes_of_the_transform_meet(void **state) {
    (void)state;
    for (int k = 0; k < BL_KERNEL_COUNT; k++) {
        double below = bl_kernel_transform((bl_kernel)k, nextafter(2, 0));
        assert_near(bl_kernel_transform((bl_kernel)k, 2), below, 1e-15);
    }
}

static void test_b_splines_transform_to_powers_of_sinc(void **state) {
    (void)state;
    for (double f = 0.1; f < 40; f *= 1.31) {
        double sinc = sin(M_PI * f) / (M_PI * f);
        assert_near(bl_kernel_transform(BL_KERNEL_LINEAR, f), pow(sinc, 2), 1e-15);
        assert_near(bl_kernel_transform(BL_KERNEL_BSPLINE2, f), pow(sinc, 3), 1e-15);
        assert_near(bl_kernel_transform(BL_KERNEL_BSPLINE3, f), pow(sinc, 4), 1e-15);
    }
}

static void test_correlations_agree_with_quadrature(void **state) {
    (void)state;
    for (int k = 0; k < BL_KERNEL_COUNT; k++)
        for (double lag = 0; lag < 4.2; lag += 0.0937) {
            integral in = {.kernel = (bl_kernel)k, .lag = lag};
            double expected = quadrature(correlation_integrand, &in, 2);
            assert_near(bl_kernel_correlation(in.kernel, lag), expected, 2e-15);
            assert_near(bl_kernel_correlation(in.kernel, -lag), expected, 2e-15);
        }
}

// --- continuity, partition of unity --------------------------------------------------------------

// The m-th derivative from one side: the m-th divided difference of m+1+extra points fits a
// polynomial piece exactly, so Newton's form through 7 points 1/64 apart gives all derivatives.
static double one_sided(bl_kernel kernel, double knot, int side, int m) {
    enum { POINTS = 7 };
    long double table[POINTS], x[POINTS], coefficient[POINTS];
    for (int i = 0; i < POINTS; i++) {
        x[i] = side * (i + 1) / 16.0L;
        table[i] = bl_kernel_value(kernel, knot + (double)x[i]);
    }
    for (int i = 0; i < POINTS; i++) { // divided differences
        coefficient[i] = table[0];
        for (int j = 0; j + i + 1 < POINTS; j++)
            table[j] = (table[j + 1] - table[j]) / (x[j + i + 1] - x[j]);
    }
    long double polynomial[POINTS] = {0}; // Horner on Newton's form, in powers of x
    for (int i = POINTS - 1; i >= 0; i--) {
        for (int j = POINTS - 1; j > 0; j--)
            polynomial[j] = polynomial[j - 1] - x[i] * polynomial[j];
        polynomial[0] = coefficient[i] - x[i] * polynomial[0];
    }
    long double factorial = 1;
    for (int j = 2; j <= m; j++)
        factorial *= j;
    return (double)(polynomial[m] * factorial);
}

static int measured_continuity(bl_kernel kernel) {
    for (int m = 0; m < 7; m++)
        for (double knot = -2; knot <= 2; knot += 0.5) {
            double jump = one_sided(kernel, knot, 1, m) - one_sided(kernel, knot, -1, m);
            if (fabs(jump) > 1e-4 * pow(16, m))
                return m - 1;
        }
    return 7;
}

static void test_continuity_by_one_sided_derivatives(void **state) {
    (void)state;
    const int expected[BL_KERNEL_COUNT] = {1, 0, 1, 2, 1, 2, 0, 1, 2, 1, 1};
    for (int k = 0; k < BL_KERNEL_COUNT; k++) {
        assert_int_equal(bl_kernel_continuity((bl_kernel)k), expected[k]);
        assert_int_equal(measured_continuity((bl_kernel)k), expected[k]);
    }
}

// The tail of |k^| falls as f^-(continuity + 2): the largest of f^(c+2) |k^| stays within bounds.
static void test_the_transform_falls_as_the_continuity_says(void **state) {
    (void)state;
    for (int k = 0; k < BL_KERNEL_COUNT; k++) {
        int c = bl_kernel_continuity((bl_kernel)k);
        double near_peak = 0, far_peak = 0;
        for (double f = 20; f < 22; f += 0.01)
            near_peak = fmax(near_peak, pow(f, c + 2) * fabs(bl_kernel_transform((bl_kernel)k, f)));
        for (double f = 2000; f < 2002; f += 0.01)
            far_peak = fmax(far_peak, pow(f, c + 2) * fabs(bl_kernel_transform((bl_kernel)k, f)));
        assert_near(far_peak / near_peak, 1, 0.1);
    }
}

static void test_value_kernels_sum_to_one(void **state) {
    (void)state;
    const bl_kernel kernels[] = {BL_KERNEL_CATMULL_ROM, BL_KERNEL_LINEAR,   BL_KERNEL_SMOOTH,
                                 BL_KERNEL_QUINTIC,     BL_KERNEL_BSPLINE2, BL_KERNEL_BSPLINE3};
    for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++) {
        for (double x = 0; x < 1; x += 1.0 / 32) {
            double sum = 0;
            for (int n = -2; n <= 2; n++)
                sum += bl_kernel_value(kernels[k], x - n);
            assert_near(sum, 1, 4e-16);
        }
        // The same in frequency: 1 at 0, 0 at all other whole numbers.
        assert_near(bl_kernel_transform(kernels[k], 0), 1, 1e-15);
        for (int f = 1; f < 9; f++)
            assert_near(bl_kernel_transform(kernels[k], f), 0, 1e-15);
    }
}

// --- the radial kernel ---------------------------------------------------------------------------

static double radial_transform_integrand(double r, void *context) {
    double f = *(const double *)context, q = 2 * M_PI * f * r;
    return 4 * M_PI * r * r * catmull_rom(r) * (q == 0 ? 1 : sin(q) / q);
}

static void test_radial_transform_agrees_with_quadrature(void **state) {
    (void)state;
    for (double f = 0; f < 20; f = 1.3 * f + 0.01) {
        double inner, outer;
        gsl_function function = {radial_transform_integrand, &f};
        gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(WORKSPACE);
        double error;
        gsl_integration_qag(&function, 0, 1, 1e-14, 1e-13, WORKSPACE, GSL_INTEG_GAUSS61, workspace,
                            &inner, &error);
        gsl_integration_qag(&function, 1, 2, 1e-14, 1e-13, WORKSPACE, GSL_INTEG_GAUSS61, workspace,
                            &outer, &error);
        gsl_integration_workspace_free(workspace);
        assert_near(bl_radial_transform(f), inner + outer, 1e-13);
    }
}

// R(d) as the transform of |K^|^2 back: int |K^(f)|^2 sin(2 pi f d)/(2 pi f d) 4 pi f^2 df. |K^|
// falls as f^-4, so what is left beyond f = 200 is below 1e-12.
static void test_radial_correlation_is_the_transform_of_its_density(void **state) {
    (void)state;
    for (double d = 0; d < 5; d += 0.31) {
        double sum = 0, step = 1.0 / 64; // Nyquist far above twice the reach: trapezoid is exact
        for (double f = step; f < 200; f += step) {
            double k = bl_radial_transform(f), q = 2 * M_PI * f * d;
            sum += 4 * M_PI * f * f * k * k * (q == 0 ? 1 : sin(q) / q) * step;
        }
        assert_near(bl_radial_correlation(d), sum, 1e-10);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kernels_are_the_formulas),
        cmocka_unit_test(test_transforms_agree_with_quadrature),
        cmocka_unit_test(test_the_two_routes_of_the_transform_meet),
        cmocka_unit_test(test_b_splines_transform_to_powers_of_sinc),
        cmocka_unit_test(test_correlations_agree_with_quadrature),
        cmocka_unit_test(test_continuity_by_one_sided_derivatives),
        cmocka_unit_test(test_the_transform_falls_as_the_continuity_says),
        cmocka_unit_test(test_value_kernels_sum_to_one),
        cmocka_unit_test(test_radial_transform_agrees_with_quadrature),
        cmocka_unit_test(test_radial_correlation_is_the_transform_of_its_density),
    };
    return bl_run_tests(tests);
}
