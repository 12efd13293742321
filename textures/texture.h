// SPDX-License-Identifier: MIT
//
// The contract of a texture, and the registry of all textures.
//
// A texture is a signal with a colour: one file, which ends with one definition
// (core/definition.h), and one line in textures.def. Its raw form and every way that it can filter
// itself stand side by side in the file. They are the words of its key `filter`; the first is
// `none`. Colours are linear, with the primaries of sRGB; the value is their luminance, or one of
// them by the key `component`.
//
// Coordinates are the texture's own (s, t), or a place in space for a solid texture.
#ifndef BL_TEXTURES_TEXTURE_H
#define BL_TEXTURES_TEXTURE_H

#include <stddef.h>

#include "core/registry.h"
#include "core/definition.h"

typedef bl_definition bl_texture;

BL_REGISTRY(bl_texture, bl_texture, bl_textures)

typedef struct bl_colour {
    double rgb[3];
} bl_colour;

// What is seen of a colour: a field of a texture's parameter block, with the width of its samples.
typedef struct bl_seeing {
    uint32_t component; // 0 luminance, 1 red, 2 green, 3 blue
    uint32_t filter;    // index in the words of the file
    double width;       // along every axis
} bl_seeing;

extern const char *const bl_colour_components[];
// clang-format off
// The keys of bl_seeing, for the parameter list of a file whose block has it as `seeing`; `words`
// are the texture's filters, ended by NULL.
#define BL_SEEING_PARAMETERS(block, words)                                                         \
    {"filter", BL_CHOICE, offsetof(block, seeing.filter), "none", "", .choices = words,            \
     .help = "how it filters itself for the width of a sample"},                                   \
    {"width", BL_REAL, offsetof(block, seeing.width), "0", "units", .maximum = INFINITY,           \
     .help = "of a sample, along every axis; 0: a point"},                                         \
    {"component", BL_CHOICE, offsetof(block, seeing.component), "luminance", "",                   \
     .choices = bl_colour_components, .help = "of the linear colour, that the value is"}
// clang-format on

// The component of a colour: luminance has the weights of sRGB's primaries.
double bl_colour_component(const double rgb[3], uint32_t component);

// (1 - x) a + x b, exact at 0 and at 1.
bl_colour bl_colour_mix(bl_colour a, bl_colour b, double x);

void bl_colour_put(bl_colour colour, double rgb[3]);
extern const bl_colour bl_colour_missing; // NaN thrice: where a texture has no value

// States the least and the largest of the component among colours that all others lie between.
void bl_texture_bound(bl_facts *facts, uint32_t component, const bl_colour *colours, size_t count,
                      const char *proof);
// States the component of the mean colour.
void bl_texture_mean(bl_facts *facts, uint32_t component, bl_colour mean);

// Whether a texture has a value: the place is finite and no larger than noises take, and the widths
// along its axes are known.
int bl_texture_is_seen(const double at[BL_AXES], const bl_footprint *footprint,
                       unsigned dimensions);

// The abilities of the signal, for its definition as .functions = {BL_TEXTURE_FUNCTIONS}. In a
// texture's file, BL_TEXTURE_ABILITIES(block, dimensions) stands after one function for a sample
// where it is seen, `static bl_colour see(const block *, const double at[BL_AXES], const
// bl_footprint *footprint)`.
#define BL_TEXTURE_ABILITIES(block, dimensions)                                                    \
    static void see_batch(const block *p, const bl_samples *samples, double *rgb) {                \
        for (size_t i = 0; i < samples->count; i++) {                                              \
            const bl_footprint *footprint = bl_samples_footprint(samples, i);                      \
            double at[BL_AXES];                                                                    \
            bl_samples_place(samples, i, at);                                                      \
            int is_seen = bl_texture_is_seen(at, footprint, dimensions);                           \
            bl_colour_put(is_seen ? see(p, at, footprint) : bl_colour_missing, rgb + 3 * i);       \
        }                                                                                          \
    }                                                                                              \
    BL_TEXTURE_BATCH_ABILITIES(block)

// The same after one function for up to BL_BATCH samples, `static void see_batch(const block *,
// const bl_samples *, double *rgb)`, of a texture that makes something once for all of them.
#define BL_TEXTURE_BATCH_ABILITIES(block)                                                          \
    static void colour(const void *parameters, const bl_samples *samples, double *rgb) {           \
        for (size_t done = 0; done < samples->count; done += BL_BATCH) {                           \
            const bl_samples part = bl_samples_part(samples, done, BL_BATCH);                      \
            see_batch(parameters, &part, rgb + 3 * done);                                          \
        }                                                                                          \
    }                                                                                              \
    static void filtered(const void *parameters, const bl_samples *samples, double *out) {         \
        bl_texture_filtered(colour, parameters, ((const block *)parameters)->seeing.component,     \
                            samples, out);                                                         \
    }                                                                                              \
    static void values(const void *parameters, const double *const at[BL_AXES], size_t count,      \
                       double *out) {                                                              \
        bl_values_of_width(filtered, parameters, ((const block *)parameters)->seeing.width, at,    \
                           count, out);                                                            \
    }
#define BL_TEXTURE_FUNCTIONS .values = values, .filtered = filtered, .colour = colour

// The ability `filtered` of a texture that has this `colour`: the component of its colours.
void bl_texture_filtered(void (*colour)(const void *, const bl_samples *, double *),
                         const void *parameters, uint32_t component, const bl_samples *samples,
                         double *out);

// Names the definition of a texture's file: BL_TEXTURE_DESCRIPTOR(brick) = {...};
#define BL_TEXTURE_DESCRIPTOR(stem)                                                                \
    extern const bl_texture bl_texture_##stem;                                                     \
    const bl_texture bl_texture_##stem

#endif
