// SPDX-License-Identifier: MIT
#include "reports/figures/lattice_contrast.h"

#include <math.h>
#include <string.h>

enum { PHASES = 8, LATTICE_SPAN = 100000 }; // places along each side of the cell

// The mean square at each place of the cell over `cells` random cells; the noises have mean zero.
static void square_by_phase(const bl_signal *signal, bl_random *random, int on_plane, size_t cells,
                            double out[PHASES * PHASES]) {
    float row[PHASES];
    const double step[BL_AXES] = {1.0 / PHASES, 0, 0, 0};
    memset(out, 0, PHASES * PHASES * sizeof *out);
    for (size_t c = 0; c < cells; c++) {
        double corner[3];
        for (int a = 0; a < 3; a++)
            corner[a] = floor((bl_random_unit(random) - 0.5) * LATTICE_SPAN);
        double z = corner[2] + (on_plane ? 0 : bl_random_unit(random));
        for (int j = 0; j < PHASES; j++) {
            const double start[BL_AXES] = {corner[0], corner[1] + (double)j / PHASES, z, 0};
            bl_signal_row(signal, start, step, PHASES, row);
            for (int i = 0; i < PHASES; i++)
                out[j * PHASES + i] += (double)row[i] * (double)row[i] / (double)cells;
        }
    }
}

// The contrast from two independent sets of cells.
static double contrast_of(const double a[PHASES * PHASES], const double b[PHASES * PHASES]) {
    double mean_a = 0, mean_b = 0, product = 0;
    const int count = PHASES * PHASES;
    for (int i = 0; i < count; i++) {
        mean_a += a[i] / count;
        mean_b += b[i] / count;
    }
    for (int i = 0; i < count; i++)
        product += (a[i] - mean_a) * (b[i] - mean_b) / count;
    return product / (mean_a * mean_b);
}

void bl_contrasts_measure(bl_run *run, const bl_gallery *gallery, size_t cells, const char *cell,
                          bl_contrasts *contrasts) {
    double a[PHASES * PHASES], b[PHASES * PHASES];
    contrasts->repeats = bl_run_count(run, 16, 32, BL_CONTRAST_REPEATS);
    bl_run_setting(run, "lattice contrast",
                   bl_run_text(run, "%d x %d places in %s, %zu pairs of %zu random cells", PHASES,
                               PHASES, cell, contrasts->repeats, cells));
    for (int on_plane = 0; on_plane < 2; on_plane++)
        for (size_t i = 0; i < gallery->count; i++) {
            bl_run_step(run, bl_run_text(run, "lattice contrast of %s", gallery->key[i]));
            for (size_t r = 0; r < contrasts->repeats; r++) {
                bl_random random = bl_run_random(run, 40960 + r);
                square_by_phase(gallery->signal[i], &random, on_plane, cells, a);
                square_by_phase(gallery->signal[i], &random, on_plane, cells, b);
                contrasts->values[on_plane][i][r] = contrast_of(a, b);
            }
        }
}

bl_estimate bl_contrast_of(const bl_contrasts *contrasts, int on_plane, int signal) {
    return bl_mean_estimate(contrasts->values[on_plane][signal], contrasts->repeats, 0.95);
}

bl_estimate bl_contrast_difference(const bl_contrasts *contrasts, int on_plane, int one,
                                   int other) {
    const double(*values)[BL_CONTRAST_REPEATS] = contrasts->values[on_plane];
    double difference[BL_CONTRAST_REPEATS];
    for (size_t r = 0; r < contrasts->repeats; r++)
        difference[r] = values[one][r] - values[other][r];
    return bl_mean_estimate(difference, contrasts->repeats, 0.95);
}
