// SPDX-License-Identifier: MIT
//
// The contract of a texture, and the registry of all textures.
//
// A texture is a signal with a colour: one file, which ends with one definition
// (core/definition.h), and one line in textures.def. Its raw form and every way that it can filter
// itself stand side by side in the file, as the words of its key `filter`, of which `none` is the
// first. Colours are linear, with the primaries of sRGB; the value is their luminance, or one of
// them by the key `component`.
//
// Coordinates are the texture's own (s, t), or a place in space for a solid texture.
#ifndef BL_TEXTURES_TEXTURE_H
#define BL_TEXTURES_TEXTURE_H

#include <stddef.h>

#include "core/definition.h"

typedef bl_definition bl_texture;

size_t bl_texture_count(void);
const bl_texture *bl_texture_at(size_t index);       // NULL past the end
const bl_texture *bl_texture_find(const char *name); // NULL for an unknown name

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
// The keys of bl_seeing, for the parameter list of a file whose block has it as `seeing`; `words`
// are the texture's filters, ended by NULL.
#define BL_SEEING_PARAMETERS(block, words)                                                         \
    {.key = "filter",                                                                              \
     .kind = BL_CHOICE,                                                                            \
     .offset = offsetof(block, seeing.filter),                                                     \
     .choices = words,                                                                             \
     .fallback = "none",                                                                           \
     .unit = "",                                                                                   \
     .help = "how it filters itself for the width of a sample"},                                   \
        {.key = "width",                                                                           \
         .kind = BL_REAL,                                                                          \
         .offset = offsetof(block, seeing.width),                                                  \
         .maximum = INFINITY,                                                                      \
         .fallback = "0",                                                                          \
         .unit = "units",                                                                          \
         .help = "of a sample, along every axis; 0: a point"},                                     \
    {                                                                                              \
        .key = "component", .kind = BL_CHOICE, .offset = offsetof(block, seeing.component),        \
        .choices = bl_colour_components, .fallback = "luminance", .unit = "",                      \
        .help = "of the linear colour, that the value is"                                          \
    }

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

// In a texture's file, after `static void colour(const void *, const double at[BL_AXES],
// const double width[BL_AXES], double rgb[3])`: the other abilities of the signal, for its
// definition as .functions = {BL_TEXTURE_FUNCTIONS}.
#define BL_TEXTURE_ABILITIES(block)                                                                \
    static double filtered(const void *parameters, const double at[BL_AXES],                       \
                           const double width[BL_AXES]) {                                          \
        double rgb[3];                                                                             \
        colour(parameters, at, width, rgb);                                                        \
        return bl_colour_component(rgb, ((const block *)parameters)->seeing.component);            \
    }                                                                                              \
    static double value(const void *parameters, const double at[BL_AXES]) {                        \
        const double w = ((const block *)parameters)->seeing.width;                                \
        return filtered(parameters, at, (const double[BL_AXES]){w, w, w, w});                      \
    }
#define BL_TEXTURE_FUNCTIONS .value = value, .filtered = filtered, .colour = colour

// Names the definition of a texture's file: BL_TEXTURE_DESCRIPTOR(brick) = {...};
#define BL_TEXTURE_DESCRIPTOR(stem)                                                                \
    extern const bl_texture bl_texture_##stem;                                                     \
    const bl_texture bl_texture_##stem

#endif
