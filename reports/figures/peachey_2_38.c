// SPDX-License-Identifier: MIT
//
// peachey-2.38: slices of fractalsum and turbulence, and what the text says of the absolute value:
// it doubles the peaks, folds the function at its zeros, and makes the changes sharper.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

enum { CELLS = 4, PIXELS = 512, SPAN = 100000 };

static const char section[] = "peachey2003, Spectral Synthesis";

static const char *const texts[] = {"fractalsum:min=1,max=64", "turbulence:min=1,max=64"};
enum { FRACTALSUM, TURBULENCE, SUMS };

static void draw(bl_run *run, const bl_gallery *gallery) {
    bl_random random = bl_run_random(run, 238);
    double z = 0.25 + 0.5 * bl_random_unit(&random);
    bl_run_setting(
        run, "slice",
        bl_run_text(run, "z = %.6f, %d x %d cells of the lowest octave", z, CELLS, CELLS));
    const bl_gallery_slices slices = {
        .name = "random",
        .title = "What do a fractal sum and turbulence look like in a slice?",
        .alternative =
            "Two grey slices side by side: the fractal sum is like clouds; turbulence is lumpy, "
            "with dark creases where an octave passes zero.",
        .origin = {0, 0, z, 0},
        .length = CELLS,
        .pixels = PIXELS,
        .unit = "cells of the lowest octave"};
    bl_gallery_draw_slices(run, gallery, &slices);
}

// --- peaks --------------------------------------------------------------------------------------

// The maxima of a line with `count` samples.
static double count_peaks(const float *row, size_t count) {
    double peaks = 0;
    for (size_t i = 1; i + 1 < count; i++)
        peaks += row[i] > row[i - 1] && row[i] >= row[i + 1];
    return peaks;
}

enum { LINE = 4096 };

// The largest change between neighbours over the mean change: how sharp the sharpest is.
static double sharpest(const float *row, size_t count) {
    double largest = 0, sum = 0;
    for (size_t i = 0; i + 2 < count; i++) {
        double bend = fabs((double)row[i] - 2 * (double)row[i + 1] + (double)row[i + 2]);
        largest = fmax(largest, bend);
        sum += bend;
    }
    return largest / (sum / (double)(count - 2));
}

// A number of each of `lines` random lines of both sums, at the same places.
static void over_lines(const bl_run *run, const bl_signal *const signal[SUMS], double step_length,
                       size_t lines, double (*number)(const float *row, size_t count),
                       double *out[SUMS]) {
    float row[LINE];
    bl_random random = bl_run_random(run, 2238);
    for (size_t k = 0; k < lines; k++) {
        double start[BL_AXES] = {0};
        for (int a = 0; a < 3; a++)
            start[a] = SPAN * (bl_random_unit(&random) - 0.5);
        const double step[BL_AXES] = {step_length, 0, 0, 0};
        for (int s = 0; s < SUMS; s++) {
            bl_signal_row(signal[s], start, step, LINE, row);
            out[s][k] = number(row, LINE);
        }
    }
}

// --- creases ------------------------------------------------------------------------------------

// The slopes on both sides of a zero of one octave of noise, found by bisection along x: the
// absolute value turns one of them round.
static double slope_jump(const bl_signal *signal, const bl_signal *basis, bl_random *random) {
    const double h = 1e-6;
    for (;;) {
        double at[BL_AXES] = {0}, left[BL_AXES], right[BL_AXES];
        for (int a = 0; a < 3; a++)
            at[a] = SPAN * (bl_random_unit(random) - 0.5);
        for (int a = 0; a < BL_AXES; a++)
            left[a] = right[a] = at[a];
        right[0] += 0.5;
        double sign = bl_signal_value(basis, left);
        if (sign * bl_signal_value(basis, right) >= 0)
            continue;
        for (int i = 0; i < 60; i++) {
            at[0] = (left[0] + right[0]) / 2;
            if (sign * bl_signal_value(basis, at) > 0)
                left[0] = at[0];
            else
                right[0] = at[0];
        }
        double here = bl_signal_value(signal, at);
        left[0] = at[0] - h;
        right[0] = at[0] + h;
        return fabs((bl_signal_value(signal, right) - here) -
                    (here - bl_signal_value(signal, left))) /
               h;
    }
}

