// SPDX-License-Identifier: MIT
//
// Averages of pulse trains and checkerboards: the box against exact arithmetic, all filters against
// sums of steps and of harmonics that are too slow for use, widths without limit, places far from
// the origin, and the text's own difference with its law of error.
#include "tests/test.h"

#include <mpfr.h>

#include "core/random.h"
#include "filters/checker.h"
#include "filters/pulse_train.h"

#define for_each_filter(filter)                                                                    \
    for (size_t i_ = 0; i_ < bl_filter_count(); i_++)                                              \
        for (const bl_filter *filter = bl_filter_at(i_); filter; filter = NULL)

// What pulse_train.h promises.
static double bound_of(const bl_filter *filter) {
    return strcmp(filter->name, "lanczos") == 0 ? 1e-14 : 4e-15;
}

static int is_sinc(const bl_filter *filter) {
    return strcmp(filter->name, "sinc") == 0;
}

// --- the box, exactly ----------------------------------------------------------------------------

enum { BITS = 3000 }; // holds sums of doubles of 2^900 and 2^-900

// value = integral of the pulse from 0 to x + side * width / 2; only the division by the width
// that comes later rounds.
static void exact_integral(double low, double high, const mpfr_t x, mpfr_t value) {
    mpfr_t whole, rest;
    mpfr_inits2(BITS, whole, rest, (mpfr_ptr)0);
    mpfr_floor(whole, x);
    mpfr_sub(rest, x, whole, MPFR_RNDN);
    mpfr_sub_d(rest, rest, low, MPFR_RNDN);
    mpfr_set_d(value, high, MPFR_RNDN);
    mpfr_sub_d(value, value, low, MPFR_RNDN);
    mpfr_min(rest, rest, value, MPFR_RNDN);
    if (mpfr_sgn(rest) < 0)
        mpfr_set_zero(rest, 1);
    mpfr_mul(value, value, whole, MPFR_RNDN);
    mpfr_add(value, value, rest, MPFR_RNDN);
    mpfr_clears(whole, rest, (mpfr_ptr)0);
}

// The average over [x + from * width, x + to * width].
static double exact_box(double low, double high, double x, double width, double from, double to) {
    mpfr_t at, one, other;
    mpfr_inits2(BITS, at, one, other, (mpfr_ptr)0);
    mpfr_set_d(at, width, MPFR_RNDN);
    mpfr_mul_d(at, at, to, MPFR_RNDN);
    mpfr_add_d(at, at, x, MPFR_RNDN);
    exact_integral(low, high, at, one);
    mpfr_set_d(at, width, MPFR_RNDN);
    mpfr_mul_d(at, at, from, MPFR_RNDN);
    mpfr_add_d(at, at, x, MPFR_RNDN);
    exact_integral(low, high, at, other);
    mpfr_sub(one, one, other, MPFR_RNDN);
    mpfr_div_d(one, one, width, MPFR_RNDN);
    double value = mpfr_get_d(one, MPFR_RNDN);
    mpfr_clears(at, one, other, (mpfr_ptr)0);
    return value;
}

typedef struct drawn {
    double low, high, x, width;
} drawn;

// Places up to 2^50, mostly near edges or anywhere; widths from 2^-20 to 2^40.
static drawn draw(bl_random *random) {
    double a = bl_random_unit(random), b = bl_random_unit(random);
    drawn d = {fmin(a, b), fmax(a, b), 0, exp2(60 * bl_random_unit(random) - 20)};
    d.x = (bl_random_unit(random) - 0.5) * exp2(50 * bl_random_unit(random));
    if (bl_random_unit(random) < 0.5)
        d.x = floor(d.x) + (bl_random_unit(random) < 0.5 ? d.low : d.high) +
              d.width * (bl_random_unit(random) - 0.5);
    return d;
}

static void test_the_box_is_exact_anywhere(void **state) {
    (void)state;
    const bl_filter *box = bl_filter_find("box");
    bl_random random = bl_random_seed(1, 2);
    size_t count = bl_test_scaled(20000, 1000);
    for (size_t i = 0; i < count; i++) {
        drawn d = draw(&random);
        double expected = exact_box(d.low, d.high, d.x, d.width, -0.5, 0.5);
        double got = bl_pulse_train_average(box, d.low, d.high, d.x, d.width);
        // Edges are rounded against x's fraction: 2^-53 of a period is 2^-53 / width of the value.
        assert_near(got, expected, 1e-15 + 0x1p-52 / d.width);
    }
}

