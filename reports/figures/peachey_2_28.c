// SPDX-License-Identifier: MIT
//
// peachey-2.28: Gardner's clouds on a flat sky.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

// How alike the sky is to itself one coarsest wave further on: the correlation over random places,
// with an interval from batches.
static bl_estimate likeness(bl_run *run, const bl_signal *sky, double lag) {
    enum { BATCHES = 16 };
    bl_random random = bl_run_random(run, 228);
    size_t places = bl_run_count(run, 1000, 10000, 100000);
    double values[BATCHES];
    for (int b = 0; b < BATCHES; b++) {
        double one = 0, other = 0, square = 0, product = 0, n = (double)places;
        for (size_t i = 0; i < places; i++) {
            double at[BL_AXES] = {1e4 * bl_random_unit(&random), 1e4 * bl_random_unit(&random)};
            double here = bl_signal_value(sky, at);
            at[0] += lag;
            double there = bl_signal_value(sky, at);
            one += here / n;
            other += there / n;
            square += here * here / n;
            product += here * there / n;
        }
        values[b] = (product - one * other) / (square - one * one);
    }
    return bl_mean_estimate(values, BATCHES, 0.95);
}

// The lightest cloud: how much of the way from the sky's red to white.
static double thickest(bl_run *run, const bl_signal *sky) {
    bl_random random = bl_run_random(run, 229);
    size_t places = bl_run_count(run, 20000, 200000, 2000000);
    double most = 0, rgb[3];
    for (size_t i = 0; i < places; i++) {
        const double at[BL_AXES] = {1e4 * bl_random_unit(&random), 1e4 * bl_random_unit(&random)};
        bl_signal_colour(sky, at, (const double[BL_AXES]){0}, rgb);
        most = fmax(most, (rgb[0] - 0.16) / 0.84);
    }
    return most;
}

static void run_figure(bl_run *run) {
    bl_signal *sky = bl_run_signal(run, "cloudplane");
    const bl_shown shown[] = {
        {.key = "near", .title = "80 units", .signal = sky},
        {.key = "far", .title = "320 units", .signal = sky, .scale = 320},
        {.key = "contrast", .title = "contrast 2.5", .text = "cloudplane:contrast=2.5"}};
    const bl_pictures pictures = {.name = "clouds",
                                  .alternative =
                                      "Soft white clouds on blue, some of them alike; from further "
                                      "away they stand in a regular pattern.",
                                  .shown = shown,
                                  .count = 3,
                                  .columns = 3,
                                  .scale = 80,
                                  .samples = 2,
                                  .pixels = (unsigned)bl_run_pick(run, 128, 320, 1024),
                                  .unit = "pictures"};
    bl_pictures_draw(run, &pictures);
    bl_make_claim(run, "peachey2003, Spectral Synthesis",
                  "Magic numbers prevent regular patterns: the correlation of the sky with itself "
                  "one coarsest wave (43.5 units) further on is below 1/2.",
                  "along x, random places", "", -INFINITY, 0.5, likeness(run, sky, 1 / 0.023),
                  "batches of places");
    bl_make_claim(
        run, "bandlimit",
        "The listing clamps the sum to 1, which it never reaches: the bound of the sum is 0.392.",
        "the thickest cloud of random places", "of the way to white", 0, 0.392,
        bl_observed(thickest(run, sky), bl_run_pick(run, 20000, 200000, 2000000)), "places");
}

BL_FIGURE_DESCRIPTOR(peachey_2_28) = {
    .name = "peachey-2.28",
    .title = "The cloud plane texture",
    .question = "Do five cosine products look like clouds?",
    .paper = "peachey2003, fig. 2.28",
    .shows =
        "Gardner's sum between the blue of the sky and white; four times as far away, where its "
        "pattern shows; and with the contrast that makes the thickest cloud white.",
    .run = run_figure};
