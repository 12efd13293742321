// SPDX-License-Identifier: MIT
//
// least-figure: two noises side by side.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

static void run_figure(bl_run *run) {
    static const char *const texts[] = {"vnoise", "gnoise"};
    static const bl_gallery_slices slices = {.name = "slices",
                                             .title = "Which of the two has blobs?",
                                             .alternative = "Two grey slices of 8 by 8 cells.",
                                             .length = 8,
                                             .pixels = 64,
                                             .deviations = 2.5,
                                             .unit = "lattice cells"};
    const bl_gallery gallery = bl_gallery_open(run, texts, 2);
    bl_gallery_draw_slices(run, &gallery, &slices);
    bl_psd_settings settings = bl_run_psd_settings(run, 1);
    bl_estimate above = bl_psd_share(bl_run_psd(run, gallery.signal[1], &settings), 1, INFINITY);
    bl_make_claim(run, "bandlimit", "Some power of gradient noise is above frequency 1.",
                  "along a line at a random place", "of the variance", 0, 1, above, "averages");
}

BL_FIGURE_DESCRIPTOR(least_figure) = {.name = "least-figure",
                                      .title = "Two noises",
                                      .question = "Which of the two has blobs?",
                                      .paper = "bandlimit",
                                      .shows = "A slice of value noise, and of gradient noise.",
                                      .run = run_figure};
