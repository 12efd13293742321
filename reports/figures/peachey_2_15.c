// SPDX-License-Identifier: MIT
//
// peachey-2.15: a pulse of mod makes a periodic pulse.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { TRAIN, PULSE, TOOTH, AVERAGED, WIDE };

static double train_less_composition(const bl_gallery *g, double x) {
    return bl_curves_at(g, TRAIN, x) - bl_curves_at(g, PULSE, bl_curves_at(g, TOOTH, x));
}

static double wide_less_mean(const bl_gallery *g, double x) {
    return bl_curves_at(g, WIDE, x) - 0.2;
}

// The mean of an average over a period is the mean of the pulse; trapezia between corners.
static double mean_of_average(const bl_gallery *g) {
    double sum = 0;
    for (int i = 0; i < 400; i++)
        sum += bl_curves_at(g, AVERAGED, (i + 0.5) / 400) / 400;
    return sum;
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"pulse:low=0.4,high=0.6", "pulse of mod", BL_INK_MEASURED, BL_STROKE_LINE},
        {"pulse:low=0.4,high=0.6,period=inf", "pulse of x", BL_INK_FOURTH, BL_STROKE_DASHED},
        {"mod", "mod(x, a) / a", BL_INK_SECOND, BL_STROKE_DASHED},
        {"pulse:low=0.4,high=0.6,width=0.3", "averaged over 0.3", BL_INK_THEORY, BL_STROKE_THIN},
        {"pulse:low=0.4,high=0.6,width=1", "over 1", BL_INK_THIRD, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A pulse from 0.4 to 0.6, the sawtooth of mod, and what they make together: a row of "
            "pulses, one in each period. Averaged over 0.3, the pulses become trapezia two thirds "
            "as high; over a whole period, the level line at 0.2.",
        .curves = curves,
        .count = 5,
        .x = {"x / a", -1, 3, 0.5, 0},
        .y = {"value", -0.1, 1.1, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 32",
                    "A function applied to mod is periodic: the largest deviation of the periodic "
                    "pulse from the pulse applied to mod.",
                    "from -1 to 3", 0, bl_curves_largest(train_less_composition, &gallery, -1, 3));
    bl_make_claim(run, "bandlimit", "No width changes the mean of the pulses, 0.2.",
                  "averaged over 0.3 a, by 400 places over a period", "", 0.2 - 1e-12, 0.2 + 1e-12,
                  bl_exactly(mean_of_average(&gallery), 400), "places");
    bl_curves_claim(
        run, "bandlimit",
        "Averaged over a whole period the pulses are their mean: the largest deviation from 0.2.",
        "from -1 to 3", 1e-15, bl_curves_largest(wide_less_mean, &gallery, -1, 3));
}

BL_FIGURE_DESCRIPTOR(peachey_2_15) = {
    .name = "peachey-2.15",
    .title = "How to make a function periodic",
    .question = "How does mod make a function periodic?",
    .paper = "peachey2003, fig. 2.15",
    .shows =
        "A pulse, the sawtooth of mod, the periodic pulse that comes of applying the first to the "
        "second, and its averages over 0.3 and over a whole period.",
    .run = run_figure};
