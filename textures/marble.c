// SPDX-License-Identifier: MIT
//
// marble: blue marble, solid: a sum of four octaves of noise through a map of colours.
//
//   m = sum over i = 0 .. 3 of  noise(scale p 2.17^i) / 2.17^i
//   colour = spline(clamp(2 m + 3/4, 0, 1)), through the 13 blues of the text
//
// Parameters
//   seed, basis   any noise of three dimensions, with basis.KEY; default gnoise
//   scale    lattice cells in a unit; default 2.5, the text's
//   filter   none
//            clamp, fade  octaves beyond the Nyquist limit of the width are removed, at once or
//                         from half the limit on (noises/octaves/octaves.h). What the map would
//                         have made of them is lost: at last all is the one colour of m = 0
//            map          fade, and the map is averaged over a normal distribution with the
//                         variance that the octaves have lost, so that the mean colour stays
//   width, component   see textures/texture.h
//
// Bound: colours are cut to [0, 1], which the spline leaves nowhere with these knots. Mean: not
// stated; infinite width gives the map's average over a normal distribution with the variance of m.
// Class C0: the clamp bends the map at its lower end; at the upper one the spline is level. NaN and
// infinite places give NaN, and those beyond 2^62.
//
// Source: peachey2003, section at figure 2.40. Deviations: the text filters nothing; shading is
// left to the viewer.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "noises/octaves/octaves.h"
#include "textures/colour_spline.h"
#include "textures/sampling.h"

enum { OCTAVES = 4 };
#define LACUNARITY 2.17

typedef struct marble_parameters {
    uint64_t seed;
    char basis[BL_TEXT_SIZE];
    double scale;
    bl_seeing seeing;
    bl_signal *sum;  // made on opening
    double variance; // of the basis
    double top;      // its highest frequency
} marble_parameters;

enum { NONE, CLAMP, FADE, MAP };
static const char *const filter_words[] = {"none", "clamp", "fade", "map", NULL};

#define PALE                                                                                       \
    {                                                                                              \
        { 0.25, 0.25, 0.35 }                                                                       \
    }
#define MEDIUM                                                                                     \
    {                                                                                              \
        { 0.10, 0.10, 0.30 }                                                                       \
    }
#define DARK                                                                                       \
    {                                                                                              \
        { 0.05, 0.05, 0.26 }                                                                       \
    }
#define DARKER                                                                                     \
    {                                                                                              \
        { 0.03, 0.03, 0.20 }                                                                       \
    }
static const bl_colour knots[] = {PALE, PALE, MEDIUM, MEDIUM, MEDIUM, PALE,  PALE,
                                  DARK, DARK, DARKER, DARKER, PALE,   DARKER};
static const bl_colour_spline map = {knots, sizeof knots / sizeof *knots};

// The variance that the octaves have lost at this width: an average that is `kept` times as strong
// has kept^2 of the variance, and the rest is within what it is the average of.
static double lost_variance(const marble_parameters *p, double width) {
    double lost = 0, frequency = 1;
    for (int i = 0; i < OCTAVES; i++) {
        double kept = bl_octave_kept(frequency * p->top, BL_CLAMP_FADE, width);
        lost += p->variance * (1 - kept * kept) / (frequency * frequency);
        frequency *= LACUNARITY;
    }
    return lost;
}

// The colour of a sum of octaves at a sample of this width, in cells.
static bl_colour colour_of(const marble_parameters *p, double sum, double cells) {
    double x = 2 * sum + 0.75;
    return bl_colour_clamp(p->seeing.filter == MAP
                               ? bl_colour_spline_normal(&map, x, 2 * sqrt(lost_variance(p, cells)))
                               : bl_colour_spline_at(&map, x));
}

static bl_colour mean_of(const marble_parameters *p) {
    return bl_colour_clamp(
        bl_colour_spline_normal(&map, 0.75, 2 * sqrt(lost_variance(p, INFINITY))));
}

