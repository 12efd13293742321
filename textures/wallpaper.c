// SPDX-License-Identifier: MIT
//
// wallpaper: small stars at random places, one a cell at most.
//
//   centre(cell) = (cell + 1/2 + 0.6 (n(cell + 1/2), n(cell + (3.5, 8.5)))) / count
//   present(cell) = 1/2 + n(3 cell_s - 9.5, 7 cell_t + 7.5) / 2 < 0.55
//
// Parameters
//   seed, noise   n: any noise of two dimensions; default gnoise:dims=2
//   count    cells in a unit along each axis; default 10
//   cells    neighbours: the star of each of the nine cells around a place is tested; one: the
//            text's first listing: there is a star in each cell, and only that of the place's own
//            cell is seen, so that it is cut off at the cell's edge
//   form     of cells=neighbours. corrected; printed: whether a star is present is asked of the
//            centre cell's column instead of the star's own, so that a star that reaches into the
//            next column may end at its edge
//   filter   none
//            boxstep, smoothstep  edges as of star. Where the sample is wider than a quarter of a
//                                 cell, stars beyond the nine cells are missed
//            fade                 boxstep, and over to the mean between half the Nyquist limit of
//                                 the cells and the limit, at which the sample is as wide as half a
//                                 cell
//   width, component   see textures/texture.h
//
// Stars have 5 points and radii of 0.1 and 0.3 cells. Bound: between two colours. Mean: not stated;
// infinite width gives the area of the stars of 64 x 64 cells, as if none overlapped or were cut.
// With cells=neighbours no star is cut: |n| <= 0.7072 for the default noise, so the centre lies
// within 0.43 cells of the middle and the tips within 0.73, less than 1 + 1/2.
// NaN and infinite places give NaN.
//
// Source: peachey2003, section Random Placement Patterns, both listings. Deviations: the angle
// within a star is right (see star); the second listing's presence test is corrected unless
// form=printed.
#include <math.h>

#include "filters/octave_fade.h"
#include "textures/noise_source.h"
#include "textures/star_shape.h"

typedef struct wallpaper_parameters {
    bl_noise_source noise;
    double count;
    uint32_t cells, form;
    bl_seeing seeing;
    double share; // of stars, made on opening
    double reach; // of a star from the middle of its cell along each axis, likewise
} wallpaper_parameters;

enum { NEIGHBOURS, ONE };
static const char *const cell_words[] = {"neighbours", "one", NULL};
static const char *const form_words[] = {"corrected", "printed", NULL};
enum { NONE, BOXSTEP, SMOOTHSTEP, FADE }; // the first three as bl_edge
static const char *const filter_words[] = {"none", "boxstep", "smoothstep", "fade", NULL};
static const bl_colour paper_colour = {{0.05, 0.12, 0.4}}, star_colour = {{1.0, 0.5161, 0.0}};

// In cells, like all coordinates below.
static const bl_star star = {.points = 5, .inner = 0.1, .outer = 0.3};

// The noise that tells whether a cell has a star, and those that move it along each axis.
enum { PRESENCE, ALONG_S, ALONG_T };
static const double noise_scale[3][2] = {{3, 7}, {1, 1}, {1, 1}};
static const double noise_aside[3][2] = {{-9.5, 7.5}, {0.5, 0.5}, {3.5, 8.5}};

static void gather_cell(bl_gathered *cells, size_t of, int noise, double column, double row) {
    bl_gather(cells, of,
              (const double[BL_AXES]){noise_scale[noise][0] * column + noise_aside[noise][0],
                                      noise_scale[noise][1] * row + noise_aside[noise][1]});
}

static int is_present(double noise) {
    return 0.5 + 0.5 * noise < 0.55;
}

// What samples see of the cells, in cells: the cell that each lies in, its place from the middle of
// that, and its widths. `share` of stars is to be found.
typedef struct wall_samples {
    double cell[2][BL_BATCH], place[2][BL_BATCH], width[2][BL_BATCH], share[BL_BATCH];
    size_t of[BL_BATCH], count;
} wall_samples;

