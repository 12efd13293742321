// SPDX-License-Identifier: MIT
//
// The laws of single primitives: inverses, symmetries, identities of the text, and averages against
// 300 bits of their plain integrals.
#include <mpfr.h>

#include "core/random.h"
#include "filters/primitive.h"
#include "tests/primitives.h"
#include "tests/test.h"

static double at(const bl_signal *signal, double x) {
    return bl_test_filtered(signal, x, 0);
}

static bl_signal *open_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
static bl_signal *open_text(const char *format, ...) {
    char text[256];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return bl_test_primitive(text);
}

// A number of any size and sign.
static double any_number(bl_random *random, double lowest, double highest) {
    double size = pow(10, lowest + (highest - lowest) * bl_random_unit(random));
    return bl_random_unit(random) < 0.5 ? -size : size;
}

static void test_modulo_is_in_its_range_and_congruent(void **state) {
    bl_random random = bl_random_seed(1, 1);
    (void)state;
    for (int i = 0; i < 100000; i++) {
        double x = any_number(&random, -20, 20), b = any_number(&random, -3, 3);
        double rest = bl_modulo(x, b);
        assert_true(b > 0 ? rest >= 0 && rest < b : rest <= 0 && rest > b);
        assert_true(bl_modulo(-x, -b) == -rest);
        // x - rest is a whole number of periods: what remains of their exact remainders is the one
        // rounding of the sum.
        assert_near(remainder(remainder(rest, b) - remainder(x, b), b), 0, 0x1p-52 * fabs(b));
    }
    assert_true(bl_modulo(-1e-20, 1) < 1 && bl_modulo(-1e-20, 1) == nextafter(1, 0));
    assert_true(bl_modulo(5, 0.5) == 0 && !signbit(bl_modulo(-5, 0.5)));
    assert_true(isnan(bl_modulo(INFINITY, 1)) && isnan(bl_modulo(NAN, 1)));
}

// The text's listing, with the conversion that processors make where C leaves it undefined.
static double printed_modulo(double a, double b) {
    double quotient = trunc(a / b);
    double n = fabs(quotient) < 2147483648.0 ? quotient : -2147483648.0;
    a -= n * b;
    return a < 0 ? a + b : a;
}

static void test_printed_modulo_fails_far_out_and_below_zero(void **state) {
    (void)state;
    assert_true(printed_modulo(7.25, 2) == bl_modulo(7.25, 2));
    assert_true(printed_modulo(3e9, 1) > 1);                            // far out of its range
    assert_true(printed_modulo(-1e-20, 1) == 1);                        // rounds up to the period
    assert_true(printed_modulo(-7.25, -2) != -printed_modulo(7.25, 2)); // falls out below 0
}

static void test_floor_and_ceiling_mirror_each_other(void **state) {
    bl_signal *lower = open_text("floor"), *upper = open_text("ceil"), *rest = open_text("mod");
    bl_random random = bl_random_seed(1, 2);
    (void)state;
    for (int i = 0; i < 3000; i++) {
        double x = any_number(&random, -6, 12);
        assert_true(at(lower, -x) == -at(upper, x));
        assert_true(at(lower, x) == floor(x));
        for (double w = 1e-6; w < 1e6; w *= 97) {
            double low = bl_test_filtered(lower, x, w);
            assert_true(bl_test_filtered(upper, -x, w) == -low);
            // x = floor + mod holds for the averages, too; x itself is rounded by 2^-53 of it.
            assert_near(low + bl_test_filtered(rest, x, w), x, 4e-16 * fabs(x) + 1e-15);
        }
    }
    bl_signal_free(lower);
    bl_signal_free(upper);
    bl_signal_free(rest);
}

// clamp, min and max as the text prints them.
static double printed_clamp(double x, double a, double b) {
    return x < a ? a : x > b ? b : x;
}

