// SPDX-License-Identifier: MIT
//
// peachey-2.19: bias for several b, as a power and as Schlick's ratio.
#include <math.h>

#include "filters/unit_curve.h"
#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { VALUES = 4 };
static const double b_of[VALUES] = {0.1, 0.3, 0.7, 0.9};

static double middle(const bl_gallery *g, double x) {
    int i = (int)fmin(x, VALUES - 1); // 0 <= x <= 4
    return fmax(fabs(bl_curves_at(g, (size_t)i, 0.5) - b_of[i]),
                fabs(bl_curves_at(g, (size_t)i + VALUES, 0.5) - b_of[i]));
}

// The largest difference of the two forms over x, for one b.
static double largest_difference(double b) {
    bl_unit_curve power = bl_bias_curve(BL_CURVE_POWER, b);
    bl_unit_curve ratio = bl_bias_curve(BL_CURVE_SCHLICK, b);
    double largest = 0;
    for (int i = 0; i <= 4000; i++)
        largest = fmax(largest, fabs(bl_unit_curve_value(&power, i / 4000.0) -
                                     bl_unit_curve_value(&ratio, i / 4000.0)));
    return largest;
}

// For each b from 0.01 to 0.99; the largest over 0.1 to 0.9, which the figure draws.
static void write_differences(bl_run *run, double *largest) {
    double b[99], difference[99];
    *largest = 0;
    for (int i = 0; i < 99; i++) {
        b[i] = (i + 1) / 100.0;
        difference[i] = largest_difference(b[i]);
        if (i >= 9 && i < 90)
            *largest = fmax(*largest, difference[i]);
    }
    const bl_line line = {"largest_difference", difference, NULL, BL_INK_MEASURED, BL_STROKE_LINE};
    bl_graph_draw(run, &(bl_graph){.name = "schlick",
                                   .what = "the largest difference of Schlick's bias from the "
                                           "power, over x from 0 to 1",
                                   .x_name = "b",
                                   .x = b,
                                   .points = 99,
                                   .lines = &line,
                                   .line_count = 1,
                                   .plot = {.title = "How far is Schlick's bias from the power?",
                                            .x = {"b", 0, 1, 0.25, 0},
                                            .y = {.label = "largest difference"}},
                                   .alternative = "The largest difference of the two forms against "
                                                  "b: 0 at 1/2, where both are straight, and "
                                                  "rising to both sides."});
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[2 * VALUES] = {
        {"bias:b=0.1", "power, b = 0.1", BL_INK_MEASURED, BL_STROKE_LINE},
        {"bias:b=0.3", "0.3", BL_INK_THEORY, BL_STROKE_LINE},
        {"bias:b=0.7", "0.7", BL_INK_SECOND, BL_STROKE_LINE},
        {"bias:b=0.9", "0.9", BL_INK_THIRD, BL_STROKE_LINE},
        {"bias:b=0.1,form=schlick", "Schlick, b = 0.1", BL_INK_MEASURED, BL_STROKE_DASHED},
        {"bias:b=0.3,form=schlick", "0.3", BL_INK_THEORY, BL_STROKE_DASHED},
        {"bias:b=0.7,form=schlick", "0.7", BL_INK_SECOND, BL_STROKE_DASHED},
        {"bias:b=0.9,form=schlick", "0.9", BL_INK_THIRD, BL_STROKE_DASHED}};
    static const bl_limit limits[] = {{1, 0.5, "bias(b, 1/2) = b"}};
    static const bl_curves plot = {
        .title = "How does bias move the middle?",
        .alternative =
            "Curves from (0, 0) to (1, 1) that pass b at x = 1/2, for b of 0.1, 0.3, 0.7 and 0.9, "
            "each as a power and as Schlick's ratio. The two lie close together for 0.3 and 0.7, "
            "and apart for 0.1 and 0.9.",
        .curves = curves,
        .count = 2 * VALUES,
        .x = {"x", 0, 1, 0.25, 0},
        .y = {"value", 0, 1, 0.25, 0},
        .limits = limits,
        .limit_count = 1};
    double largest;
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 38",
                    "bias(b, 1/2) is b, in both forms: the largest deviation.",
                    "b of 0.1, 0.3, 0.7 and 0.9", 1e-15, bl_curves_largest(middle, &gallery, 0, 4));
    write_differences(run, &largest);
    bl_make_claim(run, "peachey2003, p. 39",
                  "Schlick's ratio approximates bias: its largest difference from the power is at "
                  "most a tenth, which is our reading of it.",
                  "b from 0.1 to 0.9 by 0.01, 4001 places each", "", 0, 0.1,
                  bl_exactly(largest, 81 * 4001.0), "places");
}

BL_FIGURE_DESCRIPTOR(peachey_2_19) = {
    .name = "peachey-2.19",
    .title = "The bias function",
    .question = "How does bias move the middle, and how good is Schlick's cheap form?",
    .paper = "peachey2003, fig. 2.19",
    .shows =
        "bias for several b, as the power of the text and as Schlick's ratio of two lines; then "
        "the largest difference of the two over all b.",
    .run = run_figure};
