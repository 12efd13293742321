// SPDX-License-Identifier: MIT
//
// width-estimators: widths of samples estimated from the derivatives of a coordinate, against what
// the pixel really covers.
//
// Two truths: the extent of the pixel along the axis, which a box must cover so that nothing is
// missed, and the width of the box that has the same variance as the coordinate over the pixel,
// sqrt(12 var), which blurs as much as the pixel itself does.
#include <math.h>

#include "filters/sample_width.h"
#include "reports/figures/estimates.h"
#include "reports/figures/graph.h"
#include "reports/measure.h"

static const char section[] = "peachey2003, Determining the Sampling Rate";

enum { SUM, MAXIMUM, LENGTH, DISTANCE, ESTIMATORS, AXES = 2, GRID = 8, SIZE = 128, ANGLES = 91 };
static const char *const words[ESTIMATORS] = {"sum", "maximum", "length", "distance"};
static const char *const titles[ESTIMATORS] = {"|da/dx| + |da/dy|", "the larger of both",
                                               "length of the gradient", "distance times k"};

// Angles begin again after 8 units: a pixel on that seam has no extent that means anything.
#define SEAM 4.0

// What one pixel covers along each axis, by GRID x GRID cells of it; 0 if part of it sees nothing.
typedef struct footprint {
    bl_sight sight; // of its middle
    double extent[AXES], spread[AXES];
} footprint;

static int look(const bl_view *view, double x, double y, footprint *f) {
    double least[AXES] = {INFINITY, INFINITY}, most[AXES] = {-INFINITY, -INFINITY};
    double mean[AXES] = {0}, square[AXES] = {0};
    if (!bl_view_see(view, x, y, &f->sight))
        return 0;
    for (int i = 0; i <= GRID; i++)
        for (int j = 0; j <= GRID; j++) {
            bl_sight corner;
            if (!bl_view_see(view, x - 0.5 + (double)i / GRID, y - 0.5 + (double)j / GRID, &corner))
                return 0;
            // Simpson's weights: exact for the square of what is linear.
            double wi = i % GRID == 0 ? 1 : 2 + 2 * (i % 2),
                   wj = j % GRID == 0 ? 1 : 2 + 2 * (j % 2);
            double weight = wi * wj / (9.0 * GRID * GRID);
            for (int a = 0; a < AXES; a++) {
                double offset = corner.at[a] - f->sight.at[a]; // keeps digits far from 0
                least[a] = fmin(least[a], offset);
                most[a] = fmax(most[a], offset);
                mean[a] += weight * offset;
                square[a] += weight * offset * offset;
            }
        }
    for (int a = 0; a < AXES; a++) {
        f->extent[a] = most[a] - least[a];
        if (f->extent[a] > SEAM)
            return 0;
        f->spread[a] = sqrt(12 * fmax(0, square[a] - mean[a] * mean[a]));
    }
    return 1;
}

static double estimate(const footprint *f, int estimator, int axis, double k) {
    return bl_sample_width((bl_width_estimator)estimator, f->sight.across[axis],
                           f->sight.down[axis], f->sight.distance, k);
}

// --- a texture turned in the plane of the image -------------------------------------------------

static void measure_turned(bl_run *run, double ratio[2][ESTIMATORS][ANGLES]) {
    for (int degrees = 0; degrees < ANGLES; degrees++) {
        footprint f;
        look(bl_run_view(run, bl_run_text(run, "flat:rotate=%d", degrees), SIZE, SIZE), 40.5, 70.5,
             &f);
        for (int e = 0; e < ESTIMATORS; e++) {
            double width = estimate(&f, e, 0, 4.0 / SIZE); // k: the pixel's own size
            ratio[0][e][degrees] = width / f.extent[0];
            ratio[1][e][degrees] = width / f.spread[0];
        }
    }
}

static void range_of(const double *values, double *least, double *most) {
    *least = INFINITY;
    *most = -INFINITY;
    for (int i = 0; i < ANGLES; i++) {
        *least = fmin(*least, values[i]);
        *most = fmax(*most, values[i]);
    }
}

