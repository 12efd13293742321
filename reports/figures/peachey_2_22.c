// SPDX-License-Identifier: MIT
//
// peachey-2.22: the brick texture, and its filters at few pixels.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

enum { COARSE = 32 };
static const char *const texts[] = {"brick", "brick:filter=boxstep", "brick:filter=integral",
                                    "brick:filter=exact"};

static double seen(const bl_signal *signal, const double at[BL_AXES], double width) {
    return bl_signal_filtered(signal, at, (const double[BL_AXES]){width, width});
}

// The share of mortar that random points of the raw wall find.
static bl_estimate share_of_mortar(bl_run *run, const bl_signal *wall) {
    bl_random random = bl_run_random(run, 222);
    size_t n = bl_run_count(run, 20000, 200000, 2000000);
    bl_moments moments = {.n = 0};
    for (size_t i = 0; i < n; i++) {
        const double at[BL_AXES] = {26 * bl_random_unit(&random), 18 * bl_random_unit(&random)};
        bl_moments_add(&moments, seen(wall, at, 0) > 0.4);
    }
    double reach = bl_normal_quantile(0.975) * sqrt(bl_moments_variance(&moments) / (double)n);
    return (bl_estimate){moments.mean, moments.mean - reach, moments.mean + reach, 0.95, (double)n};
}

// The largest error of a form against the average of the wall, in parts of the contrast, where the
// sample stays in one row, or wherever it is.
static double largest_error(const bl_signal *form, const bl_signal *exact, double width,
                            int one_row) {
    const double contrast = 0.5 - seen(exact, (const double[BL_AXES]){0.13, 0.045}, 0);
    double largest = 0;
    for (int j = 0; j < 256; j++)
        for (int i = 0; i < 64; i++) {
            const double at[BL_AXES] = {0.26 * i / 64, 0.18 * j / 256};
            double middle = at[1] - 0.09 * floor(at[1] / 0.09);
            int inside = middle >= 0.5 * width && middle <= 0.09 - 0.5 * width;
            if (inside || !one_row)
                largest = fmax(largest, fabs(seen(form, at, width) - seen(exact, at, width)));
        }
    return largest / contrast;
}

static void claim_all(bl_run *run, bl_signal *const wall[4]) {
    double brick = 0.25 / 0.26 * 0.08 / 0.09;
    bl_make_claim(
        run, "peachey2003, Example: Brick Texture",
        "A brick is 0.25 by 0.08 within mortar of 0.01: the share of mortar in the wall is 0.1453.",
        "random points", "of the area", 1 - brick - 0.01, 1 - brick + 0.01,
        share_of_mortar(run, wall[0]), "points");
    bl_make_claim(run, "peachey2003, Example: Antialiased Brick Texture",
                  "The integrals of the pulses account for a filter that overlaps other bricks: "
                  "the largest error against the average over the box is 0 within a row.",
                  "filter=integral, width 0.03", "of the contrast", 0, 1e-12,
                  bl_exactly(largest_error(wall[2], wall[3], 0.03, 1), 16384), "places");
    bl_make_claim(
        run, "peachey2003, Example: Antialiased Brick Texture",
        "The same where the filter overlaps other rows, which are shifted by half a brick.",
        "filter=integral, width 0.03", "of the contrast", 0, 1e-12,
        bl_exactly(largest_error(wall[2], wall[3], 0.03, 0), 16384), "places");
    bl_make_claim(run, "peachey2003, Example: Antialiased Brick Texture",
                  "Steps replaced by ramps are not enough for a periodic pattern: the largest "
                  "error of boxstep against the average over the box, within a row.",
                  "filter=boxstep, width 0.03, three times the mortar", "of the contrast", 0.01,
                  INFINITY, bl_exactly(largest_error(wall[1], wall[3], 0.03, 1), 16384), "places");
}

static void run_figure(bl_run *run) {
    static const char *const titles[] = {"brick", "boxstep, few pixels", "integral, few pixels",
                                         "exact, few pixels", "points, few pixels"};
    static const char *const keys[] = {"brick", "boxstep", "integral", "exact", "points"};
    bl_signal *wall[4];
    bl_shown shown[5];
    bl_run_signals(run, texts, 4, wall);
    for (int i = 0; i < 5; i++)
        shown[i] = (bl_shown){.key = keys[i],
                              .title = titles[i],
                              .signal = wall[i % 4],
                              .pixels = i ? COARSE : 0,
                              .filtered = i % 4 > 0};
    const bl_pictures pictures = {
        .name = "bricks",
        .alternative =
            "A brick wall, and the same at 32 by 32 pixels: filtered in three ways, where the "
            "exact one keeps the joints even, and point sampled, which loses most of them.",
        .shown = shown,
        .at = {0.5, 0.5},
        .scale = 1,
        .samples = 3,
        .count = 5,
        .columns = 3,
        .pixels = COARSE * (unsigned)bl_run_pick(run, 6, 12, 24),
        .unit = "units"};
    bl_pictures_draw(run, &pictures);
    claim_all(run, wall);
}

BL_FIGURE_DESCRIPTOR(peachey_2_22) = {
    .name = "peachey-2.22",
    .title = "The brick texture",
    .question = "What is left of a brick wall at few pixels?",
    .paper = "peachey2003, fig. 2.22",
    .shows =
        "The wall of the text, and the same with 32 by 32 pixels, each 0.031 units wide and three "
        "times as wide as the mortar: by the text's filters, by the average over the pixel, and by "
        "one point a pixel.",
    .run = run_figure};
