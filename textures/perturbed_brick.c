// SPDX-License-Identifier: MIT
//
// perturbedbrick: the brick wall of a less precise bricklayer: each row is shifted by a noise.
//
//   shift(row) = row odd ? 1/2 : 0, plus amount * noise(row + 1/2), in bricks
//
// The noise is read half way between whole numbers, where a gradient noise is not 0.
//
// Parameters
//   brick_width, brick_height, mortar   as of brick
//   seed, noise   default gnoise:dims=1, within +-1/2
//   amount    0 to 10 bricks; default 0.1, the text's
//   filter   none
//            integral  exact averages of both pulses, all rows shifted as that of the centre
//            exact     the box average: each row that the sample touches with its own shift. Of a
//                      sample over more than 256 rows, the 256 around its centre stand for all
//            mean      the mean colour for every width above 0
//   width, component   see textures/texture.h
//
// Bound, mean: those of brick. Period: across one brick; upwards that of the noise, not stated.
// NaN and infinite places give NaN.
//
// Source: peachey2003, section Perturbed Regular Patterns. Deviations: centred samples, as in
// brick.
#include <math.h>

#include "filters/pulse_train.h"
#include "textures/brick_shape.h"
#include "textures/noise_source.h"
#include "textures/sampling.h"

enum { ROWS_MOST = 256 };

typedef struct perturbed_brick_parameters {
    bl_brick_sizes sizes;
    bl_noise_source noise;
    double amount;
    bl_seeing seeing;
} perturbed_brick_parameters;

enum { NONE, INTEGRAL, EXACT, MEAN };
static const char *const filter_words[] = {"none", "integral", "exact", "mean", NULL};

static double row_average(const perturbed_brick_parameters *p, const bl_brick *brick, double row,
                          double s, double width) {
    double shift =
        bl_brick_shift(row) + p->amount * bl_noise_source_value(&p->noise, row + 0.5, 0, 0);
    return bl_pulse_train_average(&bl_filter_box, brick->edge[0], 1 - brick->edge[0], s + shift,
                                  width);
}

// Each row's own average along s, weighted by how much of its bricks' height the sample covers.
static double average_rows(const perturbed_brick_parameters *p, const bl_brick *brick, double s,
                           double t, double width_s, double width_t) {
    double span = fmin(width_t, ROWS_MOST - 2), low = t - 0.5 * span, high = t + 0.5 * span;
    double sum = 0, centre = floor(t);
    for (double k = floor(low) - centre; k <= floor(high) - centre; k++) {
        double row = centre + k, from = fmax(low - row, brick->edge[1]);
        double to = fmin(high - row, 1 - brick->edge[1]);
        if (to > from)
            sum += (to - from) * row_average(p, brick, row, s, width_s);
    }
    return fmin(sum / span, 1); // the overlaps add up to the span but for their rounding
}

static double share_of_brick(const perturbed_brick_parameters *p, const double at[BL_AXES],
                             const double width[BL_AXES]) {
    const bl_brick brick = bl_brick_of(&p->sizes);
    int filtered = p->seeing.filter != NONE;
    double s = at[0] / brick.size[0], t = at[1] / brick.size[1];
    double width_s = filtered ? width[0] / brick.size[0] : 0;
    double width_t = filtered ? width[1] / brick.size[1] : 0;
    if (p->seeing.filter == EXACT && width_t > 0)
        return average_rows(p, &brick, s, t, width_s, width_t);
    return row_average(p, &brick, floor(t), s, width_s) *
           bl_pulse_train_average(&bl_filter_box, brick.edge[1], 1 - brick.edge[1], t, width_t);
}

static bl_colour see(const perturbed_brick_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    const bl_brick brick = bl_brick_of(&p->sizes);
    int all = bl_footprint_is_whole(footprint, 2) ||
              (p->seeing.filter == MEAN && bl_footprint_widest(footprint, 2) > 0);
    double share = all ? bl_brick_share(&brick) : share_of_brick(p, at, footprint->width);
    return bl_colour_mix(bl_mortar_colour, bl_brick_colour, share);
}

BL_TEXTURE_ABILITIES(perturbed_brick_parameters, 2)

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    perturbed_brick_parameters *p = block;
    return bl_noise_source_open(&p->noise, p->noise.text, 1, message);
}

static void release(void *block) {
    bl_noise_source_close(&((perturbed_brick_parameters *)block)->noise);
}

static void describe(const void *block, bl_facts *facts) {
    const perturbed_brick_parameters *p = block;
    const bl_brick brick = bl_brick_of(&p->sizes);
    const bl_colour ends[] = {bl_mortar_colour, bl_brick_colour};
    int point = p->seeing.width == 0 || p->seeing.filter == NONE;
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between two colours");
    bl_texture_mean(facts, p->seeing.component, bl_brick_mean(&brick));
    facts->continuity = point ? -1 : p->seeing.filter == MEAN ? 99 : -2;
    facts->period[0] = brick.size[0];
}

static const bl_parameter parameters[] = {
    BL_BRICK_PARAMETERS(perturbed_brick_parameters, sizes),
    BL_NOISE_SOURCE_PARAMETERS(perturbed_brick_parameters, noise, "gnoise:dims=1"),
    {"amount", BL_REAL, offsetof(perturbed_brick_parameters, amount), "0.1", "bricks",
     .maximum = 10, .help = "of the shift, times the noise"},
    BL_SEEING_PARAMETERS(perturbed_brick_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(perturbed_brick) = {
    .name = "perturbedbrick",
    .title = "perturbed bricks",
    .summary = "The brick wall with each row shifted by a noise.",
    .formula = "brick(s + amount * noise(row + 1/2), t)",
    .paper = "peachey2003, Perturbed Regular Patterns",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(perturbed_brick_parameters),
    .describe = describe,
    .picture = {.scale = 1, .at = {0.5, 0.5}},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build, .release = release}};
