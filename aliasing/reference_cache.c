// SPDX-License-Identifier: MIT
//
// The file: the text of all that made the image, a zero byte, the number of bytes that follow as
// doubles (rms error, samples, exact, the colours, the errors), and a 64-bit checksum of everything
// before it. Numbers are in the byte order of the machine, which the text names.
#include "aliasing/reference_cache.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/hash.h"
#include "core/random.h"
#include "core/version.h"

enum { HEAD = 3, PROBES = 1024 };

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size) {
    const unsigned char *at = bytes;
    for (; size >= 8; size -= 8, at += 8) {
        uint64_t word;
        memcpy(&word, at, sizeof word);
        hash = bl_mix(hash ^ word) + BL_GOLDEN;
    }
    for (; size > 0; size--)
        hash = bl_mix(hash ^ *at++) + BL_GOLDEN;
    return hash;
}

// What the signal gives at places of the view: a text says nothing of what stands in a file.
static uint64_t hash_values(const bl_scene *scene) {
    bl_random random = bl_random_seed(1, 0);
    uint64_t hash = 0;
    for (int i = 0; i < PROBES; i++) {
        double rgb[3];
        double x = bl_random_unit(&random) * (double)scene->view->width;
        double y = bl_random_unit(&random) * (double)scene->view->height;
        bl_scene_point(scene, x, y, rgb);
        hash = hash_bytes(hash, rgb, sizeof rgb);
    }
    return hash;
}

// All that the image depends on; the caller frees it.
static char *describe(const bl_scene *scene, const bl_reference_settings *settings) {
    char *text;
    uint16_t order = 1;
    int length = asprintf(
        &text,
        "bandlimit %s reference\nsignal %s\nview %s\nsize %zu %zu\npixel %s\nseed %" PRIu64
        "\ntolerance %a\nmost %" PRIu32 "\nbackground %a %a %a\nvalues %016" PRIx64
        "\nlittle-endian %d\n",
        BL_VERSION, scene->signal->text, scene->view->text, scene->view->width, scene->view->height,
        bl_pixel_words[settings->pixel], scene->seed, settings->tolerance, settings->most_samples,
        scene->background[0], scene->background[1], scene->background[2], hash_values(scene),
        *(const unsigned char *)&order == 1);
    return length < 0 ? NULL : text;
}

static char *path_of(const bl_reference_settings *settings, const char *text) {
    char *path;
    uint64_t hash = hash_bytes(0, text, strlen(text));
    return asprintf(&path, "%s/reference-%016" PRIx64 ".bin", settings->cache, hash) < 0 ? NULL
                                                                                         : path;
}

char *bl_reference_cache_path(const bl_scene *scene, const bl_reference_settings *settings) {
    char *text = describe(scene, settings), *path = text ? path_of(settings, text) : NULL;
    free(text);
    return path;
}

// The whole file for this image; the caller frees it. NULL out of memory.
static char *assemble(const char *text, const bl_reference *reference, size_t *size) {
    size_t pixels = reference->width * reference->height, length = strlen(text) + 1;
    double head[HEAD] = {reference->rms_error, reference->samples, reference->exact};
    *size = length + sizeof head + 4 * pixels * sizeof(double) + sizeof(uint64_t);
    char *bytes = malloc(*size), *at = bytes;
    if (!bytes)
        return NULL;
    at = mempcpy(at, text, length);
    at = mempcpy(at, head, sizeof head);
    at = mempcpy(at, reference->rgb, 3 * pixels * sizeof(double));
    at = mempcpy(at, reference->error, pixels * sizeof(double));
    uint64_t checksum = hash_bytes(0, bytes, (size_t)(at - bytes));
    memcpy(at, &checksum, sizeof checksum);
    return bytes;
}

bl_status bl_reference_cache_write(const bl_scene *scene, const bl_reference_settings *settings,
                                   const bl_reference *reference, bl_message *message) {
    size_t size = 0;
    bl_file file;
    char *text = describe(scene, settings), *path = text ? path_of(settings, text) : NULL;
    char *bytes = path ? assemble(text, reference, &size) : NULL;
    bl_status status =
        bytes ? bl_make_folder(settings->cache, message)
              : bl_report(message, BL_DEVICE, "out of memory for the cache of a converged image");
    if (status == BL_OK)
        status = bl_file_create(path, &file, message);
    if (status == BL_OK) {
        fwrite(bytes, 1, size, file.stream); // bl_file_commit checks it
        status = bl_file_commit(&file, message);
    }
    free(bytes);
    free(path);
    free(text);
    return status;
}

// Reads exactly `size` bytes, and no more may follow.
static int read_all(const char *path, char *bytes, size_t size) {
    char more;
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    int whole = fread(bytes, 1, size, file) == size && fread(&more, 1, 1, file) == 0;
    fclose(file);
    return whole;
}

// Fills the reference from the bytes if they are those of this text and undamaged.
static int take(const char *text, const char *bytes, size_t size, bl_reference *reference) {
    uint64_t checksum;
    double head[HEAD];
    size_t pixels = reference->width * reference->height, length = strlen(text) + 1;
    memcpy(&checksum, bytes + size - sizeof checksum, sizeof checksum);
    if (memcmp(bytes, text, length) != 0 ||
        checksum != hash_bytes(0, bytes, size - sizeof checksum))
        return 0;
    memcpy(head, bytes + length, sizeof head);
    memcpy(reference->rgb, bytes + length + sizeof head, 3 * pixels * sizeof(double));
    memcpy(reference->error, bytes + length + sizeof head + 3 * pixels * sizeof(double),
           pixels * sizeof(double));
    reference->rms_error = head[0];
    reference->samples = head[1];
    reference->exact = head[2] != 0;
    reference->from_cache = 1;
    return 1;
}

int bl_reference_cache_read(const bl_scene *scene, const bl_reference_settings *settings,
                            bl_reference *reference) {
    size_t size = 0;
    int taken = 0;
    char *text = describe(scene, settings), *path = text ? path_of(settings, text) : NULL;
    char *bytes = path ? assemble(text, reference, &size) : NULL; // of the right size
    if (bytes && read_all(path, bytes, size))
        taken = take(text, bytes, size, reference);
    free(bytes);
    free(path);
    free(text);
    return taken;
}
