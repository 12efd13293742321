// SPDX-License-Identifier: MIT
//
// Bare samples in a file, as a signal: vol.raw:size=128x128x128, little-endian, x fastest. The file
// must have exactly the bytes that the size asks for, behind an offset that is skipped.
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <endian.h>
#include <sys/stat.h>
#include <fcntl.h>
#include <unistd.h>

#include "core/grammar.h"
#include "sources/kind.h"
#include "sources/grid_parameters.h"

enum { FLOAT32, UINT8, UINT16 };

static const char *const types[] = {"float32", "uint8", "uint16", NULL};
static const size_t type_bytes[] = {4, 1, 2};

typedef struct raw_settings {
    char size[BL_TEXT_SIZE];
    double spacing, memory, offset;
    uint32_t wrap, reading, type;
} raw_settings;

// The parameter block; the grid's source is `values`.
typedef struct raw_block {
    bl_sampled_grid grid;
    float *values; // owned
} raw_block;

#define AT(member) offsetof(raw_settings, member)
static const bl_parameter raw_parameters[] = {
    {"size", BL_TEXT, AT(size), "", "samples",
     .help = "along each axis, as 128x128x128; one to four axes"},
    {"dtype", BL_CHOICE, AT(type), "float32", "", .choices = types,
     .help = "of a sample, little-endian; integers are divided by their full scale"},
    {"offset", BL_REAL, AT(offset), "0", "bytes", .minimum = 0, .maximum = 0x1p52,
     .help = "of a header that is skipped"},
    BL_SPACING_PARAMETER(raw_settings, "1", "between samples"),
    BL_WRAP_PARAMETERS(raw_settings, "samples"),
    BL_MEMORY_PARAMETER(raw_settings, "held at most; a larger file is refused"),
    {0}};
#undef AT

static void raw_span(const void *source, const size_t index[BL_AXES], size_t count, float *out) {
    const raw_block *block = source;
    const size_t *size = block->grid.size;
    size_t line = (index[3] * size[2] + index[2]) * size[1] + index[1];
    memcpy(out, block->values + line * size[0] + index[0], count * sizeof *out);
}

// The signal keeps a copy of the block, so each use tells the grid where that copy is.
static bl_sampled_grid own_grid(const void *parameters) {
    bl_sampled_grid grid = ((const raw_block *)parameters)->grid;
    grid.source = parameters;
    return grid;
}

static void raw_row(const void *parameters, const double start[BL_AXES], const double step[BL_AXES],
                    size_t count, float *out) {
    bl_sampled_grid grid = own_grid(parameters);
    bl_sampled_grid_row(&grid, start, step, count, out);
}

static void raw_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                       float *out) {
    bl_sampled_grid grid = own_grid(parameters);
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = (float)bl_sampled_grid_value(&grid, place);
    }
}

static double raw_value(const void *parameters, const double at[BL_AXES]) {
    bl_sampled_grid grid = own_grid(parameters);
    return bl_sampled_grid_value(&grid, at);
}

static void raw_release(void *parameters) {
    free(((raw_block *)parameters)->values);
}

static const bl_signal_functions raw_functions = {
    .row = raw_row, .points = raw_points, .value = raw_value, .release = raw_release};

// --- opening ---

// Reads 128x128x128; in doubles, so that no product wraps.
static bl_status read_size(const char *text, const char *word, bl_sampled_grid *grid,
                           double *samples, bl_message *message) {
    char copy[BL_TEXT_SIZE], *rest = NULL;
    *samples = 1;
    snprintf(copy, sizeof copy, "%s", word);
    for (unsigned a = 0; a < BL_AXES; a++)
        grid->size[a] = 1;
    int good = *word && word[strlen(word) - 1] != 'x' && *word != 'x' && !strstr(word, "xx");
    for (char *one = strtok_r(copy, "x", &rest); one && good; one = strtok_r(NULL, "x", &rest)) {
        unsigned long long number;
        good = grid->dims < BL_AXES && bl_read_unsigned(one, &number) && number > 0 &&
               number <= (1ull << 31);
        if (good) {
            grid->size[grid->dims++] = (size_t)number;
            *samples *= (double)number;
        }
    }
    if (good)
        return BL_OK;
    if (!*word)
        return bl_report(message, BL_USAGE,
                         "'%s': a raw file says nothing of its shape; give size=WIDTHxHEIGHTxDEPTH "
                         "in samples (one to four axes)",
                         text);
    return bl_report(message, BL_USAGE,
                     "'%s': size=%s is not one to four whole numbers above 0 with an x between "
                     "them, as 128x128x128",
                     text, word);
}