static void test_clamp_min_and_max_are_made_of_each_other(void **state) {
    bl_signal *clamp = open_text("clamp:low=-0.5,high=2"),
              *turned = open_text("clamp:low=2,high=1");
    bl_signal *least = open_text("min:high=2"), *most = open_text("max:low=-0.5");
    bl_signal *size = open_text("abs"), *positive = open_text("max:low=0");
    bl_signal *above = open_text("max:low=2");
    (void)state;
    for (double x = -5; x <= 5; x += 0.03125) {
        assert_true(at(clamp, x) == at(least, at(most, x)));
        assert_true(at(clamp, at(clamp, x)) == at(clamp, x));
        assert_true(at(least, x) == printed_clamp(x, x, 2)); // the text's identities
        assert_true(at(most, x) == printed_clamp(x, -0.5, x));
        assert_true(at(turned, x) == 1); // reversed: min(max(x, 2), 1)
        assert_true(at(turned, at(turned, x)) == at(turned, x));
        for (double w = 1e-9; w < 1e9; w *= 31) { // averages are linear
            double tolerance = 4e-16 * (w + fabs(x) + 3);
            assert_near(bl_test_filtered(clamp, x, w),
                        bl_test_filtered(most, x, w) - bl_test_filtered(above, x, w) + 2,
                        tolerance);
            assert_near(bl_test_filtered(size, x, w), 2 * bl_test_filtered(positive, x, w) - x,
                        tolerance);
            assert_true(bl_test_filtered(size, x, w) == bl_test_filtered(size, -x, w));
        }
    }
    // The listing with reversed edges is not idempotent, nor what min and max make.
    assert_true(printed_clamp(0, 2, 1) == 2 && printed_clamp(2, 2, 1) == 1);
    bl_signal *all[] = {clamp, turned, least, most, size, positive, above};
    for (size_t i = 0; i < 7; i++)
        bl_signal_free(all[i]);
}

static void test_pulses_are_differences_of_steps(void **state) {
    bl_signal *pulse = open_text("pulse:low=0.4,high=0.6,period=inf"),
              *back = open_text("pulse:low=0.6,high=0.4,period=inf");
    bl_signal *first = open_text("step:edge=0.4"), *second = open_text("step:edge=0.6");
    bl_signal *train = open_text("pulse:low=0.4,high=0.6");
    bl_signal *turned = open_text("pulse:low=0.6,high=0.4");
    bl_signal *mirrored = open_text("pulse:low=0.4,high=0.7,period=-2");
    bl_signal *plain = open_text("pulse:low=0.4,high=0.7,period=2");
    (void)state;
    for (double x = -0.99; x < 2; x += 0.017)
        for (double w = 0; w < 50; w = w ? w * 7 : 1e-7) {
            double difference = bl_test_filtered(first, x, w) - bl_test_filtered(second, x, w);
            assert_near(bl_test_filtered(pulse, x, w), difference, 3e-16);
            assert_true(bl_test_filtered(back, x, w) == -bl_test_filtered(pulse, x, w));
            assert_true(bl_test_filtered(turned, x, w) == -bl_test_filtered(train, x, w));
            assert_near(bl_test_filtered(mirrored, x, w), bl_test_filtered(plain, -x, w), 1e-14);
            if (x - w / 2 > -0.4 && x + w / 2 < 1.4) // one pulse is in sight
                assert_near(bl_test_filtered(train, x, w), difference, 1e-14);
        }
    bl_signal *all[] = {pulse, back, first, second, train, turned, mirrored, plain};
    for (size_t i = 0; i < 8; i++)
        bl_signal_free(all[i]);
}

