// SPDX-License-Identifier: MIT
//
// peachey-2.9: two steps make a pulse, which ever wider boxes flatten.
#include <math.h>

#include "reports/figures/curves.h"

enum { PULSE, NARROW, WIDE, FIRST, SECOND };

static double pulse_less_steps(const bl_gallery *g, double x) {
    return bl_curves_at(g, PULSE, x) - (bl_curves_at(g, FIRST, x) - bl_curves_at(g, SECOND, x));
}

// The integral over x, by the trapezoidal rule, which is exact for lines between its places.
static double area(const bl_gallery *g, size_t index) {
    double sum = 0;
    for (int i = 0; i < 6 * 64; i++)
        sum +=
            0.5 / 64 *
            (bl_curves_at(g, index, -2 + i / 64.0) + bl_curves_at(g, index, -2 + (i + 1) / 64.0));
    return sum;
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"pulse:low=0.5,high=1.5,period=inf", "pulse", BL_INK_MEASURED, BL_STROKE_LINE},
        {"pulse:low=0.5,high=1.5,period=inf,width=0.5", "averaged over 1/2", BL_INK_THEORY,
         BL_STROKE_THIN},
        {"pulse:low=0.5,high=1.5,period=inf,width=2", "averaged over 2", BL_INK_SECOND,
         BL_STROKE_DASHED},
        {"step:edge=0.5", "step at 1/2", BL_INK_FOURTH, BL_STROKE_DASHED},
        {"step:edge=1.5", "step at 3/2", BL_INK_FIFTH, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A pulse that is 1 from 1/2 to 3/2, the two steps whose difference it is, and two "
            "averages: for the width 1/2 a trapezium as high as the pulse, for the width 2 one "
            "half as high.",
        .curves = curves,
        .count = 5,
        .x = {"x", -0.5, 2.5, 0.5, 0},
        .y = {"value", -0.1, 1.1, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 27",
                    "A pulse is the difference of two steps: the largest deviation.",
                    "from -1 to 3", 0, bl_curves_largest(pulse_less_steps, &gallery, -1, 3));
    bl_curves_claim(run, "bandlimit",
                    "No width changes the area of the pulse: the largest deviation from b - a.",
                    "widths 1/2 and 2, by the trapezoidal rule between their corners", 1e-12,
                    fmax(fabs(area(&gallery, NARROW) - 1), fabs(area(&gallery, WIDE) - 1)));
}

BL_FIGURE_DESCRIPTOR(peachey_2_9) = {.name = "peachey-2.9",
                                     .title = "Two steps used to make a pulse",
                                     .question = "How do two steps make a pulse?",
                                     .paper = "peachey2003, fig. 2.9",
                                     .shows =
                                         "A pulse, the two steps whose difference it is, and its "
                                         "averages over a narrower and over a wider width.",
                                     .run = run_figure};
