// SPDX-License-Identifier: MIT
//
// Walks the registry of filters: kernel, step, ramp and response of each against one another and
// against quadrature, and what each states. The sine integral, by which two of them are written,
// against GSL's.
#include "tests/test.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_expint.h>

#include "filters/filter.h"
#include "filters/response.h"
#include "filters/sine_integral.h"

enum { WORKSPACE = 2000 };

#define for_each_filter(filter)                                                                    \
    for (size_t i_ = 0; i_ < bl_filter_count(); i_++)                                              \
        for (const bl_filter *filter = bl_filter_at(i_); filter; filter = NULL)

static int is_ideal(const bl_filter *filter) {
    return strcmp(filter->name, "sinc") == 0;
}

// A distance beyond which a kernel is 0, or for the Gaussian below 1e-30.
static double reach_of(const bl_filter *filter) {
    return isfinite(filter->support) ? filter->support : 6;
}

typedef double (*function)(double, void *);

// The integral of a function over [from, to], which may have corners at all multiples of 1/2.
static double integral(function f, void *context, double from, double to) {
    gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(WORKSPACE);
    gsl_function integrand = {f, context};
    double sum = 0;
    for (double left = from; left < to;) {
        double right = fmin(floor(2 * left + 1) / 2, to), part, error;
        gsl_integration_qag(&integrand, left, right, 1e-15, 1e-12, WORKSPACE, GSL_INTEG_GAUSS61,
                            workspace, &part, &error);
        sum += part;
        left = right;
    }
    gsl_integration_workspace_free(workspace);
    return sum;
}

typedef struct seen {
    const bl_filter *filter;
    double frequency;
} seen;

static double kernel_of(double t, void *context) {
    return ((const seen *)context)->filter->kernel(t);
}

static double step_of(double t, void *context) {
    return ((const seen *)context)->filter->step(t);
}

static double wave_of(double t, void *context) {
    const seen *s = context;
    return s->filter->kernel(t) * cos(2 * M_PI * s->frequency * t);
}

static void test_every_filter_states_what_it_is(void **state) {
    (void)state;
    assert_true(bl_filter_count() >= 8);
    for_each_filter(filter) {
        assert_true(bl_filter_find(filter->name) == filter);
        assert_string_equal(bl_filter_words[i_], filter->name);
        assert_true(*filter->title && *filter->summary && *filter->formula && *filter->paper);
        assert_true(filter->support > 0);
        assert_true(filter->kernel && filter->step && filter->ramp && filter->response);
    }
    assert_null(bl_filter_at(bl_filter_count()));
    assert_null(bl_filter_find("no such filter"));
}

static void test_kernels_have_the_integral_one(void **state) {
    (void)state;
    for_each_filter(filter) {
        seen in = {filter, 0};
        double reach = reach_of(filter);
        assert_near(filter->response(0), 1, 2e-15);
        if (is_ideal(filter))
            continue; // a limit; see test_sinc_passes_and_stops
        assert_near(integral(kernel_of, &in, -reach, reach), 1, 1e-14);
    }
}

// The sinc over [-T, T] is 1 - 2/(pi^2 T) cos(pi T) + O(T^-3): averaged over T and T + 1 the first
// term goes.
static void test_sinc_passes_and_stops(void **state) {
    (void)state;
    seen in = {bl_filter_find("sinc"), 0};
    double to_100 = integral(kernel_of, &in, -100, 100);
    double to_101 = to_100 + 2 * integral(kernel_of, &in, 100, 101);
    assert_near(0.5 * (to_100 + to_101), 1, 2 / (M_PI * M_PI * 100 * 100));
    assert_near(in.filter->step(100) - in.filter->step(-100), to_100, 1e-13);
    assert_true(in.filter->response(0.49) == 1 && in.filter->response(0.51) == 0);
}

static void test_steps_are_integrals_of_kernels(void **state) {
    (void)state;
    for_each_filter(filter) {
        seen in = {filter, 0};
        for (double t = -4.3; t < 4.5; t += 0.37) {
            double slice = integral(kernel_of, &in, t, t + 0.37);
            assert_near(filter->step(t + 0.37) - filter->step(t), slice, 2e-15);
        }
    }
}

