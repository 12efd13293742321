// SPDX-License-Identifier: MIT
//
// What the text says of the six noises at the lattice points and between them.
//
// Values at the lattice points use the point path in double. One-sided derivatives at a lattice
// point come from four points h = 1/4 apart within the cell, which is exact for a cubic:
//   f'(0)  = (-11 f0 + 18 f1 - 9 f2 + 2 f3) / (6 h),  f''(0) = (2 f0 - 5 f1 + 4 f2 - f3) / h^2.
#include "reports/figures/six_values.h"

#include <math.h>

#include "spectra/histogram.h"

enum { LATTICE_SPAN = 100000 }; // lattice points are drawn from a cube of this size

static const char points[] = "lattice points", cells[] = "cells", planes[] = "crossings";

// --- at the lattice points ----------------------------------------------------------------------

static double lattice_coordinate(bl_random *random) {
    return floor((bl_random_unit(random) - 0.5) * LATTICE_SPAN);
}

// The mean size of a uniform number on [-1, 1] is 1/2, its variance 1/3 - 1/4 = 1/12. The 95 %
// interval of n of them leaves these limits around 1/2 once in a million runs.
static double mean_size_limit(double n) {
    const double error_rate = 1e-6;
    double reach = bl_normal_quantile(1 - error_rate / 2) + bl_normal_quantile(0.975);
    return reach * sqrt(1.0 / 12 / n);
}

static void claim_at_points(bl_run *run, int noise, double largest, bl_estimate mean) {
    const char *reading = bl_run_text(run, "%s, at random lattice points", bl_six_names[noise]);
    double limit = mean_size_limit(mean.samples);
    if (noise == BL_GNOISE) {
        // All eight gradients meet distances of 0 or weights of 0 there: no rounding, no scatter.
        bl_estimate size =
            largest == 0 ? bl_exactly(0, mean.samples) : bl_observed(largest, mean.samples);
        bl_make_claim(run, "peachey2003, Gradient Noise",
                      "Gradient noise is zero at every lattice point: the largest size there.",
                      reading, "", 0, 1e-12, size, points);
        bl_make_claim(run, "bandlimit",
                      "Our gnoise is zero at every lattice point: the largest size there.", reading,
                      "", 0, 1e-12, size, points);
    }
    // 0.05 is a tenth of the mean size of vnoise: far from the zeros that are to go away.
    if (noise == BL_VGNOISE)
        bl_make_claim(run, "peachey2003, Value-Gradient Noise",
                      "Adding value noise to gradient noise takes its regular zeros away: the mean "
                      "size at lattice points.",
                      reading, "", 0.05, INFINITY, mean, points);
    if (noise == BL_VNOISE)
        bl_make_claim(run, "bandlimit",
                      "Value noise is not zero at the lattice points but takes their random "
                      "numbers, uniform on [-1, 1], whose mean size is 1/2.",
                      reading, "", 0.5 - limit, 0.5 + limit, mean, points);
}

static void claim_lattice_values(bl_run *run, const bl_gallery *six, size_t count, double *values) {
    for (int i = 0; i < BL_SIX; i++) {
        bl_random random = bl_run_random(run, 1235);
        double largest = 0;
        for (size_t k = 0; k < count; k++) {
            double at[BL_AXES] = {0};
            for (int a = 0; a < 3; a++)
                at[a] = lattice_coordinate(&random);
            values[k] = fabs(bl_signal_value(six->signal[i], at));
            largest = fmax(largest, values[k]);
        }
        claim_at_points(run, i, largest, bl_mean_estimate(values, count, 0.95));
    }
}

// --- continuity ---------------------------------------------------------------------------------

typedef struct slopes {
    double first, second;
} slopes;

