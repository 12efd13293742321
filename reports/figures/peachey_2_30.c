// SPDX-License-Identifier: MIT
//
// peachey-2.30: a sine that varies too fast for its samples, the alias that they show, and the
// frequency of the alias, predicted and measured.
#include <math.h>
#include <stdlib.h>

#include "core/fft.h"
#include "reports/figures/estimates.h"
#include "spectra/window.h"

enum { LENGTH = 16, STEPS = 32, DRAWN = LENGTH * STEPS + 1, SAMPLES = 1024, MOST_WAVES = 512 };

static const char section[] = "peachey2003, Signal Processing";
static const double shown = 0.85; // cycles per sample

static double predicted(double frequency) {
    return fabs(frequency - nearbyint(frequency));
}

// The strongest frequency of the samples of a sine, in cycles per sample, to half a bin, and their
// mean square over that of the sine.
static void measure(bl_run *run, double frequency, double phase, double *strongest,
                    double *energy) {
    const bl_fft_shape shape = {.kind = BL_FFT_REAL,
                                .precision = BL_FFT_DOUBLE,
                                .dims = 1,
                                .size = {SAMPLES},
                                .threads = 1};
    const bl_fft *plan;
    bl_run_must(run, bl_fft_plan(&shape, &plan, bl_run_message(run)));
    double *buffer = bl_run_keep(run, bl_fft_buffer(bl_fft_bytes(&shape)), free);
    double window[SAMPLES], most = 0;
    bl_window_fill(BL_WINDOW_BLACKMAN_HARRIS, SAMPLES, window);
    *energy = 0;
    for (int i = 0; i < SAMPLES; i++) {
        double sample = sin(2 * M_PI * remainder(frequency * i, 1) + phase);
        *energy += 2 * sample * sample / SAMPLES;
        buffer[i] = window[i] * sample;
    }
    bl_fft_run(plan, buffer);
    for (int k = 0; k <= SAMPLES / 2; k++) {
        double power = hypot(buffer[2 * k], buffer[2 * k + 1]);
        if (power > most) {
            most = power;
            *strongest = (double)k / SAMPLES;
        }
    }
    bl_run_release(run, buffer);
}

static void draw_signal(bl_run *run) {
    static double x[DRAWN], signal[DRAWN], alias[DRAWN], place[LENGTH + 1], sample[LENGTH + 1];
    for (size_t i = 0; i < DRAWN; i++) {
        x[i] = (double)i / STEPS;
        signal[i] = sin(2 * M_PI * shown * x[i]);
        alias[i] = sin(2 * M_PI * (shown - nearbyint(shown)) * x[i]);
    }
    for (size_t i = 0; i <= LENGTH; i++) {
        place[i] = (double)i;
        sample[i] = sin(2 * M_PI * shown * (double)i);
    }
    const bl_column curves[] = {{"x", x, NULL}, {"signal", signal, NULL}, {"alias", alias, NULL}};
    const bl_column points[] = {{"x", place, NULL}, {"sample", sample, NULL}};
    bl_run_csv(run, "signal", "a sine and its alias", curves, 3, DRAWN);
    bl_run_csv(run, "samples", "one a unit", points, 2, LENGTH + 1);
    const bl_series series[] = {
        {BL_STROKE_LINE, BL_INK_MEASURED, "signal.csv", "x", "signal", NULL, "signal", 0},
        {BL_STROKE_LINE, BL_INK_THEORY, "signal.csv", "x", "alias", NULL, "alias", 0},
        {BL_STROKE_POINTS, BL_INK_PLAIN, "samples.csv", "x", "sample", NULL, "samples", 0}};
    const bl_panel panel = {"0.85 cycles per sample", series, 3, NULL};
    const bl_plot plot = {.title = "What do too few samples of a sine look like?",
                          .x = {"x, sampling intervals", 0, LENGTH, 2, 0},
                          .y = {"value", -1.2, 1.2, 0.5, 0},
                          .panels = &panel,
                          .panel_count = 1,
                          .aspect = 0.35};
    bl_run_plot(run, "alias", &plot,
                "A fast sine, dots at its samples, and a slow sine through the same dots.");
}

typedef struct folding {
    size_t count;
    double frequency[MOST_WAVES], alias[MOST_WAVES], expected[MOST_WAVES];
    double largest_miss, highest, least_energy, most_energy;
} folding;

