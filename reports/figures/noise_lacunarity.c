// SPDX-License-Identifier: MIT
//
// noise-lacunarity: the ratio of successive octaves, 2 against 2.17, and Worley's remedy, octaves
// that are turned or shifted at random: how much of the lattice shows.
//
// With the ratio 2 the lattice points of one octave are lattice points of all higher ones: there
// all octaves of a gradient noise are 0. With 2.17 only the lowest octave's own zeros line up with
// it.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"
#include "reports/figures/lattice_contrast.h"

static const char section[] = "peachey2003, Spectral Synthesis";

enum { TWO, OTHER, TURNED, SHIFTED, SUMS };
static const char *const texts[SUMS] = {
    "fbm:octaves=5,lacunarity=2", "fbm:octaves=5,lacunarity=2.17",
    "fbm:octaves=5,lacunarity=2,rotate=random", "fbm:octaves=5,lacunarity=2,shift=random"};

static const char *const places[2] = {"slices at random heights", "slices on a lattice plane"};

static void claim_contrasts(bl_run *run, const bl_contrasts *c) {
    for (int p = 0; p < 2; p++)
        bl_make_claim(run, section,
                      "A ratio of 2.17 reduces the artifacts of the lattice, because the lattice "
                      "points of the octaves no longer coincide: the lattice contrast with the "
                      "ratio 2 minus that with 2.17.",
                      places[p], "", 0, INFINITY, bl_contrast_difference(c, p, TWO, OTHER),
                      "pairs of sets of cells");
    for (int p = 0; p < 2; p++)
        bl_make_claim(run, section,
                      "Octaves turned at random reduce the artifacts of the lattice (Worley): the "
                      "lattice contrast without minus that with turning.",
                      places[p], "", 0, INFINITY, bl_contrast_difference(c, p, TWO, TURNED),
                      "pairs of sets of cells");
    // Between the planes a shift moves the pattern of an octave and does not lessen it.
    bl_make_claim(run, "bandlimit",
                  "Octaves shifted at random no longer vanish at the same points: the lattice "
                  "contrast without minus that with shifting.",
                  places[1], "", 0, INFINITY, bl_contrast_difference(c, 1, TWO, SHIFTED),
                  "pairs of sets of cells");
}

typedef struct entry {
    const char *signal;
    bl_estimate between, on_plane;
} entry;

static const bl_field fields[] = {
    {"signal", NULL, BL_CELL_WORD, .offset = offsetof(entry, signal)},
    {"contrast", NULL, BL_CELL_ESTIMATE, .offset = offsetof(entry, between)},
    {"contrast_on_plane", NULL, BL_CELL_ESTIMATE, .offset = offsetof(entry, on_plane)},
    {0}};

static void measure_contrasts(bl_run *run, const bl_gallery *gallery) {
    bl_contrasts c;
    entry rows[SUMS];
    bl_contrasts_measure(run, gallery, bl_run_count(run, 256, 2000, 20000),
                         "the cell of the lowest octave", &c);
    claim_contrasts(run, &c);
    for (int i = 0; i < SUMS; i++)
        rows[i] = (entry){gallery->label[i], bl_contrast_of(&c, 0, i), bl_contrast_of(&c, 1, i)};
    const bl_table table = {fields, rows, SUMS, sizeof *rows, .level = 0.95};
    bl_run_table(run, "contrasts", "lattice contrast, with 95 % intervals", &table);
}

// --- the deviation along a lattice line ---------------------------------------------------------

enum { PLACES = 129 };

// The standard deviation at places x from 0 to 1 along an edge of the lattice, over random cells.
static void deviation_along_edge(const bl_signal *signal, bl_random *random, size_t cells,
                                 double out[PLACES]) {
    float row[PLACES];
    const double step[BL_AXES] = {1.0 / (PLACES - 1), 0, 0, 0};
    for (int i = 0; i < PLACES; i++)
        out[i] = 0;
    for (size_t c = 0; c < cells; c++) {
        double start[BL_AXES] = {0};
        for (int a = 0; a < 3; a++)
            start[a] = floor((bl_random_unit(random) - 0.5) * 1e5);
        bl_signal_row(signal, start, step, PLACES, row);
        for (int i = 0; i < PLACES; i++)
            out[i] += (double)row[i] * (double)row[i] / (double)cells;
    }
    for (int i = 0; i < PLACES; i++)
        out[i] = sqrt(out[i]);
}

static void draw_deviations(bl_run *run, const bl_gallery *gallery) {
    double x[PLACES], values[SUMS][PLACES];
    for (int i = 0; i < PLACES; i++)
        x[i] = (double)i / (PLACES - 1);
    for (size_t s = 0; s < SUMS; s++) {
        bl_random random = bl_run_random(run, 77);
        deviation_along_edge(gallery->signal[s], &random, bl_run_count(run, 2000, 40000, 400000),
                             values[s]);
    }
    const bl_graph graph = {
        .name = "deviations",
        .what = "standard deviation along a lattice edge, over cells and seeds",
        .plot.title = "Where along a lattice edge do the octaves vanish?",
        .alternative =
            "The standard deviation of four sums along an edge of the lattice of the lowest "
            "octave. With the ratio 2 it is 0 at both ends, where all octaves vanish together; "
            "with 2.17, or with octaves turned, it stays above 0.1 there, and with octaves shifted "
            "above 0.05.",
        .x_name = "x_cells",
        .x = x,
        .points = PLACES,
        .plot.x = {.label = "x within the cell of the lowest octave", .to = 1, .tick = 0.25},
        .plot.y = {.label = "standard deviation", .to = 0.3, .tick = 0.1},
        .plot.aspect = 0.45};
    bl_gallery_draw_curves(run, gallery, values[0], BL_STROKE_LINE, "measured", &graph);
}

// --- the figure ---------------------------------------------------------------------------------

static void run_figure(bl_run *run) {
    bl_gallery_slices slices = {
        .name = "plane",
        .title = "Do the lattice points of the octaves show, on a plane of the lattice?",
        .alternative =
            "Four grey slices of 8 by 8 cells on a lattice plane: clouds that differ in their "
            "finer detail. All octaves of the first vanish at whole cells, which is hardly seen "
            "here but clear in the next plot.",
        .length = 8,
        .pixels = 384,
        .unit = "cells of the lowest octave"};
    const bl_gallery gallery = bl_gallery_open(run, texts, SUMS);
    bl_gallery_draw_slices(run, &gallery, &slices);
    draw_deviations(run, &gallery);
    measure_contrasts(run, &gallery);
}

static const bl_term terms[] = {
    {"lacunarity", "the ratio of the frequencies of successive octaves"},
    {"lattice contrast",
     "the relative variance, over the places within a cell of the lowest octave, of the variance "
     "of the noise at that place: 0 for a noise that looks the same at every place"},
    {0}};

BL_FIGURE_DESCRIPTOR(noise_lacunarity) = {
    .name = "noise-lacunarity",
    .title = "Lacunarity 2 against 2.17",
    .question = "Does a ratio of 2.17 between octaves hide the lattice?",
    .paper = "peachey2003, Spectral Synthesis",
    .terms = terms,
    .shows =
        "Five octaves of gradient noise on a plane of the lattice of the lowest: with the ratio 2, "
        "with 2.17, and with the ratio 2 and each octave turned or shifted at random. The claims "
        "measure how much the variance depends on the place in the cell.",
    .run = run_figure};
