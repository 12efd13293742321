// SPDX-License-Identifier: MIT
//
// What stands between core/image.c and OpenImageIO: a table of functions, which core/oiio.cpp fills
// and exports from a shared object of its own, bandlimit-images.so. It is loaded when an image is
// first read or written, because OpenImageIO brings some 250 libraries, which take 0.2 s and 100 MB
// and which nothing but images needs. No exception passes these functions.
#ifndef BL_CORE_IMAGE_LIBRARY_H
#define BL_CORE_IMAGE_LIBRARY_H

#include <stdio.h>

#include "core/image.h"
#include "core/texels.h"

typedef enum bl_image_format {
    BL_IMAGE_UNKNOWN,
    BL_IMAGE_EXR,
    BL_IMAGE_TIFF,
    BL_IMAGE_PNG
} bl_image_format;

typedef struct bl_image_library {
    const char *version; // BL_VERSION of the build that it belongs to; stays the first member
    // Encodes a checked image into a stream, which can be read back and sought in.
    bl_status (*write)(FILE *stream, const char *path, bl_image_format format,
                       const bl_image *image, bl_message *message);
    // As the functions of core/image.h ...
    bl_status (*pixels_open)(const bl_pixels_choice *choice, bl_pixels **pixels,
                             bl_pixels_facts *facts, bl_message *message);
    void (*pixels_span)(const bl_pixels *pixels, size_t x, size_t y, size_t count, float *out);
    void (*pixels_close)(bl_pixels *pixels);
    // ... and of core/texels.h.
    bl_status (*texels_open)(const char *path, const bl_colourspace *space, bl_texels **texels,
                             bl_message *message);
    void (*texels_close)(bl_texels *texels);
    void (*texels_look)(const bl_texels *texels, double s, double t, double width_s, double width_t,
                        bl_texels_reading reading, double rgb[3]);
    void (*texels_mean)(const bl_texels *texels, double rgb[3]);
    void (*texels_bounds)(const bl_texels *texels, double least[3], double most[3]);
    void (*texels_size)(const bl_texels *texels, size_t size[2]);
    const char *(*texels_note)(const bl_texels *texels);
    void (*texels_plane)(const bl_texels *texels, int component, float *out);
} bl_image_library;

#define BL_IMAGE_LIBRARY_FILE "bandlimit-images.so"
#define BL_IMAGE_LIBRARY_SYMBOL "bl_image_library_table" // of the bl_image_library in it

// The table, loaded at the first call. The file is looked for beside the program or the library
// that this code is in (as in the build tree), then where `make install` puts it: in
// ../lib/bandlimit of the program, in bandlimit/ beside the library, in the folder that was
// configured. BANDLIMIT_IMAGES in the environment names another file, and then only that counts.
// Errors: BL_DEVICE, with the places looked at; they stay until the program ends. Thread-safe.
bl_status bl_image_library_load(const bl_image_library **library, bl_message *message);

#endif
