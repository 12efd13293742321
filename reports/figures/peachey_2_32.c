// SPDX-License-Identifier: MIT
//
// peachey-2.32: a step, the box that runs over it, and the ramp that the average makes of it.
#include <math.h>

#include "filters/filter.h"
#include "reports/figures/estimates.h"

static const char section[] = "peachey2003, Analytic Prefiltering";

enum { STEPS = 480, COUNTED = 20000 };
static const double edge = 0.55, width = 0.3, box_at = 0.38; // b, w and the x that is drawn

// The text's box stands on [x, x + w]: that of the registry, half a width further.
static double boxstep(double x) {
    return bl_filter_find("box")->step((x + 0.5 * width - edge) / width);
}

// The share of so many points of [x, x + w] at which the step is 1: no formula at all.
static double counted(double x) {
    int ones = 0;
    for (int i = 0; i < COUNTED; i++)
        ones += x + width * (i + 0.5) / COUNTED >= edge;
    return (double)ones / COUNTED;
}

static void draw(bl_run *run) {
    double x[STEPS + 1], step[STEPS + 1], box[STEPS + 1], ramp[STEPS + 1];
    for (int i = 0; i <= STEPS; i++) {
        x[i] = (double)i / STEPS;
        step[i] = x[i] >= edge;
        box[i] = x[i] >= box_at && x[i] <= box_at + width ? 0.5 : 0;
        ramp[i] = boxstep(x[i]);
    }
    const bl_column columns[] = {
        {"x", x, NULL}, {"step", step, NULL}, {"box", box, NULL}, {"boxstep", ramp, NULL}};
    bl_run_csv(run, "steps", "a step, a box and the average of one under the other", columns, 4,
               STEPS + 1);
    static const char file[] = "steps.csv";
    const bl_series before[] = {
        {BL_STROKE_LINE, BL_INK_PLAIN, file, "x", "step", NULL, "step(b, x)", 0},
        {BL_STROKE_LINE, BL_INK_FOURTH, file, "x", "box", NULL, "filter, not to scale", 0},
        {BL_STROKE_LINE, BL_INK_MEASURED, file, "x", "boxstep", NULL, "boxstep(a, b, x)", 1 << 20}};
    const bl_series after[] = {
        {BL_STROKE_DASHED, BL_INK_PLAIN, file, "x", "step", NULL, NULL, 0},
        {BL_STROKE_LINE, BL_INK_MEASURED, file, "x", "boxstep", NULL, "boxstep(a, b, x)", 0}};
    const bl_panel panels[] = {{"a step and the box from x to x + w", before, 3, NULL},
                               {"the average over the box that begins at x", after, 2, NULL}};
    const bl_limit limits[] = {{1, edge - width, "a = b - w"}, {1, edge, "b"}};
    const bl_plot plot = {.x = {.label = "x", .to = 1, .tick = 0.2},
                          .y = {.label = "value", .from = -0.1, .to = 1.2, .tick = 0.2},
                          .panels = panels,
                          .panel_count = 2,
                          .columns = 2,
                          .aspect = 0.6,
                          .limits = limits,
                          .limit_count = 2};
    bl_run_plot(
        run, "steps", &plot,
        "Left a step from 0 to 1 at b with a box from x to x + w that straddles it; right the "
        "average over the box: 0 up to a = b - w, a straight line to 1 at b, and 1 from there on.");
}

static void claim_shape(bl_run *run) {
    double off = 0, lowest = 1, line = 0;
    for (int i = 0; i <= STEPS; i++) {
        double x = (double)i / STEPS;
        off = fmax(off, fabs(boxstep(x) - counted(x)));
        if (x >= edge)
            lowest = fmin(lowest, boxstep(x));
        if (x >= edge - width && x <= edge)
            line = fmax(line, fabs(boxstep(x) - (x - edge + width) / width));
    }
    bl_make_claim(run, section,
                  "The value of boxstep is the area under the step within the box: the largest "
                  "difference to a count of points.",
                  bl_run_text(run, "%d points in each of %d boxes", COUNTED, STEPS + 1), "", 0,
                  1.0 / COUNTED, bl_exactly(off, STEPS + 1), "boxes");
    bl_make_claim(run, section,
                  "boxstep is a linear ramp from 0 at a to 1 at b, with the slope 1/w: the largest "
                  "difference to that line.",
                  "between a and b", "", 0, 1e-15, bl_exactly(line, STEPS + 1), "places");
    bl_make_claim(run, section,
                  "When the entire filter is left of b, that is, x >= b (as printed; it should be "
                  "x < a), the value is 0: the lowest value from b on.",
                  "as printed", "", 0, 0, bl_exactly(lowest, STEPS + 1), "places");
    bl_make_claim(run, section,
                  "When the entire filter is left of b, the value is 0: the value just below a.",
                  "corrected: x + w < b", "", 0, 0, bl_exactly(boxstep(edge - width - 1e-9), 1),
                  "place");
}

// A wave of steps up and down, sampled once a width: the power of its harmonics above the Nyquist
// frequency, which the samples show as others, with the response of the box and without. The
// harmonics left out add 1e-5 of what is counted.
static double alias_of_steps(const bl_filter *filter, double period) {
    double power = 0;
    for (double n = 1; n < 1e5 * period; n += 2) {
        double amplitude = 2 / (M_PI * n), frequency = n / period;
        double passed = filter ? filter->response(frequency) : 1;
        if (frequency > 0.5)
            power += 0.5 * amplitude * amplitude * passed * passed;
    }
    return power;
}

static void claim_alias(bl_run *run) {
    const double period = 10.24; // samples: no harmonic stands at a multiple of the sampling rate
    double raw = alias_of_steps(NULL, period);
    double filtered = alias_of_steps(bl_filter_find("box"), period);
    bl_make_claim(
        run, section,
        "If the filter width is chosen correctly, boxstep should reduce aliasing compared to the "
        "step: the power that is aliased, with the box over without.",
        bl_run_text(run, "steps up and down with a period of %g samples, w one sample", period),
        "dB", -200, 0, bl_exactly(10 * log10(filtered / raw), 1), "wave");
    bl_run_setting(run, "aliased power of the steps",
                   bl_run_text(run, "%.3g without a filter, %.3g with the box", raw, filtered));
}

static void run_figure(bl_run *run) {
    bl_run_setting(run, "b, w, x of the box", bl_run_text(run, "%g, %g, %g", edge, width, box_at));
    claim_alias(run);
    draw(run);
    claim_shape(run);
}

BL_FIGURE_DESCRIPTOR(peachey_2_32) = {
    .name = "peachey-2.32",
    .title = "Box-filtering the step",
    .question = "What does a box filter make of a step?",
    .paper = "peachey2003, fig. 2.32",
    .shows =
        "The step at b, the box of width w that begins at x, and the average of the step over it, "
        "a ramp from a = b - w to b. The claims hold the formula to a plain count of points.",
    .run = run_figure};
