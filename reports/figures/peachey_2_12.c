// SPDX-License-Identifier: MIT
//
// peachey-2.12: smoothstep, and that no other cubic could stand in its place.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { SMOOTH, AVERAGED, SLOPE };

// Conditions on the cubic c0 + c1 x + c2 x^2 + c3 x^3, a row each: p(0) = 0, p(1) = 1, p'(0) = 0,
// p'(1) = 0, the right sides last. Solved by elimination; the determinant is the product of the
// pivots, and other than 0 if there is just one solution.
static double solve_cubic(double c[4]) {
    double m[4][5] = {{1, 0, 0, 0, 0}, {1, 1, 1, 1, 1}, {0, 1, 0, 0, 0}, {0, 1, 2, 3, 0}};
    double determinant = 1;
    for (int i = 0; i < 4; i++) {
        int pivot = i;
        for (int r = i + 1; r < 4; r++)
            pivot = fabs(m[r][i]) > fabs(m[pivot][i]) ? r : pivot;
        for (int k = 0; k < 5 && pivot != i; k++) {
            double swap = m[i][k];
            m[i][k] = m[pivot][k];
            m[pivot][k] = swap;
        }
        determinant *= pivot == i ? m[i][i] : -m[i][i];
        for (int r = 0; r < 4; r++)
            for (int k = 4; k >= i && r != i; k--)
                m[r][k] -= m[i][k] * m[r][i] / m[i][i];
    }
    for (int i = 0; i < 4; i++)
        c[i] = m[i][4] / m[i][i];
    return determinant;
}

static double signal_less_cubic(const bl_gallery *g, double x) {
    double c[4];
    solve_cubic(c);
    return bl_curves_at(g, SMOOTH, x) - (c[0] + x * (c[1] + x * (c[2] + x * c[3])));
}

// How much the slope at both ends is: differences over 2^-20, whose own error is 3 * 2^-20.
static double slope_at_ends(const bl_gallery *g) {
    const double h = 0x1p-20;
    return fmax(fabs(bl_curves_at(g, SMOOTH, h) - bl_curves_at(g, SMOOTH, -h)),
                fabs(bl_curves_at(g, SMOOTH, 1 + h) - bl_curves_at(g, SMOOTH, 1 - h))) /
           (2 * h);
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"smoothstep", "smoothstep from a = 0 to b = 1", BL_INK_MEASURED, BL_STROKE_LINE},
        {"smoothstep:width=0.5", "averaged over 1/2", BL_INK_THEORY, BL_STROKE_THIN},
        {"clamp", "clamp(x, 0, 1)", BL_INK_FOURTH, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "An S from 0 to 1 that is level at both ends; its average, which is a little longer "
            "and less steep; and the straight ramp between the same ends.",
        .curves = curves,
        .count = 3,
        .x = {"x", -0.5, 1.5, 0.5, 0},
        .y = {"value", -0.1, 1.1, 0.5, 0}};
    double c[4];
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 29", "The slope of smoothstep is 0 at both ends.",
                    "central differences over 2^-20, which add up to 3/2 of it", 2e-6,
                    slope_at_ends(&gallery));
    bl_make_claim(run, "peachey2003, p. 29",
                  "There is only one cubic with these values and slopes: the determinant of the "
                  "four conditions, other than 0.",
                  "its size", "", 0.5, INFINITY, bl_exactly(fabs(solve_cubic(c)), 4), "conditions");
    bl_curves_claim(run, "peachey2003, p. 29",
                    "That cubic is 3 x^2 - 2 x^3: the largest deviation of the solution of the "
                    "four conditions from smoothstep.",
                    "from 0 to 1", 1e-15, bl_curves_largest(signal_less_cubic, &gallery, 0, 1));
}

BL_FIGURE_DESCRIPTOR(peachey_2_12) = {.name = "peachey-2.12",
                                      .title = "The smoothstep function",
                                      .question = "How does smoothstep go from 0 to 1?",
                                      .paper = "peachey2003, fig. 2.12",
                                      .shows =
                                          "smoothstep between 0 and 1, its average over half of "
                                          "its length, and the straight ramp that it replaces.",
                                      .run = run_figure};
