// SPDX-License-Identifier: MIT
//
// Sparse impulses: the closed forms of their kernels against quadratures of another kind, the
// counts of a cell against the Poisson distribution, the fourth cumulant that tells a Poisson
// process from a fixed count, and the bounds.
//
// Error rates: each statistic passes for a right program with probability above 1 - 1e-6 for all
// its comparisons together; seeds are fixed.
#include "tests/test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_bessel.h>

#include "core/random.h"
#include "core/statistics.h"
#include "noises/impulses/gabor_forms.h"
#include "noises/impulses/impulse_profiles.h"
#include "noises/impulses/impulses.h"
#include "noises/noise.h"
#include "noises/impulses/profile_float.h"
#include "tests/texts.h"

#define ERROR_RATE 1e-6

static const bl_profile profiles[] = {BL_PROFILE_COSINE, BL_PROFILE_GAUSSIAN, BL_PROFILE_RING,
                                      BL_PROFILE_DISC};
enum { PROFILES = sizeof profiles / sizeof *profiles };

// --- quadrature ---------------------------------------------------------------------------------

typedef double integrand(double x, const void *context);

typedef struct integral {
    integrand *f;
    const void *context;
} integral;

static double call(double x, void *context) {
    const integral *in = context;
    return in->f(x, in->context);
}

// Adaptive Gauss-Kronrod of GSL, another rule than the code's own; to 1e-11.
static double integrate(integrand *f, const void *context, double from, double to) {
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    integral in = {f, context};
    gsl_function function = {call, &in};
    double result, error;
    gsl_integration_qag(&function, from, to, 1e-11, 1e-11, 1000, GSL_INTEG_GAUSS31, space, &result,
                        &error);
    gsl_integration_workspace_free(space);
    return result;
}

// --- the kernels --------------------------------------------------------------------------------

static void test_profiles_end_as_they_state(void **state) {
    (void)state;
    for (int i = 0; i < PROFILES; i++) {
        bl_profile profile = profiles[i];
        double most = 0, h = 1e-6;
        assert_near(bl_profile_value(profile, 1), 0, 0);
        for (double q = 0; q < 1; q += 1e-4)
            most = fmax(most, fabs(bl_profile_value(profile, q)));
        assert_true(most <= bl_profile_most(profile) && most > 0.98 * bl_profile_most(profile));
        if (profile == BL_PROFILE_DISC)
            continue;
        // No step and no bend at the rim; the slope is that of the value.
        assert_true(fabs(bl_profile_value(profile, 1 - h)) < 200 * h * h);
        assert_true(fabs(bl_profile_slope(profile, 1 - h)) < 200 * h);
        for (double q = 0.003; q < 1; q += 0.0137)
            assert_near(bl_profile_slope(profile, q),
                        (bl_profile_value(profile, q + h) - bl_profile_value(profile, q - h)) /
                            (2 * h),
                        1e-7);
    }
    // Catmull-Rom is the kernel of scnoise; the Gaussian is a Gaussian to what its head says.
    double worst = 0;
    for (double q = 0; q < 1; q += 1e-4) {
        assert_near(bl_profile_value(BL_PROFILE_CATMULL_ROM, q), radial_kernel(2 * sqrt(q)), 1e-14);
        assert_near(bl_profile_slope(BL_PROFILE_CATMULL_ROM, q),
                    2 * radial_kernel_slope(2 * sqrt(q)), 1e-12);
        worst = fmax(worst,
                     fabs(bl_profile_value(BL_PROFILE_GAUSSIAN, q) - exp(-BL_GAUSSIAN_RATE * q)));
    }
    assert_true(worst < 0.0177 && worst > 0.001);
    assert_near(BL_GAUSSIAN_EDGE, exp(-BL_GAUSSIAN_RATE), 1e-18);
    assert_near(BL_GAUSSIAN_EDGE_4, exp(-4 * BL_GAUSSIAN_RATE), 1e-26);
}

static void test_float_functions_are_the_functions(void **state) {
    (void)state;
    for (double x = -130; x <= 0; x += 0.00137) {
        double expected = exp2(fmax((double)(float)x, -126));
        assert_near((double)bl_float_exp2((float)x), expected, 2e-7 * expected);
    }
    for (double x = -9; x <= 9; x += 0.000137) {
        assert_near((double)bl_float_cosine((float)x), cos(2 * M_PI * (double)(float)x), 3e-7);
        // The quarter taken from x rounds it by 2^-22 at 9.
        assert_near((double)bl_float_sine((float)x), sin(2 * M_PI * (double)(float)x), 4e-6);
    }
    for (int i = 0; i < PROFILES; i++)
        for (double q = 0; q < 1.2; q += 1e-4) {
            double expected = bl_profile_value(profiles[i], (double)(float)q);
            assert_near((double)profile_float(profiles[i], (float)q), expected, 5e-7);
        }
}

