// SPDX-License-Identifier: MIT
//
// noise-extremes: the error of every noise's floats against its reference in double, from
// coordinates of 1e-30 to 1e18, and what it gives at the places where arithmetic breaks: cell
// boundaries, denormals, negative zero, NaN, infinity.
#include <math.h>

#include "core/random.h"
#include "noises/octaves/octaves.h"
#include "reports/figures/all_noises.h"
#include "reports/figures/estimates.h"

enum { LOWEST = -30, HIGHEST = 18, DECADES = HIGHEST - LOWEST + 1, PLACES = 128 };

// The largest error at places of the size 10^decade, every second one on a cell boundary of x.
static double largest_error(const bl_signal *signal, int decade, bl_random *random) {
    double at[BL_AXES][PLACES];
    float out[PLACES];
    double scale = pow(10, decade), worst = 0;
    for (int i = 0; i < PLACES; i++)
        for (int a = 0; a < BL_AXES; a++) {
            double size = scale * (1 + 3 * bl_random_unit(random));
            at[a][i] = bl_random_unit(random) < 0.5 ? -size : size;
            if (a == 0 && i % 2 && scale >= 1)
                at[a][i] = floor(at[a][i]);
        }
    bl_signal_points(signal, BL_COLUMNS(at), PLACES, out);
    for (int i = 0; i < PLACES; i++) {
        const double here[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        if (scale * 4 > bl_signal_domain(signal))
            return 0;
        double error = fabs((double)out[i] - bl_signal_value(signal, here));
        worst = error <= worst ? worst : error; // keeps NaN
    }
    return worst;
}

// --- where arithmetic breaks --------------------------------------------------------------------

// The number of places among `count` coordinates of one axis at which the noise does not do what it
// should: NaN where `want_nan`, else a number that the reference agrees with.
static double count_wrong(const bl_signal *signal, const double *coordinate, size_t count,
                          int want_nan) {
    double wrong = 0;
    for (unsigned axis = 0; axis < signal->dimensions; axis++)
        for (size_t i = 0; i < count; i++) {
            double at[BL_AXES] = {0.3, 0.7, 1.1, 2.9};
            float out;
            at[axis] = coordinate[i];
            bl_signal_points(signal, (const double *const[]){&at[0], &at[1], &at[2], &at[3]}, 1,
                             &out);
            double value = bl_signal_value(signal, at);
            if (!want_nan && fabs(coordinate[i]) >= bl_signal_domain(signal))
                continue; // beyond the domain of the finest octave of a sum
            wrong += want_nan ? !isnan(out) || !isnan(value) : !isfinite(out) || !isfinite(value);
        }
    return wrong;
}

// Whether -0 and 0 differ along any axis, in either path.
static double zeros_differ(const bl_signal *signal) {
    double wrong = 0;
    for (unsigned axis = 0; axis < signal->dimensions; axis++) {
        double at[2][BL_AXES] = {{0.3, 0.7, 1.1, 2.9}, {0.3, 0.7, 1.1, 2.9}}, value[2];
        float out[2];
        for (int s = 0; s < 2; s++) {
            at[s][axis] = s ? -0.0 : 0.0;
            bl_signal_points(signal,
                             (const double *const[]){&at[s][0], &at[s][1], &at[s][2], &at[s][3]}, 1,
                             &out[s]);
            value[s] = bl_signal_value(signal, at[s]);
        }
        wrong += value[0] != value[1] || out[0] != out[1];
    }
    return wrong;
}

static void claim_edges(bl_run *run, const bl_gallery *gallery) {
    static const double broken[] = {NAN, INFINITY, -INFINITY, 1e300, -1e19};
    static const double whole[] = {
        0,   5e-324, -5e-324, 2.2e-308,    1,     -1,   2147483648.0,  -2147483649.0,
        1e9, 1e15,   0x1p53,  -0x1p53 - 2, 1e-30, 1e18, 0.99999999999, -1e-17};
    enum { BROKEN = sizeof broken / sizeof *broken, WHOLE = sizeof whole / sizeof *whole };
    double no_nan = 0, no_number = 0, zeros = 0, places = 0;
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_signal *signal = gallery->signal[i];
        no_nan += count_wrong(signal, broken, BROKEN, 1);
        no_number += count_wrong(signal, whole, WHOLE, 0);
        zeros += zeros_differ(signal);
        places += signal->dimensions;
    }
    bl_make_claim(run, "bandlimit",
                  "NaN, infinity and coordinates beyond 2^62 give NaN, in floats and in double: "
                  "how often they do not.",
                  "all noises, all axes", "", 0, 0, bl_exactly(no_nan, places * BROKEN), "places");
    bl_make_claim(
        run, "bandlimit",
        "Denormals, cell boundaries, 2^31, 2^53 and 1e18 give numbers: how often they do not.",
        "all noises, all axes", "", 0, 0, bl_exactly(no_number, places * WHOLE), "places");
    bl_make_claim(run, "bandlimit", "Negative zero is zero: how often they differ.",
                  "all noises, all axes", "", 0, 0, bl_exactly(zeros, places), "places");
}

// --- clamped sums -------------------------------------------------------------------------------

enum { SUM_PLACES = 64 };

