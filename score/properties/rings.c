// SPDX-License-Identifier: MIT
#include "score/properties/sampling.h"
#include "score/properties/rings.h"

#include <math.h>

#include "spectra/psd.h"

// Octaves below Nyquist, and all of them together.
enum { RATE = 4, RUNS = 8, AVERAGES = 8, OCTAVES = 6, ALL = OCTAVES };
static const char *const names[OCTAVES + 1] = {
    "rings_below_2_db",   "rings_below_1_db",    "rings_below_half_db", "rings_below_quarter_db",
    "rings_below_8th_db", "rings_below_16th_db", "rings_anisotropy_db"};

// The octave of a frequency in cycles a cell: 0 for 1 to 2; OCTAVES or more: too low.
static int octave_of(double frequency) {
    double below = floor(log2((double)RATE / 2 / frequency));
    return below < OCTAVES ? (int)fmax(0, below) : OCTAVES;
}

// Weighted sums of the rings' anisotropy, and of the weights.
static void sum_rings(const bl_psd *psd, double cell, double sum[OCTAVES + 1],
                      double total[OCTAVES + 1]) {
    for (size_t k = 1; k < psd->count; k++) {
        int octave = octave_of(psd->frequency[k] * cell);
        if (!isfinite(psd->anisotropy_db[k]) || octave == OCTAVES)
            continue;
        double anisotropy = pow(10, psd->anisotropy_db[k] / 10);
        double power = psd->psd[k] * psd->measure[k];
        sum[octave] += psd->measure[k] * anisotropy;
        total[octave] += psd->measure[k];
        sum[ALL] += power * anisotropy;
        total[ALL] += power;
    }
}

void bl_score_add_rings(const bl_signal *signal, const bl_score_settings *settings,
                        const bl_score_look *look, bl_score_property *result) {
    double mean[OCTAVES + 1][RUNS];
    bl_psd_settings slice = bl_psd_default_settings(2);
    slice.rate = RATE / look->cell;
    slice.size = (size_t)bl_size_pick(settings->size, 64, 128, 256);
    slice.averages = AVERAGES;
    slice.level = settings->level;
    slice.threads = settings->threads;
    bl_random random = bl_score_random(settings, "isotropy", 1 << 20);
    for (int run = 0; run < RUNS; run++) {
        double sum[OCTAVES + 1] = {0}, total[OCTAVES + 1] = {0};
        bl_psd psd;
        slice.seed = bl_random_bits(&random);
        if (bl_psd_measure(signal, &slice, &psd, NULL) != BL_OK)
            return;
        if (run == 0)
            bl_score_note_detail(result, signal, &psd.settings);
        sum_rings(&psd, look->cell, sum, total);
        bl_psd_free(&psd);
        for (int k = 0; k <= OCTAVES; k++)
            mean[k][run] = sum[k] / total[k]; // NaN: no rings so low
    }
    for (int k = 0; k <= OCTAVES; k++)
        if (isfinite(mean[k][0]))
            bl_score_add(result, names[k],
                         bl_score_db(bl_mean_estimate(mean[k], RUNS, settings->level)));
    bl_score_add_exact(result, "rings_floor_db", -10 * log10(AVERAGES));
}
