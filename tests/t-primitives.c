// SPDX-License-Identifier: MIT
//
// Every primitive of the registry: facts, averages against quadrature, rows, odd arguments. The
// laws of single primitives are in t-primitive-laws.c.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "core/grammar.h"
#include "filters/average.h"
#include "filters/primitive.h"
#include "spectra/histogram.h"
#include "spectra/psd.h"
#include "tests/primitives.h"
#include "tests/test.h"

static const double places[] = {0, 0.25, 0.4, 1, 1.0 / 3, -2.7, -1e-13};
static const double widths[] = {1e-12, 1e-6, 0.011, 0.3, 1, 2.5, 31.7};

typedef void (*visit)(const char *text, const bl_signal *signal, const bl_filter *filter);

// The settings that are tried: the defaults, every word of every choice, the examples, and what
// reversed and negative numbers do.
static void visit_all(visit function) {
    static const char *const more[] = {"pulse:low=1,high=0,period=inf",
                                       "pulse:low=0.5,high=0.5,period=inf",
                                       "pulse:period=-2",
                                       "pulse:low=0.9,high=0.1",
                                       "clamp:low=1,high=0",
                                       "smoothstep:low=1,high=0",
                                       "smoothstep:low=0.5,high=0.5",
                                       "mod:period=-0.25",
                                       "gamma:gamma=0.4",
                                       "gamma:gamma=20",
                                       "gamma:gamma=0.02",
                                       "bias:b=0.05",
                                       "bias:b=0.95,form=schlick",
                                       "gain:g=0.02",
                                       "gain:g=0.98,form=schlick",
                                       "mix:a=3,b=-1",
                                       "sine:frequency=-2,phase=0.1",
                                       "sine:frequency=0,phase=0.1",
                                       "sineturbulence:max=0"};
    char text[256];
    for (size_t f = 0; f < bl_filter_count(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        for (size_t i = 0; i < bl_primitive_count(); i++) {
            const bl_primitive *primitive = bl_primitive_at(i);
            snprintf(text, sizeof text, "%s:filter=%s", primitive->name, filter->name);
            bl_signal *signal = bl_test_primitive(text);
            function(text, signal, filter);
            bl_signal_free(signal);
            for (const bl_parameter *p = primitive->parameters; p->key; p++) {
                const char *const *words = p->kind == BL_CHOICE ? p->choices : p->examples;
                for (; words && *words && strcmp(p->key, "filter") != 0; words++) {
                    snprintf(text, sizeof text, "%s:filter=%s,%s=%s", primitive->name, filter->name,
                             p->key, *words);
                    signal = bl_test_primitive(text);
                    function(text, signal, filter);
                    bl_signal_free(signal);
                }
            }
        }
        for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
            snprintf(text, sizeof text, "%s,filter=%s", more[i], filter->name);
            bl_signal *signal = bl_test_primitive(text);
            function(text, signal, filter);
            bl_signal_free(signal);
        }
    }
}

// --- quadrature ---------------------------------------------------------------------------------

typedef struct integrand {
    const bl_signal *signal;
    const bl_filter *filter;
    double x, width;
} integrand;

static double weighted(double t, void *data) {
    const integrand *i = data;
    return i->filter->kernel(t) * bl_test_filtered(i->signal, i->x - i->width * t, 0);
}

