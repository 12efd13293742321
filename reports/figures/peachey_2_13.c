// SPDX-License-Identifier: MIT
//
// peachey-2.13: sine and cosine, near 0 and far from it.
#include <math.h>

#include "reports/figures/curves.h"

enum { SINE, COSINE, AVERAGED };

static double circle(const bl_gallery *g, double x) {
    double s = bl_curves_at(g, SINE, x), c = bl_curves_at(g, COSINE, x);
    return s * s + c * c - 1;
}

static double quarter(const bl_gallery *g, double x) {
    return bl_curves_at(g, COSINE, x) - bl_curves_at(g, SINE, x + 0.25);
}

// 2^40 periods further on the places are the same to 2^-12, of which these are multiples.
static double far_less_near(const bl_gallery *g, double x) {
    double near = floor(4096 * x) / 4096;
    return bl_curves_at(g, SINE, near + 0x1p40) - bl_curves_at(g, SINE, near);
}

// The sine of the angle in floats, as the text's C would have it, 2^20 periods out.
static double float_far(const bl_gallery *g, double x) {
    double near = floor(8 * x) / 8;
    float angle = (float)(2 * M_PI) * ((float)near + 0x1p20f);
    return sin((double)angle) - bl_curves_at(g, SINE, near);
}

static double averaged_less_share(const bl_gallery *g, double x) {
    return bl_curves_at(g, AVERAGED, x) - 2 / M_PI * bl_curves_at(g, SINE, x);
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"sine", "sin(2 pi x)", BL_INK_MEASURED, BL_STROKE_LINE},
        {"sine:phase=1/4", "cos(2 pi x)", BL_INK_THEORY, BL_STROKE_LINE},
        {"sine:width=1/2", "sine averaged over 1/2", BL_INK_SECOND, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A sine and a cosine from -1 to 1, a quarter of a period apart; and the sine averaged "
            "over half a period, which is lower.",
        .curves = curves,
        .count = 3,
        .x = {"x, in periods", -1, 1, 0.25, 0},
        .y = {"value", -1.1, 1.1, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 30",
                    "Sine and cosine go around a circle: the largest deviation of the sum of their "
                    "squares from 1.",
                    "from -1 to 1", 1e-15, bl_curves_largest(circle, &gallery, -1, 1));
    bl_curves_claim(
        run, "bandlimit",
        "The cosine is the sine a quarter of a period further on: the largest deviation.",
        "from -1 to 1", 1e-14, bl_curves_largest(quarter, &gallery, -1, 1));
    bl_curves_claim(
        run, "bandlimit",
        "Averaged over half a period, 2 / pi of the sine is left: the largest deviation.",
        "from -1 to 1", 1e-15, bl_curves_largest(averaged_less_share, &gallery, -1, 1));
    bl_curves_claim(
        run, "bandlimit", "The sine is the same 2^40 periods further on: the largest deviation.",
        "multiples of 2^-12 from -1 to 1", 0, bl_curves_largest(far_less_near, &gallery, -1, 1));
    bl_curves_claim(run, "peachey2003, p. 30",
                    "Single precision serves to save time: the largest error of the sine of an "
                    "angle in floats, 2^20 periods from 0, is within 1/255.",
                    "multiples of 1/8, which floats have exactly, from -1 to 1", 1.0 / 255,
                    bl_curves_largest(float_far, &gallery, -1, 1));
}

BL_FIGURE_DESCRIPTOR(peachey_2_13) = {
    .name = "peachey-2.13",
    .title = "The sin and cos functions",
    .question = "What do sine and cosine look like in cycles?",
    .paper = "peachey2003, fig. 2.13",
    .shows =
        "Sine and cosine over their period, and the sine averaged over half of it. Angles are in "
        "cycles, not in radians, so that whole periods can be removed exactly at any distance.",
    .run = run_figure};
