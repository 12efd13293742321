// SPDX-License-Identifier: MIT
//
// How the numbers of a picture stand for light: linear, by the curve of sRGB, or by a power; and
// the words for it, of the key `colourspace` and of files.
#ifndef BL_CORE_COLOURSPACE_H
#define BL_CORE_COLOURSPACE_H

#include <math.h>
#include <stddef.h>

#include "core/status.h"

typedef enum bl_colour_curve {
    BL_COLOURS_LINEAR,  // the numbers as they stand
    BL_COLOURS_OF_FILE, // as the file says
    BL_COLOURS_SRGB,    // IEC 61966-2-1
    BL_COLOURS_POWER    // light = code^power
} bl_colour_curve;

typedef struct bl_colourspace {
    bl_colour_curve curve;
    double power; // of BL_COLOURS_POWER
} bl_colourspace;

extern const char *const bl_colourspace_words[]; // "file", ..., "gamma2.2", NULL: any power will do

// Reads a setting: one of the words above. Errors: BL_USAGE, with all words.
bl_status bl_colourspace_read(const char *word, bl_colourspace *space, bl_message *message);

// Reads what a file says of itself, in the words of OpenImageIO ("sRGB", "Linear", "Gamma2.2",
// "lin_rec709", "g22_rec709", ...); `power` is that of "GammaCorrected", 0 for none. Returns 0 for
// words that are not known.
int bl_colourspace_of_file(const char *word, double power, bl_colourspace *space);

// "linear", "the curve of sRGB", "the power 2.2".
void bl_colourspace_text(const bl_colourspace *space, char *text, size_t size);

// The curve of IEC 61966-2-1 and its inverse. Beyond [0, 1] both go on, and below 0 they are
// straight.
static inline double bl_srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

static inline double bl_srgb_decode(double code) {
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

// Light of a code; `space` is not BL_COLOURS_OF_FILE. A power is odd.
static inline double bl_colourspace_decode(const bl_colourspace *space, double code) {
    if (space->curve == BL_COLOURS_SRGB)
        return bl_srgb_decode(code);
    return space->curve == BL_COLOURS_POWER ? copysign(pow(fabs(code), space->power), code) : code;
}

#endif
