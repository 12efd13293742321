// SPDX-License-Identifier: MIT
//
// hart2001-2: the noise of the Rayshade ray tracer with cubic and with linear weights, and the
// horizontal and vertical tendency that the paper sees in it.
//
// The tendency is measured in slices: the power of the spectrum within 22.5 degrees of the axes
// over that within 22.5 degrees of the diagonals, at radial frequencies from 0.2 to 1.2. A noise
// without preferred directions reads 0 dB.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"
#include "spectra/psd.h"

enum { SPECTRA = 12, IN_BAND = 0, ABOVE = 1, BANDS };

static const struct {
    double from, to;
    const char *word;
} bands[BANDS] = {{0.2, 1, "from 0.2 to 1 cycles per cell"}, {1, 3, "from 1 to 3 cycles per cell"}};

// Axes over diagonals, from the half plane of a slice spectrum.
static double tendency(const bl_psd *psd, int band) {
    size_t size = psd->settings.size, half = size / 2 + 1;
    double step = psd->settings.rate / (double)size, axes = 0, diagonals = 0;
    size_t axis_cells = 0, diagonal_cells = 0;
    for (size_t row = 0; row < size; row++)
        for (size_t column = 0; column < half; column++) {
            double fx = (double)column * step;
            double fy = ((double)row - (row > size / 2 ? (double)size : 0)) * step;
            double radius = hypot(fx, fy), angle = atan2(fabs(fy), fx);
            if (radius < bands[band].from || radius > bands[band].to)
                continue;
            if (fabs(angle - M_PI / 4) < M_PI / 8) {
                diagonals += psd->plane[row * half + column];
                diagonal_cells++;
            } else {
                axes += psd->plane[row * half + column];
                axis_cells++;
            }
        }
    return 10 * log10(axes / (double)axis_cells / (diagonals / (double)diagonal_cells));
}

static void measure(bl_run *run, const bl_signal *signal, bl_estimate result[BANDS]) {
    double values[BANDS][SPECTRA];
    bl_psd_settings settings = bl_run_psd_settings(run, 2);
    settings.rate = 8;
    settings.size = bl_run_count(run, 128, 256, 512);
    settings.averages = bl_run_count(run, 4, 16, 128);
    for (int i = 0; i < SPECTRA; i++) {
        settings.seed = bl_run_settings(run)->seed + 500 + (uint64_t)i;
        const bl_psd *psd = bl_run_psd(run, signal, &settings);
        for (int b = 0; b < BANDS; b++)
            values[b][i] = tendency(psd, b);
    }
    for (int b = 0; b < BANDS; b++)
        result[b] = bl_mean_estimate(values[b], SPECTRA, 0.95);
}

static void run_figure(bl_run *run) {
    static const char *const texts[] = {"rayshade", "rayshade:weights=linear", "scnoise"};
    static const bl_gallery_slices slices = {
        .name = "between",
        .alternative =
            "Grey slices of 16 by 16 cells. With cubic weights the cells are flat blobs; with "
            "linear weights creases run along the lattice lines; sparse convolution noise shows no "
            "lattice.",
        .origin = {0, 0, 0.381966, 0},
        .length = 16,
        .pixels = 256,
        .deviations = 2.5,
        .unit = "lattice cells"};
    bl_estimate result[3][BANDS];
    const bl_gallery gallery = bl_gallery_open(run, texts, 3);
    bl_gallery_draw_slices(run, &gallery, &slices);
    for (int i = 0; i < 3; i++)
        measure(run, gallery.signal[i], result[i]);
    for (int i = 0; i < 2 * BANDS; i++)
        bl_make_claim(run, "hart2001, section 2",
                      "Noise on an integer lattice has a strong horizontal and vertical tendency: "
                      "the power near the axes over that near the diagonals.",
                      bl_run_text(run, "%s, slices at random places, %s", gallery.label[i % 2],
                                  bands[i / 2].word),
                      "dB", 1, INFINITY, result[i % 2][i / 2], "spectra");
    for (int b = 0; b < BANDS; b++)
        bl_make_claim(run, "bandlimit",
                      "A noise without a lattice has no such tendency: the power near the axes "
                      "over that near the diagonals.",
                      bl_run_text(run, "scnoise, slices at random places, %s", bands[b].word), "dB",
                      -0.5, 0.5, result[2][b], "spectra");
}

BL_FIGURE_DESCRIPTOR(hart2001_2) = {
    .name = "hart2001-2",
    .title = "The Rayshade noise, cubic and linear",
    .question = "How much do the weights between the lattice points matter?",
    .paper = "hart2001, fig. 2",
    .shows =
        "Slices of the noise of the Rayshade ray tracer with the cubic weights of the program and "
        "with linear ones, and of sparse convolution noise, which has no lattice, for comparison.",
    .run = run_figure};
