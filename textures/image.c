// SPDX-License-Identifier: MIT
//
// image: a picture of a file, looked up at coordinates that a noise has moved.
//
//   (s', t') = (s, t) + amount (n(f p), n(f p + (1.5, 6.7, 3.4))),  p = (s, t, z)
//   colour = picture(frac(s'), frac(t'))
//
// Parameters
//   path     of an image file; none: a built-in card of coloured squares (core/texels.h)
//   colourspace   of the file's codes: file (what it says of itself; of one that says nothing, sRGB
//            for 8 bits and linear for more), linear, srgb, gamma2.2 or the power alone; default
//            file. The card is linear. Alpha is left aside: colours are as stored
//   seed, noise   any noise of three dimensions; default gnoise
//   amount   of the shift, units; default 0.2, the text's; 0: the picture as it is
//   frequency   f, cells per unit; default 4
//   filter   none    linear between the four nearest texels
//            mip     between two levels of a pyramid of box means, for the larger width
//            anisotropic   several such lookups along the larger width
//            sat     the mean of the box of the sample's widths, from summed-area tables of the
//                    texels, each a square of one colour: exact for any box, 24 bytes a texel
//            mean    the mean of the picture for every width above 0
//   width, component   see textures/texture.h
//
// The picture spans the unit square, t downwards, and repeats. How wide a sample is in the picture
// follows from the derivatives of (s', t'), if the noise has a gradient; else from the width as if
// nothing was moved. Lookups but those in tables are OpenImageIO's, in float; its pyramid is wide
// for its width, so that it blurs rather than aliases. Without any width sat looks between four
// texels as none does; with one it is the texel itself along an axis without.
//
// Bound: the least and the largest texel, give or take float rounding. Mean: of the texels, for
// amount 0. Period: 1 for amount 0. NaN and infinite places give NaN; beyond 2^23 units nothing is
// left of a texel's place.
//
// Source: peachey2003, section Perturbed Image Textures; crow1984 (sat). Deviation: f, which the
// text leaves to the size of the object.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/texels.h"
#include "filters/summed_area.h"
#include "textures/noise_source.h"
#include "textures/sampling.h"

typedef struct image_parameters {
    char path[BL_TEXT_SIZE], colourspace[BL_TEXT_SIZE];
    bl_noise_source noise;
    double amount, frequency;
    bl_seeing seeing;
    bl_texels *texels;        // made on opening
    bl_summed_area *table[3]; // of each component, made on opening; only of filter sat
} image_parameters;

enum { NONE, MIP, ANISOTROPIC, SAT, MEAN }; // the first three as bl_texels_reading
static const char *const filter_words[] = {"none", "mip", "anisotropic", "sat", "mean", NULL};

// What samples see of the texels: where, and how far along each axis.
typedef struct image_samples {
    bl_gathered at;
    const bl_footprint *footprint[BL_BATCH];
    double place[2][BL_BATCH], span[2][BL_BATCH];
} image_samples;

