// SPDX-License-Identifier: MIT
//
// peachey-2.40: blue marble, and its filters from afar.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

enum { BATCHES = 16, SIDE = 4 };

// The mean of the squared error of a form against the average over boxes of a width, by stratified
// random points of the raw marble in each box. What the points' own scatter adds to it is taken
// off.
static bl_estimate squared_error(bl_run *run, const bl_signal *raw, const bl_signal *form,
                                 double width) {
    bl_random random = bl_run_random(run, 240);
    size_t boxes = bl_run_count(run, 20, 200, 2000);
    double values[BATCHES];
    const double wide[BL_AXES] = {width, width, width, width};
    for (int b = 0; b < BATCHES; b++) {
        double sum = 0;
        for (size_t k = 0; k < boxes; k++) {
            bl_moments half[2] = {{.n = 0}, {.n = 0}};
            double at[BL_AXES];
            for (int a = 0; a < 3; a++)
                at[a] = 100 * bl_random_unit(&random);
            for (int i = 0; i < 2 * SIDE * SIDE * SIDE; i++) {
                double place[BL_AXES];
                int cell[3] = {i / 2 % SIDE, i / 2 / SIDE % SIDE, i / 2 / SIDE / SIDE};
                for (int a = 0; a < 3; a++)
                    place[a] = at[a] + width * ((cell[a] + bl_random_unit(&random)) / SIDE - 0.5);
                bl_moments_add(&half[i % 2], bl_signal_value(raw, place));
            }
            // Two independent averages: the product of their errors has no bias.
            double given = bl_signal_filtered(form, at, wide);
            sum += (given - half[0].mean) * (given - half[1].mean);
        }
        values[b] = sum / (double)boxes;
    }
    return bl_mean_estimate(values, BATCHES, 0.95);
}

static void claim_all(bl_run *run, bl_signal *const marble[4]) {
    const double width = 0.2; // a box in three dimensions
    bl_estimate point = squared_error(run, marble[0], marble[0], width);
    bl_estimate fade = squared_error(run, marble[0], marble[2], width);
    bl_estimate map = squared_error(run, marble[0], marble[3], width);
    const double all[BL_AXES] = {INFINITY, INFINITY, INFINITY}, at[BL_AXES] = {0.1, 0.2, 0.3};
    const double far[BL_AXES] = {100, 100, 100};
    double mean = bl_signal_filtered(marble[0], at, all);
    bl_make_claim(run, "peachey2003, fig. 2.40",
                  "Without clamping the marble aliases from far away, so clamping brings it nearer "
                  "to what the pixel covers: the squared error of the points over that of the "
                  "faded sum, against averages over boxes.",
                  "boxes of 0.2 units, half a cell of the coarsest octave", "dB", 0, INFINITY,
                  bl_ratio_db(point, fade), "batches of boxes");
    bl_make_claim(run, "bandlimit",
                  "A faded sum loses what the map of colours makes of the removed octaves; an "
                  "averaged map keeps it: the squared error of fade over that of map.",
                  "boxes of 0.2 units", "dB", 0, INFINITY, bl_ratio_db(fade, map),
                  "batches of boxes");
    bl_make_claim(run, "peachey2003, Alternative Antialiasing Methods",
                  "Far away a texture fades to its average colour: the luminance of the faded sum "
                  "minus the mean.",
                  "filter=fade at 100 units", "of the mean", -0.02, 0.02,
                  bl_exactly(bl_signal_filtered(marble[2], at, far) / mean - 1, 1), "place");
    bl_make_claim(run, "bandlimit", "The same with an averaged map.", "filter=map at 100 units",
                  "of the mean", -0.02, 0.02,
                  bl_exactly(bl_signal_filtered(marble[3], at, far) / mean - 1, 1), "place");
}

static void run_figure(bl_run *run) {
    static const char *const texts[] = {"marble", "marble:filter=clamp", "marble:filter=fade",
                                        "marble:filter=map"};
    static const char *const titles[] = {"blue marble", "points, few pixels", "clamp, few pixels",
                                         "fade, few pixels", "map, few pixels"};
    static const char *const keys[] = {"marble", "points", "clamp", "fade", "map"};
    bl_signal *marble[4];
    bl_shown shown[5];
    bl_run_signals(run, texts, 4, marble);
    for (int i = 0; i < 5; i++)
        shown[i] = (bl_shown){.key = keys[i],
                              .title = titles[i],
                              .signal = marble[i ? i - 1 : 0],
                              .pixels = i ? 32 : 0,
                              .filtered = i > 1};
    const bl_pictures pictures = {
        .name = "marbles",
        .alternative =
            "Marble in blue veins; at 32 by 32 pixels points sparkle, clamped sums are smooth and "
            "lose the dark veins, and an averaged map keeps their shade.",
        .shown = shown,
        .count = 5,
        .columns = 3,
        .at = {0, 0, 0.4},
        .scale = 2,
        .samples = 2,
        .pixels = 32 * (unsigned)bl_run_pick(run, 5, 9, 32),
        .unit = "pictures of 2 units"};
    bl_pictures_draw(run, &pictures);
    claim_all(run, marble);
}

BL_FIGURE_DESCRIPTOR(peachey_2_40) = {
    .name = "peachey-2.40",
    .title = "Blue marble",
    .question = "What is left of marble at few pixels?",
    .paper = "peachey2003, fig. 2.40",
    .shows =
        "A slice of the solid marble of the text, and the same with 32 by 32 pixels: by points, by "
        "clamped and faded octaves, and with the map of colours averaged over what the octaves "
        "have lost.",
    .run = run_figure};