// --- transforms and correlations ----------------------------------------------------------------

typedef struct radial {
    bl_profile profile;
    unsigned dimensions;
    double f, d, r;
} radial;

static double transform_integrand(double r, const void *context) {
    const radial *in = context;
    double k = bl_profile_value(in->profile, r * r), u = 2 * M_PI * in->f * r;
    return in->dimensions == 2 ? 2 * M_PI * r * k * gsl_sf_bessel_J0(u)
                               : 4 * M_PI * r * r * k * gsl_sf_bessel_j0(u);
}

static void test_transforms_are_the_integrals(void **state) {
    (void)state;
    static const double frequencies[] = {0, 1e-9, 1e-3, 0.3, 0.77, 1, 2.5, 7.1, 30.3};
    for (int i = 0; i < PROFILES; i++)
        for (unsigned dimensions = 2; dimensions <= 3; dimensions++)
            for (size_t n = 0; n < sizeof frequencies / sizeof *frequencies; n++) {
                radial in = {.profile = profiles[i], dimensions, .f = frequencies[n]};
                assert_near(bl_profile_transform(profiles[i], dimensions, in.f),
                            integrate(transform_integrand, &in, 0, 1), 2e-10);
            }
}

// In space the raised cosine has an elementary transform: with w = 2 pi f and S(w) = int_0^1
// r sin(w r) dr = (sin w - w cos w)/w^2, it is (S(w) + (S(w+pi) + S(w-pi))/2)/f.
static double moment(double w) {
    return fabs(w) < 1e-4 ? w / 3 : (sin(w) - w * cos(w)) / (w * w);
}

static void test_the_cosine_has_its_elementary_transform(void **state) {
    (void)state;
    for (double f = 0.01; f < 20; f *= 1.13) {
        double w = 2 * M_PI * f;
        double expected = (moment(w) + (moment(w + M_PI) + moment(w - M_PI)) / 2) / f;
        assert_near(bl_profile_transform(BL_PROFILE_COSINE, 3, f), expected, 1e-11);
    }
}

// About one centre: the other factor averaged over the circle or the sphere of radius r.
static double angle_integrand(double angle, const void *context) {
    const radial *in = context;
    double square = in->r * in->r + in->d * in->d - 2 * in->r * in->d * cos(angle);
    double k = bl_profile_value(in->profile, square);
    return in->dimensions == 2 ? 2 * k : 2 * M_PI * sin(angle) * in->r * k;
}

static double shell_integrand(double r, const void *context) {
    radial in = *(const radial *)context;
    in.r = r;
    // Nothing beyond the angle where the circle leaves the other disc.
    double cosine = (r * r + in.d * in.d - 1) / (2 * r * in.d);
    if (cosine >= 1)
        return 0;
    double to = cosine <= -1 ? M_PI : acos(cosine);
    return r * bl_profile_value(in.profile, r * r) * integrate(angle_integrand, &in, 0, to);
}

static void test_correlations_are_the_integrals(void **state) {
    (void)state;
    static const double distances[] = {1e-3, 0.1, 0.4, 0.95, 1.2, 1.7, 1.96};
    for (int i = 0; i < PROFILES; i++)
        for (unsigned dimensions = 2; dimensions <= 3; dimensions++) {
            for (size_t n = 0; n < sizeof distances / sizeof *distances; n++) {
                radial in = {.profile = profiles[i], dimensions, .d = distances[n]};
                double middle = fabs(1 - in.d), expected = 0;
                expected += integrate(shell_integrand, &in, 0, fmin(middle, 1));
                expected += integrate(shell_integrand, &in, fmin(middle, 1), 1);
                assert_near(bl_profile_correlation(profiles[i], dimensions, in.d), expected, 1e-9);
            }
            assert_near(bl_profile_correlation(profiles[i], dimensions, 2), 0, 0);
        }
}

// --- Gabor kernels ------------------------------------------------------------------------------

static double envelope_integrand(double r, const void *context) {
    const double *in = context; // a, f
    return 2 * M_PI * r * exp(-M_PI * in[0] * in[0] * r * r) *
           gsl_sf_bessel_J0(2 * M_PI * in[1] * r);
}

