// SPDX-License-Identifier: MIT
//
// peachey-2.36: slices of six noises on one scale of grey, through a random place and on a plane of
// the lattice, and how much of the lattice is seen in them.
//
// Two measures of a grid pattern, both zero for a noise that has none:
//   lattice contrast  let v(p) be the variance over cells and seeds at the place p within the cell;
//                     the contrast is the variance of v over p, over the square of its mean. Two
//                     independent halves of the cells are multiplied, so that the scatter of the
//                     estimate of v does not count.
//   ring anisotropy   of the slice spectrum (spectra/psd.h), above the level that an isotropic
//                     noise reads; the mean in dB over the rings with 0.2 < f < 1.2.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "core/random.h"
#include "reports/figures/six_noises.h"
#include "spectra/psd.h"

enum { CELLS = 16, PER_CELL = 16, SIDE = CELLS * PER_CELL };
enum { PHASES = 8, LATTICE_SPAN = 100000 };

static const double unlimited = INFINITY;
static const char text_gridless[] = "peachey2003, Sparse Convolution Noise";

// --- the slices ---------------------------------------------------------------------------------

static void fill_slice(const bl_signal *signal, double z, float *out) {
    const bl_grid grid = {.origin = {0, 0, z, 0},
                          .right = {1.0 / PER_CELL, 0, 0, 0},
                          .down = {0, 1.0 / PER_CELL, 0, 0},
                          .width = SIDE,
                          .height = SIDE};
    bl_grid_fill(signal, &grid, 1, out);
}

static bl_status write_slices(bl_run *run, const bl_six *six, const char *place, double z,
                              float *values, bl_message *message) {
    bl_status status = BL_OK;
    for (int i = 0; i < BL_SIX && status == BL_OK; i++) {
        fill_slice(six->signal[i], z, values);
        const bl_attribute signal = {"bandlimit:signal", six->signal[i]->text};
        const bl_image image = {.width = SIDE,
                                .height = SIDE,
                                .values = values,
                                .spacing = 1.0 / PER_CELL,
                                .black = -1,
                                .white = 1,
                                .attributes = &signal,
                                .attribute_count = 1};
        status =
            bl_run_image(run, bl_run_text(run, "%s-%s", bl_six_names[i], place), &image, message);
    }
    return status;
}

static bl_status plot_slices(bl_run *run, const char *place, const char *title,
                             const char *alternative, bl_message *message) {
    bl_panel panels[BL_SIX] = {0};
    for (int i = 0; i < BL_SIX; i++) {
        panels[i].title = bl_six_names[i];
        panels[i].image = bl_run_text(run, "%s-%s.png", bl_six_names[i], place);
    }
    const bl_plot plot = {.title = title,
                          .x = {"x, lattice cells", 0, CELLS, 4},
                          .y = {"y, lattice cells", CELLS, 0, 4},
                          .panels = panels,
                          .panel_count = BL_SIX,
                          .columns = 3,
                          .aspect = 1,
                          .black = -1,
                          .white = 1,
                          .pixel = 1.0 / PER_CELL,
                          .scale_label = "value"};
    return bl_run_plot(run, bl_run_text(run, "slices-%s", place), &plot, alternative, message);
}

static bl_status make_slices(bl_run *run, const bl_six *six, bl_message *message) {
    bl_random random = bl_random_seed(bl_run_settings(run)->seed, 236);
    double z = 0.25 + 0.5 * bl_random_unit(&random); // well between two planes
    bl_run_setting(run, "slice at a random place", bl_run_text(run, "z = %.6f", z));
    bl_run_setting(run, "slice on a lattice plane", "z = 0");
    bl_run_setting(
        run, "image",
        bl_run_text(run,
                    "%d x %d cells, %d pixels a cell, x to the right, "
                    "y downwards; grey from -1 (black) to 1 (white), beyond them clipped, in PNG",
                    CELLS, CELLS, PER_CELL));
    float *values = malloc(sizeof *values * SIDE * SIDE);
    if (!values)
        return bl_report(message, BL_DEVICE, "out of memory");
    bl_run_step(run, "slices");
    bl_status status = write_slices(run, six, "random", z, values, message);
    if (status == BL_OK)
        status = write_slices(run, six, "lattice", 0, values, message);
    free(values);
    if (status == BL_OK)
        status = plot_slices(run, "random", "What do slices between the lattice planes look like?",
                             "Six grey slices of 16 by 16 cells at a random height between two "
                             "planes of the lattice.",
                             message);
    if (status == BL_OK)
        status = plot_slices(run, "lattice", "What do slices on a lattice plane look like?",
                             "The same six noises on a plane of the lattice, where the zeros of "
                             "gradient noise form a grid.",
                             message);
    return status;
}

