// SPDX-License-Identifier: MIT
//
// Images on disk, written whole or not at all, and read as signals. OpenImageIO stands behind this
// header, in core/oiio.cpp and nowhere else; no exception passes it.
#ifndef BL_CORE_IMAGE_H
#define BL_CORE_IMAGE_H

#include <stddef.h>

#include "core/signal.h"

// A setting that travels with an image, as an attribute of the file.
typedef struct bl_attribute {
    const char *name; // "bandlimit:signal"
    const char *value;
} bl_attribute;

typedef struct bl_image {
    size_t width, height;
    size_t channels;     // 1 grey, 3 colour; 2 or 4 numbers, not in PNG; 0 means 1
    const float *values; // height rows of width pixels of channels values; row 0 is the top
    double spacing;      // units between pixels; 0: not stated
    double black, white; // PNG: the values shown as 0 and as full scale; both 0: the finite range
    unsigned bits;       // PNG: 8 or 16; 0 means 8
    int srgb;            // PNG: the values are linear light, and codes follow the curve of sRGB
    const bl_attribute *attributes;
    size_t attribute_count;
} bl_image;

// Writes an image in the format of the name's ending: .exr and .tif/.tiff hold the values as 32-bit
// floats; .png holds codes proportional to (value - black) / (white - black), clamped, with no
// further curve, so that equal steps of value are equal steps of code, unless `srgb` asks for the
// curve of IEC 61966-2-1, which a viewer undoes; NaN is black there. The attributes, the spacing ("bandlimit:spacing") and for PNG the range are written too where the
// format has room for them. Errors: BL_USAGE for another ending, an empty image or bits other than
// 8 and 16; BL_DEVICE for a folder that is missing or full: every byte is written through a
// bl_file, so a disk that fills half way leaves nothing. Thread-safe for different paths.
bl_status bl_image_write(const char *path, const bl_image *image, bl_message *message);

typedef struct bl_image_source {
    const char *path;
    const char *channel; // name or index; NULL: the first
    double spacing;      // 0: from the file, else 1
    int part;            // of a multi-part file; -1: not chosen
    size_t memory_bytes; // held at most
    const char *text;    // the whole text, for the signal and for messages
    unsigned wrap;       // beyond the edge: 0 nothing, 1 the image again, 2 mirrored
    unsigned reading;    // between the pixels: 0 the nearest, 1 linear, 2 cubic
} bl_image_source;

// Opens an image as a two-dimensional signal; see
// sources/source.h for the meaning and the errors.
bl_status bl_image_open(const bl_image_source *source, bl_signal **signal, bl_message *message);

#endif