static void test_the_difference_keeps_its_law_of_error(void **state) {
    (void)state;
    bl_random random = bl_random_seed(3, 4);
    for (int exponent = 4; exponent <= 44; exponent += 8) {
        double worst = 0;
        for (int i = 0; i < 2000; i++) {
            drawn d = draw(&random);
            d.x = exp2(exponent) * (1 + bl_random_unit(&random));
            d.width = exp2(6 * bl_random_unit(&random) - 4);
            double expected = exact_box(d.low, d.high, d.x, d.width, 0, 1);
            double error = bl_pulse_train_difference(d.low, d.high, d.x, d.width) - expected;
            double law = 0x1p-53 * (2 * fabs(d.x) + fabs(d.x + d.width)) / d.width + 0x1p-52;
            assert_less(fabs(error), law);
            worst = fmax(worst, fabs(error) / law);
            double kept = bl_pulse_train_average(bl_filter_find("box"), d.low, d.high,
                                                 d.x + 0.5 * d.width, d.width);
            // The middle of the box is rounded too, before anyone is asked.
            assert_near(kept, expected,
                        2e-15 + 0x1p-52 / d.width + 0x1p-52 * fabs(d.x) / d.width * 0.5);
        }
        assert_true(worst > 0.1); // the law is not idle
    }
}

// Where x and the middle of the box are the same numbers far away as near, so are the averages.
static void test_places_far_away_are_as_good_as_near(void **state) {
    (void)state;
    bl_random random = bl_random_seed(5, 6);
    for_each_filter(filter) {
        for (int i = 0; i < 300; i++) {
            double x = floor(bl_random_unit(&random) * 4096) / 4096;
            double width = exp2(20 * bl_random_unit(&random) - 6);
            double near = bl_pulse_train_average(filter, 0.1, 0.7, x, width);
            assert_near(bl_pulse_train_average(filter, 0.1, 0.7, x + 0x1p39, width), near, 0);
            assert_near(bl_pulse_train_average(filter, 0.1, 0.7, x - 0x1p39, width), near, 0);
        }
    }
    // The difference has lost half of its digits there.
    double far = bl_pulse_train_difference(0.1, 0.7, 0x1p39 + 0.3, 0.01);
    assert_true(fabs(far - bl_pulse_train_difference(0.1, 0.7, 0.3, 0.01)) > 1e-6);
}

// --- every filter
// ---------------------------------------------------------------------------------

// All pulses in reach, one by one, the smallest last numbers first; exact to their rounding.
static double sum_of_steps(const bl_filter *filter, drawn d) {
    double reach = isfinite(filter->support) ? filter->support : 5;
    long double sum = 0;
    d.x -= floor(d.x);
    for (double k = -ceil(reach * d.width) - 1; k <= ceil(reach * d.width) + 1; k++) {
        sum += (long double)filter->step((d.x - d.low - k) / d.width);
        sum -= (long double)filter->step((d.x - d.high - k) / d.width);
    }
    return (double)sum;
}

static double sum_of_harmonics(const bl_filter *filter, drawn d, long count) {
    long double sum = 0;
    for (long n = count; n >= 1; n--) {
        long double a = remainderl((long double)n * ((long double)d.x - d.low), 1);
        long double b = remainderl((long double)n * ((long double)d.x - d.high), 1);
        long double waves =
            sinl(2 * 3.14159265358979323846264L * a) - sinl(2 * 3.14159265358979323846264L * b);
        sum += (long double)filter->response((double)n * d.width) * waves / (long double)n;
    }
    return d.high - d.low + (double)(sum / 3.14159265358979323846264L);
}

static void test_all_filters_are_sums_of_steps(void **state) {
    (void)state;
    bl_random random = bl_random_seed(7, 8);
    for_each_filter(filter) {
        if (is_sinc(filter))
            continue;
        for (int i = 0; i < 1500; i++) {
            drawn d = draw(&random);
            d.x = bl_random_unit(&random);
            d.width = exp2(11 * bl_random_unit(&random) - 5);      // 1/32 to 64
            double tolerance = bound_of(filter) + 1e-16 * d.width; // of the sum's own terms
            assert_near(bl_pulse_train_average(filter, d.low, d.high, d.x, d.width),
                        sum_of_steps(filter, d), tolerance);
        }
    }
}