static void test_ramps_are_integrals_of_steps(void **state) {
    (void)state;
    for_each_filter(filter) {
        seen in = {filter, 0};
        for (double t = -4.3; t < 4.5; t += 0.37) {
            double slice = integral(step_of, &in, t, t + 0.37);
            assert_near(filter->ramp(t + 0.37) - filter->ramp(t), slice, 4e-15);
        }
    }
}

static void test_steps_and_ramps_are_symmetric(void **state) {
    (void)state;
    for_each_filter(filter) {
        for (double t = 0; t < 7; t += 0.043) {
            assert_near(filter->kernel(-t), filter->kernel(t), 0);
            assert_near(filter->step(t) + filter->step(-t), 1, 3e-16);
            assert_near(filter->ramp(t) - filter->ramp(-t), t, 4e-15);
            assert_near(filter->response(-t), filter->response(t), 0);
        }
    }
}

static void test_ends_are_exact(void **state) {
    (void)state;
    for_each_filter(filter) {
        double far[] = {filter->support, 2 * filter->support, 1e300, INFINITY};
        for (size_t i = isfinite(filter->support) ? 1 : 3; i < 4; i++) {
            assert_true(filter->kernel(far[i]) == 0 && filter->kernel(-far[i]) == 0);
            assert_true(filter->step(-far[i]) == 0 && filter->step(far[i]) == 1);
            assert_true(filter->ramp(-far[i]) == 0 && filter->ramp(far[i]) == far[i]);
        }
        assert_near(filter->step(-1e300), 0, 1e-299);
        assert_near(filter->ramp(-1e300), 0, 0.11); // the sinc: a wave of 1/pi^2, its phase lost
        if (!is_ideal(filter))
            assert_near(filter->response(1e300), 0, 1e-299);
        assert_true(filter->response(INFINITY) == 0 && filter->response(-INFINITY) == 0);
    }
}

static void test_nan_gives_nan(void **state) {
    (void)state;
    for_each_filter(filter) {
        assert_true(isnan(filter->kernel(NAN)) && isnan(filter->step(NAN)));
        assert_true(isnan(filter->ramp(NAN)) && isnan(filter->response(NAN)));
    }
}

static void test_responses_are_transforms_of_kernels(void **state) {
    (void)state;
    const double frequencies[] = {1e-9, 0.01,    0.1,  0.25,  1.0 / 3, 0.4,   0.5,
                                  0.6,  2.0 / 3, 0.8,  0.999, 1,       1.001, 1.37,
                                  2,    2.49,    3.14, 7.77,  15.3,    40.03};
    for_each_filter(filter) for (size_t i = 0;
                                 i < sizeof frequencies / sizeof *frequencies && !is_ideal(filter);
                                 i++) {
        seen in = {filter, frequencies[i]};
        double reach = reach_of(filter);
        assert_near(filter->response(in.frequency), 2 * integral(wave_of, &in, 0, reach), 2e-15);
    }
}

// Where quadrature of so many waves is too dear. Integration by parts leaves an envelope
// f^-(continuity + 2) and terms of higher orders, which are below 1 % at 300.
static void test_responses_fall_as_the_continuity_says(void **state) {
    (void)state;
    for_each_filter(filter) {
        if (filter->continuity > 3)
            continue;
        double near_peak = 0, far_peak = 0;
        for (double f = 300; f < 303; f += 0.011)
            near_peak = fmax(near_peak, pow(f, filter->continuity + 2) * fabs(filter->response(f)));
        for (double f = 3000; f < 3003; f += 0.011)
            far_peak = fmax(far_peak, pow(f, filter->continuity + 2) * fabs(filter->response(f)));
        assert_near(far_peak / near_peak, 1, 0.02);
    }
}