static void test_the_truncated_gaussian_has_its_transform(void **state) {
    (void)state;
    for (double a = 1; a <= 4; a += 0.5)
        for (double f = 0; f < 12; f += 0.37) {
            const double in[] = {a, f};
            double whole = exp(-M_PI * f * f / (a * a)) / (a * a);
            double g = bl_gabor_envelope(a, f);
            assert_near(g, integrate(envelope_integrand, in, 0, 1), 1e-11);
            // What is cut off has the integral e^(-pi a^2)/a^2, and no frequency more than it.
            assert_near(g, whole, exp(-M_PI * a * a) / (a * a) + 1e-13);
        }
}

// Random phase: two Gaussians, or the ring with the Bessel function, when nothing is cut off.
static void test_the_ring_is_that_of_the_bessel_function(void **state) {
    (void)state;
    double a = 2.5;
    for (double wave = 0; wave <= 4; wave += 1)
        for (double f = 0; f < 8; f += 0.61) {
            bl_gabor ring = {wave, a, {1, 0}, 1, 0}, pair = {wave, a, {0.6, 0.8}, 0, 0};
            double x = 4 * M_PI * f * wave / (a * a), s = f - wave;
            double expected =
                exp(-2 * M_PI * s * s / (a * a)) * gsl_sf_bessel_I0_scaled(x) / (2 * pow(a, 4));
            assert_near(bl_gabor_density(&ring, 0.6 * f, -0.8 * f), expected, 1e-9);
            double far = hypot(f - 0.6 * wave, 0.8 * wave),
                   near = hypot(f + 0.6 * wave, 0.8 * wave);
            expected =
                (exp(-2 * M_PI * far * far / (a * a)) + exp(-2 * M_PI * near * near / (a * a))) /
                (4 * pow(a, 4));
            assert_near(bl_gabor_density(&pair, f, 0), expected, 1e-9);
        }
}

// K*K by a plain sum over a grid of places and a mean over phases and directions: the grid is as
// good as the circumference of the discs allows, 4 % of a cell wide.
static double gabor_kernel(const bl_gabor *kernel, double x, double y, double turn, double phase) {
    double ux = kernel->isotropic ? cos(turn) : kernel->direction[0];
    double uy = kernel->isotropic ? sin(turn) : kernel->direction[1];
    double square = x * x + y * y, a = kernel->bandwidth;
    return square < 1 ? exp(-M_PI * a * a * square) *
                            cos(2 * M_PI * kernel->frequency * (ux * x + uy * y) + phase)
                      : 0;
}

static double brute_covariance(const bl_gabor *kernel, double lag_x, double lag_y) {
    enum { GRID = 400, TURNS = 16, PHASES = 3 };
    int turns = kernel->isotropic ? TURNS : 1, phases = kernel->zero_phase ? 1 : PHASES;
    double sum = 0, h = 2.0 / GRID;
    for (int t = 0; t < turns; t++)
        for (int p = 0; p < phases; p++)
            for (int i = 0; i < GRID; i++)
                for (int j = 0; j < GRID; j++) {
                    double x = (i + 0.5) * h - 1, y = (j + 0.5) * h - 1;
                    double turn = M_PI * (t + 0.5) / turns, phase = 2 * M_PI * p / phases;
                    sum += gabor_kernel(kernel, x, y, turn, phase) *
                           gabor_kernel(kernel, x + lag_x, y + lag_y, turn, phase);
                }
    return sum * h * h / (turns * phases);
}

static void test_the_covariance_of_gabor_kernels_is_their_autocorrelation(void **state) {
    (void)state;
    static const double lags[][2] = {{0, 0}, {0.3, -0.2}, {0.1, 0.9}, {-1.2, 0.7}, {1.9, 0.1}};
    for (int form = 0; form < 4; form++)
        for (size_t n = 0; n < 5; n++) {
            bl_gabor kernel = {0.8, 1, {cos(0.7), sin(0.7)}, form & 1, form >> 1};
            assert_near(bl_gabor_covariance(&kernel, lags[n][0], lags[n][1]),
                        brute_covariance(&kernel, lags[n][0], lags[n][1]), 3e-5);
        }
}