static void claim_creases(bl_run *run, double *values, size_t count) {
    const bl_signal *basis = bl_run_seeded_signal(run, "fractalsum:min=1,max=2");
    const bl_signal *folded = bl_run_seeded_signal(run, "turbulence:min=1,max=2");
    for (int s = 0; s < SUMS; s++) {
        bl_random random = bl_run_random(run, 3238);
        for (size_t k = 0; k < count; k++)
            values[k] = slope_jump(s == TURBULENCE ? folded : basis, basis, &random);
        // Finite differences of a C1 function over h = 1e-6 leave h times its second derivative.
        bl_make_claim(run, section,
                      s == TURBULENCE ? "The absolute value folds the function at its zeros, where "
                                        "its derivative jumps: the mean jump of the slope there."
                                      : "Without the absolute value the derivative does not jump "
                                        "at the zeros: the mean jump of the slope there.",
                      s == TURBULENCE ? "turbulence of one octave" : "fractalsum of one octave",
                      "per cell", s == TURBULENCE ? 0.1 : 0, s == TURBULENCE ? INFINITY : 1e-4,
                      bl_mean_estimate(values, count, 0.95), "zeros along lines");
    }
}

static void claim_lines(bl_run *run) {
    size_t lines = bl_run_count(run, 64, 1024, 65536);
    double *values = bl_run_memory(run, (SUMS + 1) * lines, sizeof *values);
    double *own[SUMS] = {values, values + lines};
    for (int octaves = 1; octaves <= 6; octaves += 5) {
        const char *const sums[SUMS] = {bl_run_text(run, "fractalsum:min=1,max=%d", 1 << octaves),
                                        bl_run_text(run, "turbulence:min=1,max=%d", 1 << octaves)};
        const bl_signal *const signal[SUMS] = {bl_run_seeded_signal(run, sums[0]),
                                               bl_run_seeded_signal(run, sums[1])};
        const char *reading = bl_run_text(run, "%d octave%s, along lines at random places", octaves,
                                          octaves > 1 ? "s" : "");
        over_lines(run, signal, octaves == 1 ? 1.0 / 64 : 1.0 / 512, lines, count_peaks, own);
        bl_make_claim(run, section,
                      "The absolute value doubles the number of peaks, because the troughs become "
                      "peaks: peaks of turbulence over those of the fractal sum.",
                      reading, "", 1.9, 2.1,
                      bl_ratio_estimate(own[TURBULENCE], own[FRACTALSUM], lines, 0.95), "lines");
        over_lines(run, signal, octaves == 1 ? 1.0 / 64 : 1.0 / 512, lines, sharpest, own);
        bl_make_claim(run, section,
                      "Turbulence has sharper changes in value: the sharpest bend of a line over "
                      "its mean bend, turbulence against the fractal sum.",
                      reading, "", 1, INFINITY,
                      bl_ratio_estimate(own[TURBULENCE], own[FRACTALSUM], lines, 0.95), "lines");
    }
    claim_creases(run, values, lines);
}

static void run_figure(bl_run *run) {
    const bl_gallery gallery = bl_gallery_open(run, texts, SUMS);
    draw(run, &gallery);
    claim_lines(run);
}

static const bl_term terms[] = {
    {"peak",
     "a maximum along a line, between two samples a 64th of a cell of the highest octave apart or "
     "less"},
    {"bend", "the size of the second difference of three neighbouring samples"},
    {0}};

BL_FIGURE_DESCRIPTOR(peachey_2_38) = {
    .name = "peachey-2.38",
    .title = "Slices of fractalsum and turbulence",
    .question = "What does the absolute value do to a sum of octaves?",
    .paper = "peachey2003, fig. 2.38",
    .terms = terms,
    .shows =
        "Two slices through six octaves of gradient noise, whose amplitudes fall as 1/f: the plain "
        "sum, and the sum of the absolute values, which is never negative. Both share one scale of "
        "grey.",
    .run = run_figure};