// A step never falls where its kernel is nowhere negative, and falls somewhere where it is.
static void test_steps_rise_where_kernels_are_positive(void **state) {
    (void)state;
    for_each_filter(filter) {
        int negative = 0, falls = 0;
        for (double t = -5; t < 5; t += 1.0 / 256) {
            negative |= filter->kernel(t) < 0;
            falls |= filter->step(t + 1.0 / 256) < filter->step(t) - 1e-15;
        }
        assert_int_equal(negative, falls);
    }
}

// The kernel jumps by less than the distance allows if and only if the filter says that it is C0.
static void test_jumps_are_stated(void **state) {
    (void)state;
    for_each_filter(filter) {
        double jump = 0;
        const double h = 1e-9;
        for (double t = -4; t <= 4; t += 0.25)
            jump = fmax(jump, fabs(filter->kernel(t + h) - filter->kernel(t - h)));
        assert_int_equal(jump > 1e-7, filter->continuity < 0);
    }
}

// A polynomial filter is the same kernel as its pieces.
static void test_pieces_are_the_kernel(void **state) {
    (void)state;
    size_t count = 0;
    for_each_filter(filter) {
        if (!filter->pieces)
            continue;
        count++;
        assert_near(bl_piecewise_support(filter->pieces), filter->support, 0);
        assert_int_equal(bl_piecewise_continuity(filter->pieces), filter->continuity);
        for (double t = -3.01; t < 3; t += 0.0317)
            assert_near(bl_piecewise_value(filter->pieces, t), filter->kernel(t), 1e-15);
    }
    assert_true(count >= 5);
}

// --- the formulas by which the filters are known -------------------------------------------------

static double sinc(double x) {
    return x == 0 ? 1 : sin(M_PI * x) / (M_PI * x);
}

static void test_kernels_are_their_formulas(void **state) {
    (void)state;
    for (double t = -3.5; t < 3.5; t += 0.0371) {
        double u = fabs(t), clamped = fmin(1, fmax(0, t + 0.5));
        assert_near(bl_filter_find("tent")->kernel(t), fmax(0, 1 - u), 1e-15);
        assert_near(bl_filter_find("box")->step(t), clamped, 1e-15);
        assert_near(bl_filter_find("parabola")->step(t), clamped * clamped * (3 - 2 * clamped),
                    1e-15);
        // Keys' cubic with a = -1/2, and Mitchell's with B = C = 1/3, as they are usually written.
        double keys = u < 1   ? 1.5 * u * u * u - 2.5 * u * u + 1
                      : u < 2 ? -0.5 * (u * u * u - 5 * u * u + 8 * u - 4)
                              : 0;
        double spline = u < 1   ? (4 - 6 * u * u + 3 * u * u * u) / 6
                        : u < 2 ? (2 - u) * (2 - u) * (2 - u) / 6
                                : 0;
        // Their terms add up to 20 in size near |t| = 2.
        assert_near(bl_filter_find("catmull-rom")->kernel(t), keys, 5e-15);
        assert_near(bl_filter_find("mitchell")->kernel(t), (spline + 2 * keys) / 3, 5e-15);
        assert_near(bl_filter_find("gaussian")->kernel(t),
                    exp(-0.5 * 4 * t * t) / (0.5 * sqrt(2 * M_PI)), 1e-15);
        assert_near(bl_filter_find("sinc")->kernel(t), sinc(t), 1e-15);
        // Scaled to the integral 1, which nothing but the scale can tell.
        double scale = bl_filter_find("lanczos")->kernel(0);
        assert_near(bl_filter_find("lanczos")->kernel(t), u < 3 ? scale * sinc(t) * sinc(t / 3) : 0,
                    1e-15);
    }
}

static void test_responses_are_their_formulas(void **state) {
    (void)state;
    for (double f = 0.03; f < 9; f += 0.0731) {
        double a = M_PI * f, s = sinc(f);
        assert_near(bl_filter_find("box")->response(f), s, 1e-15);
        assert_near(bl_filter_find("tent")->response(f), s * s, 1e-15);
        assert_near(bl_filter_find("parabola")->response(f),
                    3 * (sin(a) - a * cos(a)) / (a * a * a), 1e-13 / (a * a));
        assert_near(bl_filter_find("gaussian")->response(f), exp(-2 * a * a * 0.25), 1e-15);
    }
}