// The covariance at 0 is the integral of the density: by rings, up to where the tail of the rim,
// whose power beyond f falls as 1/f, is below 1e-4.
static void test_the_variance_of_gabor_noise_is_the_integral_of_its_density(void **state) {
    (void)state;
    for (int zero = 0; zero <= 1; zero++) {
        bl_gabor kernel = {0.6, 1, {1, 0}, 1, zero};
        double sum = 0, h = 0.02;
        for (double f = h / 2; f < 8; f += h)
            sum += 2 * M_PI * f * h * bl_gabor_density(&kernel, f, 0);
        double variance = bl_gabor_covariance(&kernel, 0, 0);
        assert_true(sum < variance * (1 + 1e-4) && sum > 0.998 * variance);
        if (!zero)
            assert_near(variance, (1 - exp(-2 * M_PI)) / 4, 1e-12);
    }
}

// --- the counts ---------------------------------------------------------------------------------

// Chi-square of the counts of many cells against the Poisson distribution, classes of 20 or more.
static double count_p(uint32_t mean, uint64_t seed) {
    enum { SIDE = 40, CELLS = SIDE * SIDE * SIDE };
    impulse_source source;
    const bl_lattice_settings settings = {.seed = seed};
    impulse_source_open(&source, &settings, mean, 1);
    double seen[IMPULSE_MOST + 1] = {0};
    for (uint64_t i = 0; i < CELLS; i++) {
        bl_lattice_key x = impulse_key(&source, 0, i % SIDE - 20);
        bl_lattice_key y = impulse_key(&source, 1, i / SIDE % SIDE);
        bl_lattice_key z = impulse_key(&source, 2, i / SIDE / SIDE);
        seen[impulse_count(&source, impulse_words_of(&source, &x, &y, &z).third)]++;
    }
    double statistic = 0, expected = 0, found = 0, left = 1;
    int classes = 0;
    for (unsigned n = 0; n <= IMPULSE_MOST; n++) {
        double p = gsl_ran_poisson_pdf(n, mean);
        expected += p * CELLS;
        found += seen[n];
        left -= p;
        if (expected < 20 || left * CELLS < 20)
            continue;
        statistic += (found - expected) * (found - expected) / expected;
        expected = found = 0;
        classes++;
    }
    statistic += (found - expected) * (found - expected) / expected;
    return gsl_cdf_chisq_Q(statistic, classes);
}

static void test_counts_are_poisson(void **state) {
    (void)state;
    static const uint32_t means[] = {1, 2, 3, 8, 30, 64};
    for (size_t n = 0; n < 6; n++)
        for (uint64_t seed = 0; seed < 3; seed++)
            assert_true(count_p(means[n], seed) > ERROR_RATE / 18);
}

// The limits are the distribution function to a unit of 2^-32, and end where 2^-33 is left.
static void test_limits_are_the_distribution_function(void **state) {
    (void)state;
    for (uint32_t mean = 1; mean <= IMPULSE_MOST_MEAN; mean++) {
        uint32_t limits[IMPULSE_MOST];
        int most = impulse_limits(mean, limits);
        assert_true(most < IMPULSE_MOST);
        for (int n = 0; n < most; n++)
            assert_near(limits[n] / 0x1p32, gsl_cdf_poisson_P((unsigned)n, mean), 0x1p-32);
        assert_true(gsl_cdf_poisson_Q((unsigned)most, mean) < 0x1p-32);
        assert_true(gsl_cdf_poisson_Q((unsigned)most - 1, mean) > 0x1p-34);
    }
}

// The count is the number of limits up to the word: at a limit it is one more than before it.
static void test_a_count_steps_at_its_limits(void **state) {
    (void)state;
    static const uint32_t means[] = {1, 4, 12}; // whose first limit is above 0
    for (size_t m = 0; m < 3; m++) {
        impulse_source source;
        const bl_lattice_settings settings = {.seed = 1};
        impulse_source_open(&source, &settings, means[m], 1);
        for (int n = 0; n < source.most; n++) {
            int least = 0; // limits may be the same far out
            for (int k = 0; k < source.most; k++)
                least += source.limit[k] < source.limit[n];
            assert_true(impulse_count(&source, source.limit[n]) > n);
            assert_int_equal(impulse_count(&source, source.limit[n] - 1), least);
        }
        assert_int_equal(impulse_count(&source, UINT32_MAX), source.most);
        assert_int_equal(impulse_count(&source, 0), 0);
    }
}

// --- float against double -----------------------------------------------------------------------
//
// The walkers allow an error in proportion to the stated range, which of impulse noises is a
// hundred times what they ever have. Here it is what the noises state: 1e-6 for each impulse in
// reach, over the root of their mean number.

