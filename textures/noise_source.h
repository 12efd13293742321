// SPDX-License-Identifier: MIT
//
// The noise within a texture: a signal of the registry, opened with the texture's own seed.
#ifndef BL_TEXTURES_NOISE_SOURCE_H
#define BL_TEXTURES_NOISE_SOURCE_H

#include "textures/texture.h"

// Fields of a parameter block: the settings, and the signal that `build` makes of them.
typedef struct bl_noise_source {
    uint64_t seed;
    char text[BL_TEXT_SIZE];
    bl_signal *signal;
} bl_noise_source;

// Opens `text` as a noise of the registry with the seed of the source; the caller ends with
// bl_noise_source_close. `source->signal` is set and never read, since a copied block has that of
// another. Errors: those of bl_noise_open; BL_USAGE for a noise without a seed, or with fewer
// dimensions than asked for, since what lies across them would be stripes.
bl_status bl_noise_source_open(bl_noise_source *source, const char *text, unsigned dimensions,
                               bl_message *message);
void bl_noise_source_close(bl_noise_source *source);

// clang-format off
// The keys seed and noise, for a block that has the source as `field`; `usual` is the noise.
#define BL_NOISE_SOURCE_PARAMETERS(block, field, usual)                                            \
    {"seed", BL_SEED, offsetof(block, field.seed), "0", "", .help = "of the noise"},               \
    {"noise", BL_NESTED, offsetof(block, field.text), usual, "",                                   \
     .help = "any noise of the registry, with noise.KEY"}
// clang-format on

#endif