// How far each step overshoots, and where, as the heads of the files say.
static void test_overshoots_are_those_stated(void **state) {
    (void)state;
    assert_near(bl_filter_find("catmull-rom")->step(1), 1 + 1.0 / 24, 4e-16);
    assert_near(bl_filter_find("mitchell")->step(8.0 / 7), 1.0175, 5e-5);
    assert_near(bl_filter_find("sinc")->step(1), 1.0895, 5e-5); // Gibbs: Si(pi)/pi + 1/2
    for_each_filter(filter) {
        double most = 0;
        for (double t = 0; t < 9; t += 1.0 / 1024)
            most = fmax(most, filter->step(t));
        const char *name = filter->name;
        double stated = strcmp(name, "catmull-rom") == 0 ? 1.0 / 24
                        : strcmp(name, "mitchell") == 0  ? 0.0175
                        : strcmp(name, "sinc") == 0      ? 0.0895
                        : strcmp(name, "lanczos") == 0   ? 0.0731
                                                         : 0;
        assert_near(most - 1, stated, 5e-5);
    }
}

// The orders of the zeros at 1: halving the distance divides the response by 2^order.
static void test_zeros_at_the_sampling_frequency(void **state) {
    (void)state;
    const struct {
        const char *name;
        int order;
    } expected[] = {{"box", 1}, {"tent", 2}, {"catmull-rom", 3}, {"mitchell", 3}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const bl_filter *filter = bl_filter_find(expected[i].name);
        double near = filter->response(1 + 1e-3), nearer = filter->response(1 + 5e-4);
        assert_near(log2(fabs(near / nearer)), expected[i].order, 0.01);
    }
    double a = 4.493409457909064; // the first root of tan a = a
    assert_near(bl_filter_find("parabola")->response(a / M_PI), 0, 1e-15);
    assert_near(bl_filter_find("parabola")->response(1), 3 / (M_PI * M_PI), 1e-15);
}

// The measured numbers, where they are known in closed form or by the other route.
static void test_measured_numbers(void **state) {
    (void)state;
    for_each_filter(filter) {
        bl_filter_numbers n = bl_filter_measure(filter);
        if (!is_ideal(filter)) // whose power falls there at once
            assert_near(filter->response(n.half_power), M_SQRT1_2, 1e-9);
        // Without a closed form: the powers as sums over a fine grid of frequencies.
        double alias = 0, blur = 0, h = 1.0 / 512;
        for (double f = 0.5 * h; f < 60; f += h) {
            double passed = filter->response(f);
            alias += f > 0.5 ? 2 * h * passed * passed : 0;
            blur += f < 0.5 ? 2 * h * (1 - passed) * (1 - passed) : 0;
        }
        // The box leaves 1/(pi^2 60) beyond, the parabola and the tent far less.
        assert_near(n.alias, alias, filter->continuity < 0 ? 2e-3 : 3e-5);
        assert_near(n.blur, blur, 3e-6); // the sum: h^2/12 times a slope below 10
    }
    bl_filter_numbers box = bl_filter_measure(bl_filter_find("box"));
    assert_near(box.first_zero, 1, 1e-7);
    assert_near(box.lobe_frequency * M_PI, 4.493409457909064, 1e-6); // tan a = a
    assert_near(box.lobe, -0.217233628211222, 1e-9);
    assert_true(box.overshoot == 0 && isnan(box.overshoot_at));
    bl_filter_numbers catmull = bl_filter_measure(bl_filter_find("catmull-rom"));
    assert_near(catmull.first_zero, 1, 0);
    assert_near(catmull.overshoot, 1.0 / 24, 1e-15);
    assert_near(bl_filter_measure(bl_filter_find("tent")).first_zero, 1, 0);
    bl_filter_numbers gaussian = bl_filter_measure(bl_filter_find("gaussian"));
    assert_near(gaussian.half_power, sqrt(log(2)) / M_PI, 1e-9);
    assert_true(isnan(gaussian.first_zero) && isnan(gaussian.lobe));
    bl_filter_numbers sinc = bl_filter_measure(bl_filter_find("sinc"));
    assert_near(sinc.first_zero, 0.5, 1e-9);
    assert_near(sinc.half_power, 0.5, 1e-9);
    assert_near(sinc.alias, 0, 1e-12);
    assert_near(sinc.blur, 0, 1e-12);
    assert_true(isnan(sinc.lobe));
}

