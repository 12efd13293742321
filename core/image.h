// SPDX-License-Identifier: MIT
//
// Images on disk, written whole or not at all, and read by pixels. OpenImageIO stands behind this
// header, in core/oiio.cpp and nowhere else; it is loaded when the first of these functions is
// called, and where it is missing they end with BL_DEVICE (core/image_library.h).
#ifndef BL_CORE_IMAGE_H
#define BL_CORE_IMAGE_H

#include <stddef.h>

#include "core/colourspace.h"
#include "core/status.h"

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
// curve of IEC 61966-2-1, which a viewer undoes; NaN is black there. The attributes and the spacing
// ("bandlimit:spacing") are written too where the format has room for them. Errors: BL_USAGE for
// another ending, an empty image or bits other than 8 and 16; BL_DEVICE for a folder that is
// missing or full: every byte is written through a bl_file, so a disk that fills half way leaves
// nothing. Thread-safe for different paths.
bl_status bl_image_write(const char *path, const bl_image *image, bl_message *message);

// The pixels of one channel of an image file.
typedef struct bl_pixels bl_pixels;

typedef struct bl_pixels_choice {
    const char *path;
    const char *channel;        // its name; NULL: the first
    int channel_index;          // where no channel has that name (bl_channel_index); -1: none
    int part;                   // of a multi-part file; -1: not chosen
    size_t memory_bytes;        // held at most; a larger image is read in blocks
    bl_colourspace colourspace; // of colours; the numbers of other channels are as stored
} bl_pixels_choice;

typedef struct bl_pixels_facts {
    size_t width, height;
    char spacing[64]; // what the file says of "bandlimit:spacing"; "" if nothing
    char note[256];   // what the values are: the channel, its scale and its colours, in words
} bl_pixels_facts;

// The index that a channel is called by, or -1.
int bl_channel_index(const char *channel);

// Opens the pixels. Integers of 8 and 16 bits are divided by their full scale; those of more are
// numbers of things, and stay as they are (a float holds them up to 2^24). The whole
// image is read once, so that a damaged one is refused here. The caller ends with bl_pixels_close.
// Errors: BL_USAGE for a channel or part that is not there; BL_MISMATCH for a file of several parts
// of which none is chosen, for one that is not one plane of pixels, and for one whose colours are
// asked for as the file says, in words that are not known; BL_DEVICE for a file that
// is missing, unreadable or damaged, and without memory. Thread-safe.
bl_status bl_pixels_open(const bl_pixels_choice *choice, bl_pixels **pixels, bl_pixels_facts *facts,
                         bl_message *message);
// Pixels x .. x + count - 1 of row y, all within the image; row 0 is the top. NaN where the file
// fails us. Thread-safe.
void bl_pixels_span(const bl_pixels *pixels, size_t x, size_t y, size_t count, float *out);
void bl_pixels_close(bl_pixels *pixels); // NULL is fine

#endif