// How far a sum clamped to `width` is from the sum that is not, or with `gone` from one number,
// over places: NaN if any value is.
static double width_error(const bl_signal *sum, double width, int gone) {
    bl_random random = bl_random_seed(9, 0);
    double worst = 0, first = NAN;
    for (int i = 0; i < SUM_PLACES; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = 1e3 * (bl_random_unit(&random) - 0.5);
        double value = bl_octaves_value_for_width(sum, at, width);
        first = i ? first : value;
        double error = fabs(value - (gone ? first : bl_signal_value(sum, at)));
        worst = error <= worst ? worst : error;
    }
    return worst;
}

static void claim_widths(bl_run *run, const bl_gallery *gallery) {
    static const double none[] = {0, 1e-30, 5e-324}, all[] = {1e30, INFINITY}, bad[] = {NAN, -1};
    double kept = 0, lost = 0, numbers = 0, sums = 0;
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_signal *sum = gallery->signal[i];
        if (!bl_octaves_is_sum(sum))
            continue;
        sums++;
        for (size_t w = 0; w < sizeof none / sizeof *none; w++)
            kept += !(width_error(sum, none[w], 0) == 0);
        for (size_t w = 0; w < sizeof all / sizeof *all; w++)
            lost += !(width_error(sum, all[w], 1) == 0);
        for (size_t w = 0; w < sizeof bad / sizeof *bad; w++)
            numbers += !isnan(width_error(sum, bad[w], 1));
    }
    bl_make_claim(run, "bandlimit",
                  "A sum clamped to a width of 0, 1e-30 or the least denormal is the whole sum: "
                  "how often it is not.",
                  "all sums of octaves", "", 0, 0, bl_exactly(kept, 3 * sums), "widths");
    bl_make_claim(run, "bandlimit",
                  "A sum clamped to a width of 1e30 or infinity is one number, the mean of its "
                  "octaves: how often it is not.",
                  "all sums of octaves", "", 0, 0, bl_exactly(lost, 2 * sums), "widths");
    bl_make_claim(run, "bandlimit",
                  "A width that is NaN or negative gives NaN: how often it does not.",
                  "all sums of octaves", "", 0, 0, bl_exactly(numbers, 2 * sums), "widths");
}

// --- the figure ---------------------------------------------------------------------------------

// log10 of the largest errors, all decades of a noise after those of another; judges each noise.
static void measure(bl_run *run, const bl_gallery *gallery, double *values) {
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_signal *signal = gallery->signal[i];
        double *own = values + i * DECADES, worst = 0;
        bl_random random = bl_run_random(run, 5000 + i);
        bl_run_step(run, gallery->key[i]);
        for (int d = 0; d < DECADES; d++) {
            double error = largest_error(signal, LOWEST + d, &random);
            worst = error <= worst ? worst : error;
            own[d] = error > 0 ? log10(error) : NAN;
        }
        // The kernels may spend 32 halves of a unit in the last place of their range.
        double size = fmax(1, fmax(fabs(signal->facts.lower), fabs(signal->facts.upper)));
        bl_make_claim(
            run, "bandlimit",
            "The floats are within 32 x 2^-24 of the reference, times the range where that is "
            "above 1, at all coordinates from 1e-30 to 1e18: the largest error over that limit.",
            gallery->label[i], "", 0, 1,
            bl_observed(worst / (32 * 0x1p-24 * size), PLACES * (double)DECADES), "places");
    }
}

static void draw_errors(bl_run *run, const bl_gallery *gallery) {
    double decade[DECADES], *values = bl_run_memory(run, gallery->count * DECADES, sizeof *values);
    for (int d = 0; d < DECADES; d++)
        decade[d] = LOWEST + d;
    measure(run, gallery, values);
    const bl_limit half_ulp = {0, -24 * 0.30102999566398120, NULL};
    const bl_graph graph = {
        .name = "errors",
        .what =
            "log10 of the largest error against the double reference, by log10 of the coordinates",
        .alternative =
            "The largest error of every noise against its reference, a point for each decade of "
            "the coordinates: a few units in the last place of a float (the dashed line is 2^-24, "
            "half a unit of 1), as large near the origin as far from it. No error at all has no "
            "point.",
        .x_name = "decade",
        .x = decade,
        .points = DECADES,
        .plot.x = {.label = "log10 of the coordinates", .from = LOWEST, .to = HIGHEST, .tick = 12},
        .plot.y = {.label = "log10 of the largest error", .from = -9, .to = -4, .tick = 1},
        .plot.aspect = 0.6,
        .plot.limits = &half_ulp,
        .plot.limit_count = 1};
    bl_gallery_draw_curves(run, gallery, values, BL_STROKE_POINTS, "largest of 128 places", &graph);
}

static void run_figure(bl_run *run) {
    const bl_gallery gallery = bl_all_noises_open(run);
    draw_errors(run, &gallery);
    claim_edges(run, &gallery);
    claim_widths(run, &gallery);
}

BL_FIGURE_DESCRIPTOR(noise_extremes) = {
    .name = "noise-extremes",
    .title = "Every noise at the extremes",
    .question = "How large is the error of the floats, from 1e-30 to 1e18?",
    .paper = "bandlimit",
    .shows =
        "The largest difference between the float path and the reference in double, over 128 "
        "places for each decade of the coordinates, half of them on cell boundaries. The claims "
        "hold every noise to its tolerance, and to what it states of NaN, infinity, denormals and "
        "negative zero.",
    .run = run_figure};
