// SPDX-License-Identifier: MIT
//
// brick: rows of bricks in mortar, each second row shifted by half a brick.
//
//   colour = mix(mortar, brick, w h),  w = pulse(edge, 1 - edge; frac(s'/across + shift)),  h alike
//
// Parameters
//   brick_width, brick_height, mortar   units; defaults of the text: 1/4, 0.08 and 0.01
//   filter   none
//            boxstep, smoothstep  the text's first remedy: the steps at both ends of the brick that
//                                 the sample's centre lies in become ramps (or cubics) one width
//                                 long. Right in the middle of a brick. The brick next door is not
//                                 seen, so mortar gets too wide as soon as the width exceeds it; at
//                                 width w >> 1 all is mortar
//            integral             the text's second remedy: exact averages of both pulses. Their
//                                 product is the average of the wall only while the sample stays in
//                                 one row; across rows, the shift of the centre's row is taken for
//                                 all of them
//            exact                the box average of the wall: both parities of rows, each with its
//                                 own shift
//            mean                 the mean colour for every width above 0
//   width, component   see textures/texture.h
//
// Bound: between the two colours, since all weights lie in [0, 1]. Mean: that of the shares of
// brick and mortar. Period: one brick across, two rows up. Class: jumps; C0 if filtered at a width
// above 0, except for the forms that depend on the centre's brick and row, which jump where it
// changes. NaN and infinite places give NaN; beyond 2^52 bricks nothing is left of the fraction.
//
// Source: peachey2003, pp. 39-42 and 64-69. Deviations: the text's filters reach from x to x + w,
// here samples are centred, which is the same picture half a width aside; diffuse shading is left
// to the viewer.
#include "textures/texture.h"

#include <math.h>

#include "filters/pulse_train.h"
#include "textures/brick_shape.h"
#include "textures/sampling.h"

typedef struct brick_parameters {
    bl_brick_sizes sizes;
    bl_seeing seeing;
} brick_parameters;

enum { NONE, BOXSTEP, SMOOTHSTEP, INTEGRAL, EXACT, MEAN };
static const char *const filter_words[] = {"none",  "boxstep", "smoothstep", "integral",
                                           "exact", "mean",    NULL};

// The pulse of one brick, whose neighbours are not seen.
static double lone_pulse(bl_edge edge, double low, double x, double width) {
    x -= floor(x);
    if (isinf(width))
        return 1 - 2 * low;
    return bl_edge_step(edge, x - low, width) - bl_edge_step(edge, x - (1 - low), width);
}

static double share_of_brick(const brick_parameters *p, const double at[BL_AXES],
                             const double width[BL_AXES]) {
    const bl_brick brick = bl_brick_of(&p->sizes);
    if (p->seeing.filter == EXACT)
        return bl_brick_average(&brick, at, width);
    double place[2], span[2];
    for (int a = 0; a < 2; a++) {
        place[a] = at[a] / brick.size[a];
        span[a] = p->seeing.filter == NONE ? 0 : width[a] / brick.size[a];
    }
    place[0] += bl_brick_shift(floor(place[1]));
    double product = 1;
    for (int a = 0; a < 2; a++)
        product *= p->seeing.filter == BOXSTEP || p->seeing.filter == SMOOTHSTEP
                       ? lone_pulse((bl_edge)p->seeing.filter, brick.edge[a], place[a], span[a])
                       : bl_pulse_train_average(&bl_filter_box, brick.edge[a], 1 - brick.edge[a],
                                                place[a], span[a]);
    return product;
}

static bl_colour see(const brick_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    const bl_brick brick = bl_brick_of(&p->sizes);
    int all = bl_footprint_is_whole(footprint, 2) ||
              (p->seeing.filter == MEAN && bl_footprint_widest(footprint, 2) > 0);
    double share = all ? bl_brick_share(&brick) : share_of_brick(p, at, footprint->width);
    return bl_colour_mix(bl_mortar_colour, bl_brick_colour, share);
}

BL_TEXTURE_ABILITIES(brick_parameters, 2)

static void describe(const void *block, bl_facts *facts) {
    const brick_parameters *p = block;
    const bl_brick brick = bl_brick_of(&p->sizes);
    const bl_colour ends[] = {bl_mortar_colour, bl_brick_colour};
    double share = bl_brick_share(&brick);
    int point = p->seeing.width == 0 || p->seeing.filter == NONE;
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between two colours");
    double contrast = facts->upper - facts->lower;
    if (point)
        facts->variance = share * (1 - share) * contrast * contrast;
    // The forms that see one brick alone lose what its neighbours would give.
    if (point || p->seeing.filter >= EXACT)
        bl_texture_mean(facts, p->seeing.component, bl_brick_mean(&brick));
    facts->continuity = point                       ? -1
                        : p->seeing.filter == EXACT ? 0
                        : p->seeing.filter == MEAN  ? 99
                                                    : -2;
    facts->period[0] = brick.size[0];
    facts->period[1] = 2 * brick.size[1];
}

static const bl_parameter parameters[] = {BL_BRICK_PARAMETERS(brick_parameters, sizes),
                                          BL_SEEING_PARAMETERS(brick_parameters, filter_words),
                                          {0}};

BL_TEXTURE_DESCRIPTOR(brick) = {.name = "brick",
                                .title = "bricks in mortar",
                                .summary = "Rows of bricks, each second row shifted by a half.",
                                .formula = "mix(mortar, brick, pulse(s) pulse(t))",
                                .paper = "peachey2003, p. 39",
                                .dimensions = 2,
                                .parameters = parameters,
                                .parameters_size = sizeof(brick_parameters),
                                .describe = describe,
                                .picture = {.scale = 1, .at = {0.5, 0.5}},
                                .functions = {BL_TEXTURE_FUNCTIONS}};
