// SPDX-License-Identifier: MIT
//
// The contract of a filtered lookup in a picture of a file, for the texture that shows it.
//
// Textures know no library of images: they call these functions, which OpenImageIO's texture system
// answers, loaded as core/image.h says. Pictures repeat beyond their edges. Colours
// are linear: codes of a file are decoded before anything is filtered.
#ifndef BL_CORE_TEXELS_H
#define BL_CORE_TEXELS_H

#include <stddef.h>

#include "core/colourspace.h"
#include "core/status.h"

typedef struct bl_texels bl_texels;

// How texels become a colour.
typedef enum bl_texels_reading {
    BL_TEXELS_POINT,      // between the four nearest, whatever the width
    BL_TEXELS_TRILINEAR,  // between two levels of a pyramid of box means, for the larger width
    BL_TEXELS_ANISOTROPIC // several such lookups along the larger width
} bl_texels_reading;

// Reads the whole picture; "" is a built-in card of 128 x 128 texels (coloured squares that get
// finer to the right, and a ramp of grey at the bottom), whose colours are linear whatever is asked
// for. Grey counts as three equal colours. An alpha channel is left aside: colours are as stored,
// which is times alpha in EXR, and not in PNG. On success the caller ends with bl_texels_close.
// Errors: BL_DEVICE for a file that is missing, damaged or too large, BL_MISMATCH for one without
// pixels or whose own word for its colours is not known. Thread-safe.
bl_status bl_texels_open(const char *path, const bl_colourspace *space, bl_texels **texels,
                         bl_message *message);
void bl_texels_close(bl_texels *texels); // NULL is fine

// The colour at (s, t) for samples of these widths; the picture spans the unit square, s to the
// right and t downwards. NaN and infinite places give NaN. Computed in float. Thread-safe.
void bl_texels_look(const bl_texels *texels, double s, double t, double width_s, double width_t,
                    bl_texels_reading reading, double rgb[3]);

// The mean colour of all texels, their bounds, and their numbers along both axes.
void bl_texels_mean(const bl_texels *texels, double rgb[3]);
void bl_texels_bounds(const bl_texels *texels, double least[3], double most[3]);
void bl_texels_size(const bl_texels *texels, size_t size[2]);

// What was taken of the file, and how its codes were read, in words.
const char *bl_texels_note(const bl_texels *texels);

// Copies one component (0 to 2) of all texels, the upper row first, into size[0] * size[1] floats.
void bl_texels_plane(const bl_texels *texels, int component, float *out);

#endif
