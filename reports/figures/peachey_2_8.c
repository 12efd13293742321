// SPDX-License-Identifier: MIT
//
// peachey-2.8: the step function, and its average under a box.
#include <math.h>

#include "reports/figures/curves.h"

enum { STEP, BOX, WIDE };

// The mean of the step over the 1/2 wide box about x, by 10000 of its samples.
static double average_less_samples(const bl_gallery *g, double x) {
    double sum = 0;
    for (int i = 0; i < 10000; i++)
        sum += bl_curves_at(g, STEP, x + 0.5 * ((i + 0.5) / 10000 - 0.5));
    return bl_curves_at(g, BOX, x) - sum / 10000;
}

static double step_less_comparison(const bl_gallery *g, double x) {
    return bl_curves_at(g, STEP, x) - (x >= 1);
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"step:edge=1", "step at a = 1", BL_INK_MEASURED, BL_STROKE_LINE},
        {"step:edge=1,width=0.5", "averaged over 1/2", BL_INK_THEORY, BL_STROKE_THIN},
        {"step:edge=1,width=1", "averaged over 1", BL_INK_SECOND, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A jump from 0 to 1 at x = 1, and two ramps through (1, 1/2) that are as long as the "
            "widths that the step is averaged over.",
        .curves = curves,
        .count = 3,
        .x = {"x", 0, 2, 0.5, 0},
        .y = {"value", -0.1, 1.1, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 27",
                    "The step is 0 below its edge, and 1 from the edge itself on: the largest "
                    "difference from that.",
                    "from 0 to 2, the edge among the places", 0,
                    bl_curves_largest(step_less_comparison, &gallery, 0, 2));
    bl_curves_claim(run, "bandlimit",
                    "The average by the integral is the mean over the width: its largest "
                    "difference from the mean of 10000 samples is at most one sample.",
                    "width 1/2, from 0 to 2", 1.0 / 10000 + 1e-12,
                    bl_curves_largest(average_less_samples, &gallery, 0, 2));
}

BL_FIGURE_DESCRIPTOR(peachey_2_8) = {.name = "peachey-2.8",
                                     .title = "The step function",
                                     .question = "What does a step look like, and its average?",
                                     .paper = "peachey2003, fig. 2.8",
                                     .shows =
                                         "The step at 1, and the same averaged over widths of 1/2 "
                                         "and 1: the ramps that replace it where it would alias.",
                                     .run = run_figure};
