// SPDX-License-Identifier: MIT
//
// peachey-2.18: the gamma correction function for 0.4 and 2.3.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { LOW, HIGH, AVERAGED, BACK };

static double fixed_ends(const bl_gallery *g, double x) {
    double end = x < 0.5 ? 0 : 1;
    return fabs(bl_curves_at(g, LOW, end) - end) + fabs(bl_curves_at(g, HIGH, end) - end);
}

// Where a curve is on the wrong side of the diagonal, by how much.
static double wrong_side(const bl_gallery *g, double x) {
    return fmax(0, fmax(x - bl_curves_at(g, HIGH, x), bl_curves_at(g, LOW, x) - x));
}

static double there_and_back(const bl_gallery *g, double x) {
    return bl_curves_at(g, BACK, bl_curves_at(g, HIGH, x)) - x;
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"gamma:gamma=0.4", "gamma = 0.4", BL_INK_MEASURED, BL_STROKE_LINE},
        {"gamma:gamma=2.3", "gamma = 2.3", BL_INK_THEORY, BL_STROKE_LINE},
        {"gamma:gamma=2.3,width=0.2", "2.3, averaged over 0.2", BL_INK_THIRD, BL_STROKE_DASHED},
        {"gamma:gamma=10/23", "gamma = 1/2.3, the inverse", BL_INK_SECOND, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "Curves from (0, 0) to (1, 1): for 2.3 above the diagonal and steep at 0, for 0.4 and "
            "1/2.3 below it; the average of the first is rounded at 0.",
        .curves = curves,
        .count = 4,
        .x = {"x", 0, 1, 0.25, 0},
        .y = {"value", 0, 1, 0.25, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 37",
                    "0 and 1 are mapped to themselves: the largest deviation.", "gamma 0.4 and 2.3",
                    0, bl_curves_largest(fixed_ends, &gallery, 0, 1));
    bl_curves_claim(run, "peachey2003, p. 37",
                    "gamma above 1 shifts values upward, below 1 downward: the most by which a "
                    "value is on the wrong side.",
                    "gamma 2.3 and 0.4, from 0 to 1", 0,
                    bl_curves_largest(wrong_side, &gallery, 0, 1));
    bl_curves_claim(run, "bandlimit", "1 / gamma is the inverse of gamma: the largest deviation.",
                    "gamma 2.3, from 0 to 1", 1e-15,
                    bl_curves_largest(there_and_back, &gallery, 0, 1));
}

BL_FIGURE_DESCRIPTOR(peachey_2_18) = {.name = "peachey-2.18",
                                      .title = "The gamma correction function",
                                      .question = "How does gamma correction move values?",
                                      .paper = "peachey2003, fig. 2.18",
                                      .shows =
                                          "x^(1 / gamma) for the text's 0.4 and 2.3, the inverse "
                                          "of the latter, and its average over widths of 0.2.",
                                      .run = run_figure};