// A place exactly on an edge belongs to what begins there: intervals are closed below and open
// above, whatever the sign and the place, and a double next to the edge is on its own side. (The
// period is a power of two, so that a place in periods is not rounded.)
static void test_edges_belong_to_what_begins_there(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double edge, before, from; // value just before, and from the edge on
    } known[] = {
        {"step:edge=0.75", 0.75, 0, 1},
        {"step:edge=-3", -3, 0, 1},
        {"pulse:low=0.25,high=0.625,period=inf", 0.25, 0, 1},
        {"pulse:low=0.25,high=0.625,period=inf", 0.625, 1, 0},
        {"pulse:low=0.25,high=0.625,period=4", 0.25, 0, 1},
        {"pulse:low=0.25,high=0.625,period=4", 0.625, 1, 0},
        {"pulse:low=0.25,high=0.625,period=4", -3.375, 1, 0},
        {"pulse:low=0.25,high=0.625,period=4", 300.25, 0, 1},
        {"pulse:low=0.625,high=0.25,period=inf", 0.25, 0, -1},
        {"pulse:low=0.625,high=0.25,period=inf", 0.625, -1, 0},
        {"floor", 5, 4, 5},
        {"floor", -5, -6, -5},
        {"floor", -1, -2, -1},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        bl_signal *signal = open_text(known[i].text);
        double below = nextafter(known[i].edge, -INFINITY);
        double above = nextafter(known[i].edge, INFINITY);
        double seen[3] = {at(signal, below), at(signal, known[i].edge), at(signal, above)};
        if (seen[0] != known[i].before || seen[1] != known[i].from || seen[2] != known[i].from)
            fail_msg("%s about %g: %g, %g, %g", known[i].text, known[i].edge, seen[0], seen[1],
                     seen[2]);
        bl_signal_free(signal);
    }
}

static void test_smoothstep_is_symmetric_and_level_at_its_ends(void **state) {
    bl_signal *up = open_text("smoothstep:low=-1,high=3"),
              *down = open_text("smoothstep:low=3,high=-1");
    (void)state;
    for (double x = -2; x < 4; x += 0.0625) {
        assert_near(at(up, x) + at(down, x), 1, 1e-15);
        assert_near(at(up, x) + at(up, 2 - x), 1, 1e-15);
        for (double w = 1e-6; w < 100; w *= 10)
            assert_near(bl_test_filtered(up, x, w) + bl_test_filtered(up, 2 - x, w), 1, 2e-15);
    }
    for (double h = 1e-2; h > 1e-7; h /= 10) { // 3 (h/4)^2
        assert_near(at(up, -1 + h) / (h * h), 3.0 / 16, h);
        assert_near((1 - at(up, 3 - h)) / (h * h), 3.0 / 16, h + 1e-16 / (h * h));
    }
    bl_signal_free(up);
    bl_signal_free(down);
}

static void test_gamma_and_bias_have_their_inverses(void **state) {
    (void)state;
    for (double g = 0.1; g < 8; g *= 1.7) {
        bl_signal *curve = open_text("gamma:gamma=%.17g", g),
                  *back = open_text("gamma:gamma=%.17g", 1 / g);
        for (double x = 0; x <= 1; x += 1.0 / 64) // rounding grows by the slope of the inverse
            assert_near(at(back, at(curve, x)), x, 1e-14 * fmax(1, g));
        bl_signal_free(curve);
        bl_signal_free(back);
    }
    for (double b = 0.05; b < 1; b += 0.05) {
        bl_signal *power = open_text("bias:b=%.17g", b);
        bl_signal *cheap = open_text("bias:form=schlick,b=%.17g", b);
        bl_signal *other = open_text("bias:form=schlick,b=%.17g", 1 - b);
        bl_signal *back = open_text("bias:b=%.17g", exp2(1 / log2(b))); // 2^-e becomes 2^-1/e
        assert_near(at(power, 0.5), b, 1e-15);
        assert_near(at(cheap, 0.5), b, 1e-15);
        for (double x = 0; x <= 1; x += 1.0 / 64) {
            assert_near(at(other, at(cheap, x)), x, 2e-14);
            assert_near(at(back, at(power, x)), x, 1e-13);
            // Mirrored about the falling diagonal, Schlick's bias is itself; the power is not.
            assert_near(at(cheap, 1 - at(cheap, x)), 1 - x, 1e-13);
        }
        bl_signal *all[] = {power, cheap, other, back};
        for (size_t i = 0; i < 4; i++)
            bl_signal_free(all[i]);
    }
}

