// SPDX-License-Identifier: MIT
//
// What the walkers do not hold of Wiener interpolation: that the products of the weights on a line
// are the estimate of least error in space (the 64 by 64 system, solved by GSL), that the noise
// interpolates, the polynomials' error, the bound, the known special cases, and the closed forms
// against each other.
#include "tests/test.h"

#include <gsl/gsl_linalg.h>

#include "core/random.h"
#include "noises/lattice/lattice.h"
#include "noises/lattice/wiener_weights.h"
#include "tests/texts.h"

static const double widths[] = {0.5, 0.7, 1, 1.4, 2};
enum { WIDTHS = sizeof widths / sizeof *widths, COVARIANCES = 3 };

// The covariance on a line, once more and straight.
static double rho(int covariance, double width, double d) {
    double x = d / width;
    switch (covariance) {
    case BL_WIENER_EXPONENTIAL:
        return exp(-fabs(x));
    case BL_WIENER_SINC:
        return x == 0 ? 1 : sin(M_PI * x) / (M_PI * x);
    default:
        return exp(-x * x / 2);
    }
}

static double rho3(int covariance, double width, const double a[3], const double b[3]) {
    return rho(covariance, width, a[0] - b[0]) * rho(covariance, width, a[1] - b[1]) *
           rho(covariance, width, a[2] - b[2]);
}

static void lattice_point(int n, double at[3]) {
    at[0] = n % 4 - 1;
    at[1] = n / 4 % 4 - 1;
    at[2] = n / 16 - 1;
}

static void test_products_of_weights_solve_the_system_in_space(void **state) {
    (void)state;
    bl_random random = bl_random_seed(1, 0);
    gsl_matrix *matrix = gsl_matrix_alloc(64, 64);
    gsl_vector *right = gsl_vector_alloc(64), *solution = gsl_vector_alloc(64);
    for (int covariance = 0; covariance < COVARIANCES; covariance++) {
        const double width = 1.2;
        bl_wiener_kernel kernel = bl_wiener_kernel_of((bl_wiener_covariance)covariance, width);
        double p[3], w[3][4], slope[4], a[3], b[3];
        for (int axis = 0; axis < 3; axis++) {
            p[axis] = bl_random_unit(&random);
            bl_wiener_weights(&kernel, p[axis], w[axis], slope);
        }
        for (int i = 0; i < 64; i++) {
            lattice_point(i, a);
            gsl_vector_set(right, (size_t)i, rho3(covariance, width, a, p));
            for (int j = 0; j < 64; j++) {
                lattice_point(j, b);
                gsl_matrix_set(matrix, (size_t)i, (size_t)j, rho3(covariance, width, a, b));
            }
        }
        assert_int_equal(gsl_linalg_cholesky_decomp1(matrix), 0);
        assert_int_equal(gsl_linalg_cholesky_solve(matrix, right, solution), 0);
        for (int i = 0; i < 64; i++) // conditioned to 1e9 at worst
            assert_near(w[0][i % 4] * w[1][i / 4 % 4] * w[2][i / 16],
                        gsl_vector_get(solution, (size_t)i), 1e-8);
    }
    gsl_matrix_free(matrix);
    gsl_vector_free(right);
    gsl_vector_free(solution);
}

static void test_the_noise_is_the_value_at_a_lattice_point(void **state) {
    (void)state;
    static const char *const texts[] = {"wiener:seed=4", "wiener:seed=4,covariance=exponential",
                                        "wiener:seed=4,covariance=sinc,width=2"};
    bl_lattice lattice = bl_lattice_of(4, BL_LATTICE_HASH);
    for (int t = 0; t < 3; t++) {
        bl_signal *signal = bl_test_open(texts[t], BL_ISA_BEST);
        for (int n = 0; n < 60; n++) {
            const double at[BL_AXES] = {n % 5 - 2, n / 5 % 4 - 7, n / 20};
            const uint64_t cell[3] = {(uint64_t)(int64_t)at[0], (uint64_t)(int64_t)at[1],
                                      (uint64_t)(int64_t)at[2]};
            double v = bl_lattice_value(bl_lattice_word(&lattice, cell, 0)) * BL_LATTICE_UNIT;
            assert_near(bl_signal_value(signal, at), v, 1e-9);
        }
        bl_signal_free(signal);
    }
}