// Around the widths at which the route changes, both sides agree.
static void test_the_routes_meet(void **state) {
    (void)state;
    const double widths[] = {0.5, 1, 24, 0.5 / 64};
    for_each_filter(filter) {
        for (size_t w = 0; w < 4; w++) {
            if (w == 3 && is_sinc(filter))
                continue; // a harmonic enters there: it does jump
            for (double x = -0.4; x < 0.5; x += 0.01)
                assert_near(bl_pulse_train_average(filter, 0.2, 0.55, x, nextafter(widths[w], 0)),
                            bl_pulse_train_average(filter, 0.2, 0.55, x, widths[w]),
                            is_sinc(filter) && w == 0 ? 1 : bound_of(filter));
        }
    }
}

static void test_sinc_is_the_sum_of_the_harmonics_it_passes(void **state) {
    (void)state;
    const bl_filter *sinc = bl_filter_find("sinc");
    bl_random random = bl_random_seed(9, 10);
    for (int i = 0; i < 400; i++) {
        drawn d = draw(&random);
        d.x = bl_random_unit(&random) - 0.5;
        d.width = exp2(-12 * bl_random_unit(&random));
        if (i % 4 == 0) // one at the very edge of the band, of which half passes
            d.width = exp2(-1 - i % 12);
        if (i % 5 == 0)
            d.x = d.low; // on an edge
        double expected = sum_of_harmonics(sinc, d, (long)(0.5 / d.width) + 2);
        assert_near(bl_pulse_train_average(sinc, d.low, d.high, d.x, d.width), expected,
                    bound_of(sinc));
    }
    // Gibbs: however narrow, it overshoots by 9 %.
    assert_near(bl_pulse_train_average(sinc, 0.25, 0.75, 0.25 + 1e-9, 1e-9), sinc->step(1), 1e-8);
}

// Wide: what the harmonics add up to, of the box the slowest.
static void test_wide_averages_are_sums_of_harmonics(void **state) {
    (void)state;
    bl_random random = bl_random_seed(11, 12);
    for_each_filter(filter) {
        if (filter->continuity < 0)
            continue; // falls too slowly; it is tested exactly above
        for (int i = 0; i < 20; i++) {
            drawn d = draw(&random);
            d.x = bl_random_unit(&random);
            d.width = exp2(6 + 6 * bl_random_unit(&random));
            assert_near(bl_pulse_train_average(filter, d.low, d.high, d.x, d.width),
                        sum_of_harmonics(filter, d, 4000), 1e-13);
        }
    }
}

// Any width, at once: a loop over the periods of 1e300 would not return.
static void test_widths_without_limit(void **state) {
    (void)state;
    const double widths[] = {1e6, 1e9, 1e15, 1e18, 1e100, 1e300, INFINITY};
    for_each_filter(filter) {
        for (size_t w = 0; w < sizeof widths / sizeof *widths; w++) {
            // A box, the worst, can miss a pulse at one end.
            double limit = 1 / widths[w] + 4e-16;
            assert_near(bl_pulse_train_average(filter, 0.1, 0.35, 0.77, widths[w]), 0.25, limit);
        }
        for (double width = 1e-300; width < 1e-3; width *= 1e9) {
            assert_near(bl_pulse_train_average(filter, 0.1, 0.35, 0.2, width), 1, 2 * width / 0.1);
            assert_near(bl_pulse_train_average(filter, 0.1, 0.35, 0.1, width), 0.5,
                        width / 0.1 + bound_of(filter));
        }
    }
}

static void test_points_and_no_numbers(void **state) {
    (void)state;
    const bl_filter *box = bl_filter_find("box");
    for (double x = -3; x < 3; x += 1.0 / 64) {
        double fraction = x - floor(x);
        assert_true(bl_pulse_train_average(box, 0.25, 0.75, x, 0) ==
                    (fraction >= 0.25 && fraction < 0.75));
        assert_true(bl_pulse_train_average(box, 0, 1, x, 0) == 1);
        assert_near(bl_pulse_train_average(box, 0, 1, x, 0.3), 1, 1e-15);
        assert_near(bl_pulse_train_average(box, 0, 1, x, 30.3), 1, 1e-15);
        assert_near(bl_pulse_train_average(box, 0.5, 0.5, x, 3.3), 0, 1e-15);
    }
    // Just left of a whole number the fraction is just below 1, which no double needs to hold.
    assert_true(bl_pulse_train_average(box, 0.5, 1, -1e-300, 0) == 1);
    assert_true(bl_pulse_train_average(box, 0, 0.5, -1e-300, 0) == 0);
    const double none[] = {NAN, INFINITY, -INFINITY};
    for_each_filter(filter) {
        for (int i = 0; i < 3; i++)
            assert_true(isnan(bl_pulse_train_average(filter, 0.2, 0.4, none[i], 1)));
        assert_true(isnan(bl_pulse_train_average(filter, 0.2, 0.4, 0.3, NAN)));
    }
}