static void test_gain_is_symmetric_about_its_middle(void **state) {
    (void)state;
    for (double g = 0.05; g < 1; g += 0.09) {
        bl_signal *form[2] = {open_text("gain:g=%.17g", g),
                              open_text("gain:form=schlick,g=%.17g", g)};
        bl_signal *back = open_text("gain:form=schlick,g=%.17g", 1 - g);
        for (int f = 0; f < 2; f++) {
            assert_true(at(form[f], 0.5) == 0.5);
            assert_near(at(form[f], 0.25), (1 - g) / 2, 1e-15);
            for (double x = 0; x <= 1; x += 1.0 / 64) {
                assert_near(at(form[f], x) + at(form[f], 1 - x), 1, 3e-16);
                for (double w = 1e-5; w < 100; w *= 10)
                    assert_near(bl_test_filtered(form[f], x, w) +
                                    bl_test_filtered(form[f], 1 - x, w),
                                1, 1e-14);
            }
        }
        for (double x = 0; x <= 1; x += 1.0 / 64)
            assert_near(at(back, at(form[1], x)), x, 2e-14);
        for (int f = 0; f < 2; f++)
            bl_signal_free(form[f]);
        bl_signal_free(back);
    }
}

static void test_splines_pass_their_knots_and_keep_quadratics(void **state) {
    bl_signal *through = open_text("spline:knots=9;1;-2;5;0.5;3;-7"); // 4 spans
    bl_signal *square = open_text("spline:knots=1;0;1;4;9;16");       // ((3 x))^2
    bl_signal *mirrored = open_text("spline:knots=-7;3;0.5;5;-2;1;9");
    const double knot[] = {1, -2, 5, 0.5, 3};
    (void)state;
    for (int i = 0; i < 5; i++) {
        assert_true(at(through, i / 4.0) == knot[i]);
        double h = 1e-6, left = (at(through, i / 4.0) - at(through, i / 4.0 - h)) / h;
        double right = (at(through, i / 4.0 + h) - at(through, i / 4.0)) / h;
        if (i > 0 && i < 4) // the same slope from both sides: second derivatives are below 1000
            assert_near(left, right, 1000 * h);
    }
    for (double x = 0; x <= 1; x += 1.0 / 128) {
        assert_near(at(square, x), 9 * x * x, 1e-14);
        assert_near(at(mirrored, x), at(through, 1 - x), 2e-14);
        for (double w = 1e-4; w < 0.1; w *= 3) // the mean of a square adds w^2 / 12
            if (x > w && x < 1 - w)
                assert_near(bl_test_filtered(square, x, w), 9 * (x * x + w * w / 12), 1e-14);
    }
    bl_signal_free(through);
    bl_signal_free(square);
    bl_signal_free(mirrored);
}

static void test_a_spline_of_colours_is_three_splines(void **state) {
    bl_signal *colours =
        open_text("spline:knots=0/0.1/1;1/0.5/0;1/1/1;0.2/0.3/0.4,component=green");
    bl_signal *parts[3] = {open_text("spline:knots=0;1;1;0.2"),
                           open_text("spline:knots=0.1;0.5;1;0.3"),
                           open_text("spline:knots=1;0;1;0.4")};
    (void)state;
    for (double x = -0.5; x < 1.5; x += 0.0371)
        for (double w = 0; w < 3; w = w ? w * 3 : 0.01) {
            double rgb[3];
            bl_signal_colour(colours, (const double[BL_AXES]){x}, (const double[BL_AXES]){w}, rgb);
            for (int c = 0; c < 3; c++)
                assert_true(rgb[c] == bl_test_filtered(parts[c], x, w));
            assert_true(bl_test_filtered(colours, x, w) == rgb[1]);
        }
    bl_signal_free(colours);
    for (int c = 0; c < 3; c++)
        bl_signal_free(parts[c]);
}

// --- laws of all --------------------------------------------------------------------------------

// The box over a width is the mean of the boxes over its halves, at any width.
static void test_a_box_is_the_mean_of_its_halves(void **state) {
    bl_random random = bl_random_seed(1, 3);
    (void)state;
    for (size_t i = 0; i < bl_primitive_count(); i++) {
        bl_signal *signal = open_text("%s:anchor=start", bl_primitive_at(i)->name);
        for (int k = 0; k < 2000; k++) {
            double w = fabs(any_number(&random, -9, 4)), x = 4 * bl_random_unit(&random) - 2;
            double far = x + w;
            if (!(far > x))
                continue;
            w = far - x; // so that the halves meet
            double whole = bl_test_filtered(signal, x, 2 * w);
            double halves =
                0.5 * (bl_test_filtered(signal, x, w) + bl_test_filtered(signal, far, w));
            // Where it jumps, the places of the halves are rounded by 2^-53 of x, over w.
            double tolerance = 1e-14 * (1 + fabs(whole)) + 4e-16 * (2 + w) / w;
            if (!(fabs(whole - halves) <= tolerance))
                fail_msg("%s over %.17g from %.17g: %.17g, by halves %.17g", signal->text, 2 * w, x,
                         whole, halves);
        }
        bl_signal_free(signal);
    }
}