static void test_special_cases(void **state) {
    (void)state;
    for (int i = 0; i <= 64; i++) {
        double t = i / 64.0, w[4], slope[4];
        // A Markov process knows its nearest neighbours.
        bl_wiener_kernel kernel = bl_wiener_kernel_of(BL_WIENER_EXPONENTIAL, 0.8);
        bl_wiener_weights(&kernel, t, w, slope);
        const double markov[4] = {0, sinh((1 - t) / 0.8) / sinh(1 / 0.8),
                                  sinh(t / 0.8) / sinh(1 / 0.8), 0};
        // Values at the zeros of the sinc are uncorrelated.
        double cut[4];
        for (int k = 0; k < 4; k++)
            cut[k] = rho(BL_WIENER_SINC, 1, t - (k - 1));
        for (int k = 0; k < 4; k++)
            assert_near(w[k], markov[k], 1e-14);
        kernel = bl_wiener_kernel_of(BL_WIENER_SINC, 1);
        bl_wiener_weights(&kernel, t, w, slope);
        for (int k = 0; k < 4; k++)
            assert_near(w[k], cut[k], 1e-14);
        // Driscoll and Fornberg (2002): flat gaussians interpolate as the cubic through the points.
        const double cubic[4] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                                 -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
        double nearer = 1;
        for (double width = 2; width <= 8; width *= 2) {
            double far = 0;
            kernel = bl_wiener_kernel_of(BL_WIENER_GAUSSIAN, width);
            bl_wiener_weights(&kernel, t, w, slope);
            for (int k = 0; k < 4; k++)
                far = fmax(far, fabs(w[k] - cubic[k]));
            assert_true(far <= nearer / 3 + 1e-9); // an error of the order width^-2
            nearer = far;
        }
    }
}

// The pieces against the exact weights, and the bound against the largest sum of these: it is kept,
// and is less than half a percent too large.
static void test_pieces_and_bound(void **state) {
    (void)state;
    enum { PLACES = 5000 };
    double worst = 0;
    for (int covariance = 0; covariance < COVARIANCES; covariance++)
        for (int n = 0; n < WIDTHS; n++) {
            bl_wiener_kernel kernel =
                bl_wiener_kernel_of((bl_wiener_covariance)covariance, widths[n]);
            double most = 0;
            for (int i = 0; i <= PLACES; i++) {
                double t = (double)i / PLACES, w[4], slope[4], sum = 0;
                bl_wiener_weights(&kernel, t, w, slope);
                for (int k = 0; k < 4; k++) {
                    double x = t - (k - 1);
                    sum += fabs(w[k]);
                    if (fabs(x) < 2)
                        worst = fmax(worst, fabs(bl_wiener_value(&kernel, x) - w[k]));
                }
                most = fmax(most, sum);
            }
            double bound = bl_wiener_largest_sum(&kernel);
            assert_true(most <= bound);
            assert_near(bound, most, 0.005 * most);
        }
    printf("# largest error of the pieces %.3g\n", worst);
    assert_less(worst, 3e-9);
}

static void test_the_closed_forms_agree(void **state) {
    (void)state;
    for (int covariance = 0; covariance < COVARIANCES; covariance++)
        for (int n = 0; n < WIDTHS; n++) {
            bl_wiener_kernel kernel =
                bl_wiener_kernel_of((bl_wiener_covariance)covariance, widths[n]);
            // Poisson's sum: correlations at the multiples of 8 are 0, except for that at 0.
            for (double shift = 0; shift < 0.125; shift += 0.04) {
                double sum = 0, expected = bl_wiener_correlation(&kernel, 0);
                for (int k = -160; k < 160; k++)
                    sum += pow(bl_wiener_transform(&kernel, shift + k / 8.0), 2) / 8;
                // The square of the transform of a kernel with kinks of J falls as (J/4 pi^2)^2
                // f^-4 in the mean; J^2 adds up to 18 at most (the exponential of width 1/2), which
                // leaves 2 * 18/39.5^2 / (3 * 20^3) beyond 20.
                assert_near(sum, expected, 1.1e-6);
            }
            // The correlation is even and its integral the square of the kernel's.
            double sum = 0, whole = bl_wiener_transform(&kernel, 0);
            for (int k = -512; k < 512; k++)
                sum += bl_wiener_correlation(&kernel, k / 128.0) / 128;
            assert_near(sum, whole * whole, 1e-5);
            assert_near(bl_wiener_correlation(&kernel, 0.3), bl_wiener_correlation(&kernel, -0.3),
                        1e-15);
            assert_near(bl_wiener_correlation(&kernel, 4), 0, 0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_products_of_weights_solve_the_system_in_space),
        cmocka_unit_test(test_the_noise_is_the_value_at_a_lattice_point),
        cmocka_unit_test(test_special_cases),
        cmocka_unit_test(test_pieces_and_bound),
        cmocka_unit_test(test_the_closed_forms_agree),
    };
    return bl_run_tests(tests);
}
