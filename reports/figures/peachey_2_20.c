// SPDX-License-Identifier: MIT
//
// peachey-2.20: gain for several g, as powers and as Schlick's ratios.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { VALUES = 4 };

static double middle(const bl_gallery *g, double x) {
    size_t i = (size_t)fmin(x, 2 * VALUES - 1); // 0 <= x <= 8
    return bl_curves_at(g, i, 0.5) - 0.5;
}

static double asymmetry(const bl_gallery *g, double x) {
    double largest = 0;
    for (size_t i = 0; i < 2 * VALUES; i++)
        largest = fmax(largest, fabs(bl_curves_at(g, i, x) + bl_curves_at(g, i, 1 - x) - 1));
    return largest;
}

static double difference(const bl_gallery *g, double x) {
    double largest = 0;
    for (size_t i = 0; i < VALUES; i++)
        largest = fmax(largest, fabs(bl_curves_at(g, i, x) - bl_curves_at(g, i + VALUES, x)));
    return largest;
}

// Schlick's formula with 1/g - 2, as he gives it, less the gain of 1 - g in that form; 0.1 and 0.9
// are the first and the last curve.
static double as_printed_less_mirrored(const bl_gallery *g, double x) {
    double a = 1 / 0.1 - 2, u = fmin(x, 1 - x), half = u / (a * (1 - 2 * u) + 1);
    return (x <= 0.5 ? half : 1 - half) - bl_curves_at(g, 2 * VALUES - 1, x);
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[2 * VALUES] = {
        {"gain:g=0.1", "power, g = 0.1", BL_INK_MEASURED, BL_STROKE_LINE},
        {"gain:g=0.3", "0.3", BL_INK_THEORY, BL_STROKE_LINE},
        {"gain:g=0.7", "0.7", BL_INK_SECOND, BL_STROKE_LINE},
        {"gain:g=0.9", "0.9", BL_INK_THIRD, BL_STROKE_LINE},
        {"gain:g=0.1,form=schlick", "Schlick, g = 0.1", BL_INK_MEASURED, BL_STROKE_DASHED},
        {"gain:g=0.3,form=schlick", "0.3", BL_INK_THEORY, BL_STROKE_DASHED},
        {"gain:g=0.7,form=schlick", "0.7", BL_INK_SECOND, BL_STROKE_DASHED},
        {"gain:g=0.9,form=schlick", "0.9", BL_INK_THIRD, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .title = "How does gain bend the unit interval?",
        .alternative =
            "Curves from (0, 0) to (1, 1) through (1/2, 1/2): S-shaped for g of 0.7 and 0.9, and "
            "level in the middle for 0.3 and 0.1, each as powers and as Schlick's ratios close by.",
        .curves = curves,
        .count = 2 * VALUES,
        .x = {"x", 0, 1, 0.25, 0},
        .y = {"value", 0, 1, 0.25, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(
        run, "peachey2003, p. 39", "All gain functions are 1/2 at 1/2: the largest deviation.",
        "g of 0.1, 0.3, 0.7 and 0.9, both forms", 0, bl_curves_largest(middle, &gallery, 0, 8));
    bl_curves_claim(run, "peachey2003, p. 39",
                    "gain is made of two scaled bias curves, and symmetric about its middle: the "
                    "largest deviation of gain(x) + gain(1 - x) from 1.",
                    "g of 0.1, 0.3, 0.7 and 0.9, both forms, from 0 to 1; 1 - x is rounded, and "
                    "slopes are up to 10",
                    2e-15, bl_curves_largest(asymmetry, &gallery, 0, 1));
    bl_make_claim(run, "peachey2003, p. 39",
                  "Schlick's ratios approximate gain: the largest difference is at most a tenth, "
                  "which is our reading of it.",
                  "g of 0.1, 0.3, 0.7 and 0.9, from 0 to 1", "", 0, 0.1,
                  bl_exactly(bl_curves_largest(difference, &gallery, 0, 1), BL_CURVES_STEPS + 1),
                  "places");
    bl_curves_claim(
        run, "bandlimit",
        "Schlick's formula with 1/g - 2 makes the gain of 1 - g: the largest deviation.",
        "g = 0.1, from 0 to 1", 1e-15, bl_curves_largest(as_printed_less_mirrored, &gallery, 0, 1));
}

BL_FIGURE_DESCRIPTOR(peachey_2_20) = {
    .name = "peachey-2.20",
    .title = "The gain function",
    .question = "How does gain bend the unit interval, and how good is Schlick's cheap form?",
    .paper = "peachey2003, fig. 2.20",
    .shows = "gain for several g, as the powers of the text and as Schlick's ratios.",
    .run = run_figure};
