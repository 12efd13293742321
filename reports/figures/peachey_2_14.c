// SPDX-License-Identifier: MIT
//
// peachey-2.14: mod(x, a) / a, the sawtooth, and where the listings of mod and FLOOR go wrong.
#include <math.h>

#include "reports/figures/curves.h"
#include "reports/figures/estimates.h"

enum { TOOTH, WHOLE, AVERAGED, TURNED };

// An int made of x as processors do it where C leaves it undefined.
static double as_int(double x) {
    double cut = trunc(x);
    return cut >= -2147483648.0 && cut < 2147483648.0 ? cut : -2147483648.0;
}

// The listings of the text.
static double printed_mod(double a, double b) {
    a -= as_int(a / b) * b;
    return a < 0 ? a + b : a;
}

static double printed_floor(double x) {
    return as_int(x) - (x < 0 && x != as_int(x));
}

static double beyond_range(const bl_gallery *g, double x) {
    double value = bl_curves_at(g, TOOTH, x);
    return value < 0 ? -value : value >= 1 ? 1 : 0;
}

static double listing_less_mod(const bl_gallery *g, double x) {
    return printed_mod(x, 1) - bl_curves_at(g, TOOTH, x);
}

static double next_period(const bl_gallery *g, double x) {
    double near = floor(1024 * x) / 1024; // so that x + 1 is exact
    return bl_curves_at(g, TOOTH, near + 1) - bl_curves_at(g, TOOTH, near);
}

static double floor_and_mod(const bl_gallery *g, double x) {
    return bl_curves_at(g, WHOLE, x) + bl_curves_at(g, TOOTH, x) - x;
}

static void claim_listings(bl_run *run, const bl_gallery *gallery) {
    const double far = 3e9 + 0.25;
    bl_curves_claim(
        run, "peachey2003, p. 31",
        "The listing of mod gives the positive remainder: the largest deviation near 0.",
        "period 1, from -2 to 2", 1e-15, bl_curves_largest(listing_less_mod, gallery, -2, 2));
    bl_make_claim(
        run, "peachey2003, p. 31",
        "The listing of mod gives a remainder below the period, at 3e9 + 1/4 periods too.",
        "the conversion to int as usual processors do it", "periods", 0, 1,
        bl_exactly(printed_mod(far, 1), 1), "places");
    bl_make_claim(run, "peachey2003, p. 31",
                  "The listing of mod gives a remainder below the period, just below 0 too: the "
                  "distance to the period is above 0.",
                  "at x = -1e-20, period 1", "periods", 5e-324, 1,
                  bl_exactly(1 - printed_mod(-1e-20, 1), 1), "places");
    bl_make_claim(run, "peachey2003, p. 33",
                  "FLOOR(x) is floor(x) in another type, at 3e9 too: the difference.",
                  "the conversion to int as usual processors do it", "", 0, 0,
                  bl_exactly(printed_floor(far) - floor(far), 1), "places");
    bl_make_claim(
        run, "bandlimit",
        "mod is exact at 3e9 + 1/4 periods, and below the period at -1e-20: the larger error.",
        "period 1", "periods", 0, 0x1p-53,
        bl_exactly(fmax(fabs(bl_curves_at(gallery, TOOTH, far) - 0.25),
                        1 - bl_curves_at(gallery, TOOTH, -1e-20)),
                   2),
        "places");
}

static void run_figure(bl_run *run) {
    static const bl_curve curves[] = {
        {"mod", "mod(x, a) / a, a = 1", BL_INK_MEASURED, BL_STROKE_LINE},
        {"floor", "floor(x)", BL_INK_FOURTH, BL_STROKE_DASHED},
        {"mod:width=0.25", "mod averaged over 1/4", BL_INK_THEORY, BL_STROKE_THIN},
        {"mod:period=-1", "mod(x, -1)", BL_INK_SECOND, BL_STROKE_DASHED}};
    static const bl_curves plot = {
        .alternative =
            "A sawtooth that rises from 0 to 1 in each period, on both sides of 0; its average, "
            "whose falls are slanted; the stairs of floor; and the sawtooth of a negative period, "
            "from -1 to 0.",
        .curves = curves,
        .count = 4,
        .x = {"x / a", -2, 2, 0.5, 0},
        .y = {"value", -2.1, 1.1, 0.5, 0}};
    const bl_gallery gallery = bl_curves_draw(run, &plot);
    bl_curves_claim(run, "peachey2003, p. 31",
                    "mod(x, a) / a has the amplitude 1: the most by which it leaves [0, 1).",
                    "from -2 to 2", 0, bl_curves_largest(beyond_range, &gallery, -2, 2));
    bl_curves_claim(run, "peachey2003, p. 31",
                    "mod(x, a) / a has the period a: the largest difference after one.",
                    "multiples of a / 1024 from -2 to 2", 0,
                    bl_curves_largest(next_period, &gallery, -2, 2));
    bl_curves_claim(run, "bandlimit", "floor and mod add up to x: the largest deviation.",
                    "from -2 to 2", 5e-16, bl_curves_largest(floor_and_mod, &gallery, -2, 2));
    claim_listings(run, &gallery);
}

BL_FIGURE_DESCRIPTOR(peachey_2_14) = {
    .name = "peachey-2.14",
    .title = "The periodic function mod(x, a) / a",
    .question = "What do mod and floor do, below 0 too?",
    .paper = "peachey2003, fig. 2.14",
    .shows =
        "The sawtooth, its average, and the stairs of floor. The text's listings of mod and floor "
        "convert to int: the claims say where that fails.",
    .run = run_figure};