static void count_in_reach(void *context, const double d[IMPULSE_AXES], uint32_t third,
                           uint32_t fourth) {
    (void)third, (void)fourth;
    *(double *)context += d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 1;
}

static void test_floats_are_as_near_as_is_stated(void **state) {
    (void)state;
    static const struct {
        const char *settings;
        unsigned dims, impulses;
    } cases[] = {{"gabor:seed=5,impulses=1", 2, 1},
                 {"gabor:seed=5,impulses=1,phase=zero,frequency=4", 2, 1},
                 {"gabor:seed=5,impulses=8,kind=anisotropic,bandwidth=4", 2, 8},
                 {"spot:seed=5,impulses=1", 2, 1},
                 {"spot:seed=5,impulses=3,shape=cosine", 2, 3},
                 {"spot:seed=5,impulses=2,shape=ring,dims=3", 3, 2}};
    enum { PLACES = 2000 };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        bl_signal *signal = bl_test_open(cases[n].settings, BL_ISA_BEST);
        bl_random random = bl_random_seed(6, n);
        impulse_source source;
        const bl_lattice_settings settings = {.seed = 5};
        impulse_source_open(&source, &settings, cases[n].impulses, 1);
        static double column[BL_AXES][PLACES];
        static float out[PLACES];
        for (int a = 0; a < BL_AXES; a++)
            for (int i = 0; i < PLACES; i++)
                column[a][i] = 200 * bl_random_unit(&random) - 100;
        bl_signal_points(signal, BL_COLUMNS(column), PLACES, out);
        double met = 0;
        for (int i = 0; i < PLACES; i++) {
            const double at[BL_AXES] = {column[0][i], column[1][i], column[2][i], column[3][i]};
            double count = 0, value = bl_signal_value(signal, at);
            impulse_visit(&source, cases[n].dims, 1, at, count_in_reach, &count);
            assert_near((double)out[i], value, 1e-6 * count / sqrt(cases[n].impulses));
            met += count / PLACES;
        }
        // As many as there are in a disc or a ball of radius 1, to 10 %.
        double expected = (cases[n].dims == 2 ? M_PI : 4 * M_PI / 3) * cases[n].impulses;
        assert_near(met, expected, 0.1 * expected);
        bl_signal_free(signal);
    }
}

// --- the fourth cumulant ------------------------------------------------------------------------
//
// Discs of radius 1 at the middle of a cell, one impulse a cell on average. With E2 = 1/3 and
// E4 = 1/5 the moments of the amplitudes, variance s^2 = E2 pi for both counts. A Poisson process
// has the fourth cumulant E4 pi (Campbell). A fixed count is a sum of independent terms, one a
// cell, which is met with the probability m, the area that the disc shares with the cell; their
// fourth cumulants E4 m - 3 (E2 m)^2 add up to E4 pi - 3 E2^2 sum m^2. The middle cell has m = 1,
// its neighbours at the sides int_{-1/2}^{1/2} (sqrt(1 - y^2) - 1/2) dy = sqrt(3)/4 + pi/6 - 1/2,
// and those at the corners what is left of pi.
//
// x^4 - 6 s^2 x^2 + 3 s^4 has the fourth cumulant as its expectation. Its mean over batches of one
// seed each is normal.

static double fourth_cumulant(const char *text, double *error) {
    enum { BATCHES = 400, SIDE = 16, POINTS = SIDE * SIDE };
    static double column[2][POINTS];
    static float out[POINTS];
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    double s2 = signal->facts.variance;
    bl_random random = bl_random_seed(8, 0);
    bl_moments moments = {.n = 0};
    for (size_t batch = 0; batch < bl_test_scaled(BATCHES, BATCHES); batch++) {
        bl_signal *fresh = bl_signal_reseed(signal, bl_random_bits(&random));
        double mean = 0;
        for (int i = 0; i < POINTS; i++) {
            column[0][i] = 4 * (i % SIDE) + 0.5; // no two share a cell
            column[1][i] = 4 * (i / SIDE) + 0.5;
        }
        bl_signal_points(fresh, (const double *const[]){column[0], column[1], column[1], column[1]},
                         POINTS, out);
        for (int i = 0; i < POINTS; i++) {
            double square = (double)out[i] * (double)out[i];
            mean += (square * square - 6 * s2 * square + 3 * s2 * s2) / POINTS;
        }
        bl_moments_add(&moments, mean);
        bl_signal_free(fresh);
    }
    bl_signal_free(signal);
    *error = sqrt(bl_moments_variance(&moments) / moments.n);
    return moments.mean;
}

