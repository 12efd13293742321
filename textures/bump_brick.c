// SPDX-License-Identifier: MIT
//
// bumpbrick: the brick wall with grooves of mortar, seen in a fixed light.
//
//   height(s, t) = depth g(s) g(t),  g = smoothstep(0, edge, .) - smoothstep(1 - edge, 1, .)
//   colour = brick colour * (1/4 + 3/4 max(0, n . l)),  n = (-dh/ds, -dh/dt, 1) / |.|
//   l = (-2, 3, 6) / 7, from the upper left
//
// Parameters
//   brick_width, brick_height, mortar   as of brick
//   depth    of the grooves, units; default 0.003, a slope of 0.9 at most for the default mortar
//   filter   none
//            slope  the box averages of the height's slopes (differences of heights, in the row of
//                   the sample's centre) bend the normal, and the colour has its exact average.
//                   What a bend of both signs adds to the light is lost
//            fade   the point's colour goes over to the mean between half the Nyquist limit of a
//                   row of bricks and the limit
//   width, component   see textures/texture.h
//
// Bound: between black and the brick's colours, as light is no more than 1. Mean: not stated (no
// closed form); infinite width gives the midpoint rule over one brick, 256 x 256 places, whose
// error is about 1e-4. Period: that of brick. NaN and infinite places give NaN.
//
// Source: peachey2003, pp. 43-46. Deviations: the text's height of 1 has no unit; the light is
// ours.
#include "textures/texture.h"

#include <math.h>

#include "filters/octave_fade.h"
#include "textures/brick_shape.h"
#include "textures/sampling.h"

typedef struct bump_brick_parameters {
    bl_brick_sizes sizes;
    double depth;
    bl_seeing seeing;
    bl_colour mean; // made on opening
} bump_brick_parameters;

enum { NONE, SLOPE, FADE };
static const char *const filter_words[] = {"none", "slope", "fade", NULL};

static double profile(double edge, double x) {
    x -= floor(x);
    return bl_unit_smoothstep(x / edge) - bl_unit_smoothstep((x - (1 - edge)) / edge);
}

static double profile_slope(double edge, double x) {
    x -= floor(x);
    double u = x < edge ? x / edge : (1 - x) / edge, sign = x < edge ? 1 : -1;
    return u < 1 ? sign * 6 * u * (1 - u) / edge : 0;
}

// The integral of the profile from 0 to x in [0, 1].
static double profile_part(double edge, double x) {
    if (x < edge)
        return edge * bl_unit_smoothstep_integral(x / edge);
    double u = x > 1 - edge ? (x - (1 - edge)) / edge : 0;
    return x - 0.5 * edge - edge * bl_unit_smoothstep_integral(u);
}

static double profile_integral(double edge, double x) {
    double whole = floor(x);
    return whole * (1 - edge) + profile_part(edge, x - whole);
}

// The average of the profile and of its slope over [x - width/2, x + width/2].
static void average(double edge, double x, double width, double *height, double *slope) {
    x -= floor(x);
    if (isinf(width)) {
        *height = 1 - edge;
        *slope = 0;
    } else if (width > 0) {
        double from = x - 0.5 * width, to = x + 0.5 * width;
        *height = (profile_integral(edge, to) - profile_integral(edge, from)) / width;
        *slope = (profile(edge, to) - profile(edge, from)) / width;
    } else {
        *height = profile(edge, x);
        *slope = profile_slope(edge, x);
    }
}

static bl_colour shade(const bump_brick_parameters *p, const double at[BL_AXES],
                       const double width[BL_AXES]) {
    static const double light[3] = {-2.0 / 7, -3.0 / 7, 6.0 / 7}; // from the upper left
    const bl_brick brick = bl_brick_of(&p->sizes);
    double height[2], slope[2], place[2] = {at[0] / brick.size[0], at[1] / brick.size[1]};
    place[0] += bl_brick_shift(floor(place[1]));
    for (int a = 0; a < 2; a++)
        average(brick.edge[a], place[a], width[a] / brick.size[a], &height[a], &slope[a]);
    double x = -p->depth * slope[0] * height[1] / brick.size[0];
    double y = -p->depth * slope[1] * height[0] / brick.size[1];
    double towards = (x * light[0] + y * light[1] + light[2]) / sqrt(1 + x * x + y * y);
    double share = bl_brick_average(&brick, at, width);
    return bl_colour_mix((bl_colour){{0, 0, 0}},
                         bl_colour_mix(bl_mortar_colour, bl_brick_colour, share),
                         0.25 + 0.75 * fmax(towards, 0));
}

static bl_colour see(const bump_brick_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    const bl_brick brick = bl_brick_of(&p->sizes);
    if (bl_footprint_is_whole(footprint, 2))
        return p->mean;
    bl_colour seen =
        shade(p, at, p->seeing.filter == SLOPE ? footprint->width : bl_footprint_point.width);
    if (p->seeing.filter != FADE)
        return seen;
    return bl_colour_mix(
        p->mean, seen,
        bl_octave_kept(1 / brick.size[1], BL_CLAMP_FADE, bl_footprint_widest(footprint, 2)));
}

BL_TEXTURE_ABILITIES(bump_brick_parameters, 2)

// Rows differ by their shift alone, which a mean does not see.
static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    enum { PLACES = 256 };
    bump_brick_parameters *p = block;
    const bl_brick brick = bl_brick_of(&p->sizes);
    bl_colour sum = {{0, 0, 0}};
    (void)message;
    for (int j = 0; j < PLACES; j++)
        for (int i = 0; i < PLACES; i++) {
            const double at[BL_AXES] = {(i + 0.5) / PLACES * brick.size[0],
                                        (j + 0.5) / PLACES * brick.size[1]};
            bl_colour seen = shade(p, at, bl_footprint_point.width);
            for (int c = 0; c < 3; c++)
                sum.rgb[c] += seen.rgb[c] / ((double)PLACES * PLACES);
        }
    p->mean = sum;
    return BL_OK;
}

static void describe(const void *block, bl_facts *facts) {
    const bump_brick_parameters *p = block;
    const bl_brick brick = bl_brick_of(&p->sizes);
    const bl_colour ends[] = {{{0, 0, 0}}, bl_mortar_colour, bl_brick_colour};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 3, "light is no more than 1");
    facts->continuity = p->seeing.width == 0 || p->seeing.filter == NONE ? -1 : -2;
    facts->period[0] = brick.size[0];
    facts->period[1] = 2 * brick.size[1];
}

static const bl_parameter parameters[] = {BL_BRICK_PARAMETERS(bump_brick_parameters, sizes),
                                          {"depth", BL_REAL, offsetof(bump_brick_parameters, depth),
                                           "0.003", "units", .minimum = -1e6, .maximum = 1e6,
                                           .help = "of the grooves; below 0 they stand out"},
                                          BL_SEEING_PARAMETERS(bump_brick_parameters, filter_words),
                                          {0}};

BL_TEXTURE_DESCRIPTOR(bump_brick) = {
    .name = "bumpbrick",
    .title = "bricks with grooves",
    .summary = "The brick wall with grooves of mortar, seen in a fixed light.",
    .formula = "brick colour (1/4 + 3/4 max(0, n . l)), n from height = depth g(s) g(t)",
    .paper = "peachey2003, p. 43",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(bump_brick_parameters),
    .describe = describe,
    .picture = {.scale = 1, .at = {0.5, 0.5}},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build}};
