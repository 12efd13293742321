// SPDX-License-Identifier: MIT
//
// brick: rows of bricks in mortar, each second row shifted by half a brick.
#include "textures/texture.h"

#include <math.h>

#include "filters/pulse_train.h"

typedef struct brick_parameters {
    double brick_width, brick_height, mortar;
    bl_seeing seeing;
} brick_parameters;

enum { NONE, INTEGRAL };
static const char *const filter_words[] = {"none", "integral", NULL};

static const bl_colour brick_colour = {{0.5, 0.15, 0.14}}, mortar_colour = {{0.5, 0.5, 0.5}};

static void colour(const void *block, const double at[BL_AXES], const double width[BL_AXES],
                   double rgb[3]) {
    const brick_parameters *p = block;
    double across = p->brick_width + p->mortar, up = p->brick_height + p->mortar;
    double s = at[0] / across, t = at[1] / up;
    double edge_s = 0.5 * p->mortar / across, edge_t = 0.5 * p->mortar / up;
    int filtered = p->seeing.filter == INTEGRAL;
    const bl_filter *box = bl_filter_find("box");
    if (0.5 * t - floor(0.5 * t) > 0.5)
        s += 0.5;
    double w = bl_pulse_train_average(box, edge_s, 1 - edge_s, s, filtered ? width[0] / across : 0);
    double h = bl_pulse_train_average(box, edge_t, 1 - edge_t, t, filtered ? width[1] / up : 0);
    bl_colour mixed = bl_colour_mix(mortar_colour, brick_colour, w * h);
    for (int i = 0; i < 3; i++)
        rgb[i] = mixed.rgb[i];
}

BL_TEXTURE_ABILITIES(brick_parameters)

static void describe(const void *block, bl_facts *facts) {
    (void)block;
    *facts = bl_facts_unknown();
    facts->lower = 0;
    facts->upper = 1;
}

#define LENGTH(field, usual, what)                                                                 \
    {                                                                                              \
        .key = #field, .kind = BL_REAL, .offset = offsetof(brick_parameters, field),               \
        .minimum = 1e-6, .maximum = 1e6, .fallback = usual, .unit = "units", .help = what          \
    }
static const bl_parameter parameters[] = {LENGTH(brick_width, "0.25", "of a brick"),
                                          LENGTH(brick_height, "0.08", "of a brick"),
                                          LENGTH(mortar, "0.01", "thickness of the mortar"),
                                          BL_SEEING_PARAMETERS(brick_parameters, filter_words),
                                          {.key = NULL}};

BL_TEXTURE_DESCRIPTOR(brick) = {.name = "brick",
                                .title = "bricks in mortar",
                                .summary = "Rows of bricks, each second row shifted by a half.",
                                .formula = "mix(mortar, brick, pulse(s) pulse(t))",
                                .paper = "peachey2003, p. 39",
                                .dimensions = 2,
                                .parameters = parameters,
                                .parameters_size = sizeof(brick_parameters),
                                .seed_offset = SIZE_MAX,
                                .describe = describe,
                                .functions = {BL_TEXTURE_FUNCTIONS}};
