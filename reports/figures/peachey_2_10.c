// SPDX-License-Identifier: MIT
//
// peachey-2.10: the clamp function, and which of the text's identities hold for all edges.
#include <math.h>

#include "reports/figures/curves.h"

enum { CLAMP, AVERAGED, TURNED };

// The listings of the text.
static double printed_clamp(double x, double a, double b) {
    return x < a ? a : x > b ? b : x;
}

static double printed_min(double a, double b) {
    return a < b ? a : b;
}

static double printed_max(double a, double b) {
    return a < b ? b : a;
}

// The largest deviation of the three identities for edges and x from -2 to 2: min as a clamp, max
// as a clamp, and clamp as both, with edges in order and reversed.
static void measure_identities(double largest[4]) {
    for (double x = -2; x <= 2; x += 0.125)
        for (double a = -2; a <= 2; a += 0.125) {
            largest[0] = fmax(largest[0], fabs(printed_min(x, a) - printed_clamp(x, x, a)));
            largest[1] = fmax(largest[1], fabs(printed_max(x, a) - printed_clamp(x, a, x)));
            for (double b = -2; b <= 2; b += 0.125) {
                double both = printed_min(printed_max(x, a), b);
                double *which = &largest[a <= b ? 2 : 3];
                *which = fmax(*which, fabs(printed_clamp(x, a, b) - both));
            }
        }
}

static double clamp_less_listing(const bl_gallery *g, double x) {
    return bl_curves_at(g, CLAMP, x) - printed_clamp(x, 0.5, 1.5);
}

static double clamped_twice(const bl_gallery *g, double x) {
    double once = bl_curves_at(g, CLAMP, x), turned = bl_curves_at(g, TURNED, x);
    return fabs(bl_curves_at(g, CLAMP, once) - once) +
           fabs(bl_curves_at(g, TURNED, turned) - turned);
}

static void claim_identities(bl_run *run) {
    static const char *const sentences[] = {
        "min(x, b) is clamp(x, x, b): the largest deviation.",
        "max(x, a) is clamp(x, a, x): the largest deviation.",
        "clamp(x, a, b) is min(max(x, a), b), for a <= b: the largest deviation.",
        "clamp(x, a, b) is min(max(x, a), b), for a > b too: the largest deviation."};
    double largest[4] = {0};
    measure_identities(largest);
    for (int i = 0; i < 4; i++)
        bl_curves_claim(run, "peachey2003, p. 28", sentences[i],
                        "the listings as printed, x and the edges from -2 to 2 by 1/8", 0,
                        largest[i]);
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"clamp:low=0.5,high=1.5", "clamp, a = 1/2, b = 3/2", BL_INK_MEASURED, BL_STROKE_LINE},
        {"clamp:low=0.5,high=1.5,width=0.5", "averaged over 1/2", BL_INK_THEORY, BL_STROKE_THIN},
        {"clamp:low=1.5,high=0.5", "a = 3/2, b = 1/2: reversed", BL_INK_SECOND, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A line of slope 1 between two level parts at 1/2 and 3/2; its average, whose bends "
            "are round; and for reversed limits a level line at 1/2.",
        .curves = curves,
        .count = 3,
        .x = {"x", 0, 2, 0.5, 0},
        .y = {"value", 0, 2, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 28",
                    "clamp is a below a, x between a and b, and b above b: the largest deviation.",
                    "from -1 to 3", 0, bl_curves_largest(clamp_less_listing, &gallery, -1, 3));
    bl_curves_claim(
        run, "bandlimit",
        "Clamping twice is clamping once, with reversed limits too: the largest deviation.",
        "from -1 to 3", 0, bl_curves_largest(clamped_twice, &gallery, -1, 3));
    claim_identities(run);
}

BL_FIGURE_DESCRIPTOR(peachey_2_10) = {
    .name = "peachey-2.10",
    .title = "The clamp function",
    .question = "What does clamp do, and with reversed limits?",
    .paper = "peachey2003, fig. 2.10",
    .shows =
        "clamp and its average. With limits in order, clamp is what min and max make. With "
        "reversed limits the printed listing jumps at the first of them instead; here clamp is "
        "always min(max(x, a), b).",
    .run = run_figure};
