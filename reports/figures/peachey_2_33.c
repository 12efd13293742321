// SPDX-License-Identifier: MIT
//
// peachey-2.33: the geometry of a summed-area table, in numbers: what an entry holds, what the four
// corners of a box give, and what an image averaged by it looks like.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/measure.h"

static const char section[] = "peachey2003, Integrals and Summed-Area Tables";

enum { SIDE = 96, PIXELS = SIDE * SIDE };
static const double box = 12; // pixels, a side

// Rings that get finer outwards, of 8-bit values: something to average.
static float image_at(int i, int j) {
    double x = (i + 0.5) / SIDE, y = (j + 0.5) / SIDE;
    return (float)nearbyint(255 * (0.5 + 0.5 * cos(40 * (x * x + y * y))));
}

// The sum of the pixels of columns [left, right) and rows [top, bottom), one by one; whole numbers,
// so that it is exact.
static double counted(const float *values, int left, int right, int top, int bottom) {
    double sum = 0;
    for (int j = top; j < bottom; j++)
        for (int i = left; i < right; i++)
            sum += (double)values[j * SIDE + i];
    return sum;
}

// The entry (s, t): the sum over the box that has it for its lower right corner.
static double entry(const bl_summed_area *table, int s, int t) {
    const double size[2] = {s, t};
    return s * t == 0 ? 0 : s * t * bl_summed_area_mean(table, 0.5 * s, 0.5 * t, size);
}

// --- claims -------------------------------------------------------------------------------------

static void claim_geometry(bl_run *run, const float *values, const bl_summed_area *table) {
    bl_random random = bl_run_random(run, 233);
    int boxes = (int)bl_run_pick(run, 500, 2000, 2000);
    double off_entry = 0, off_corners = 0;
    for (int n = 0; n < boxes; n++) {
        int left = (int)(SIDE * bl_random_unit(&random));
        int top = (int)(SIDE * bl_random_unit(&random));
        int right = left + 1 + (int)((SIDE - left) * bl_random_unit(&random));
        int bottom = top + 1 + (int)((SIDE - top) * bl_random_unit(&random));
        double sum = counted(values, left, right, top, bottom);
        double a = entry(table, left, top), b = entry(table, right, top);
        double c = entry(table, left, bottom), d = entry(table, right, bottom);
        off_corners = fmax(off_corners, fabs(d + a - b - c - sum));
        off_entry = fmax(off_entry, fabs(d - counted(values, 0, right, 0, bottom)));
    }
    bl_make_claim(run, section,
                  "The entry (s, t) of the table is the sum of the pixels of the rectangle from "
                  "(0, 0) to (s, t): the largest difference to a sum of pixels.",
                  "entries at the corners of random boxes", "of 255 a pixel", 0, 1e-8,
                  bl_exactly(off_entry, boxes), "entries");
    bl_make_claim(run, section,
                  "The sum over any rectangle of pixels is D + A - B - C, from the entries at its "
                  "four corners, A and D opposite: the largest difference to a sum of pixels.",
                  "random boxes", "of 255 a pixel", 0, 1e-8, bl_exactly(off_corners, boxes),
                  "boxes");
    bl_make_claim(run, section,
                  "The table needs numbers of a higher precision than the image: the bits of the "
                  "largest entry, of an image of 8 bits.",
                  bl_run_text(run, "%d by %d pixels", SIDE, SIDE), "bits", 9, INFINITY,
                  bl_exactly(ceil(log2(1 + entry(table, SIDE, SIDE))), 1), "entry");
}

// --- pictures -----------------------------------------------------------------------------------

// The box that is shown, and what the rest of the image is dimmed to.
enum { LEFT = 30, TOP = 24, RIGHT = 66, BOTTOM = 60, PANELS = 4 };
static const float dimmed = 0.3F;

// The part of the image that an entry sums, that which four entries leave, the table as shares of
// its last entry, and the image averaged by boxes.
static void draw(bl_run *run, const float *values, const bl_summed_area *table) {
    static const char *const names[PANELS] = {"entry", "box", "table", "averaged"};
    static const char *const titles[PANELS] = {
        "lit: what the entry (66, 60) sums", "lit: what D + A - B - C leaves",
        "the table, in shares of its last entry", "means over 12 by 12 pixels, read off it"};
    float panel[PANELS][PIXELS];
    bl_panel panels[PANELS] = {0};
    const double size[2] = {box, box}, total = entry(table, SIDE, SIDE);
    for (int n = 0; n < PIXELS; n++) {
        int i = n % SIDE, j = n / SIDE, before = i < RIGHT && j < BOTTOM;
        panel[0][n] = values[n] / 255 * (before ? 1 : dimmed);
        panel[1][n] = values[n] / 255 * (before && i >= LEFT && j >= TOP ? 1 : dimmed);
        panel[2][n] = (float)(entry(table, i + 1, j + 1) / total);
        panel[3][n] = (float)(bl_summed_area_mean(table, i + 0.5, j + 0.5, size) / 255);
    }
    for (int k = 0; k < PANELS; k++) {
        const bl_image image = {
            .width = SIDE, .height = SIDE, .values = panel[k], .spacing = 1, .white = 1};
        panels[k].title = titles[k];
        panels[k].image = bl_run_image(run, names[k], &image);
    }
    const bl_plot plot = {.x = {.label = "s, pixels", .to = SIDE, .tick = 24},
                          .y = {.label = "t, pixels", .from = SIDE, .tick = 24},
                          .panels = panels,
                          .panel_count = PANELS,
                          .columns = 2,
                          .aspect = 1,
                          .black = 0,
                          .white = 1,
                          .pixel = 1,
                          .scale_label = "value"};
    bl_run_plot(run, "geometry", &plot,
                "Four grey pictures: an image of rings, dark except for the rectangle from the "
                "upper left corner to s = 66, t = 60; the same, dark except for the box from 30, "
                "24 to 66, 60; the table, which brightens steadily towards the lower right; and "
                "the image averaged by boxes of 12 by 12 pixels, with the fine rings gone grey.");
}

static void run_figure(bl_run *run) {
    float values[PIXELS];
    bl_run_setting(run, "image", bl_run_text(run, "%d by %d pixels of 8 bits", SIDE, SIDE));
    for (int n = 0; n < PIXELS; n++)
        values[n] = image_at(n % SIDE, n / SIDE);
    const bl_summed_area *table = bl_run_summed_area(run, values, SIDE, BL_SUMS_DOUBLE);
    draw(run, values, table);
    claim_geometry(run, values, table);
}

BL_FIGURE_DESCRIPTOR(peachey_2_33) = {
    .name = "peachey-2.33",
    .title = "The summed-area table",
    .question = "How do four entries of a table give the sum over a box?",
    .paper = "peachey2003, fig. 2.33",
    .shows =
        "The pixels that one entry of the table sums; the box that four entries leave, at its "
        "corners A (upper left), B, C and D (lower right); the table itself; and means over boxes "
        "of 12 by 12 pixels, read off it. The claims hold entries and boxes to sums of pixels.",
    .run = run_figure};