// Up to BL_BATCH samples.
static void see_batch(const marble_parameters *p, const bl_samples *samples, double *rgb) {
    bl_gathered inside = {.count = 0};
    double cells[BL_BATCH], sum[BL_BATCH];
    for (size_t i = 0; i < samples->count; i++) {
        const bl_footprint *footprint = bl_samples_footprint(samples, i);
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        if (!bl_texture_is_seen(at, footprint, 3)) {
            bl_colour_put(bl_colour_missing, rgb + 3 * i);
        } else if (bl_footprint_is_whole(footprint, 3)) {
            bl_colour_put(mean_of(p), rgb + 3 * i);
        } else {
            const double place[BL_AXES] = {at[0] * p->scale, at[1] * p->scale, at[2] * p->scale};
            double widest = bl_footprint_widest(footprint, 3);
            cells[inside.count] = p->seeing.filter == NONE ? 0 : widest * p->scale;
            bl_gather(&inside, i, place);
        }
    }
    const bl_samples gathered = bl_gathered_samples(&inside, &bl_footprint_point, 0);
    bl_octaves_values_for_widths(p->sum, gathered.at, cells, gathered.count, sum);
    for (size_t k = 0; k < gathered.count; k++)
        bl_colour_put(colour_of(p, sum[k], cells[k]), rgb + 3 * inside.of[k]);
}

BL_TEXTURE_BATCH_ABILITIES(marble_parameters)

static void release(void *block) {
    marble_parameters *p = block;
    bl_signal_free(p->sum);
    p->sum = NULL;
}

// The sum of octaves of the basis, with the texture's own seed.
static bl_status open_sum(marble_parameters *p, bl_message *message) {
    static const char *const clamps[] = {"none", "hard", "fade", "fade"};
    char octaves[128], *text = NULL;
    snprintf(octaves, sizeof octaves,
             "fbm:seed=%llu,octaves=%d,lacunarity=2.17,gain=100/217,seeds=same,clamp=%s",
             (unsigned long long)p->seed, OCTAVES, clamps[p->seeing.filter]);
    bl_status status = bl_text_nest(octaves, "basis", p->basis, &text, message);
    if (status == BL_OK)
        status = bl_noise_open(text, BL_ISA_BASELINE, &p->sum, message);
    free(text);
    return status;
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    marble_parameters *p = block;
    p->sum = NULL;
    bl_status status = open_sum(p, message);
    if (status == BL_OK && p->sum->dimensions < 3)
        status =
            bl_report(message, BL_USAGE, "the basis '%s' must have three dimensions", p->basis);
    if (status != BL_OK) {
        release(p);
        return status;
    }
    double all = 0, frequency = 1;
    for (int i = 0; i < OCTAVES; i++, frequency *= LACUNARITY)
        all += 1 / (frequency * frequency);
    const bl_octaves_settings *settings = p->sum->parameters;
    p->top = settings->octaves->top;
    p->variance = isfinite(p->sum->facts.variance) ? p->sum->facts.variance / all : 0;
    return BL_OK;
}

static void describe(const void *block, bl_facts *facts) {
    const marble_parameters *p = block;
    const bl_colour ends[] = {{{0, 0, 0}}, {{1, 1, 1}}};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "colours are cut to [0, 1]");
    for (int a = 0; a < 3; a++)
        facts->period[a] = p->sum->facts.period[a] / p->scale;
}

static const bl_parameter parameters[] = {
    {"seed", BL_SEED, offsetof(marble_parameters, seed), "0", "", .help = "of the noise"},
    {"basis", BL_NESTED, offsetof(marble_parameters, basis), "gnoise", "",
     .help = "any noise, with its settings as basis.KEY"},
    {"scale", BL_REAL, offsetof(marble_parameters, scale), "2.5", "cells per unit", .minimum = 1e-6,
     .maximum = 1e6, .help = "of the coarsest octave"},
    BL_SEEING_PARAMETERS(marble_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(marble) = {
    .name = "marble",
    .title = "blue marble",
    .summary = "A sum of octaves of noise through a map of blues, solid.",
    .formula = "spline(clamp(2 sum_i noise(scale p 2.17^i) / 2.17^i + 3/4, 0, 1))",
    .paper = "peachey2003, fig. 2.40",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(marble_parameters),
    .describe = describe,
    .picture = {.scale = 2, .at = {0, 0, 0.4}},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build, .release = release}};
