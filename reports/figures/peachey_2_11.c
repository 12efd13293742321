// SPDX-License-Identifier: MIT
//
// peachey-2.11: the absolute value, and a sine rectified by it.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { SIZE, AVERAGED, RECTIFIED, SINE };

static double rectified_less_size(const bl_gallery *g, double x) {
    return bl_curves_at(g, RECTIFIED, x) - bl_curves_at(g, SIZE, bl_curves_at(g, SINE, x));
}

static double negative_part(const bl_gallery *g, double x) {
    return fmin(bl_curves_at(g, RECTIFIED, x), 0);
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"abs", "abs", BL_INK_MEASURED, BL_STROKE_LINE},
        {"abs:width=1", "averaged over 1", BL_INK_THEORY, BL_STROKE_THIN},
        {"sineturbulence:min=1,max=2", "abs of the sine", BL_INK_SECOND, BL_STROKE_LINE},
        {"sine", "sin(2 pi x)", BL_INK_FOURTH, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A V with its point at 0, its average, which is round there, a sine, and the row of "
            "bumps that abs makes of the sine.",
        .curves = curves,
        .count = 4,
        .x = {"x", -2, 2, 0.5, 0},
        .y = {"value", -1, 2, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 29",
                    "abs rectifies a sine: what is left below 0 of the pulses.", "from -2 to 2", 0,
                    bl_curves_largest(negative_part, &gallery, -2, 2));
    bl_make_claim(run, "peachey2003, p. 29", "The pulses rise to 1.",
                  "at the quarter of the period", "", 1, 1,
                  bl_exactly(bl_curves_at(&gallery, RECTIFIED, 0.25), 1), "places");
    bl_curves_claim(run, "bandlimit",
                    "One term of the turbulence of sines is abs of a sine: the largest deviation.",
                    "from -2 to 2", 1e-14, bl_curves_largest(rectified_less_size, &gallery, -2, 2));
    // The mean of |x| over [-1/2, 1/2].
    bl_make_claim(run, "bandlimit", "Averaged over the width w, the point of abs rises to w / 4.",
                  "at 0, width 1", "", 0.25, 0.25,
                  bl_exactly(bl_curves_at(&gallery, AVERAGED, 0), 1), "places");
}

BL_FIGURE_DESCRIPTOR(peachey_2_11) = {
    .name = "peachey-2.11",
    .title = "The abs function",
    .question = "What does abs do to a line and to a sine?",
    .paper = "peachey2003, fig. 2.11",
    .shows = "abs, its average over a width of 1, and a sine before and after it.",
    .run = run_figure};
