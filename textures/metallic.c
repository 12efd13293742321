// SPDX-License-Identifier: MIT
//
// metallic: what a polished ball reflects: brown earth, a pale horizon, and a sky that darkens.
//
//   altitude = 1/2 + z / (2 |(x, y, z)|),  colour = spline(altitude)
//
// The place is a direction of any length: the reflected ray 2 n (n . v) - v in world space, z up.
//
// Parameters
//   filter   none
//            integral  the exact average of the map over the altitudes that the sample spans: its
//                      width in altitude is width_z / (2 |(x, y, z)|). What the other widths change
//                      is left aside
//   width, component   see textures/texture.h
//
// Bound: colours are cut to [0, 1]; the spline undershoots 0 in blue just below the horizon. Mean
// and infinite width: the average over all altitudes, which on a sphere are uniformly distributed
// (Archimedes), before the cut. Period: none. Class C0, where blue is cut at 0, but at the origin,
// where there is no direction: it has the colour of the horizon. NaN and infinite places give NaN.
//
// Source: peachey2003, p. 36. Deviation: the listing's names of two blues are damaged; the ramp
// from the horizon up is that of its seven blues and black in the order of their brightness.
#include <math.h>

#include "textures/colour_spline.h"
#include "textures/sampling.h"

typedef struct metallic_parameters {
    bl_seeing seeing;
} metallic_parameters;

enum { NONE, INTEGRAL };
static const char *const filter_words[] = {"none", "integral", NULL};

#define BROWN                                                                                      \
    {                                                                                              \
        { 0.1307, 0.0609, 0.0355 }                                                                 \
    }
static const bl_colour knots[] = {BROWN,
                                  BROWN,
                                  BROWN,
                                  BROWN,
                                  BROWN,
                                  {{0.4274, 0.5880, 0.9347}},
                                  {{0.1221, 0.3794, 0.9347}},
                                  {{0.1090, 0.3386, 0.8342}},
                                  {{0.0643, 0.2571, 0.6734}},
                                  {{0.0513, 0.2053, 0.5377}},
                                  {{0.0326, 0.1591, 0.4322}},
                                  {{0, 0, 0}}};
static const bl_colour_spline sky = {knots, sizeof knots / sizeof *knots};

static bl_colour see(const metallic_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    // The ratio of the squares overflows for no place up to 2^62, and is exact in its sign.
    double length = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    double altitude = length == 0 ? 0.5 : 0.5 + 0.5 * at[2] / length;
    bl_colour seen;
    if (!isfinite(length))
        return bl_colour_missing;
    if (bl_footprint_is_whole(footprint, 3)) {
        seen = bl_colour_spline_mean(&sky, 0.5, 1);
    } else if (p->seeing.filter == INTEGRAL) {
        // No direction is higher than straight up, so no width is more than all altitudes.
        double width = footprint->width[2], half = width > 0 ? 0.25 * width / length : width;
        double from = fmax(altitude - half, 0), to = fmin(altitude + half, 1);
        seen = isnan(half) ? bl_colour_missing
                           : bl_colour_spline_mean(&sky, 0.5 * (from + to), to - from);
    } else {
        seen = bl_colour_spline_at(&sky, altitude);
    }
    return bl_colour_clamp(seen);
}

BL_TEXTURE_ABILITIES(metallic_parameters, 3)

static void describe(const void *block, bl_facts *facts) {
    const metallic_parameters *p = block;
    const bl_colour ends[] = {{{0, 0, 0}}, {{1, 1, 1}}};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "colours are cut to [0, 1]");
    for (int a = 0; a < 3; a++)
        facts->period[a] = 0;
}

static const bl_parameter parameters[] = {BL_SEEING_PARAMETERS(metallic_parameters, filter_words),
                                          {0}};

BL_TEXTURE_DESCRIPTOR(metallic) = {
    .name = "metallic",
    .title = "reflected sky",
    .summary = "Earth, horizon and sky by the altitude of a direction.",
    .formula = "spline(1/2 + z / (2 |p|))",
    .paper = "peachey2003, p. 36",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(metallic_parameters),
    .describe = describe,
    .picture = {.scale = 4, .at = {1, 0, 0}, .normal = {-1, 0, 0}},
    .functions = {BL_TEXTURE_FUNCTIONS}};
