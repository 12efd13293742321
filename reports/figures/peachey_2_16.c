// SPDX-License-Identifier: MIT
//
// peachey-2.16: a Catmull-Rom spline through its knots, and how smooth it is at them.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { SPLINE, SQUARE, AVERAGED };

#define KNOTS "0;0;0.8;0.3;0.9;0.5;1;1"
static const double inner_knot[] = {0, 0.8, 0.3, 0.9, 0.5, 1};
enum { SPANS = 5 };

static double missed_knots(const bl_gallery *g) {
    double largest = 0;
    for (int i = 0; i <= SPANS; i++)
        largest = fmax(largest, fabs(bl_curves_at(g, SPLINE, (double)i / SPANS) - inner_knot[i]));
    return largest;
}

static double square_less_spline(const bl_gallery *g, double x) {
    return bl_curves_at(g, SQUARE, x) - x * x;
}

// The largest jump of a derivative at a knot between the ends, per span: one-sided differences of
// three values, which are exact for the second derivative of a cubic except for its third times h.
static double jump_at_knots(const bl_gallery *g, int order) {
    const double h = 1e-4 / SPANS;
    double largest = 0;
    for (int i = 1; i < SPANS; i++) {
        double x = (double)i / SPANS, derivative[2];
        for (int side = 0; side < 2; side++) {
            double s = side ? h : -h, a = bl_curves_at(g, SPLINE, x),
                   b = bl_curves_at(g, SPLINE, x + s), c = bl_curves_at(g, SPLINE, x + 2 * s);
            derivative[side] = order == 1 ? (4 * b - 3 * a - c) / (2 * s) / SPANS
                                          : (a - 2 * b + c) / (s * s) / (SPANS * SPANS);
        }
        largest = fmax(largest, fabs(derivative[1] - derivative[0]));
    }
    return largest;
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"spline:knots=" KNOTS, "spline", BL_INK_MEASURED, BL_STROKE_LINE},
        {"spline:knots=0.25;0;0.25;1;2.25", "spline of squares", BL_INK_FOURTH, BL_STROKE_DASHED},
        {"spline:knots=" KNOTS ",width=0.2", "averaged over one span", BL_INK_THEORY,
         BL_STROKE_THIN}};
    static const bl_limit limits[] = {
        {1, 0.2, "knots"}, {1, 0.4, NULL}, {1, 0.6, NULL}, {1, 0.8, NULL}};
    static const bl_curves plot = {
        .alternative =
            "A wavy curve from 0 to 1 that passes 0, 0.8, 0.3, 0.9, 0.5 and 1 at evenly spaced "
            "places, its average over one span with flatter waves, and a spline through squares, "
            "which is the parabola x^2.",
        .curves = curves,
        .count = 3,
        .x = {"x", 0, 1, 0.2, 0},
        .y = {"value", -0.1, 1.3, 0.5, 0},
        .limits = limits,
        .limit_count = 4};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 34",
                    "The spline passes through its knots, at 0 through the second and at 1 through "
                    "the last but one: the largest deviation.",
                    "at the knots", 1e-15, missed_knots(&gallery));
    bl_curves_claim(run, "bandlimit",
                    "A spline through squares is a parabola: the largest deviation.", "from 0 to 1",
                    4e-15, bl_curves_largest(square_less_spline, &gallery, 0, 1));
    bl_curves_claim(
        run, "peachey2003, p. 70",
        "Catmull-Rom splines make the derivative continuous: its largest jump at a knot, per span.",
        "one-sided differences over 1e-4 of a span", 1e-6, jump_at_knots(&gallery, 1));
    bl_curves_claim(run, "peachey2003, p. 70",
                    "Catmull-Rom splines make the second derivative continuous: its largest jump "
                    "at a knot, per span squared.",
                    "one-sided differences over 1e-4 of a span", 0.01, jump_at_knots(&gallery, 2));
}

BL_FIGURE_DESCRIPTOR(peachey_2_16) = {
    .name = "peachey-2.16",
    .title = "An example of the spline function",
    .question = "How does a Catmull-Rom spline pass its knots?",
    .paper = "peachey2003, fig. 2.16",
    .shows =
        "A spline of eight knots (the first and the last only set the slopes at the ends), its "
        "average over one span, and a spline through squares. The first derivative is continuous; "
        "the second is not, contrary to the text.",
    .run = run_figure};