static void fold(bl_run *run, folding *f) {
    bl_random random = bl_run_random(run, 230);
    *f = (folding){.count = bl_run_count(run, 128, 512, 512), .least_energy = INFINITY};
    for (size_t i = 0; i < f->count; i++) {
        double energy = 0;
        f->frequency[i] = 3 * ((double)i + bl_random_unit(&random)) / (double)f->count;
        f->expected[i] = predicted(f->frequency[i]);
        measure(run, f->frequency[i], 2 * M_PI * bl_random_unit(&random), &f->alias[i], &energy);
        f->largest_miss = fmax(f->largest_miss, fabs(f->alias[i] - f->expected[i]));
        f->highest = fmax(f->highest, f->alias[i]);
        if (f->expected[i] < 8.0 / SAMPLES || f->expected[i] > 0.5 - 8.0 / SAMPLES)
            continue; // less than a few cycles, or beats: their mean square is that of a part
        f->least_energy = fmin(f->least_energy, energy);
        f->most_energy = fmax(f->most_energy, energy);
    }
}

static void draw_folding(bl_run *run, const folding *f) {
    const bl_column columns[] = {{"frequency_cycles_per_sample", f->frequency, NULL},
                                 {"measured_cycles_per_sample", f->alias, NULL},
                                 {"predicted_cycles_per_sample", f->expected, NULL}};
    bl_run_csv(run, "folding", "sines and where their samples show them", columns, 3, f->count);
    const bl_series series[] = {
        {BL_STROKE_LINE, BL_INK_THEORY, "folding.csv", "frequency_cycles_per_sample",
         "predicted_cycles_per_sample", NULL, "predicted", 0},
        {BL_STROKE_POINTS, BL_INK_MEASURED, "folding.csv", "frequency_cycles_per_sample",
         "measured_cycles_per_sample", NULL, "measured", 0}};
    const bl_limit limits[] = {{1, 0.5, "half the rate"}};
    const bl_panel panel = {"sines of random frequencies and phases", series, 2, NULL};
    const bl_plot plot = {.title = "At which frequency do samples show a sine?",
                          .x = {"frequency of the sine, cycles per sample", 0, 3, 0.5, 0},
                          .y = {"seen, cycles per sample", 0, 0.6, 0.1, 0},
                          .panels = &panel,
                          .panel_count = 1,
                          .aspect = 0.4,
                          .limits = limits,
                          .limit_count = 1};
    bl_run_plot(run, "folding", &plot,
                "A zigzag between 0 and one half: up with the frequency of the sine to half the "
                "sampling rate, down to 0 at the rate, and so on; the measured points lie on it.");
}

static void run_figure(bl_run *run) {
    folding f;
    double alias = NAN, energy;
    bl_run_setting(run, "sine", bl_run_text(run, "%g cycles per sample", shown));
    draw_signal(run);
    fold(run, &f);
    draw_folding(run, &f);
    measure(run, shown, 0, &alias, &energy);
    const double bin = 1.0 / SAMPLES, waves = (double)f.count;
    bl_make_claim(run, "bandlimit",
                  "A sine of 0.85 cycles per sample shows as its distance from the nearest whole "
                  "frequency, 0.15.",
                  "the strongest of 1024 samples, to half a bin", "cycles per sample",
                  predicted(shown) - bin, predicted(shown) + bin, bl_observed(alias, SAMPLES),
                  "samples");
    bl_make_claim(run, "bandlimit",
                  "This is true of any sine: the largest difference between the predicted and the "
                  "measured frequency.",
                  "sines of 0 to 3 cycles per sample", "cycles per sample", 0, bin,
                  bl_observed(f.largest_miss, waves), "sines");
    bl_make_claim(
        run, section,
        "The frequencies that samples show do not exceed half the sampling rate: the highest.",
        "sines of 0 to 3 cycles per sample", "cycles per sample", 0, 0.5,
        bl_observed(f.highest, waves), "sines");
    bl_make_claim(
        run, section,
        "The energy beyond half the sampling rate does not disappear: the mean square of the "
        "samples over that of their sine, the least of all sines.",
        "the same, except for those that fold to within 8 cycles of 0 or of half the rate", "",
        0.95, 1.05, bl_observed(f.least_energy, waves), "sines");
}

BL_FIGURE_DESCRIPTOR(peachey_2_30) = {
    .name = "peachey-2.30",
    .title = "A sampled sine and its alias",
    .question = "Where do samples show what they cannot follow?",
    .paper = "peachey2003, fig. 2.30",
    .shows =
        "A sine of 0.85 cycles per sample with the slow sine that has the same samples; and for "
        "sines of any frequency where their samples show them, predicted and measured.",
    .run = run_figure};