static void test_the_fourth_cumulant_tells_poisson_from_fixed_counts(void **state) {
    (void)state;
    double side = sqrt(3) / 4 + M_PI / 6 - 0.5, corner = (M_PI - 1 - 4 * side) / 4;
    double poisson = M_PI / 5;
    double fixed = M_PI / 5 - (1 + 4 * side * side + 4 * corner * corner) / 3;
    double limit = -bl_normal_quantile(ERROR_RATE / 4), error[2], found[2];
    found[0] = fourth_cumulant("spot:shape=disc,impulses=1,count=poisson", &error[0]);
    found[1] = fourth_cumulant("spot:shape=disc,impulses=1,count=fixed", &error[1]);
    printf("# poisson %.4f +- %.4f, expected %.4f; fixed %.4f +- %.4f, expected %.4f\n", found[0],
           error[0], poisson, found[1], error[1], fixed);
    assert_near(found[0], poisson, limit * error[0]);
    assert_near(found[1], fixed, limit * error[1]);
    // The power: each is refused as the other.
    assert_true(fabs(found[0] - fixed) > 2 * limit * error[0]);
    assert_true(fabs(found[1] - poisson) > 2 * limit * error[1]);
}

// --- the bounds ---------------------------------------------------------------------------------

// The largest K in each cell, for a point in a box, summed: K falls with the distance, so it is
// that of the nearest points of box and cell.
static double upper(bl_profile profile, const double low[3], const double high[3]) {
    double sum = 0;
    for (int i = 0; i < 125; i++) {
        const int cell[3] = {i / 25 - 2, i / 5 % 5 - 2, i % 5 - 2};
        double square = 0;
        for (int a = 0; a < 3; a++) {
            double gap = fmax(0, fmax(cell[a] - high[a], low[a] - (cell[a] + 1)));
            square += gap * gap;
        }
        sum += bl_profile_value(profile, square / 4);
    }
    return sum;
}

// Branch and bound on 0 <= x <= y <= z <= 1/2, as in t-bounds.
static int certify(bl_profile profile, const double low[3], const double high[3], double limit,
                   int depth) {
    if (low[0] > high[1] || low[1] > high[2] || upper(profile, low, high) < limit)
        return 1;
    if (depth == 0)
        return 0;
    int longest = 0;
    for (int a = 1; a < 3; a++)
        if (high[a] - low[a] > high[longest] - low[longest])
            longest = a;
    double left[3], right[3], middle = (low[longest] + high[longest]) / 2;
    memcpy(left, high, sizeof left);
    memcpy(right, low, sizeof right);
    left[longest] = right[longest] = middle;
    return certify(profile, low, left, limit, depth - 1) &&
           certify(profile, right, high, limit, depth - 1);
}

static void test_the_bounds_of_sparse_convolution(void **state) {
    (void)state;
    static const bl_profile both[] = {BL_PROFILE_COSINE, BL_PROFILE_GAUSSIAN};
    const double zero[3] = {0}, half[3] = {0.5, 0.5, 0.5};
    for (int n = 0; n < 2; n++) {
        double bound = bl_profile_sparse_bound(both[n]);
        assert_true(certify(both[n], zero, half, bound, 60));
        assert_near(upper(both[n], zero, zero), bound, 1e-2); // reached at a corner
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_profiles_end_as_they_state),
        cmocka_unit_test(test_float_functions_are_the_functions),
        cmocka_unit_test(test_transforms_are_the_integrals),
        cmocka_unit_test(test_the_cosine_has_its_elementary_transform),
        cmocka_unit_test(test_correlations_are_the_integrals),
        cmocka_unit_test(test_the_truncated_gaussian_has_its_transform),
        cmocka_unit_test(test_the_ring_is_that_of_the_bessel_function),
        cmocka_unit_test(test_the_covariance_of_gabor_kernels_is_their_autocorrelation),
        cmocka_unit_test(test_the_variance_of_gabor_noise_is_the_integral_of_its_density),
        cmocka_unit_test(test_counts_are_poisson),
        cmocka_unit_test(test_limits_are_the_distribution_function),
        cmocka_unit_test(test_a_count_steps_at_its_limits),
        cmocka_unit_test(test_floats_are_as_near_as_is_stated),
        cmocka_unit_test(test_the_fourth_cumulant_tells_poisson_from_fixed_counts),
        cmocka_unit_test(test_the_bounds_of_sparse_convolution),
    };
    return bl_run_tests(tests);
}