static void claim_turned(bl_run *run, double ratio[2][ESTIMATORS][ANGLES]) {
    double least[2][ESTIMATORS], most[2][ESTIMATORS];
    static const char reading[] = "a texture turned by 0 to 90 degrees";
    for (int truth = 0; truth < 2; truth++)
        for (int e = 0; e < ESTIMATORS; e++)
            range_of(ratio[truth][e], &least[truth][e], &most[truth][e]);
    bl_make_claim(run, section,
                  "The sum of the absolute values is an upper bound: the least ratio of it to the "
                  "extent of the pixel.",
                  reading, "", 1 - 1e-9, INFINITY, bl_observed(least[0][SUM], ANGLES), "angles");
    bl_make_claim(run, section,
                  "Its error makes the filter too wide: its largest ratio to the width that blurs "
                  "as the pixel does.",
                  reading, "", sqrt(2) - 1e-3, sqrt(2) + 1e-3, bl_observed(most[1][SUM], ANGLES),
                  "angles");
    bl_make_claim(run, "bandlimit",
                  "The larger of both derivatives leaves half of the extent out, at 45 degrees: "
                  "the least ratio.",
                  reading, "", 0.5 - 1e-3, 0.5 + 1e-3, bl_observed(least[0][MAXIMUM], ANGLES),
                  "angles");
    bl_make_claim(run, "bandlimit",
                  "The length of the gradient blurs as the pixel does, whatever the rotation: the "
                  "largest deviation of the ratio from 1.",
                  reading, "", 0, 1e-9,
                  bl_observed(fmax(most[1][LENGTH] - 1, 1 - least[1][LENGTH]), ANGLES), "angles");
}

static void draw_turned(bl_run *run, double ratio[2][ESTIMATORS][ANGLES]) {
    static const bl_ink inks[ESTIMATORS] = {BL_INK_MEASURED, BL_INK_THEORY, BL_INK_SECOND,
                                            BL_INK_FOURTH};
    static const char *const panels[] = {"over the extent of the pixel",
                                         "over the width that blurs as the pixel does"};
    static const bl_limit right = {0, 1, "right"};
    double angle[ANGLES];
    bl_line lines[2][ESTIMATORS];
    for (int i = 0; i < ANGLES; i++)
        angle[i] = i;
    for (int truth = 0; truth < 2; truth++)
        for (int e = 0; e < ESTIMATORS; e++)
            lines[truth][e] =
                (bl_line){bl_run_text(run, "%s_over_%s", words[e], truth ? "same_blur" : "extent"),
                          ratio[truth][e], titles[e], inks[e],
                          e == DISTANCE ? BL_STROKE_DASHED : BL_STROKE_LINE};
    bl_graph_draw(
        run,
        &(bl_graph){
            .name = "turned",
            .what = "estimated width over the extent of the pixel along the axis, and over the "
                    "width of the box with the pixel's own variance",
            .x_name = "angle_degrees",
            .x = angle,
            .points = ANGLES,
            .lines = lines[0],
            .line_count = 2 * ESTIMATORS,
            .panels = panels,
            .panel_count = 2,
            .plot = {.title = "How wide is a sample of a texture that is turned?",
                     .x = {.label = "angle, degrees", .to = 90, .tick = 15},
                     .y = {"estimated width, true widths", 0.4, 1.6, 0.2, 0},
                     .columns = 2,
                     .aspect = 0.8,
                     .limits = &right,
                     .limit_count = 1},
            .alternative =
                "Ratios against the angle. The sum covers the extent at every angle and is up to "
                "1.41 "
                "times as wide as blurs like the pixel; the larger derivative falls to half the "
                "extent at "
                "45 degrees; the length of the gradient blurs like the pixel at every angle."});
}

// --- views in perspective -----------------------------------------------------------------------

// Of all pixels and both axes of a view: the ratios of each estimator to the extent.
typedef struct ratios {
    double least[ESTIMATORS], most[ESTIMATORS];
    double count;
} ratios;