static void test_the_sine_integral_is_that_of_gsl(void **state) {
    (void)state;
    const double euler = 0.57721566490153286061;
    for (double x = 1e-3; x < 1e4; x *= 1.07) {
        assert_near(bl_sine_integral(x), gsl_sf_Si(x), 2e-15);
        assert_near(bl_sine_integral(-x), -gsl_sf_Si(x), 2e-15);
        double cin = euler + log(x) - gsl_sf_Ci(x);
        assert_near(bl_entire_cosine_integral(x), cin, 3e-15 * fmax(1, cin));
        bl_sine_auxiliary rest = bl_sine_integral_auxiliary(x);
        assert_near(M_PI_2 - rest.f * cos(x) - rest.g * sin(x), gsl_sf_Si(x), 4e-15);
        assert_near(rest.f * sin(x) - rest.g * cos(x), gsl_sf_Ci(x), 3e-15 * fmax(1, cin));
    }
}

// f and g as they are defined, since large x would hide their errors in Si.
static double auxiliary_f(double t, void *context) {
    return exp(-*(const double *)context * t) / (1 + t * t);
}

static double auxiliary_g(double t, void *context) {
    return t * auxiliary_f(t, context);
}

static void test_the_auxiliary_functions_are_their_integrals(void **state) {
    (void)state;
    for (double x = 1; x < 3000; x *= 1.9) {
        double f = 0, g = 0, end = 40 / x, part = end / 32;
        gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(WORKSPACE);
        for (int i = 0; i < 32; i++) {
            double sum, error;
            gsl_function of_f = {auxiliary_f, &x}, of_g = {auxiliary_g, &x};
            gsl_integration_qag(&of_f, i * part, (i + 1) * part, 0, 1e-13, WORKSPACE,
                                GSL_INTEG_GAUSS61, workspace, &sum, &error);
            f += sum;
            gsl_integration_qag(&of_g, i * part, (i + 1) * part, 0, 1e-13, WORKSPACE,
                                GSL_INTEG_GAUSS61, workspace, &sum, &error);
            g += sum;
        }
        gsl_integration_workspace_free(workspace);
        assert_near(bl_sine_integral_auxiliary(x).f, f, 2e-15 * fmin(1, 10 / x));
        assert_near(bl_sine_integral_auxiliary(x).g, g, 2e-15 * fmin(1, 10 / x));
    }
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_filter_states_what_it_is),
        cmocka_unit_test(test_kernels_have_the_integral_one),
        cmocka_unit_test(test_sinc_passes_and_stops),
        cmocka_unit_test(test_steps_are_integrals_of_kernels),
        cmocka_unit_test(test_ramps_are_integrals_of_steps),
        cmocka_unit_test(test_steps_and_ramps_are_symmetric),
        cmocka_unit_test(test_ends_are_exact),
        cmocka_unit_test(test_nan_gives_nan),
        cmocka_unit_test(test_responses_are_transforms_of_kernels),
        cmocka_unit_test(test_responses_fall_as_the_continuity_says),
        cmocka_unit_test(test_steps_rise_where_kernels_are_positive),
        cmocka_unit_test(test_jumps_are_stated),
        cmocka_unit_test(test_pieces_are_the_kernel),
        cmocka_unit_test(test_kernels_are_their_formulas),
        cmocka_unit_test(test_responses_are_their_formulas),
        cmocka_unit_test(test_overshoots_are_those_stated),
        cmocka_unit_test(test_zeros_at_the_sampling_frequency),
        cmocka_unit_test(test_measured_numbers),
        cmocka_unit_test(test_the_sine_integral_is_that_of_gsl),
        cmocka_unit_test(test_the_auxiliary_functions_are_their_integrals),
    };
    return bl_run_tests(tests);
}