// Moves the places, and stretches the widths by the derivatives of the movement: a box of widths
// (w_s, w_t, w_z) becomes one of sum over a of |d s'/d a| w_a.
static void move(const image_parameters *p, image_samples *seen) {
    static const double aside[2][3] = {{0, 0, 0}, {1.5, 6.7, 3.4}};
    const bl_signal *noise = p->noise.signal;
    for (int i = 0; i < 2; i++) {
        bl_gathered moved = {.count = 0};
        double shift[BL_BATCH];
        for (size_t k = 0; k < seen->at.count; k++) {
            double there[BL_AXES] = {0};
            for (int a = 0; a < 3; a++)
                there[a] = p->frequency * seen->at.at[a][k] + aside[i][a];
            bl_gather(&moved, k, there);
        }
        bl_signal_values_gathered(noise, &moved, shift);
        for (size_t k = 0; k < moved.count; k++) {
            const double *width =
                p->seeing.filter == NONE ? bl_footprint_point.width : seen->footprint[k]->width;
            double slope[BL_AXES] = {0}, there[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                there[a] = moved.at[a][k];
            if (noise->functions->gradient && p->seeing.filter != NONE)
                noise->functions->gradient(noise->parameters, there, slope);
            seen->place[i][k] += p->amount * shift[k];
            seen->span[i][k] = 0;
            for (int a = 0; a < 3; a++)
                seen->span[i][k] += fabs((a == i) + p->amount * p->frequency * slope[a]) * width[a];
        }
    }
}

static void look_in_tables(const image_parameters *p, const double place[2], const double span[2],
                           double rgb[3]) {
    size_t size[2];
    bl_texels_size(p->texels, size);
    double columns = (double)size[0], rows = (double)size[1];
    const double box[2] = {span[0] * columns, span[1] * rows};
    for (int c = 0; c < 3; c++)
        rgb[c] = bl_summed_area_mean(p->table[c], (place[0] - floor(place[0])) * columns,
                                     (place[1] - floor(place[1])) * rows, box);
}

// How the library looks, which has no word for `sat` without a width and for `mean`.
static bl_texels_reading reading_of(uint32_t filter) {
    return filter < SAT ? (bl_texels_reading)filter : BL_TEXELS_POINT;
}

static int is_mean(const image_parameters *p, const bl_footprint *footprint) {
    double widest = bl_footprint_widest(footprint, 3);
    int is_exact = p->seeing.filter == SAT && p->amount == 0; // of a box that is endless one way
    return bl_footprint_is_whole(footprint, 3) || (p->seeing.filter == MEAN && widest > 0) ||
           (isinf(widest) && p->seeing.filter != NONE && !is_exact);
}

// Up to BL_BATCH samples.
static void see_batch(const image_parameters *p, const bl_samples *samples, double *rgb) {
    image_samples seen;
    seen.at.count = 0;
    for (size_t i = 0; i < samples->count; i++) {
        const bl_footprint *footprint = bl_samples_footprint(samples, i);
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        if (!bl_texture_is_seen(at, footprint, 3)) {
            bl_colour_put(bl_colour_missing, rgb + 3 * i);
        } else if (is_mean(p, footprint)) {
            bl_texels_mean(p->texels, rgb + 3 * i);
        } else {
            for (int a = 0; a < 2; a++) {
                seen.place[a][seen.at.count] = at[a];
                seen.span[a][seen.at.count] = footprint->width[a];
            }
            seen.footprint[seen.at.count] = footprint;
            bl_gather(&seen.at, i, at);
        }
    }
    if (p->amount > 0)
        move(p, &seen);
    for (size_t k = 0; k < seen.at.count; k++) {
        const double place[2] = {seen.place[0][k], seen.place[1][k]};
        const double span[2] = {seen.span[0][k], seen.span[1][k]};
        double *out = rgb + 3 * seen.at.of[k];
        if (p->seeing.filter == SAT && fmax(span[0], span[1]) > 0)
            look_in_tables(p, place, span, out);
        else
            bl_texels_look(p->texels, place[0], place[1], span[0], span[1],
                           reading_of(p->seeing.filter), out);
    }
}

BL_TEXTURE_BATCH_ABILITIES(image_parameters)

static bl_status make_tables(image_parameters *p, bl_message *message) {
    size_t size[2];
    bl_texels_size(p->texels, size);
    float *plane = malloc(size[0] * size[1] * sizeof *plane);
    bl_status status = plane ? BL_OK
                             : bl_report(message, BL_DEVICE, "out of memory for %zu by %zu texels",
                                         size[0], size[1]);
    for (int c = 0; c < 3 && status == BL_OK; c++) {
        bl_texels_plane(p->texels, c, plane);
        status = bl_summed_area_make(plane, size[0], size[1], BL_SUMS_DOUBLE, BL_WRAPPED,
                                     &p->table[c], message);
    }
    free(plane);
    return status;
}

static void release(void *block) {
    image_parameters *p = block;
    for (int c = 0; c < 3; c++) {
        bl_summed_area_free(p->table[c]);
        p->table[c] = NULL;
    }
    bl_texels_close(p->texels);
    p->texels = NULL;
    bl_noise_source_close(&p->noise);
}

static bl_status open_texels(image_parameters *p, bl_message *message) {
    bl_colourspace space;
    bl_status status = bl_colourspace_read(p->colourspace, &space, message);
    return status == BL_OK ? bl_texels_open(p->path, &space, &p->texels, message) : status;
}

static void note(const void *block, char *text, size_t size) {
    snprintf(text, size, "%s", bl_texels_note(((const image_parameters *)block)->texels));
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    image_parameters *p = block;
    p->texels = NULL;
    p->table[0] = p->table[1] = p->table[2] = NULL;
    bl_status status = bl_noise_source_open(&p->noise, p->noise.text, 3, message);
    if (status != BL_OK)
        return status;
    status = open_texels(p, message);
    if (status == BL_OK && p->seeing.filter == SAT)
        status = make_tables(p, message);
    if (status != BL_OK)
        release(p);
    return status;
}

static void describe(const void *block, bl_facts *facts) {
    const image_parameters *p = block;
    double rgb[3];
    bl_colour ends[2];
    bl_texels_bounds(p->texels, ends[0].rgb, ends[1].rgb);
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between its texels");
    double rounding = 0x1p-20 * fmax(fabs(facts->lower), fabs(facts->upper));
    facts->lower -= rounding;
    facts->upper += rounding;
    if (p->amount == 0 || (p->seeing.filter == MEAN && p->seeing.width > 0)) {
        bl_texels_mean(p->texels, rgb);
        facts->mean = bl_colour_component(rgb, p->seeing.component);
        facts->period[0] = facts->period[1] = facts->period[2] = 1; // along z it is constant
    }
    facts->far = 0x1p23;
}

static const bl_parameter parameters[] = {
    {"path", BL_TEXT, offsetof(image_parameters, path), "", "",
     .help = "of an image file, which spans the unit square, t downwards; none: a built-in card"},
    {"colourspace", BL_TEXT, offsetof(image_parameters, colourspace), "file", "",
     .choices = bl_colourspace_words, .help = "of the file's codes; file: what it says of itself"},
    BL_NOISE_SOURCE_PARAMETERS(image_parameters, noise, "gnoise"),
    {"amount", BL_REAL, offsetof(image_parameters, amount), "0.2", "units", .maximum = 10,
     .help = "of the shift, times the noise; 0: the picture as it is"},
    {"frequency", BL_REAL, offsetof(image_parameters, frequency), "4", "cells per unit",
     .minimum = 1e-6, .maximum = 1e6, .help = "of the noise"},
    BL_SEEING_PARAMETERS(image_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(image) = {
    .name = "image",
    .title = "perturbed picture",
    .summary = "A picture of a file, looked up at coordinates that a noise has moved.",
    .formula = "picture(s + amount n(f p), t + amount n(f p + (1.5, 6.7, 3.4)))",
    .paper = "peachey2003, Perturbed Image Textures",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(image_parameters),
    .describe = describe,
    .picture = {.scale = 1, .at = {0.5, 0.5, 0.4}},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build, .release = release, .note = note}};
