// SPDX-License-Identifier: MIT
//
// Images and texels for the rest of the house: what needs no image library is done here, the rest
// by the library that core/image_library.h loads.
#include "core/image.h"

#include <limits.h>
#include <string.h>
#include <strings.h>

#include "core/file.h"
#include "core/grammar.h"
#include "core/image_library.h"
#include "core/texels.h"

// --- writing ---

static bl_image_format format_of(const char *path) {
    static const struct {
        const char *ending;
        bl_image_format format;
    } endings[] = {{".exr", BL_IMAGE_EXR},
                   {".png", BL_IMAGE_PNG},
                   {".tif", BL_IMAGE_TIFF},
                   {".tiff", BL_IMAGE_TIFF}};
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(dot, endings[i].ending) == 0)
            return endings[i].format;
    return BL_IMAGE_UNKNOWN;
}

static bl_status check_image(const char *path, const bl_image *image, bl_message *message) {
    const size_t most = 1 << 24; // pixels along a side: beyond it no format here can hold them
    bl_image_format format = format_of(path);
    if (format == BL_IMAGE_UNKNOWN)
        return bl_report(message, BL_USAGE,
                         "cannot tell the format of '%s': the name must end in .exr, .png or .tif",
                         path);
    if (!image->width || !image->height || image->width > most || image->height > most)
        return bl_report(message, BL_USAGE, "'%s': no image has %zu x %zu pixels", path,
                         image->width, image->height);
    if (image->channels > 4 ||
        (format == BL_IMAGE_PNG && image->channels && image->channels % 2 == 0) ||
        (image->bits && image->bits != 8 && image->bits != 16))
        return bl_report(message, BL_USAGE,
                         "'%s': an image has 1 to 4 channels, PNG 1 or 3, and 8 or 16 bits", path);
    return BL_OK;
}

bl_status bl_image_write(const char *path, const bl_image *image, bl_message *message) {
    const bl_image_library *library;
    bl_file file;
    bl_status status = check_image(path, image, message);
    if (status == BL_OK)
        status = bl_image_library_load(&library, message);
    if (status == BL_OK)
        status = bl_file_create(path, &file, message);
    if (status != BL_OK)
        return status;
    status = library->write(file.stream, path, format_of(path), image, message);
    if (status == BL_OK)
        return bl_file_commit(&file, message);
    bl_file_discard(&file);
    return status;
}

// --- reading: whoever has pixels or texels has loaded the library ---

static const bl_image_library *loaded(void) {
    const bl_image_library *library;
    bl_image_library_load(&library, NULL);
    return library;
}

int bl_channel_index(const char *channel) {
    unsigned long long index;
    return channel && bl_read_unsigned(channel, &index) && index <= INT_MAX ? (int)index : -1;
}

bl_status bl_pixels_open(const bl_pixels_choice *choice, bl_pixels **pixels, bl_pixels_facts *facts,
                         bl_message *message) {
    const bl_image_library *library;
    bl_status status = bl_image_library_load(&library, message);
    return status == BL_OK ? library->pixels_open(choice, pixels, facts, message) : status;
}

void bl_pixels_span(const bl_pixels *pixels, size_t x, size_t y, size_t count, float *out) {
    loaded()->pixels_span(pixels, x, y, count, out);
}

void bl_pixels_close(bl_pixels *pixels) {
    if (pixels)
        loaded()->pixels_close(pixels);
}

bl_status bl_texels_open(const char *path, const bl_colourspace *space, bl_texels **texels,
                         bl_message *message) {
    const bl_image_library *library;
    bl_status status = bl_image_library_load(&library, message);
    return status == BL_OK ? library->texels_open(path, space, texels, message) : status;
}

void bl_texels_close(bl_texels *texels) {
    if (texels)
        loaded()->texels_close(texels);
}

void bl_texels_look(const bl_texels *texels, double s, double t, double width_s, double width_t,
                    bl_texels_reading reading, double rgb[3]) {
    loaded()->texels_look(texels, s, t, width_s, width_t, reading, rgb);
}

void bl_texels_mean(const bl_texels *texels, double rgb[3]) {
    loaded()->texels_mean(texels, rgb);
}

void bl_texels_bounds(const bl_texels *texels, double least[3], double most[3]) {
    loaded()->texels_bounds(texels, least, most);
}

void bl_texels_size(const bl_texels *texels, size_t size[2]) {
    loaded()->texels_size(texels, size);
}

const char *bl_texels_note(const bl_texels *texels) {
    return loaded()->texels_note(texels);
}

void bl_texels_plane(const bl_texels *texels, int component, float *out) {
    loaded()->texels_plane(texels, component, out);
}
