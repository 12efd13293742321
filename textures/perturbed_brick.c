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

enum { ROWS_MOST = 256, ROWS_AT_ONCE = 16 };

typedef struct perturbed_brick_parameters {
    bl_brick_sizes sizes;
    bl_noise_source noise;
    double amount;
    bl_seeing seeing;
} perturbed_brick_parameters;

enum { NONE, INTEGRAL, EXACT, MEAN };
static const char *const filter_words[] = {"none", "integral", "exact", "mean", NULL};

// A row is shifted by the noise at its middle.
static void gather_row(bl_gathered *rows, size_t of, double row) {
    bl_gather(rows, of, (const double[BL_AXES]){row + 0.5});
}

static double row_average(const perturbed_brick_parameters *p, const bl_brick *brick, double row,
                          double noise, double s, double width) {
    double shift = bl_brick_shift(row) + p->amount * noise;
    return bl_pulse_train_average(&bl_filter_box, brick->edge[0], 1 - brick->edge[0], s + shift,
                                  width);
}

// Each row's own average along s, weighted by how much of its bricks' height the sample covers.
static double average_rows(const perturbed_brick_parameters *p, const bl_brick *brick, double s,
                           double t, double width_s, double width_t) {
    double span = fmin(width_t, ROWS_MOST - 2), low = t - 0.5 * span, high = t + 0.5 * span;
    double sum = 0, centre = floor(t), k = floor(low) - centre, last = floor(high) - centre;
    while (k <= last) {
        bl_gathered rows;
        double row[ROWS_AT_ONCE] = {0}, covered[ROWS_AT_ONCE], noise[ROWS_AT_ONCE];
        rows.count = 0;
        for (; k <= last && rows.count < ROWS_AT_ONCE; k++) {
            double here = centre + k, from = fmax(low - here, brick->edge[1]);
            double to = fmin(high - here, 1 - brick->edge[1]);
            if (to > from) {
                row[rows.count] = here;
                covered[rows.count] = to - from;
                gather_row(&rows, rows.count, here);
            }
        }
        bl_signal_values_gathered(p->noise.signal, &rows, noise);
        for (size_t n = 0; n < rows.count; n++)
            sum += covered[n] * row_average(p, brick, row[n], noise[n], s, width_s);
    }
    return fmin(sum / span, 1); // the overlaps add up to the span but for their rounding
}

static bl_colour colour_of(double share) {
    return bl_colour_mix(bl_mortar_colour, bl_brick_colour, share);
}

// Up to BL_BATCH samples.
static void see_batch(const perturbed_brick_parameters *p, const bl_samples *samples, double *rgb) {
    const bl_brick brick = bl_brick_of(&p->sizes);
    bl_gathered rows = {.count = 0};
    double s[BL_BATCH], t[BL_BATCH], width[2][BL_BATCH], noise[BL_BATCH];
    for (size_t i = 0; i < samples->count; i++) {
        const bl_footprint *footprint = bl_samples_footprint(samples, i);
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        size_t k = rows.count;
        for (int a = 0; a < 2; a++)
            width[a][k] = p->seeing.filter == NONE ? 0 : footprint->width[a] / brick.size[a];
        s[k] = at[0] / brick.size[0];
        t[k] = at[1] / brick.size[1];
        if (!bl_texture_is_seen(at, footprint, 2))
            bl_colour_put(bl_colour_missing, rgb + 3 * i);
        else if (bl_footprint_is_whole(footprint, 2) ||
                 (p->seeing.filter == MEAN && bl_footprint_widest(footprint, 2) > 0))
            bl_colour_put(colour_of(bl_brick_share(&brick)), rgb + 3 * i);
        else if (p->seeing.filter == EXACT && width[1][k] > 0)
            bl_colour_put(colour_of(average_rows(p, &brick, s[k], t[k], width[0][k], width[1][k])),
                          rgb + 3 * i);
        else
            gather_row(&rows, i, floor(t[k]));
    }
    bl_signal_values_gathered(p->noise.signal, &rows, noise);
    for (size_t k = 0; k < rows.count; k++) {
        double along = row_average(p, &brick, floor(t[k]), noise[k], s[k], width[0][k]);
        double up = bl_pulse_train_average(&bl_filter_box, brick.edge[1], 1 - brick.edge[1], t[k],
                                           width[1][k]);
        bl_colour_put(colour_of(along * up), rgb + 3 * rows.of[k]);
    }
}

BL_TEXTURE_BATCH_ABILITIES(perturbed_brick_parameters)

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