// One-sided derivatives in x at a point, from the side that `direction` (+1 or -1) names.
static slopes slopes_at(const bl_signal *signal, const double at[BL_AXES], double direction) {
    const double h = 0.25;
    double f[4];
    for (int i = 0; i < 4; i++) {
        const double there[BL_AXES] = {at[0] + direction * h * i, at[1], at[2], at[3]};
        f[i] = bl_signal_value(signal, there);
    }
    return (slopes){direction * (-11 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / (6 * h),
                    (2 * f[0] - 5 * f[1] + 4 * f[2] - f[3]) / (h * h)};
}

static void claim_continuity(bl_run *run, const bl_signal *vnoise, size_t count, double *first,
                             double *second) {
    static const char sentence[] =
        "The cubic Catmull-Rom interpolation of vnoise keeps the first and the second derivative "
        "continuous: the mean jump across a lattice plane.";
    for (int on_edge = 1; on_edge >= 0; on_edge--) {
        bl_random random = bl_run_random(run, 2235);
        for (size_t k = 0; k < count; k++) {
            double at[BL_AXES] = {0};
            for (int a = 0; a < 3; a++)
                at[a] =
                    lattice_coordinate(&random) + (on_edge || a == 0 ? 0 : bl_random_unit(&random));
            slopes before = slopes_at(vnoise, at, -1), after = slopes_at(vnoise, at, 1);
            first[k] = fabs(after.first - before.first);
            second[k] = fabs(after.second - before.second);
        }
        const char *line = on_edge ? "on a lattice edge" : "at a random place";
        // Rounding: values of size 1 with errors of some 1e-15, divided by h^2 = 1/16.
        bl_make_claim(run, "peachey2003, Value Noise", sentence,
                      bl_run_text(run, "first derivative, along a line %s", line), "per cell", 0,
                      1e-9, bl_mean_estimate(first, count, 0.95), planes);
        bl_make_claim(run, "peachey2003, Value Noise", sentence,
                      bl_run_text(run, "second derivative, along a line %s", line),
                      "per cell squared", 0, 1e-9, bl_mean_estimate(second, count, 0.95), planes);
    }
}

// --- changes of direction -----------------------------------------------------------------------

// A gradient near zero puts its turning point close to a lattice point, so the samples of a cell
// crowd there: 1/128 apart, and at 2^-8, 2^-9, ... 2^-30 from both ends. A turning point in 10^9
// lies closer than that.
enum { EVEN = 128, CROWD = 23, IN_CELL = EVEN + 1 + 2 * CROWD };

static void place_samples(double offset[IN_CELL]) {
    int n = 0;
    offset[n++] = 0;
    for (int k = CROWD - 1; k >= 0; k--)
        offset[n++] = ldexp(1, -8 - k);
    for (int i = 1; i < EVEN; i++)
        offset[n++] = (double)i / EVEN;
    for (int k = 0; k < CROWD; k++)
        offset[n++] = 1 - ldexp(1, -8 - k);
    offset[n] = 1;
}

// The turning points within one cell along x; flat steps keep the direction before them.
static int turns_in_cell(const bl_signal *signal, const double corner[3],
                         const double offset[IN_CELL]) {
    double last = 0, direction = 0;
    int turns = 0;
    for (int i = 0; i < IN_CELL; i++) {
        const double at[BL_AXES] = {corner[0] + offset[i], corner[1], corner[2], 0};
        double value = bl_signal_value(signal, at), step = i ? value - last : 0;
        turns += step * direction < 0;
        direction = step != 0 ? step : direction;
        last = value;
    }
    return turns;
}

static void claim_turns(bl_run *run, const bl_signal *gnoise, size_t count) {
    static const char sentence[] =
        "Gradient noise changes direction at least once in every lattice step, because of its "
        "zeros: the fewest turning points observed in a cell.";
    double offset[IN_CELL];
    place_samples(offset);
    for (int on_edge = 1; on_edge >= 0; on_edge--) {
        bl_random random = bl_run_random(run, 3235);
        int fewest = IN_CELL;
        for (size_t k = 0; k < count; k++) {
            double at[3];
            for (int a = 0; a < 3; a++)
                at[a] =
                    lattice_coordinate(&random) + (on_edge || a == 0 ? 0 : bl_random_unit(&random));
            int turns = turns_in_cell(gnoise, at, offset);
            fewest = turns < fewest ? turns : fewest;
        }
        bl_make_claim(run, "peachey2003, Gradient Noise", sentence,
                      bl_run_text(run, "gnoise, along a %s, observed over %zu cells",
                                  on_edge ? "lattice edge" : "line at a random place", count),
                      "a cell", 1, INFINITY, bl_observed(fewest, (double)count), cells);
    }
}

// --- the range of other interpolations ----------------------------------------------------------

static void claim_range(bl_run *run, size_t samples) {
    static const char *const kernels[] = {"catmull-rom", "bspline2", "bspline3"};
    const bl_histogram *h[3];
    const bl_histogram_settings settings = bl_run_histogram_settings(run, samples);
    for (int i = 0; i < 3; i++)
        h[i] = bl_run_histogram(
            run, bl_run_seeded_signal(run, bl_run_text(run, "vnoise:interp=%s", kernels[i])),
            &settings);
    for (int i = 1; i < 3; i++) {
        bl_estimate ratio = bl_ratio_db(h[i]->variance, h[0]->variance);
        const char *sentence =
            "B-splines approximate the lattice numbers and so have a narrower range than the "
            "Catmull-Rom spline.";
        bl_make_claim(
            run, "peachey2003, Value Noise", sentence,
            bl_run_text(run, "%s, variance against Catmull-Rom, at random places", kernels[i]),
            "dB", -INFINITY, 0, ratio, "batches");
        bl_make_claim(run, "peachey2003, Value Noise", sentence,
                      bl_run_text(run, "%s, observed range over that of Catmull-Rom", kernels[i]),
                      "", 0, 1,
                      bl_observed((h[i]->maximum - h[i]->minimum) / (h[0]->maximum - h[0]->minimum),
                                  (double)h[i]->count),
                      "values");
    }
}

void bl_six_values_claim(bl_run *run, const bl_gallery *six) {
    size_t count = bl_run_count(run, 2000, 20000, 1000000);
    double *values = bl_run_memory(run, 2 * count, sizeof *values);
    bl_run_setting(
        run, "points of the claims",
        bl_run_text(run, "%zu, drawn from a cube of %d cells a side", count, LATTICE_SPAN));
    bl_run_step(run, "values at lattice points");
    claim_lattice_values(run, six, count, values);
    claim_turns(run, six->signal[BL_GNOISE], count / 10);
    claim_continuity(run, six->signal[BL_VNOISE], count, values, values + count);
    bl_run_step(run, "ranges");
    claim_range(run, bl_run_count(run, 1e5, 2e6, 1e8));
}
