// SPDX-License-Identifier: MIT
//
// summed-area-error: the error of means read off summed-area tables of floats, against the size of
// the image, with the law of it.
//
// The law. An entry at (s, t) of an image with the mean m is about m s t. Rounded once to float its
// error is uniform within half an ulp, and an ulp lies between 1 and 2 epsilons of the number, so
// that its deviation is about c 2^-24 m s t with c between 1/sqrt(3) and half of that. Four such
// errors stand in a box, and the mean of (s t)^2 over the table is N^4 / 9: of the mean over a
// pixels the error has the deviation
//     2 c 2^-24 m N^2 / (3 a),   about 0.27 2^-24 m N^2 / a, for c the geometric mean.
// Added up in float, each row of a box leaves two roundings of its own, h rows of them sqrt(2 h) in
// place of 2. With the mean of the image taken off before the sums, entries are sums of random
// signs and grow as N.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/graph.h"
#include "reports/measure.h"

enum { KINDS = 3, SIZES_MOST = 7, SEEDS_MOST = 16, BOX = 16, SMALLEST = 32 };
enum { ROUNDED, ADDED, CENTRED };
static const char *const keys[KINDS] = {"rounded", "added", "centred"};
static const char *const labels[KINDS] = {"rounded once", "added in float", "mean taken off"};
static const bl_sums sums_of[KINDS] = {BL_SUMS_ROUNDED, BL_SUMS_FLOAT, BL_SUMS_ROUNDED};

typedef struct measured {
    size_t sizes, seeds;
    double side[SIZES_MOST];
    double error[2][KINDS][SIZES_MOST][SEEDS_MOST]; // of single pixels, and of boxes
} measured;

// The deviation of the means over boxes from those of a table of pairs, which is exact.
static double deviation(const bl_summed_area *table, const bl_summed_area *exact, size_t side,
                        size_t box) {
    const double size[2] = {(double)box, (double)box};
    double sum = 0, count = 0;
    size_t stride = box > 1 ? 5 : side > 64 ? 5 : 2; // a share of all places is enough
    for (size_t j = 0; j + box <= side; j += stride)
        for (size_t i = 0; i + box <= side; i += stride, count++) {
            double x = (double)i + 0.5 * size[0], y = (double)j + 0.5 * size[1];
            double error =
                bl_summed_area_mean(table, x, y, size) - bl_summed_area_mean(exact, x, y, size);
            sum += error * error;
        }
    return sqrt(sum / count);
}

static void measure_image(bl_run *run, measured *m, const float *values, size_t n, size_t seed,
                          int centred) {
    size_t side = (size_t)m->side[n];
    const bl_summed_area *exact = bl_run_summed_area(run, values, side, BL_SUMS_COMPENSATED);
    for (int k = 0; k < KINDS; k++) {
        if ((k == CENTRED) != centred)
            continue;
        const bl_summed_area *table = bl_run_summed_area(run, values, side, sums_of[k]);
        for (int b = 0; b < 2; b++)
            m->error[b][k][n][seed] = deviation(table, exact, side, b ? BOX : 1);
        bl_run_release(run, table);
    }
    bl_run_release(run, exact);
}

// White noise between 0 and 1 of 24 bits, so that doubles hold all sums to the last bit.
static void measure_size(bl_run *run, measured *m, size_t n) {
    size_t pixels = (size_t)m->side[n] * (size_t)m->side[n];
    float *values = bl_run_memory(run, pixels, sizeof *values);
    bl_run_step(run, bl_run_text(run, "tables of %g by %g", m->side[n], m->side[n]));
    for (size_t seed = 0; seed < m->seeds; seed++) {
        bl_random random = bl_run_random(run, 3000 + 100 * n + seed);
        for (size_t i = 0; i < pixels; i++)
            values[i] = (float)(floor(0x1p24 * bl_random_unit(&random)) * 0x1p-24);
        measure_image(run, m, values, n, seed, 0);
        for (size_t i = 0; i < pixels; i++)
            values[i] -= 0.5F; // exact
        measure_image(run, m, values, n, seed, 1);
    }
}

// --- what is drawn ------------------------------------------------------------------------------

static double law(double side, double area) {
    return 2 / (3 * sqrt(3 * 2)) * 0x1p-24 * 0.5 * side * side / area;
}

static void draw(bl_run *run, const measured *m) {
    double values[2][KINDS][SIZES_MOST], laws[2][SIZES_MOST];
    bl_line lines[2][KINDS + 1];
    static const bl_ink inks[KINDS] = {BL_INK_FIFTH, BL_INK_SECOND, BL_INK_THIRD};
    static const char *const places[2] = {"pixel", "box"};
    static const char *const panels[2] = {"means over single pixels", "means over 16 by 16 pixels"};
    static const bl_limit limit = {0, -48.13, "1/255"};
    for (int b = 0; b < 2; b++) {
        for (int k = 0; k < KINDS; k++) {
            for (size_t n = 0; n < m->sizes; n++)
                values[b][k][n] =
                    20 * log10(bl_mean_estimate(m->error[b][k][n], m->seeds, 0.95).value);
            lines[b][k] = (bl_line){bl_run_text(run, "%s_%s_db", keys[k], places[b]), values[b][k],
                                    labels[k], inks[k], BL_STROKE_LINE};
        }
        for (size_t n = 0; n < m->sizes; n++)
            laws[b][n] = 20 * log10(law(m->side[n], b ? BOX * BOX : 1));
        lines[b][KINDS] = (bl_line){bl_run_text(run, "law_%s_db", places[b]), laws[b], "the law",
                                    BL_INK_PLAIN, BL_STROKE_DASHED};
    }
    bl_graph_draw(
        run,
        &(bl_graph){
            .name = "errors",
            .what = "rms error, in dB of 1, of means read off summed-area tables of white noise "
                    "between 0 and 1",
            .x_name = "side_pixels",
            .x = m->side,
            .points = m->sizes,
            .lines = lines[0],
            .line_count = 2 * (KINDS + 1),
            .panels = panels,
            .panel_count = 2,
            .plot = {.x = {.label = "side of the image, pixels",
                           .from = 24,
                           .to = 2800,
                           .logarithmic = 1},
                     .y = {.label = "rms error, dB of 1", .from = -200, .to = 0, .tick = 40},
                     .columns = 2,
                     .aspect = 0.9,
                     .limits = &limit,
                     .limit_count = 1},
            .alternative =
                "Error in decibels over the side of the image. Tables of floats rise by 12 dB for "
                "each doubling of the side, on the line of the law, those with the mean taken off "
                "by 6; for single pixels of an image of 1024 the error passes 1/255."});
}

