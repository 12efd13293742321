// SPDX-License-Identifier: MIT
//
// noise-histograms: the distribution of the values of every noise. The text says that most values
// lie close to 0 with only occasional excursions to the limits, and asks for a histogram.
#include <math.h>

#include "reports/figures/all_noises.h"
#include "reports/figures/estimates.h"
#include "spectra/histogram.h"

// The share of the values in the middle half of the proven range: a uniform distribution reads 1/2.
static void claim_middle(bl_run *run, const bl_gallery *gallery) {
    bl_histogram_settings settings =
        bl_run_histogram_settings(run, bl_run_count(run, 1 << 16, 1 << 19, 1 << 24));
    for (size_t i = 0; i < gallery->count; i++) {
        const bl_facts *facts = &gallery->signal[i]->facts;
        double middle = (facts->lower + facts->upper) / 2, half = (facts->upper - facts->lower) / 4;
        settings.from = middle - half;
        settings.to = middle + half;
        const bl_histogram *h = bl_run_histogram(run, gallery->signal[i], &settings);
        double share = 1 - (double)h->outside / (double)h->count, n = (double)h->count;
        double error = bl_normal_quantile(0.975) * sqrt(fmax(share * (1 - share), 1 / n) / n);
        bl_make_claim(run, "peachey2003, Lattice Noises",
                      "Most of the values lie close to the middle of the range, with only "
                      "occasional excursions to its limits: the share in the middle half.",
                      gallery->label[i], "of the values", 0.75, 1,
                      (bl_estimate){share, fmax(0, share - error), fmin(1, share + error), 0.95, n},
                      "values");
    }
}

static void run_figure(bl_run *run) {
    const bl_gallery gallery = bl_all_noises_open(run);
    bl_gallery_draw_histograms(run, &gallery, bl_run_count(run, 1 << 16, 1 << 20, 1 << 24),
                               "How are the values of all the noises distributed?",
                               "The density of the values of every noise, in standard deviations "
                               "from its mean, over the normal density.");
    claim_middle(run, &gallery);
}

BL_FIGURE_DESCRIPTOR(noise_histograms) = {
    .name = "noise-histograms",
    .title = "Histograms of every noise",
    .question = "How are the values of all the noises distributed?",
    .paper = "peachey2003, the paragraph before Spectral Synthesis",
    .shows =
        "The density of the values of every noise over random places and seeds, and the normal "
        "density, dashed. histograms.csv holds moments, observed ranges and proven bounds.",
    .run = run_figure};
