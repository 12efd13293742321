// SPDX-License-Identifier: MIT
//
// least-waves: a grey wave along s, (1 + sin(2 pi s)) / 2, and its exact average over the width.
#include <math.h>

#include "textures/texture.h"

typedef struct least_parameters {
    bl_seeing seeing;
} least_parameters;

static bl_colour see(const least_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    int is_point = !p->seeing.filter && !bl_footprint_is_whole(footprint, 1);
    double half = is_point ? 0 : M_PI * footprint->width[0];
    double kept = isinf(half) ? 0 : half > 0 ? sin(half) / half : 1;
    double grey = 0.5 + 0.5 * kept * sin(2 * M_PI * remainder(at[0], 1));
    return (bl_colour){{grey, grey, grey}};
}

BL_TEXTURE_ABILITIES(least_parameters, 1)

static void describe(const void *block, bl_facts *facts) {
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, ((const least_parameters *)block)->seeing.component,
                     (const bl_colour[]){{{0, 0, 0}}, {{1, 1, 1}}}, 2, "half of 1 plus a sine");
    facts->mean = 0.5, facts->continuity = 99, facts->period[0] = 1;
}

static const char *const filter_words[] = {"none", "exact", NULL};
static const bl_parameter parameters[] = {BL_SEEING_PARAMETERS(least_parameters, filter_words),
                                          {0}};

BL_TEXTURE_DESCRIPTOR(least_texture) = {.name = "least-waves",
                                        .title = "waves",
                                        .summary = "A grey wave along s.",
                                        .formula = "(1 + sin(2 pi s)) / 2",
                                        .paper = "bandlimit",
                                        .dimensions = 1,
                                        .parameters = parameters,
                                        .parameters_size = sizeof(least_parameters),
                                        .describe = describe,
                                        .functions = {BL_TEXTURE_FUNCTIONS}};
