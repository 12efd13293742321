// SPDX-License-Identifier: MIT
//
// noise-period: the text's permutation of 256 entries against a hash of the whole cell: how soon a
// noise comes back, and how much of its rows is the same.
#include <math.h>
#include <stdlib.h>

#include "core/grid.h"
#include "core/random.h"
#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

enum { TEXTS = 4 };
static const char *const texts[TEXTS] = {"vnoise:lattice=perm256", "vnoise",
                                         "gnoise:lattice=perm256", "gnoise"};

// --- correlation with itself, far away ----------------------------------------------------------

enum { DISTANCES = 40 };

// The correlation of the values at random places with those `distance` away along x.
static double correlation(const bl_signal *signal, double distance, size_t probes, uint64_t seed,
                          double *at[BL_AXES], float *here, float *there) {
    bl_random random = bl_random_seed(seed, 4096);
    for (size_t i = 0; i < probes; i++)
        for (int a = 0; a < BL_AXES; a++)
            // Multiples of 2^-16, so that the sum with any distance below 2^36 is exact.
            at[a][i] = a < 3 ? 0x1p-16 * floor(0x1p33 * (bl_random_unit(&random) - 0.5)) : 0;
    bl_signal_points(signal, (const double *const *)at, probes, here);
    for (size_t i = 0; i < probes; i++)
        at[0][i] += distance;
    bl_signal_points(signal, (const double *const *)at, probes, there);
    double product = 0, square = 0, other = 0;
    for (size_t i = 0; i < probes; i++) {
        product += (double)here[i] * (double)there[i];
        square += (double)here[i] * (double)here[i];
        other += (double)there[i] * (double)there[i];
    }
    return product / sqrt(square * other);
}

// The interval of a correlation r of n pairs by Fisher's transform; r = 1 is exact.
static bl_estimate correlation_estimate(double r, double n) {
    if (r == 1)
        return bl_exactly(1, n);
    double z = atanh(r), half = bl_normal_quantile(0.975) / sqrt(n - 3);
    return (bl_estimate){r, tanh(z - half), tanh(z + half), 0.95, n};
}

typedef struct probes {
    size_t count;
    double *at[BL_AXES];
    float *here, *there;
} probes;

static probes open_probes(bl_run *run, size_t count) {
    probes p = {.count = count,
                .here = bl_run_memory(run, count, sizeof(float)),
                .there = bl_run_memory(run, count, sizeof(float))};
    for (size_t a = 0; a < BL_AXES; a++)
        p.at[a] = bl_run_memory(run, count, sizeof(double));
    return p;
}

static void plot_correlations(bl_run *run, const bl_gallery *gallery, const probes *p) {
    double distance[DISTANCES], values[TEXTS][DISTANCES];
    for (int d = 0; d < DISTANCES; d++)
        distance[d] = d < 18 ? ldexp(1, d) : 256.0 * (double)(3 + 2 * (d - 18));
    for (int i = 0; i < TEXTS; i++)
        for (int d = 0; d < DISTANCES; d++)
            values[i][d] =
                correlation(gallery->signal[i], distance[d], p->count, bl_run_settings(run)->seed,
                            (double **)p->at, p->here, p->there);
    const bl_graph graph = {
        .name = "correlations",
        .what = "correlation of a noise with itself some cells away along x",
        .alternative =
            "The correlation of four noises with themselves over the distance. With the "
            "permutation it is 1 at every multiple of 256 cells and about 0 elsewhere; with the "
            "hash it is about 0 from the second cell on.",
        .x_name = "distance_cells",
        .x = distance,
        .points = DISTANCES,
        .plot.x = {.label = "distance along x, cells", .from = 1, .to = 200000, .logarithmic = 1},
        .plot.y = {.label = "correlation", .from = -0.2, .to = 1.1, .tick = 0.2},
        .plot.aspect = 0.4};
    bl_gallery_draw_curves(run, gallery, values[0], BL_STROKE_POINTS, "measured", &graph);
}

static void claim_correlations(bl_run *run, const bl_gallery *gallery, const probes *p) {
    static const double distances[] = {256, 65536, 4294967296};
    for (int i = 0; i < TEXTS; i++)
        for (size_t d = 0; d < sizeof distances / sizeof *distances; d++) {
            double r = correlation(gallery->signal[i], distances[d], p->count,
                                   bl_run_settings(run)->seed, (double **)p->at, p->here, p->there);
            // A correct noise leaves these limits once in a million.
            double limit = tanh((bl_normal_quantile(1 - 5e-7) + bl_normal_quantile(0.975)) /
                                sqrt((double)p->count - 3));
            int repeats = i % 2 == 0;
            bl_make_claim(
                run, repeats ? "peachey2003, Lattice Noises" : "bandlimit",
                repeats ? "A table of 256 entries makes the noise repeat after 256 cells: its "
                          "correlation with itself that far away is 1."
                        : "A hash of the whole cell never repeats: the correlation with itself far "
                          "away is 0.",
                bl_run_text(run, "%s, %.0f cells along x", gallery->label[i], distances[d]), "",
                repeats ? 1 : -limit, repeats ? 1 : limit,
                correlation_estimate(r, (double)p->count), "places");
        }
}

// --- rows that are shifts of one another --------------------------------------------------------

enum { ROW = 256 };