static int ascending(const void *a, const void *b) {
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

// The multiples of `step` in the width, as places t in the kernel.
static size_t add_breaks(double *breaks, size_t count, size_t most, const integrand *i, double step,
                         double reach) {
    double first = ceil((i->x - reach * i->width) / step);
    double last = floor((i->x + reach * i->width) / step);
    for (double k = first; k <= last && count < most; k++)
        breaks[count++] = (i->x - k * step) / i->width;
    return count;
}

// The average by adaptive quadrature of GSL between all multiples of 1/48 and of 1/5, where the
// primitives under test may break, and of half a width.
static double by_quadrature(const integrand *i, double reach) {
    enum { MOST = 40000 };
    static double breaks[MOST];
    static gsl_integration_cquad_workspace *space;
    if (!space)
        space = gsl_integration_cquad_workspace_alloc(200);
    size_t count = add_breaks(breaks, 0, MOST, i, 1.0 / 48, reach);
    count = add_breaks(breaks, count, MOST, i, 0.2, reach);
    for (double t = -reach; t <= reach && count < MOST; t += 0.5)
        breaks[count++] = t;
    assert_true(count < MOST);
    qsort(breaks, count, sizeof *breaks, ascending);
    gsl_function function = {weighted, (void *)i};
    double sum = 0;
    for (size_t k = 0; k + 1 < count; k++) {
        double part = 0, error;
        if (breaks[k + 1] - breaks[k] > 1e-13 &&
            gsl_integration_cquad(&function, breaks[k], breaks[k + 1], 1e-16, 1e-13, space, &part,
                                  &error, NULL) == 0)
            sum += part;
    }
    return sum;
}

static void check_average(const char *text, const bl_signal *signal, const bl_filter *filter) {
    double reach = bl_filter_reach(filter);
    int start = strstr(text, "anchor=start") != NULL;
    for (size_t k = 0; k < sizeof widths / sizeof *widths; k++)
        for (size_t n = 0; n < sizeof places / sizeof *places; n++) {
            double w = widths[k];
            if (isinf(reach) || (w > 0.1 && n > 1) || (w > 10 && n > 0))
                continue; // t-average has the ideal filter
            double centre = start ? places[n] + 0.5 * w : places[n];
            const integrand i = {signal, filter, centre, w}; // width 0 has no anchor
            double expected = by_quadrature(&i, reach);
            double value = bl_test_filtered(signal, places[n], w);
            // The reference rounds places by 2^-53 of 7, which shifts a jump by a share of a narrow
            // width, and slopes of up to 25 by their product; panels below 1e-13 are left out.
            double tolerance = 3e-13 * (1 + fabs(expected)) + 1e-15 * fabs(centre) / w;
            if (!(fabs(value - expected) <= tolerance))
                fail_msg("%s at %.17g, width %g: %.17g, by quadrature %.17g", text, places[n], w,
                         value, expected);
        }
}

static void test_averages_are_those_of_quadrature(void **state) {
    (void)state;
    gsl_set_error_handler_off();
    visit_all(check_average);
}

// --- limits and facts ---------------------------------------------------------------------------

static void check_narrow_and_wide(const char *text, const bl_signal *signal,
                                  const bl_filter *filter) {
    int start = strstr(text, "anchor=start") != NULL;
    if (isinf(bl_filter_reach(filter)))
        return;
    double mean = bl_test_filtered(signal, 0.3, INFINITY);
    if (!isfinite(mean) || start)
        return;
    for (double w = 1e6; w <= 1e12; w *= 1000) {
        double value = bl_test_filtered(signal, 0.3, w);
        // What is not constant is within 1 or a period of 2 about 0, of a size up to 6 in
        // `examples`, and no kernel is above 1.5; the rest is rounding.
        if (!(fabs(value - mean) <= 20 / w + 1e-13))
            fail_msg("%s at width %g: %.17g, but its mean is %.17g", text, w, value, mean);
    }
    double narrow = bl_test_filtered(signal, 0.3, 1e-15), plain = bl_test_filtered(signal, 0.3, 0);
    if (!(fabs(narrow - plain) <= 1e-13)) // slopes up to 25, and no jump at 0.3
        fail_msg("%s at width 1e-15: %.17g, unfiltered %.17g", text, narrow, plain);
    if (isfinite(signal->facts.mean) && !(fabs(signal->facts.mean - mean) <= 1e-15))
        fail_msg("%s states the mean %.17g, and gives %.17g", text, signal->facts.mean, mean);
}

static void test_the_narrowest_is_the_value_and_the_widest_the_mean(void **state) {
    (void)state;
    visit_all(check_narrow_and_wide);
}

static void check_facts(const char *text, const bl_signal *signal, const bl_filter *filter) {
    const bl_facts *facts = &signal->facts;
    (void)filter;
    double least = INFINITY, most = -INFINITY, sum = 0;
    enum { PLACES = 4801 };
    for (int i = 0; i < PLACES; i++) {
        double x = -1 + 3.0 * (i + 0.5) / PLACES, value = bl_test_filtered(signal, x, 0);
        assert_true(isfinite(value));
        least = fmin(least, value);
        most = fmax(most, value);
        sum += value / PLACES;
        if (facts->period[0] > 0 &&
            !(fabs(bl_test_filtered(signal, x + facts->period[0], 0) - value) <= 1e-12) &&
            fabs(x / facts->period[0] - round(x / facts->period[0])) > 1e-9)
            fail_msg("%s does not repeat after %g, at %.17g", text, facts->period[0], x);
    }
    if (least < facts->lower || most > facts->upper)
        fail_msg("%s has values %.17g to %.17g, but states %.17g to %.17g", text, least, most,
                 facts->lower, facts->upper);
    // Bounds are reached, except for the hull of a spline, which is at most a sixth of a step too
    // wide.
    if (isfinite(facts->lower) && strncmp(text, "spline", 6) != 0 &&
        strncmp(text, "sineturbulence", 14) != 0 &&
        !(least - facts->lower < 2e-3 && facts->upper - most < 2e-3))
        fail_msg("%s has values %.17g to %.17g only, but states %.17g to %.17g", text, least, most,
                 facts->lower, facts->upper);
    if (facts->period[0] > 0 && fabs(3 / facts->period[0] - round(3 / facts->period[0])) < 1e-9 &&
        isfinite(facts->mean) && !(fabs(sum - facts->mean) < 2e-3))
        fail_msg("%s has the mean %.17g, but states %.17g", text, sum, facts->mean);
}

static void test_facts_are_kept(void **state) {
    (void)state;
    visit_all(check_facts);
}

// A jump, and a kink, show as differences that do not shrink with the step.
static void check_continuity(const char *text, const bl_signal *signal, const bl_filter *filter) {
    (void)filter;
    int jumps = 0;
    for (int i = -240; i < 480; i++) { // all breaks are multiples of 1/240
        double x = i / 240.0;
        double rise = bl_test_filtered(signal, x + 1e-9, 0) - bl_test_filtered(signal, x - 1e-9, 0);
        double near =
            bl_test_filtered(signal, x + 1e-13, 0) - bl_test_filtered(signal, x - 1e-13, 0);
        jumps += fabs(rise) > 0.01 && fabs(near) > 0.9 * fabs(rise); // x^0.03 keeps 0.77
    }
    if (signal->facts.continuity >= 0 && jumps > 0)
        fail_msg("%s states to be continuous, but has %d jumps", text, jumps);
    // An empty pulse has none to show.
    if (signal->facts.continuity < 0 && jumps == 0 && !strstr(text, "low=0.5,high=0.5"))
        fail_msg("%s states jumps, but has none", text);
}

static void test_continuity_is_as_stated(void **state) {
    (void)state;
    visit_all(check_continuity);
}

// --- odd arguments ------------------------------------------------------------------------------

static void check_odd(const char *text, const bl_signal *signal, const bl_filter *filter) {
    static const double far[] = {1e9,    -1e9,  0x1p53, -0x1p62, 1e100,
                                 -1e300, 8e307, -8e307, 5e-324,  -0.0};
    int keeps = bl_filter_keeps_bounds(filter);
    for (size_t k = 0; k < 4; k++) {
        double w = (const double[]){0, 1e-12, 1, 1e12}[k];
        if (isinf(bl_filter_reach(filter)) && w < 1 && w > 0)
            continue;
        if (!isnan(bl_test_filtered(signal, NAN, w)))
            fail_msg("%s: NaN at width %g gives %g", text, w, bl_test_filtered(signal, NAN, w));
        for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
            double value = bl_test_filtered(signal, far[i], w);
            if (isnan(value))
                fail_msg("%s at %g, width %g: NaN", text, far[i], w);
            if (isfinite(signal->facts.lower) && keeps &&
                !(value >= signal->facts.lower - 1e-12 && value <= signal->facts.upper + 1e-12))
                fail_msg("%s at %g, width %g: %.17g is beyond the bound", text, far[i], w, value);
        }
        double ends[2] = {bl_test_filtered(signal, -INFINITY, w),
                          bl_test_filtered(signal, INFINITY, w)};
        for (int e = 0; e < 2; e++) // a limit, or NaN where there is none: never a wrong number
            if (isfinite(ends[e]) && signal->facts.period[0] == 0 && w == 0 &&
                !(fabs(ends[e] - bl_test_filtered(signal, e ? 1e300 : -1e300, w)) < 1e-15))
                fail_msg("%s has another limit at infinity than far out", text);
    }
}