// --- claims -------------------------------------------------------------------------------------

// The slope of log error over log side, by least squares, an estimate from independent images.
static bl_estimate exponent(const measured *m, int box, int kind) {
    double slopes[SEEDS_MOST], side[SIZES_MOST], error[SIZES_MOST];
    for (size_t s = 0; s < m->seeds; s++) {
        for (size_t n = 0; n < m->sizes; n++) {
            side[n] = log2(m->side[n]);
            error[n] = log2(m->error[box][kind][n][s]);
        }
        slopes[s] = bl_slope(side, error, m->sizes);
    }
    return bl_mean_estimate(slopes, m->seeds, 0.95);
}

// The error of one kind over another's, or over the law, at the largest size.
static bl_estimate ratio(const measured *m, int box, int kind, int other) {
    double ratios[SEEDS_MOST];
    size_t n = m->sizes - 1;
    for (size_t s = 0; s < m->seeds; s++)
        ratios[s] = m->error[box][kind][n][s] /
                    (other < 0 ? law(m->side[n], box ? BOX * BOX : 1) : m->error[box][other][n][s]);
    return bl_mean_estimate(ratios, m->seeds, 0.95);
}

static void claim_laws(bl_run *run, const measured *m) {
    const char *largest =
        bl_run_text(run, "%g by %g pixels", m->side[m->sizes - 1], m->side[m->sizes - 1]);
    bl_make_claim(
        run, "peachey2003, Integrals and Summed-Area Tables",
        "The table might need numbers of a higher precision than the image: the error of single "
        "pixels in a table of floats, as steps of an image of 8 bits.",
        bl_run_text(run, "%s, white noise", largest), "of 1/255", 0.05, INFINITY,
        bl_exactly(255 * bl_mean_estimate(m->error[0][ROUNDED][m->sizes - 1], m->seeds, 0.95).value,
                   (double)m->seeds),
        "images");
    bl_make_claim(run, "bandlimit",
                  "The error of a table that is rounded to float grows as the area of the image: "
                  "the exponent of the side.",
                  "single pixels", "", 1.9, 2.1, exponent(m, 0, ROUNDED), "images");
    bl_make_claim(run, "bandlimit",
                  "The error of a table that is rounded to float is 2 c 2^-24 m N^2 / (3 a): the "
                  "error over this law.",
                  bl_run_text(run, "single pixels, %s", largest), "", 0.7, 1.42,
                  ratio(m, 0, ROUNDED, -1), "images");
    bl_make_claim(run, "bandlimit",
                  "With the mean of the image taken off before it is summed, the error grows as "
                  "its side rather than as its area: the exponent is nearer to 1 than to 2.",
                  "single pixels", "", 0.5, 1.5, exponent(m, 0, CENTRED), "images");
    bl_make_claim(run, "bandlimit",
                  "Adding up in float costs sqrt(2 h) roundings for a box of h rows, not 2: the "
                  "error over that of a table rounded once.",
                  bl_run_text(run, "16 rows, %s", largest), "", 2.2, 3.5,
                  ratio(m, 1, ADDED, ROUNDED), "images");
    bl_make_claim(run, "bandlimit", "... which for a single row is less than rounding once.",
                  bl_run_text(run, "single pixels, %s", largest), "", 0.5, 0.9,
                  ratio(m, 0, ADDED, ROUNDED), "images");
}

static void run_figure(bl_run *run) {
    measured *m = bl_run_memory(run, 1, sizeof *m);
    m->sizes = bl_run_count(run, 4, 6, 7);
    m->seeds = bl_run_count(run, 16, 8, 16);
    bl_run_setting(run, "images",
                   bl_run_text(run, "%zu of each size, white noise between 0 and 1", m->seeds));
    for (size_t n = 0; n < m->sizes; n++) {
        m->side[n] = ldexp(SMALLEST, (int)n);
        measure_size(run, m, n);
    }
    draw(run, m);
    claim_laws(run, m);
}

BL_FIGURE_DESCRIPTOR(summed_area_error) = {
    .name = "summed-area-error",
    .title = "The error of summed-area tables in float",
    .question = "How large is the error of a summed-area table of floats?",
    .paper = "crow1984; peachey2003, Integrals and Summed-Area Tables",
    .shows =
        "The root mean square error of means read off summed-area tables, against the side of the "
        "image: of floats that are rounded once, of floats that are added up in float, of floats "
        "of an image whose mean was taken off first. Broken: the law for the first. Doubles hold "
        "the sums of these images to the last bit.",
    .run = run_figure};
