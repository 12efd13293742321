// SPDX-License-Identifier: MIT
//
// hart2001-1: one octave of noise beside a 1/f sum of it.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

// The share of the variance above frequency 1, along lines at random places.
static bl_estimate share_above_one(bl_run *run, const bl_signal *signal) {
    bl_psd_settings settings = bl_run_psd_settings(run, 1);
    settings.rate = 64;
    settings.averages = bl_run_count(run, 64, 512, 8192);
    return bl_psd_share(bl_run_psd(run, signal, &settings), 1, INFINITY);
}

static void run_figure(bl_run *run) {
    static const char *const texts[] = {"rayshade", "fractalsum:basis=rayshade,min=1,max=32"};
    static const bl_gallery_slices slices = {
        .name = "between",
        .alternative =
            "Two grey slices of 8 by 8 cells: soft blobs of one size, and the same blobs with ever "
            "finer detail.",
        .origin = {0, 0, 0.381966, 0},
        .length = 8,
        .pixels = 256,
        .deviations = 2.5,
        .unit = "lattice cells"};
    const bl_gallery gallery = bl_gallery_open(run, texts, 2);
    bl_gallery_draw_slices(run, &gallery, &slices);
    const bl_estimate one = share_above_one(run, gallery.signal[0]);
    const bl_estimate sum = share_above_one(run, gallery.signal[1]);
    bl_make_claim(run, "hart2001, section 1",
                  "The bandwidth of noise can be controlled to inhibit aliasing: the share of its "
                  "variance above frequency 1 is no more than 1 %.",
                  "rayshade, along a line at a random place", "of the variance", 0, 0.01, one,
                  "averages");
    bl_make_claim(run, "hart2001, section 1",
                  "Sums of octaves form fractal structures, with power at all scales: the share of "
                  "the sum above frequency 1 minus that of one octave.",
                  "along a line at a random place", "of the variance", 0, 1,
                  bl_difference(sum, one), "averages");
}

BL_FIGURE_DESCRIPTOR(hart2001_1) = {
    .name = "hart2001-1",
    .title = "A noise and a 1/f sum of it",
    .question = "What does a 1/f sum add to a noise?",
    .paper = "hart2001, fig. 1",
    .shows =
        "A slice of the noise of the Rayshade ray tracer, and of five octaves of it whose "
        "amplitudes fall as 1/f, each from 2.5 standard deviations below its mean to 2.5 above.",
    .run = run_figure};
