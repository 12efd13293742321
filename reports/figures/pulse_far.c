// SPDX-License-Identifier: MIT
//
// pulse-far: the average of a periodic pulse far from the origin, as the difference of two values
// of its integral and by phases alone, and the text's macro as it is printed.
//
// The law. The integral from 0 is about x d, d the share of the period that is 1; of the difference
// of two of them, over the width, is left an error of up to 2^-53 (2 |x| + |x + w|) / w in double
// and 2^-24 (...) in float.
#include <float.h>
#include <math.h>

#include "filters/pulse_train.h"
#include "reports/figures/estimates.h"
#include "reports/figures/graph.h"

static const char section[] = "peachey2003, Example: Antialiased Brick Texture";

enum { EXPONENTS = 41, FLOATS = 19, LAST = 40 };
enum { PHASES, DOUBLES, FLOATED, WAYS };

// --- the ways -----------------------------------------------------------------------------------

// The pulse from 0 to a fraction.
static long double partial(long double fraction, long double low, long double high) {
    return fminl(fmaxl(fraction - low, 0), high - low);
}

// The reference: whole periods are counted apart from the fractions, which have 64 bits. All x and
// x + w here are exact.
static double reference(double low, double high, double x, double width) {
    double begin = floor(x), end = floor(x + width);
    long double from = partial((long double)(x - begin), (long double)low, (long double)high);
    long double to = partial((long double)(x + width - end), (long double)low, (long double)high);
    long double whole = (long double)(end - begin) * ((long double)high - (long double)low);
    return (double)((whole + to - from) / (long double)width);
}

// The difference of bl_pulse_train_difference with every operation in float.
static float difference_in_float(float low, float high, float x, float width) {
    float begin = floorf(x), end = floorf(x + width);
    float from = begin * (high - low) + fminf(fmaxf(0, x - begin - low), high - low);
    float to = end * (high - low) + fminf(fmaxf(0, x + width - end - low), high - low);
    return (to - from) / width;
}

typedef struct errors {
    double distance[EXPONENTS]; // log2 of |x|
    double worst[WAYS][EXPONENTS], law[EXPONENTS], law_of_floats[EXPONENTS];
    double share; // of the law, at most
    size_t pulses;
} errors;

// A place from 2^n to 2^(n+1), a multiple of 2^(n-bits).
static double place(bl_random *random, int n, int bits) {
    return ldexp(floor(ldexp(1 + bl_random_unit(random), bits)), n - bits);
}

// One pulse, width and place. Widths are multiples of 1/4 up to 8, and four bits are left below
// those of x, so that x + w and x + w/2 are exact: all ways know the same.
static void measure_one(errors *e, int n, bl_random *random) {
    const bl_filter *box = bl_filter_find("box");
    double low = 0.5 * bl_random_unit(random), high = 0.5 + 0.5 * bl_random_unit(random);
    double width = 0.25 * (1 + floor(32 * bl_random_unit(random)));
    double x = place(random, n, 48);
    double exact = reference(low, high, x, width);
    double error = fabs(bl_pulse_train_average(box, low, high, x + 0.5 * width, width) - exact);
    e->worst[PHASES][n] = fmax(e->worst[PHASES][n], error);
    error = fabs(bl_pulse_train_difference(low, high, x, width) - exact);
    e->worst[DOUBLES][n] = fmax(e->worst[DOUBLES][n], error);
    double law = 0.5 * DBL_EPSILON * (2 * x + x + width) / width + DBL_EPSILON;
    e->share = fmax(e->share, error / law);
    e->law[n] = fmax(e->law[n], law);
    e->law_of_floats[n] = fmax(e->law_of_floats[n], ldexp(law, 29));
    if (n < FLOATS) {
        x = place(random, n, 20);
        low = (double)(float)low;
        high = (double)(float)high;
        double got = (double)difference_in_float((float)low, (float)high, (float)x, (float)width);
        error = fabs(got - reference(low, high, x, width));
        e->worst[FLOATED][n] = fmax(e->worst[FLOATED][n], error);
    }
}

static void measure(bl_run *run, errors *e) {
    e->pulses = bl_run_count(run, 2000, 10000, 100000);
    for (int n = 0; n < EXPONENTS; n++) {
        bl_random random = bl_run_random(run, 500 + (uint64_t)n);
        e->distance[n] = n;
        for (size_t i = 0; i < e->pulses; i++)
            measure_one(e, n, &random);
    }
}

// --- the plot -----------------------------------------------------------------------------------