static void test_every_double_has_a_value(void **state) {
    (void)state;
    visit_all(check_odd);
}

// Rows are the values rounded to float, wherever a row is cut.
static void check_rows(const char *text, const bl_signal *signal, const bl_filter *filter) {
    enum { COUNT = 37 };
    float whole[COUNT], parts[COUNT];
    const double start[BL_AXES] = {-1.3}, step[BL_AXES] = {0.0937};
    (void)filter;
    bl_signal_row(signal, start, step, COUNT, whole);
    bl_signal_row(signal, start, step, 11, parts);
    for (int i = 11; i < COUNT; i++) {
        const double at[BL_AXES] = {start[0] + i * step[0]};
        parts[i] = (float)bl_signal_value(signal, at);
    }
    if (memcmp(whole, parts, sizeof whole) != 0)
        fail_msg("%s: a row differs from its points", text);
}

static void test_rows_are_the_values(void **state) {
    (void)state;
    visit_all(check_rows);
}

static void test_settings_that_make_no_sense_are_refused(void **state) {
    static const char *const cases[][2] = {{"mod:period=0", "period"},
                                           {"pulse:period=0", "period"},
                                           {"spline:knots=0;1;2", "4 knots"},
                                           {"spline:knots=0;1/2;1;1", "R/G/B"},
                                           {"spline:knots=0;;1;1", "R/G/B"},
                                           {"spline:knots=0;1/1/1;1;1", "a colour"},
                                           {"step:width=-1", "width"},
                                           {"step:width=nan", "width"},
                                           {"step:edge=inf", "edge"},
                                           {"gamma:gamma=0", "gamma"},
                                           {"bias:b=1", "b=1"},
                                           {"clamp:lo=1", "low"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = NULL;
        bl_message message = {""};
        assert_int_equal(bl_test_open_primitive(cases[i][0], &signal, &message), BL_USAGE);
        if (!strstr(message.text, cases[i][1]))
            fail_msg("%s: the message '%s' does not say '%s'", cases[i][0], message.text,
                     cases[i][1]);
    }
    bl_signal_free(bl_test_primitive("step:width=inf"));
}

static void test_statistics_are_measured_only_where_they_exist(void **state) {
    static const char *const with[] = {"mod", "pulse", "sine", "sineturbulence"};
    static const char *const without[] = {"step", "abs", "floor", "mix", "spline"};
    bl_psd_settings settings = bl_psd_default_settings(1);
    bl_histogram_settings counts = bl_histogram_default_settings();
    (void)state;
    settings.averages = 4;
    counts.samples = 4096;
    for (size_t i = 0; i < 4 + 5; i++) {
        bl_signal *signal = bl_test_primitive(i < 4 ? with[i] : without[i - 4]);
        bl_psd psd;
        bl_histogram histogram;
        bl_message message = {""};
        bl_status expected = i < 4 ? BL_OK : BL_MISMATCH;
        assert_int_equal(bl_psd_measure(signal, &settings, &psd, &message), expected);
        assert_int_equal(bl_histogram_measure(signal, &counts, &histogram, &message), expected);
        if (i < 4) {
            bl_psd_free(&psd);
            bl_histogram_free(&histogram);
        } else if (!strstr(message.text, "neither repeats nor is random")) {
            fail_msg("%s: '%s'", without[i - 4], message.text);
        }
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_averages_are_those_of_quadrature),
        cmocka_unit_test(test_the_narrowest_is_the_value_and_the_widest_the_mean),
        cmocka_unit_test(test_facts_are_kept),
        cmocka_unit_test(test_continuity_is_as_stated),
        cmocka_unit_test(test_every_double_has_a_value),
        cmocka_unit_test(test_rows_are_the_values),
        cmocka_unit_test(test_settings_that_make_no_sense_are_refused),
        cmocka_unit_test(test_statistics_are_measured_only_where_they_exist),
    };
    return bl_run_tests(tests);
}