static bl_status check_bytes(const char *path, const struct stat *info, const char *size,
                             const raw_settings *settings, double samples, bl_message *message) {
    size_t each = type_bytes[settings->type];
    double expected = samples * (double)each + settings->offset, found = (double)info->st_size;
    if (settings->offset != floor(settings->offset))
        return bl_report(message, BL_USAGE, "'%s': offset=%g: a whole number of bytes", path,
                         settings->offset);
    if (found != expected)
        return bl_report(message, BL_MISMATCH,
                         "'%s' has %.0f bytes, and size=%s of %s with offset=%.0f takes %.0f; give "
                         "the size that it has",
                         path, found, size, types[settings->type], settings->offset, expected);
    if (samples * 4 > settings->memory * 1048576)
        return bl_report(message, BL_MISMATCH,
                         "'%s' takes %.0f MiB, and memory=%.6g allows less; give memory=%.0f", path,
                         ceil(samples * 4 / 1048576), settings->memory,
                         ceil(samples * 4 / 1048576));
    return BL_OK;
}

// Turns the bytes into floats where they stand: a sample is never wider than a float, and the last
// goes first, so none is overwritten before it is read.
static void decode(unsigned char *bytes, float *values, size_t count, uint32_t type) {
    size_t each = type_bytes[type];
    for (size_t i = count; i-- > 0;) {
        uint32_t word = 0;
        float value;
        memcpy(&word, bytes + i * each, each);
        word = le32toh(word);
        memcpy(&value, &word, sizeof value);
        if (type == UINT8)
            value = (float)word / 255;
        if (type == UINT16)
            value = (float)word / 65535;
        memcpy(values + i, &value, sizeof value);
    }
}

static bl_status read_values(int file, const char *path, const raw_settings *settings,
                             size_t samples, float **values, bl_message *message) {
    size_t wanted = samples * type_bytes[settings->type], done = 0;
    *values = malloc(samples * sizeof **values);
    if (!*values)
        return bl_report(message, BL_DEVICE, "out of memory for %zu samples of '%s'", samples,
                         path);
    unsigned char *bytes = (unsigned char *)*values;
    while (done < wanted) {
        ssize_t got =
            pread(file, bytes + done, wanted - done, (off_t)settings->offset + (off_t)done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0) {
            free(*values);
            *values = NULL;
            return bl_report(message, BL_DEVICE, "cannot read '%s': %s", path,
                             got < 0 ? strerror(errno) : "it ended early");
        }
        done += (size_t)got;
    }
    decode(bytes, *values, samples, settings->type);
    return BL_OK;
}

static bl_status read_file(const char *path, const raw_settings *settings, raw_block *block,
                           double samples, bl_message *message) {
    struct stat info;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); // a pipe is refused, not waited for
    if (file < 0 || fstat(file, &info) != 0) {
        bl_status status =
            bl_report(message, BL_DEVICE, "cannot read '%s': %s", path, strerror(errno));
        if (file >= 0)
            close(file);
        return status;
    }
    bl_status status = BL_OK;
    if (!S_ISREG(info.st_mode))
        status =
            bl_report(message, BL_DEVICE,
                      "cannot read '%s': it is no file but a folder, a device or a pipe", path);
    if (status == BL_OK)
        status = check_bytes(path, &info, settings->size, settings, samples, message);
    if (status == BL_OK)
        status = read_values(file, path, settings, (size_t)samples, &block->values, message);
    close(file);
    return status;
}

static bl_status open_text(const char *text, bl_signal **signal, bl_message *message) {
    const char *colon = strchr(text, ':');
    raw_settings settings = {0};
    raw_block block = {.grid = {.span = raw_span}};
    double samples;
    bl_status status = bl_source_settings(raw_parameters, text, colon ? colon + 1 : NULL,
                                          colon ? strlen(colon + 1) : 0, &settings, message);
    if (status == BL_OK && !(settings.spacing > 0))
        status = bl_report(message, BL_USAGE, "'%s': spacing=%g: units between samples are above 0",
                           text, settings.spacing);
    if (status == BL_OK)
        status = read_size(text, settings.size, &block.grid, &samples, message);
    if (status != BL_OK)
        return status;
    block.grid.spacing = settings.spacing;
    block.grid.wrap = settings.wrap;
    block.grid.reading = settings.reading;
    char *path = colon ? strndup(text, (size_t)(colon - text)) : strdup(text);
    if (!path)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    status = read_file(path, &settings, &block, samples, message);
    free(path);
    if (status != BL_OK)
        return status;
    bl_signal *made = bl_signal_new(&raw_functions, &block, sizeof block, text);
    if (!made) {
        free(block.values);
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    }
    made->name = "raw";
    bl_sampled_grid_describe(&block.grid, made);
    *signal = made;
    return BL_OK;
}

static int takes(const char *text) {
    return !bl_source_is_whole_file(text) && bl_source_ends_with(text, strcspn(text, ":"), ".raw");
}

BL_SOURCE_DESCRIPTOR(raw) = {
    .name = "raw-file",
    .title = "a file of samples",
    .summary = "Bare samples, x fastest, little-endian; the settings account for every byte.",
    .paper = "bandlimit",
    .kind = "file",
    .form = "FILE.raw:size=WxHxD,KEY=VALUE",
    .example = "volume.raw:size=128x128x128,wrap=periodic",
    .parameters = raw_parameters,
    .sampled = 1,
    .takes = takes,
    .open = open_text};