// Whole periods further the average is the same to the last bit, as long as x is a float.
static void test_periodic_averages_keep_their_digits_far_out(void **state) {
    static const char *const texts[] = {"mod", "mod:period=0.5", "pulse", "sine", "sineturbulence"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_signal *signal = open_text("%s", texts[i]);
        for (double x = 0.0009765625; x < 1; x += 0.0341796875)
            for (double w = 0; w < 1e4; w = w ? w * 13 : 1e-9)
                assert_near(bl_test_filtered(signal, x + 0x1p40, w), bl_test_filtered(signal, x, w),
                            1e-15 * (1 + signal->facts.upper));
        bl_signal_free(signal);
    }
}

// --- 300 bits -----------------------------------------------------------------------------------

enum { BITS = 300 };
typedef void (*antiderivative)(mpfr_t out, mpfr_srcptr x); // on [0, 1], 0 at 0

static void of_smoothstep(mpfr_t out, mpfr_srcptr x) { // x^3 - x^4 / 2
    mpfr_t t;
    mpfr_init2(t, BITS);
    mpfr_pow_ui(t, x, 4, MPFR_RNDN);
    mpfr_div_ui(t, t, 2, MPFR_RNDN);
    mpfr_pow_ui(out, x, 3, MPFR_RNDN);
    mpfr_sub(out, out, t, MPFR_RNDN);
    mpfr_clear(t);
}

// x^(p + 1) / (p + 1), p as a double
static void of_power(mpfr_t out, mpfr_srcptr x, double p) {
    mpfr_t q;
    mpfr_init2(q, BITS);
    mpfr_set_d(q, p, MPFR_RNDN);
    mpfr_add_ui(q, q, 1, MPFR_RNDN);
    mpfr_pow(out, x, q, MPFR_RNDN);
    mpfr_div(out, out, q, MPFR_RNDN);
    mpfr_clear(q);
}

static void of_gamma(mpfr_t out, mpfr_srcptr x) {
    of_power(out, x, 1 / 2.5);
}

static void of_steep_gamma(mpfr_t out, mpfr_srcptr x) {
    of_power(out, x, 1 / 0.01);
}

// -x / a + (1 + a) / a^2 ln((1 + a) / (1 + a - a x)), a = 1/b - 2
static void of_schlick(mpfr_t out, mpfr_srcptr x, double b) {
    mpfr_t a, one, t;
    mpfr_inits2(BITS, a, one, t, (mpfr_ptr)0);
    mpfr_set_d(a, 1 / b - 2, MPFR_RNDN);
    mpfr_add_ui(one, a, 1, MPFR_RNDN);
    mpfr_mul(t, a, x, MPFR_RNDN);
    mpfr_sub(t, one, t, MPFR_RNDN);
    mpfr_div(t, one, t, MPFR_RNDN);
    mpfr_log(t, t, MPFR_RNDN);
    mpfr_mul(t, t, one, MPFR_RNDN);
    mpfr_div(t, t, a, MPFR_RNDN);
    mpfr_sub(t, t, x, MPFR_RNDN);
    mpfr_div(out, t, a, MPFR_RNDN);
    mpfr_clears(a, one, t, (mpfr_ptr)0);
}

static void of_steep_bias(mpfr_t out, mpfr_srcptr x) {
    of_schlick(out, x, 0.02);
}

static void of_flat_bias(mpfr_t out, mpfr_srcptr x) {
    of_schlick(out, x, 0.499);
}

static void of_high_bias(mpfr_t out, mpfr_srcptr x) {
    of_schlick(out, x, 0.97);
}

static void of_clamp(mpfr_t out, mpfr_srcptr x) {
    mpfr_sqr(out, x, MPFR_RNDN);
    mpfr_div_ui(out, out, 2, MPFR_RNDN);
}

