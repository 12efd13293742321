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

static int is_present(const wallpaper_parameters *p, double column, double row) {
    return 0.5 + 0.5 * bl_noise_source_value(&p->noise, 3 * column - 9.5, 7 * row + 7.5, 0) < 0.55;
}

// How much of the star of a cell is seen at (s, t), given from the cell's own middle.
static double star_of(const wallpaper_parameters *p, double column, double row, double s, double t,
                      const double width[BL_AXES]) {
    double x = s - 0.6 * bl_noise_source_value(&p->noise, column + 0.5, row + 0.5, 0);
    double y = t - 0.6 * bl_noise_source_value(&p->noise, column + 3.5, row + 8.5, 0);
    bl_edge edge = p->seeing.filter == FADE ? BL_EDGE_BOXSTEP : (bl_edge)p->seeing.filter;
    return bl_star_step(&star, edge, x, y, width);
}

static double share_of_stars(const wallpaper_parameters *p, const double at[BL_AXES],
                             const double wide[BL_AXES]) {
    double s = at[0] * p->count, t = at[1] * p->count, column = floor(s), row = floor(t);
    const double width[BL_AXES] = {wide[0] * p->count, wide[1] * p->count};
    s -= column + 0.5;
    t -= row + 0.5;
    if (p->cells == ONE)
        return star_of(p, column, row, s, t, width);
    // Beyond a tip, the filtered step falls along the axis 3.9 times slower than across the edges.
    double most = 0, reach = p->reach + (p->seeing.filter == NONE ? 0 : 2 * (width[0] + width[1]));
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++)
            if (fabs(s - i) <= reach && fabs(t - j) <= reach &&
                is_present(p, column + (p->form ? 0 : i), row + j))
                most = fmax(most, star_of(p, column + i, row + j, s - i, t - j, width));
    return most;
}

static double share_of(const wallpaper_parameters *p, const double at[BL_AXES],
                       const bl_footprint *footprint) {
    if (bl_footprint_is_whole(footprint, 2))
        return p->share;
    double widest = bl_footprint_widest(footprint, 2);
    double kept = p->seeing.filter == FADE ? bl_octave_kept(p->count, BL_CLAMP_FADE, widest) : 1;
    double share = kept > 0 ? share_of_stars(p, at, footprint->width) : 0;
    return (1 - kept) * p->share + kept * share;
}

static bl_colour see(const wallpaper_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    return bl_colour_mix(paper_colour, star_colour, share_of(p, at, footprint));
}

BL_TEXTURE_ABILITIES(wallpaper_parameters, 2)

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    enum { CELLS = 64 };
    wallpaper_parameters *p = block;
    bl_status status = bl_noise_source_open(&p->noise, p->noise.text, 2, message);
    if (status != BL_OK)
        return status;
    const bl_facts *facts = &p->noise.signal->facts;
    double bound = fmax(fabs(facts->lower), fabs(facts->upper)); // of a noise without one, NaN
    p->reach = isfinite(bound) ? 0.6 * bound + star.outer : INFINITY;
    int present = 0;
    for (int j = 0; j < CELLS; j++)
        for (int i = 0; i < CELLS; i++)
            present += p->cells == ONE || is_present(p, i, j);
    p->share = bl_star_area(&star) * present / (CELLS * CELLS);
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