// --- the text's macro ----------------------------------------------------------------------------

static void test_the_printed_integral_rises_over_the_gap(void **state) {
    (void)state;
    const double edge = 0.0625; // all numbers here are exact
    // Both ends within the pulse: right.
    assert_near(bl_pulse_train_printed(edge, 0.25, 3.5),
                bl_pulse_train_difference(edge, 1 - edge, 0.25, 3.5), 0);
    // An end in the gap before a whole number: the gap counts as brick.
    assert_near(bl_pulse_train_printed(edge, 0.5, 0.5 - 0x1p-20) -
                    bl_pulse_train_difference(edge, 1 - edge, 0.5, 0.5 - 0x1p-20),
                edge / 0.5, 1e-5);
    double worst = 0;
    for (double x = 0; x < 1; x += 1.0 / 256)
        worst = fmax(worst, fabs(bl_pulse_train_printed(edge, x, 0.75) -
                                 exact_box(edge, 1 - edge, x, 0.75, 0, 1)));
    assert_near(worst, edge / 0.75, 1.0 / 128);
}

// --- checkerboard
// ----------------------------------------------------------------------------------

// The share of white under a box, square by square.
static double counted_checker(double x, double y, const double width[2]) {
    double sum = 0, left = x - 0.5 * width[0], top = y - 0.5 * width[1];
    for (double j = floor(top); j < top + width[1]; j++)
        for (double i = floor(left); i < left + width[0]; i++) {
            double across = fmin(i + 1, left + width[0]) - fmax(i, left);
            double down = fmin(j + 1, top + width[1]) - fmax(j, top);
            sum += fmod(fabs(i + j), 2) == 0 ? across * down : 0;
        }
    return sum / (width[0] * width[1]);
}

static void test_the_box_over_a_checkerboard_is_counted(void **state) {
    (void)state;
    const bl_filter *box = bl_filter_find("box");
    bl_random random = bl_random_seed(13, 14);
    for (int i = 0; i < 2000; i++) {
        double x = 20 * (bl_random_unit(&random) - 0.5), y = 20 * (bl_random_unit(&random) - 0.5);
        double width[2] = {exp2(8 * bl_random_unit(&random) - 4),
                           exp2(8 * bl_random_unit(&random) - 4)};
        double tolerance = 1e-14 / fmin(1, fmin(width[0], width[1])); // of the counting
        assert_near(bl_checker_average(box, x, y, width), counted_checker(x, y, width), tolerance);
    }
}

static void test_checkerboards_of_all_filters(void **state) {
    (void)state;
    const double point[2] = {0, 0}, wide[2] = {INFINITY, INFINITY}, strip[2] = {0, 2};
    for_each_filter(filter) {
        for (double x = -3.5; x < 4; x++)
            for (double y = -3.5; y < 4; y++) {
                int white = fmod(floor(x) + floor(y), 2) == 0;
                assert_true(bl_checker_average(filter, x, y, point) == white);
                assert_near(bl_checker_average(filter, x, y, wide), 0.5, 0);
                const double some[2] = {0.7, 1.9};
                // A square further the colours are exchanged.
                assert_near(bl_checker_average(filter, x + 0.21, y, some) +
                                bl_checker_average(filter, x + 1.21, y, some),
                            1, bound_of(filter));
            }
        assert_near(bl_checker_average(bl_filter_find("box"), 0.3, 0.7, strip), 0.5, 1e-15);
        assert_true(isnan(bl_checker_average(filter, NAN, 0, point)));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_box_is_exact_anywhere),
        cmocka_unit_test(test_the_difference_keeps_its_law_of_error),
        cmocka_unit_test(test_places_far_away_are_as_good_as_near),
        cmocka_unit_test(test_all_filters_are_sums_of_steps),
        cmocka_unit_test(test_the_routes_meet),
        cmocka_unit_test(test_sinc_is_the_sum_of_the_harmonics_it_passes),
        cmocka_unit_test(test_wide_averages_are_sums_of_harmonics),
        cmocka_unit_test(test_widths_without_limit),
        cmocka_unit_test(test_points_and_no_numbers),
        cmocka_unit_test(test_the_printed_integral_rises_over_the_gap),
        cmocka_unit_test(test_the_box_over_a_checkerboard_is_counted),
        cmocka_unit_test(test_checkerboards_of_all_filters),
    };
    return bl_run_tests(tests);
}
