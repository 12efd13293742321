// SPDX-License-Identifier: MIT
//
// peachey-2.29: a signal, its samples, and what is made of them again; and what the sampling
// theorem says of it, up to and at half the sampling rate.
#include <math.h>

#include "reports/figures/estimates.h"

enum { SAMPLES = 32, STEPS = 16, DRAWN = SAMPLES * STEPS + 1 };

static const char section[] = "peachey2003, Signal Processing";

// Waves that repeat after SAMPLES units, the highest at 13/32 of the sampling rate.
static double band_limited(double x) {
    double t = 2 * M_PI * x / SAMPLES;
    return 0.5 * sin(2 * t + 0.4) + 0.35 * cos(5 * t + 1) + 0.25 * sin(9 * t) +
           0.2 * cos(13 * t + 2);
}

static double at_the_limit(double x) {
    return sin(M_PI * x);
}

static double linear(double (*signal)(double x), double x) {
    double cell = floor(x), t = x - cell;
    return (1 - t) * signal(cell) + t * signal(cell + 1);
}

// The sum of sincs at all samples of a signal that repeats: of each, sin(pi d) / (n tan(pi d / n)).
static double ideal(double (*signal)(double x), double x) {
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++) {
        double d = x - i;
        double weight = d == 0 ? 1 : sin(M_PI * d) / (SAMPLES * tan(M_PI * d / SAMPLES));
        sum += weight * signal(i);
    }
    return sum;
}

// The rms error between the samples.
static double error_of(double (*signal)(double x),
                       double (*rebuild)(double (*signal)(double x), double x)) {
    double squares = 0;
    size_t count = 0;
    for (size_t i = 0; i + 1 < DRAWN; i++) {
        double x = ((double)i + 0.5) / STEPS, error = rebuild(signal, x) - signal(x);
        squares += error * error;
        count++;
    }
    return sqrt(squares / (double)count);
}

static void draw(bl_run *run) {
    static double x[DRAWN], signal[DRAWN], lines[DRAWN], sincs[DRAWN], place[SAMPLES + 1],
        sample[SAMPLES + 1];
    for (size_t i = 0; i < DRAWN; i++) {
        x[i] = (double)i / STEPS;
        signal[i] = band_limited(x[i]);
        lines[i] = linear(band_limited, x[i]);
        sincs[i] = ideal(band_limited, x[i]);
    }
    for (size_t i = 0; i <= SAMPLES; i++) {
        place[i] = (double)i;
        sample[i] = band_limited((double)i);
    }
    const bl_column curves[] = {
        {"x", x, NULL}, {"signal", signal, NULL}, {"linear", lines, NULL}, {"ideal", sincs, NULL}};
    const bl_column points[] = {{"x", place, NULL}, {"sample", sample, NULL}};
    bl_run_csv(run, "curves", "the signal and what is made of its samples", curves, 4, DRAWN);
    bl_run_csv(run, "samples", "one a unit", points, 2, SAMPLES + 1);
    const bl_series sampled[] = {
        {BL_STROKE_LINE, BL_INK_MEASURED, "curves.csv", "x", "signal", NULL, "signal", 0},
        {BL_STROKE_POINTS, BL_INK_PLAIN, "samples.csv", "x", "sample", NULL, "samples", 0},
        {BL_STROKE_THIN, BL_INK_THEORY, "curves.csv", "x", "linear", NULL, "made of samples", 0}};
    const bl_series joined[] = {sampled[0], sampled[1], sampled[2]};
    const bl_series rebuilt[] = {
        sampled[0],
        sampled[1],
        {BL_STROKE_THIN, BL_INK_THEORY, "curves.csv", "x", "ideal", NULL, NULL, 0}};
    const bl_panel panels[] = {{"sampling", sampled, 2, NULL},
                               {"joined by lines", joined, 3, NULL},
                               {"each sample a sinc", rebuilt, 3, NULL}};
    const bl_plot plot = {.x = {"x, sampling intervals", 0, SAMPLES, 8, 0},
                          .y = {"value", -1.5, 1.5, 0.5, 0},
                          .panels = panels,
                          .panel_count = 3,
                          .aspect = 0.3};
    bl_run_plot(
        run, "sampling", &plot,
        "Three graphs of one wavy signal with dots at its samples: alone, with lines from dot to "
        "dot that cut its crests, and with a curve through the dots that lies on the signal.");
}

static void run_figure(bl_run *run) {
    bl_run_setting(run, "signal", "four waves of 2, 5, 9 and 13 cycles in 32 samples");
    draw(run);
    const double count = DRAWN - 1;
    bl_make_claim(run, section,
                  "A signal whose highest frequency is below half the sampling rate is rebuilt "
                  "from its samples: the rms error.",
                  "the highest at 13/32 of the rate, each sample a sinc", "of full scale 1", 0,
                  1e-12, bl_exactly(error_of(band_limited, ideal), count), "places");
    bl_make_claim(
        run, section,
        "That holds at half the sampling rate too (\"less than or equal\"): the rms error.",
        "a sine of exactly half the rate, whose samples are all 0", "of full scale 1", 0, 1e-12,
        bl_exactly(error_of(at_the_limit, ideal), count), "places");
    bl_make_claim(run, "bandlimit", "Lines from sample to sample do not rebuild it: the rms error.",
                  "the same signal", "of full scale 1", 0.01, 1,
                  bl_exactly(error_of(band_limited, linear), count), "places");
}

BL_FIGURE_DESCRIPTOR(peachey_2_29) = {
    .name = "peachey-2.29",
    .title = "Sampling and reconstruction",
    .question = "What can be made of samples again?",
    .paper = "peachey2003, fig. 2.29",
    .shows =
        "A signal of four waves below half the sampling rate: with its samples, with these joined "
        "by lines, and rebuilt by a sinc at each sample, as the sampling theorem says.",
    .run = run_figure};