// --- lattice contrast ---------------------------------------------------------------------------

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

static void measure_contrast(const bl_run *run, const bl_signal *signal, int on_plane, size_t cells,
                             size_t repeats, double *out) {
    double a[PHASES * PHASES], b[PHASES * PHASES];
    for (size_t r = 0; r < repeats; r++) {
        bl_random random = bl_random_seed(bl_run_settings(run)->seed, 40960 + r);
        square_by_phase(signal, &random, on_plane, cells, a);
        square_by_phase(signal, &random, on_plane, cells, b);
        out[r] = contrast_of(a, b);
    }
}

// The contrasts of all noises between the planes and on them, `repeats` each.
typedef struct contrasts {
    size_t repeats;
    double *values[2][BL_SIX], *difference;
} contrasts;

static const char *const slice_words[] = {"slice at random places", "slice on a lattice plane"};

static bl_estimate contrast_difference(const contrasts *c, int on_plane, int one, int other) {
    for (size_t r = 0; r < c->repeats; r++)
        c->difference[r] = c->values[on_plane][one][r] - c->values[on_plane][other][r];
    return bl_mean_estimate(c->difference, c->repeats, 0.95);
}

static void claim_contrasts(bl_run *run, const contrasts *c) {
    for (int p = 0; p < 2; p++)
        bl_six_claim(run, "peachey2003, Value-Gradient Noise",
                     "Value-gradient noise looks less regular than gradient noise: its lattice "
                     "contrast less that of gnoise.",
                     bl_run_text(run, "vgnoise, %s", slice_words[p]), "", -unlimited, 0,
                     contrast_difference(c, p, BL_VGNOISE, BL_GNOISE));
    for (int p = 0; p < 2; p++)
        for (int i = 0; i < BL_SCNOISE; i++)
            bl_six_claim(run, text_gridless,
                         "Sparse convolution noise shows fewer gridlike patterns than the others: "
                         "the other's lattice contrast less that of scnoise.",
                         bl_run_text(run, "against %s, %s", bl_six_names[i], slice_words[p]), "", 0,
                         unlimited, contrast_difference(c, p, i, BL_SCNOISE));
    for (int p = 0; p < 2; p++)
        bl_six_claim(run, "bandlimit",
                     "Impulses at uniform places make scnoise stationary: its lattice contrast "
                     "is 0.",
                     bl_run_text(run, "scnoise, %s", slice_words[p]), "", -0.05, 0.05,
                     bl_mean_estimate(c->values[p][BL_SCNOISE], c->repeats, 0.95));
}

