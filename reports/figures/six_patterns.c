// SPDX-License-Identifier: MIT
//
// How much of the lattice is seen in slices of the six noises.
//
// Two measures of a grid pattern, both zero for a noise that has none:
//   lattice contrast  see lattice_contrast.h
//   ring anisotropy   of the slice spectrum (spectra/psd.h), above the level that an isotropic
//                     noise reads; the mean in dB over the rings with 0.2 < f < 1.2.
#include "reports/figures/six_patterns.h"

#include <math.h>
#include <string.h>

#include "reports/figures/lattice_contrast.h"
#include "spectra/psd.h"

static const char text_gridless[] = "peachey2003, Sparse Convolution Noise";
static const char pairs[] = "pairs of sets of cells";

// --- lattice contrast ---------------------------------------------------------------------------

// The contrast of a stationary noise is a mean of products of two independent deviations. A mean
// square over n cells has the relative variance (kurtosis - 1) / n; even if all places of a cell
// strayed together, the standard deviation of one product would be no more than that, and that of
// the mean of R products by sqrt(R) less. scnoise has the kurtosis 3.14. Its 95 % interval leaves
// the limits less than once in a million runs.
static double stationary_limit(double repeats, double n) {
    const double error_rate = 1e-6, kurtosis = 3.2;
    double reach = bl_normal_quantile(1 - error_rate / 2) + bl_normal_quantile(0.975);
    return reach * (kurtosis - 1) / n / sqrt(repeats);
}

static const char *const slice_words[] = {"slice at random places", "slice on a lattice plane"};

// `limit` is that on the size of the contrast of a stationary noise.
static void claim_contrasts(bl_run *run, const bl_contrasts *c, double limit) {
    for (int p = 0; p < 2; p++)
        bl_make_claim(run, "peachey2003, Value-Gradient Noise",
                      "Value-gradient noise looks less regular than gradient noise: its lattice "
                      "contrast minus that of gnoise.",
                      bl_run_text(run, "vgnoise, %s", slice_words[p]), "", -INFINITY, 0,
                      bl_contrast_difference(c, p, BL_VGNOISE, BL_GNOISE), pairs);
    for (int p = 0; p < 2; p++)
        for (int i = 0; i < BL_SCNOISE; i++)
            bl_make_claim(run, text_gridless,
                          "Sparse convolution noise shows fewer gridlike patterns than the others: "
                          "the other's lattice contrast minus that of scnoise.",
                          bl_run_text(run, "against %s, %s", bl_six_names[i], slice_words[p]), "",
                          0, INFINITY, bl_contrast_difference(c, p, i, BL_SCNOISE), pairs);
    for (int p = 0; p < 2; p++)
        bl_make_claim(
            run, "bandlimit",
            "Impulses at uniform places make scnoise stationary: its lattice contrast is 0.",
            bl_run_text(run, "scnoise, %s", slice_words[p]), "", -limit, limit,
            bl_contrast_of(c, p, BL_SCNOISE), pairs);
}

// --- ring anisotropy ----------------------------------------------------------------------------

static double mean_anisotropy(const bl_psd *psd) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < psd->count; i++) {
        int wanted = psd->frequency[i] > 0.2 && psd->frequency[i] < 1.2;
        if (!wanted || isnan(psd->anisotropy_db[i]))
            continue;
        sum += psd->anisotropy_db[i] - psd->anisotropy_floor_db[i];
        count++;
    }
    return count ? sum / (double)count : NAN;
}

enum { ANISOTROPY_REPEATS = 6 };

static void measure_anisotropy(bl_run *run, const bl_signal *signal,
                               double out[ANISOTROPY_REPEATS]) {
    bl_psd_settings settings = bl_run_psd_settings(run, 2);
    settings.rate = 8;
    settings.size = bl_run_count(run, 128, 256, 512);
    settings.averages = bl_run_count(run, 2, 16, 256);
    settings.axis[2] = 1;
    for (int r = 0; r < ANISOTROPY_REPEATS; r++) {
        settings.seed = bl_run_settings(run)->seed + 100 + (uint64_t)r;
        const bl_psd *psd = bl_run_psd(run, signal, &settings);
        out[r] = mean_anisotropy(psd);
    }
}

static void claim_anisotropy(bl_run *run, const bl_gallery *six, double *mean) {
    double values[BL_SIX][ANISOTROPY_REPEATS], difference[ANISOTROPY_REPEATS];
    bl_run_step(run, "ring anisotropy");
    for (int i = 0; i < BL_SIX; i++) {
        measure_anisotropy(run, six->signal[i], values[i]);
        mean[i] = bl_mean_estimate(values[i], ANISOTROPY_REPEATS, 0.95).value;
    }
    for (int i = 0; i < BL_SCNOISE; i++) {
        for (int r = 0; r < ANISOTROPY_REPEATS; r++)
            difference[r] = values[i][r] - values[BL_SCNOISE][r];
        bl_make_claim(run, text_gridless,
                      "Sparse convolution noise prefers fewer directions than the others: the "
                      "other's ring anisotropy minus that of scnoise.",
                      bl_run_text(run, "against %s, slice at random places", bl_six_names[i]), "dB",
                      0, INFINITY, bl_mean_estimate(difference, ANISOTROPY_REPEATS, 0.95),
                      "spectra");
    }
}

void bl_six_patterns_claim(bl_run *run, const bl_gallery *six) {
    size_t cells = bl_run_count(run, 128, 1000, 20000);
    double between[BL_SIX], on_plane[BL_SIX], anisotropy[BL_SIX];
    bl_contrasts c;
    bl_contrasts_measure(run, six, cells, "the cell", &c);
    for (int i = 0; i < BL_SIX; i++) {
        between[i] = bl_contrast_of(&c, 0, i).value;
        on_plane[i] = bl_contrast_of(&c, 1, i).value;
    }
    claim_contrasts(run, &c, stationary_limit((double)c.repeats, (double)cells));
    claim_anisotropy(run, six, anisotropy);
    const bl_column columns[] = {{.name = "noise", .words = bl_six_names},
                                 {.name = "lattice_contrast_random_place", .values = between},
                                 {.name = "lattice_contrast_lattice_plane", .values = on_plane},
                                 {.name = "ring_anisotropy_above_floor_db", .values = anisotropy}};
    bl_run_csv(run, "grid-patterns", "how much of the lattice is seen in a slice", columns, 4,
               BL_SIX);
}