// Going on as 0 below 0 and as x above 1.
static void extended(mpfr_t out, antiderivative inside, mpfr_srcptr x) {
    mpfr_t one, over;
    mpfr_inits2(BITS, one, over, (mpfr_ptr)0);
    mpfr_set_ui(one, 1, MPFR_RNDN);
    mpfr_set_ui(over, 0, MPFR_RNDN);
    if (mpfr_cmp_ui(x, 1) > 0)
        mpfr_sub_ui(over, x, 1, MPFR_RNDN);
    if (mpfr_sgn(x) <= 0)
        mpfr_set_ui(out, 0, MPFR_RNDN);
    else
        inside(out, mpfr_cmp_ui(x, 1) > 0 ? one : x);
    mpfr_add(out, out, over, MPFR_RNDN);
    mpfr_clears(one, over, (mpfr_ptr)0);
}

static double exact_average(antiderivative inside, double x, double width) {
    mpfr_t end, high, low;
    mpfr_inits2(BITS, end, high, low, (mpfr_ptr)0);
    mpfr_set_d(end, x, MPFR_RNDN);
    mpfr_add_d(end, end, width / 2, MPFR_RNDN);
    extended(high, inside, end);
    mpfr_sub_d(end, end, width, MPFR_RNDN);
    extended(low, inside, end);
    mpfr_sub(high, high, low, MPFR_RNDN);
    mpfr_div_d(high, high, width, MPFR_RNDN);
    double average = mpfr_get_d(high, MPFR_RNDN);
    mpfr_clears(end, high, low, (mpfr_ptr)0);
    return average;
}

static void test_box_averages_against_300_bits(void **state) {
    static const struct {
        const char *text;
        antiderivative inside;
        double steepest; // slope, by which the rounding of a place counts
    } cases[] = {{"smoothstep", of_smoothstep, 1.5},
                 {"clamp", of_clamp, 1},
                 {"gamma:gamma=2.5", of_gamma, 1e3},
                 {"gamma:gamma=0.01", of_steep_gamma, 100},
                 {"bias:form=schlick,b=0.02", of_steep_bias, 50},
                 {"bias:form=schlick,b=0.499", of_flat_bias, 2},
                 {"bias:form=schlick,b=0.97", of_high_bias, 35}};
    static const double places[] = {-0.3, 0, 1e-6, 0.25, 0.5, 0.8125, 0.999, 1, 1.7, 1e5};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_text("%s", cases[i].text);
        for (size_t n = 0; n < sizeof places / sizeof *places; n++)
            for (double w = 1e-12; w < 2e12; w *= 10) {
                double value = bl_test_filtered(signal, places[n], w);
                double exact = exact_average(cases[i].inside, places[n], w);
                if (!(fabs(value - exact) <= 3e-16 * cases[i].steepest + 4e-16))
                    fail_msg("%s at %.17g, width %g: %.17g, exactly %.17g", cases[i].text,
                             places[n], w, value, exact);
            }
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_modulo_is_in_its_range_and_congruent),
        cmocka_unit_test(test_printed_modulo_fails_far_out_and_below_zero),
        cmocka_unit_test(test_floor_and_ceiling_mirror_each_other),
        cmocka_unit_test(test_clamp_min_and_max_are_made_of_each_other),
        cmocka_unit_test(test_pulses_are_differences_of_steps),
        cmocka_unit_test(test_edges_belong_to_what_begins_there),
        cmocka_unit_test(test_smoothstep_is_symmetric_and_level_at_its_ends),
        cmocka_unit_test(test_gamma_and_bias_have_their_inverses),
        cmocka_unit_test(test_gain_is_symmetric_about_its_middle),
        cmocka_unit_test(test_splines_pass_their_knots_and_keep_quadratics),
        cmocka_unit_test(test_a_spline_of_colours_is_three_splines),
        cmocka_unit_test(test_a_box_is_the_mean_of_its_halves),
        cmocka_unit_test(test_periodic_averages_keep_their_digits_far_out),
        cmocka_unit_test(test_box_averages_against_300_bits),
    };
    return bl_run_tests(tests);
}