static bl_status claim_contrast(bl_run *run, const bl_six *six, double between[BL_SIX],
                                double on_plane[BL_SIX], bl_message *message) {
    contrasts c = {.repeats = (size_t)bl_run_pick(run, 16, 32, 64)};
    size_t cells = (size_t)bl_run_pick(run, 32, 500, 20000);
    bl_run_setting(run, "lattice contrast",
                   bl_run_text(run, "%d x %d places in the cell, %zu pairs of %zu random cells",
                               PHASES, PHASES, c.repeats, cells));
    double *all = malloc(sizeof *all * c.repeats * (2 * BL_SIX + 1));
    if (!all)
        return bl_report(message, BL_DEVICE, "out of memory");
    c.difference = all + 2 * BL_SIX * c.repeats;
    for (int p = 0; p < 2; p++) {
        bl_run_step(run, bl_run_text(run, "lattice contrast, %s", slice_words[p]));
        for (int i = 0; i < BL_SIX; i++) {
            double *values = c.values[p][i] = all + (size_t)(p * BL_SIX + i) * c.repeats;
            measure_contrast(run, six->signal[i], p, cells, c.repeats, values);
            (p ? on_plane : between)[i] = bl_mean_estimate(values, c.repeats, 0.95).value;
        }
    }
    claim_contrasts(run, &c);
    free(all);
    return BL_OK;
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

static bl_status measure_anisotropy(bl_run *run, const bl_signal *signal,
                                    double out[ANISOTROPY_REPEATS], bl_message *message) {
    bl_psd_settings settings = bl_psd_default_settings(2);
    settings.rate = 8;
    settings.size = (size_t)bl_run_pick(run, 128, 256, 512);
    settings.averages = (size_t)bl_run_pick(run, 2, 16, 256);
    settings.axis[2] = 1;
    settings.threads = bl_run_settings(run)->threads;
    for (int r = 0; r < ANISOTROPY_REPEATS; r++) {
        bl_psd psd;
        settings.seed = bl_run_settings(run)->seed + 100 + (uint64_t)r;
        bl_status status = bl_psd_measure(signal, &settings, &psd, message);
        if (status != BL_OK)
            return status;
        out[r] = mean_anisotropy(&psd);
        bl_psd_free(&psd);
    }
    return BL_OK;
}

static bl_status claim_anisotropy(bl_run *run, const bl_six *six, double *mean,
                                  bl_message *message) {
    double values[BL_SIX][ANISOTROPY_REPEATS], difference[ANISOTROPY_REPEATS];
    bl_status status = BL_OK;
    bl_run_step(run, "ring anisotropy");
    for (int i = 0; i < BL_SIX && status == BL_OK; i++) {
        status = measure_anisotropy(run, six->signal[i], values[i], message);
        if (status == BL_OK)
            mean[i] = bl_mean_estimate(values[i], ANISOTROPY_REPEATS, 0.95).value;
    }
    for (int i = 0; i < BL_SCNOISE && status == BL_OK; i++) {
        for (int r = 0; r < ANISOTROPY_REPEATS; r++)
            difference[r] = values[i][r] - values[BL_SCNOISE][r];
        bl_six_claim(run, text_gridless,
                     "Sparse convolution noise prefers fewer directions than the others: the "
                     "other's ring anisotropy less that of scnoise.",
                     bl_run_text(run, "against %s, slice at random places", bl_six_names[i]), "dB",
                     0, unlimited, bl_mean_estimate(difference, ANISOTROPY_REPEATS, 0.95));
    }
    return status;
}

static bl_status run_figure(bl_run *run, bl_message *message) {
    bl_six six;
    double between[BL_SIX], on_plane[BL_SIX], anisotropy[BL_SIX];
    bl_status status = bl_six_open(run, &six, message);
    if (status != BL_OK)
        return status;
    status = make_slices(run, &six, message);
    if (status == BL_OK)
        status = claim_contrast(run, &six, between, on_plane, message);
    if (status == BL_OK)
        status = claim_anisotropy(run, &six, anisotropy, message);
    const bl_column columns[] = {{.name = "noise", .words = bl_six_names},
                                 {.name = "lattice_contrast_random_place", .values = between},
                                 {.name = "lattice_contrast_lattice_plane", .values = on_plane},
                                 {.name = "ring_anisotropy_above_floor_db", .values = anisotropy}};
    if (status == BL_OK)
        status = bl_run_csv(run, "grid-patterns", "how much of the lattice is seen in a slice",
                            columns, 4, BL_SIX, message);
    bl_six_close(&six);
    return status;
}

BL_FIGURE_DESCRIPTOR(peachey_2_36) = {
    .name = "peachey-2.36",
    .title = "Slices of six noises",
    .question = "What do the six noises look like in a slice, and how much of the lattice shows?",
    .paper = "peachey2003, fig. 2.36",
    .shows =
        "Slices of 16 by 16 cells, all on the same scale of grey: first at a random height "
        "between two planes of the lattice, then on a plane, where the regular zeros of "
        "gradient noise show. The claims put two numbers to the grid pattern: how much the "
        "variance depends on the place in the cell, and how much the spectrum prefers "
        "directions.",
    .run = run_figure};