static void draw(bl_run *run, const errors *e) {
    static const char *const names[] = {"phases_db", "difference_db", "difference_in_float_db",
                                        "law_db", "law_of_floats_db"};
    static const char *const labels[] = {"by phases", "difference", "difference in float",
                                         "law of it", NULL};
    static const bl_ink inks[] = {BL_INK_MEASURED, BL_INK_THEORY, BL_INK_FOURTH, BL_INK_PLAIN,
                                  BL_INK_PLAIN};
    const double *from[] = {e->worst[PHASES], e->worst[DOUBLES], e->worst[FLOATED], e->law,
                            e->law_of_floats};
    static const char *const panel = "averages over 1/4 to 8 periods";
    static const bl_limit limit = {0, -48.13, "1/255"};
    double values[5][EXPONENTS];
    bl_line lines[5];
    for (int k = 0; k < 5; k++) {
        for (int n = 0; n < EXPONENTS; n++) {
            int shown = n < FLOATS || (k != 2 && k != 4);
            values[k][n] = shown ? 20 * log10(fmax(from[k][n], 1e-17)) : NAN;
        }
        lines[k] = (bl_line){names[k], values[k], labels[k], inks[k],
                             k < 3 ? BL_STROKE_LINE : BL_STROKE_DASHED};
    }
    bl_graph_draw(
        run,
        &(bl_graph){
            .name = "errors",
            .what = "largest error of the average of a pulse train, in dB of 1, and its law",
            .x_name = "log2_of_distance",
            .x = e->distance,
            .points = EXPONENTS,
            .lines = lines,
            .line_count = 5,
            .panels = &panel,
            .panel_count = 1,
            .plot = {.x = {.label = "log2 of the distance, periods", .to = LAST, .tick = 5},
                     .y = {.label = "largest error, dB of 1", .from = -340, .to = 20, .tick = 40},
                     .aspect = 0.5,
                     .limits = &limit,
                     .limit_count = 1},
            .alternative =
                "Largest error in decibels over the distance from the origin in powers of two. The "
                "difference of integrals rises by 6 dB for each doubling, along its law, in float "
                "from about -120 dB at the origin; the average by phases stays at about -300 dB."});
}

// --- claims -------------------------------------------------------------------------------------

// The text's macros for the pulse from the edge to 1 - edge, against the reference, near the
// origin: the largest error times the width, over the edge.
static double worst_of_text(int printed) {
    const double edge = 0.0625, width = 0.75;
    double worst = 0;
    for (double x = 0; x < 4; x += 1.0 / 1024) {
        double got = printed ? bl_pulse_train_printed(edge, x, width)
                             : bl_pulse_train_difference(edge, 1 - edge, x, width);
        worst = fmax(worst, fabs(got - reference(edge, 1 - edge, x, width)));
    }
    return worst;
}

static void claim(bl_run *run, const errors *e) {
    static const char sentence[] =
        "The difference of the integrals at both ends of the filter over its width is the average "
        "of the periodic pulse: the largest error.";
    bl_make_claim(run, section, sentence,
                  "as printed: max(0, frac - edge) rises on over the gap at the end of a period; "
                  "edge 1/16, width 3/4",
                  "", 0, 1e-12, bl_exactly(worst_of_text(1), 4096), "places");
    bl_make_claim(run, section, sentence,
                  "corrected: no more than 1 - 2 edge a period; edge 1/16, width 3/4", "", 0, 1e-12,
                  bl_exactly(worst_of_text(0), 4096), "places");
    double digits = 0;
    for (int n = 0; n < EXPONENTS; n++)
        digits = fmax(digits, e->worst[PHASES][n]);
    bl_make_claim(run, "bandlimit",
                  "The average by phases keeps its digits anywhere: the largest error.",
                  bl_run_text(run, "%zu pulses at each of %d distances up to 2^%d", e->pulses,
                              EXPONENTS, LAST + 1),
                  "", 0, 4e-15, bl_observed(digits, (double)e->pulses * EXPONENTS), "pulses");
    bl_make_claim(run, "bandlimit",
                  "The error of the difference is at most 2^-53 (2 |x| + |x + w|) / w + 2^-52: the "
                  "largest share of that.",
                  "the same pulses", "of the law", 0.1, 1,
                  bl_observed(e->share, (double)e->pulses * EXPONENTS), "pulses");
    bl_make_claim(run, "bandlimit",
                  "In float a few thousand periods are too far: the largest error, in steps of an "
                  "image of 8 bits.",
                  "distances from 8192 to 16384", "of 1/255", 0.5, INFINITY,
                  bl_observed(255 * e->worst[FLOATED][13], (double)e->pulses), "pulses");
}

static void run_figure(bl_run *run) {
    errors *e = bl_run_memory(run, 1, sizeof *e);
    measure(run, e);
    bl_run_setting(run, "pulses", bl_run_text(run, "%zu at each distance", e->pulses));
    draw(run, e);
    claim(run, e);
}

BL_FIGURE_DESCRIPTOR(pulse_far) = {
    .name = "pulse-far",
    .title = "Pulse trains far from the origin",
    .question = "How many digits has the average of a pulse train far from the origin?",
    .paper = "peachey2003, Example: Antialiased Brick Texture",
    .shows =
        "The largest error of the box-filtered pulse train, which bricks are made of, against the "
        "distance from the origin: as the difference of two values of the integral, in double and "
        "in float, and by phases, which are exact at any distance. Broken lines: the laws of the "
        "difference.",
    .run = run_figure};