static void add_sample(const wallpaper_parameters *p, wall_samples *seen, size_t of,
                       const double at[BL_AXES], const double width[BL_AXES]) {
    size_t k = seen->count++;
    for (int a = 0; a < 2; a++) {
        double place = at[a] * p->count;
        seen->cell[a][k] = floor(place);
        seen->place[a][k] = place - (seen->cell[a][k] + 0.5);
        seen->width[a][k] = width[a] * p->count;
    }
    seen->share[k] = 0;
    seen->of[k] = of;
}

// The samples that the star of the cell (i, j) beside their own may reach, if it is there.
static void find_present(const wallpaper_parameters *p, const wall_samples *seen, int i, int j,
                         bl_gathered *present) {
    bl_gathered near;
    double noise[BL_BATCH];
    near.count = 0;
    for (size_t k = 0; k < seen->count; k++) {
        // Beyond a tip, the filtered step falls along the axis 3.9 times slower than across edges.
        double more = 2 * (seen->width[0][k] + seen->width[1][k]);
        double reach = p->reach + (p->seeing.filter == NONE ? 0 : more);
        if (fabs(seen->place[0][k] - i) <= reach && fabs(seen->place[1][k] - j) <= reach)
            gather_cell(&near, k, PRESENCE, seen->cell[0][k] + (p->form ? 0 : i),
                        seen->cell[1][k] + j);
    }
    bl_signal_values_gathered(p->noise.signal, &near, noise);
    for (size_t n = 0; n < near.count; n++)
        if (is_present(noise[n]))
            present->of[present->count++] = near.of[n];
}

// How much of the stars of the cell (i, j) beside their own the samples see.
static void add_stars(const wallpaper_parameters *p, int i, int j, wall_samples *seen) {
    const bl_edge edge = p->seeing.filter == FADE ? BL_EDGE_BOXSTEP : (bl_edge)p->seeing.filter;
    bl_gathered present, along_s, along_t;
    double x[BL_BATCH], y[BL_BATCH];
    present.count = along_s.count = along_t.count = 0;
    if (p->cells == ONE)
        for (; present.count < seen->count; present.count++)
            present.of[present.count] = present.count;
    else
        find_present(p, seen, i, j, &present);
    for (size_t n = 0; n < present.count; n++) {
        size_t k = present.of[n];
        gather_cell(&along_s, k, ALONG_S, seen->cell[0][k] + i, seen->cell[1][k] + j);
        gather_cell(&along_t, k, ALONG_T, seen->cell[0][k] + i, seen->cell[1][k] + j);
    }
    bl_signal_values_gathered(p->noise.signal, &along_s, x);
    bl_signal_values_gathered(p->noise.signal, &along_t, y);
    for (size_t n = 0; n < present.count; n++) {
        size_t k = present.of[n];
        const double width[BL_AXES] = {seen->width[0][k], seen->width[1][k]};
        double star_seen = bl_star_step(&star, edge, seen->place[0][k] - i - 0.6 * x[n],
                                        seen->place[1][k] - j - 0.6 * y[n], width);
        seen->share[k] = p->cells == ONE ? star_seen : fmax(seen->share[k], star_seen);
    }
}

static void find_stars(const wallpaper_parameters *p, wall_samples *seen) {
    const int reach = p->cells == ONE ? 0 : 1;
    for (int j = -reach; j <= reach; j++)
        for (int i = -reach; i <= reach; i++)
            add_stars(p, i, j, seen);
}

static double kept_of(const wallpaper_parameters *p, const bl_footprint *footprint) {
    return p->seeing.filter == FADE
               ? bl_octave_kept(p->count, BL_CLAMP_FADE, bl_footprint_widest(footprint, 2))
               : 1;
}