// The largest correlation of the lattice values of two rows over all shifts.
static double best_shift(const bl_signal *signal, double y, double other_y) {
    double row[ROW], other[ROW], best = 0;
    for (int i = 0; i < ROW; i++) {
        row[i] = bl_signal_value(signal, (const double[BL_AXES]){i, y, 0, 0});
        other[i] = bl_signal_value(signal, (const double[BL_AXES]){i, other_y, 0, 0});
    }
    for (int shift = 0; shift < ROW; shift++) {
        double product = 0, square = 0, own = 0;
        for (int i = 0; i < ROW; i++) {
            product += row[i] * other[(i + shift) % ROW];
            square += row[i] * row[i];
            own += other[i] * other[i];
        }
        best = fmax(best, product / sqrt(square * own));
    }
    return best;
}

static void claim_rows(bl_run *run, const bl_gallery *gallery) {
    size_t rows = bl_run_count(run, 24, 128, 256);
    double *values = bl_run_memory(run, rows, sizeof *values);
    for (int i = 0; i < 2; i++) {
        for (size_t k = 0; k < rows; k++)
            values[k] = best_shift(gallery->signal[i], (double)k, (double)k + 1);
        bl_make_claim(
            run, "bandlimit",
            i == 0 ? "With the text's index every row of lattice numbers is a shift of any other: "
                     "the largest correlation of neighbouring rows over all shifts is 1."
                   : "With the hash no row is a shift of another: the largest correlation of "
                     "neighbouring rows over all 256 shifts is far below 1.",
            bl_run_text(run, "%s, lattice values", gallery->label[i]), "", i == 0 ? 1 - 1e-12 : 0,
            i == 0 ? 1 + 1e-12 : 0.5, bl_mean_estimate(values, rows, 0.95), "pairs of rows");
    }
}

// --- the picture --------------------------------------------------------------------------------

enum { CELLS = 768, BLOCK = 16, SIDE = CELLS / BLOCK };

// The means of blocks of cells, one sample a cell: what a table of 256 repeats shows best from far
// away, where single cells are too small to be told apart.
static void block_means(bl_run *run, const bl_signal *signal, float *out) {
    float *samples = bl_run_memory(run, CELLS * CELLS, sizeof *samples);
    const bl_grid grid = {.origin = {0.5, 0.5, 0.5, 0},
                          .right = {1, 0, 0, 0},
                          .down = {0, 1, 0, 0},
                          .width = CELLS,
                          .height = CELLS};
    bl_grid_fill(signal, &grid, bl_run_settings(run)->threads, samples);
    for (size_t n = 0; n < SIDE * SIDE; n++) {
        size_t left = n % SIDE * BLOCK, top = n / SIDE * BLOCK;
        double sum = 0;
        for (size_t k = 0; k < BLOCK * BLOCK; k++)
            sum += (double)samples[(top + k / BLOCK) * CELLS + left + k % BLOCK];
        out[n] = (float)(sum / (BLOCK * BLOCK));
    }
}

static void draw_wide(bl_run *run, const bl_gallery *gallery) {
    enum { SHOWN = 2 };
    bl_panel panels[SHOWN] = {0};
    float values[SIDE * SIDE];
    const double white = 0.07; // about three standard deviations of a mean
    for (int i = 0; i < SHOWN; i++) {
        const bl_image image = {.width = SIDE,
                                .height = SIDE,
                                .values = values,
                                .spacing = BLOCK,
                                .black = -white,
                                .white = white};
        block_means(run, gallery->signal[i], values);
        panels[i].title = gallery->label[i];
        panels[i].image = bl_run_image(run, bl_run_text(run, "%s-wide", gallery->key[i]), &image);
    }
    const bl_plot plot = {
        .title = "What do 768 cells look like from far away, with a table of 256 and with a hash?",
        .x = {.label = "x, lattice cells", .to = CELLS, .tick = 256},
        .y = {.label = "y, lattice cells", .from = CELLS, .tick = 256},
        .panels = panels,
        .panel_count = SHOWN,
        .columns = SHOWN,
        .aspect = 1,
        .black = -white,
        .white = white,
        .pixel = BLOCK,
        .scale_label = "mean"};
    bl_run_plot(
        run, "wide", &plot,
        "Two grey pictures of 768 by 768 cells, a pixel the mean of 16 by 16 cells. With the table "
        "one patch is repeated three times across and down; with the hash nothing comes back.");
}

static void run_figure(bl_run *run) {
    const bl_gallery gallery = bl_gallery_open(run, texts, TEXTS);
    const probes p = open_probes(run, bl_run_count(run, 4096, 32768, 65536));
    draw_wide(run, &gallery);
    plot_correlations(run, &gallery, &p);
    claim_correlations(run, &gallery, &p);
    claim_rows(run, &gallery);
}

BL_FIGURE_DESCRIPTOR(noise_period) = {
    .name = "noise-period",
    .title = "A table of 256 against a hash",
    .question = "How far away does a noise come back?",
    .paper = "peachey2003, Lattice Noises",
    .shows =
        "Value and gradient noise with the permutation of 256 entries that the text prints, and "
        "with a hash of the 64-bit cell numbers: pictures of 768 cells a side, seen from so far "
        "that a pixel is the mean of 16 by 16 cells, and the correlation of each noise with itself "
        "some distance away.",
    .run = run_figure};