static ratios measure_view(bl_run *run, const char *text) {
    const bl_view *view = bl_run_view(run, text, SIZE, SIZE);
    ratios r = {.count = 0};
    footprint middle;
    // k so that the estimate is right for one pixel near the middle, and used for all, as one has
    // to.
    double k = NAN;
    for (int y = SIZE / 2; y < SIZE && isnan(k); y++)
        if (look(view, SIZE / 2 + 0.5, y + 0.5, &middle))
            k = middle.extent[1] / middle.sight.distance;
    for (int e = 0; e < ESTIMATORS; e++) {
        r.least[e] = INFINITY;
        r.most[e] = -INFINITY;
    }
    for (int x = 0; x < SIZE; x += 3)
        for (int y = 0; y < SIZE; y += 3) {
            footprint f;
            if (!look(view, x + 0.5, y + 0.5, &f))
                continue;
            for (int a = 0; a < AXES; a++)
                for (int e = 0; e < ESTIMATORS; e++) {
                    double ratio = estimate(&f, e, a, k) / f.extent[a];
                    r.least[e] = fmin(r.least[e], ratio);
                    r.most[e] = fmax(r.most[e], ratio);
                }
            r.count += AXES;
        }
    return r;
}

enum { VIEWS = 3 };
static const char *const views[VIEWS] = {"plane:pitch=45", "sphere:distance=6,tilt=0", "torus"};

static void claim_views(bl_run *run) {
    double least[VIEWS * ESTIMATORS], most[VIEWS * ESTIMATORS];
    const char *view[VIEWS * ESTIMATORS], *estimator[VIEWS * ESTIMATORS];
    for (int v = 0; v < VIEWS; v++) {
        const ratios r = measure_view(run, views[v]);
        for (int e = 0; e < ESTIMATORS; e++) {
            least[v * ESTIMATORS + e] = r.least[e];
            most[v * ESTIMATORS + e] = r.most[e];
            view[v * ESTIMATORS + e] = views[v];
            estimator[v * ESTIMATORS + e] = titles[e];
        }
        // Derivatives at the middle of a pixel miss how they change within it.
        bl_make_claim(run, section,
                      "The sum of the absolute values is an upper bound: the least ratio of it to "
                      "the extent of the pixel, to within a hundredth.",
                      views[v], "", 0.99, INFINITY, bl_observed(r.least[SUM], r.count),
                      "pixels and axes");
        if (v == 0)
            bl_make_claim(run, section,
                          "The distance of the camera times a constant can stand in for the "
                          "derivatives: the largest ratio to the extent, over the smallest.",
                          views[v], "", 1, 2,
                          bl_observed(r.most[DISTANCE] / r.least[DISTANCE], r.count),
                          "pixels and axes");
    }
    const bl_column columns[] = {{.name = "view", .words = view},
                                 {.name = "estimator", .words = estimator},
                                 {.name = "least_over_extent", .values = least},
                                 {.name = "most_over_extent", .values = most}};
    bl_run_csv(run, "views", "estimated width over the extent of the pixel, over a view", columns,
               4, VIEWS * ESTIMATORS);
}

static void run_figure(bl_run *run) {
    double ratio[2][ESTIMATORS][ANGLES];
    bl_run_setting(run, "pixels", bl_run_text(run, "every third of %d x %d", SIZE, SIZE));
    measure_turned(run, ratio);
    draw_turned(run, ratio);
    claim_turned(run, ratio);
    return claim_views(run);
}

BL_FIGURE_DESCRIPTOR(width_estimators) = {
    .name = "width-estimators",
    .title = "Widths estimated from derivatives against the pixel's true footprint",
    .question = "How wide is a sample, and who says so?",
    .paper = "peachey2003, Determining the Sampling Rate",
    .shows =
        "Four estimators of the width along one axis of a texture that is turned in the plane of "
        "the image. Each is divided by the extent of the pixel along this axis, and by the width "
        "of the box that blurs as much as the pixel does. The extremes over views in perspective "
        "are in views.csv.",
    .run = run_figure};