// Up to BL_BATCH samples.
static void see_batch(const wallpaper_parameters *p, const bl_samples *samples, double *rgb) {
    wall_samples seen;
    seen.count = 0;
    for (size_t i = 0; i < samples->count; i++) {
        const bl_footprint *footprint = bl_samples_footprint(samples, i);
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        if (!bl_texture_is_seen(at, footprint, 2))
            bl_colour_put(bl_colour_missing, rgb + 3 * i);
        else if (bl_footprint_is_whole(footprint, 2) || !(kept_of(p, footprint) > 0))
            bl_colour_put(bl_colour_mix(paper_colour, star_colour, p->share), rgb + 3 * i);
        else
            add_sample(p, &seen, i, at, footprint->width);
    }
    find_stars(p, &seen);
    for (size_t k = 0; k < seen.count; k++) {
        double kept = kept_of(p, bl_samples_footprint(samples, seen.of[k]));
        double share = (1 - kept) * p->share + kept * seen.share[k];
        bl_colour_put(bl_colour_mix(paper_colour, star_colour, share), rgb + 3 * seen.of[k]);
    }
}

BL_TEXTURE_BATCH_ABILITIES(wallpaper_parameters)

enum { CELLS = 64 };
_Static_assert((int)CELLS <= (int)BL_BATCH, "a row of cells is one batch");

// How many of CELLS x CELLS cells have a star.
static int count_stars(const wallpaper_parameters *p) {
    int present = 0;
    for (int j = 0; j < CELLS; j++) {
        bl_gathered cells = {.count = 0};
        double noise[BL_BATCH];
        for (int i = 0; i < CELLS; i++)
            gather_cell(&cells, (size_t)i, PRESENCE, i, j);
        bl_signal_values_gathered(p->noise.signal, &cells, noise);
        for (int i = 0; i < CELLS; i++)
            present += p->cells == ONE || is_present(noise[i]);
    }
    return present;
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    wallpaper_parameters *p = block;
    bl_status status = bl_noise_source_open(&p->noise, p->noise.text, 2, message);
    if (status != BL_OK)
        return status;
    const bl_facts *facts = &p->noise.signal->facts;
    double bound = fmax(fabs(facts->lower), fabs(facts->upper)); // of a noise without one, NaN
    p->reach = isfinite(bound) ? 0.6 * bound + star.outer : INFINITY;
    p->share = bl_star_area(&star) * count_stars(p) / (CELLS * CELLS);
    return BL_OK;
}

static void release(void *block) {
    bl_noise_source_close(&((wallpaper_parameters *)block)->noise);
}

static void describe(const void *block, bl_facts *facts) {
    const wallpaper_parameters *p = block;
    const bl_colour ends[] = {paper_colour, star_colour};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between two colours");
    facts->continuity = p->seeing.width == 0 || p->seeing.filter == NONE ? -1 : -2;
}

static const bl_parameter parameters[] = {
    BL_NOISE_SOURCE_PARAMETERS(wallpaper_parameters, noise, "gnoise:dims=2"),
    {"count", BL_REAL, offsetof(wallpaper_parameters, count), "10", "cells per unit",
     .minimum = 1e-6, .maximum = 1e6, .help = "of stars along each axis"},
    {"cells", BL_CHOICE, offsetof(wallpaper_parameters, cells), "neighbours", "",
     .choices = cell_words, .help = "whose stars a place sees"},
    {"form", BL_CHOICE, offsetof(wallpaper_parameters, form), "corrected", "",
     .choices = form_words, .help = "or as printed, with the presence of the wrong column"},
    BL_SEEING_PARAMETERS(wallpaper_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(wallpaper) = {
    .name = "wallpaper",
    .title = "wallpaper of stars",
    .summary = "Small stars at random places, one a cell at most.",
    .formula = "mix(paper, star, max over cells of present(cell) star(p - centre(cell)))",
    .paper = "peachey2003, Random Placement Patterns",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(wallpaper_parameters),
    .describe = describe,
    .picture = {.scale = 1, .at = {0.5, 0.5}},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build, .release = release}};
