// SPDX-License-Identifier: MIT
//
// An image by its text: the settings behind the name of a file, as sources/source.h states them.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/grammar.h"
#include "core/image.h"
#include "core/registry.h"
#include "sources/kind.h"
#include "sources/grid_parameters.h"

// The settings of an image, as the grammar reads them. Indices may be left out: -1.
typedef struct image_settings {
    double spacing, part, memory;
    char colourspace[BL_TEXT_SIZE];
    uint32_t wrap, reading;
} image_settings;

enum { LARGEST_PART = 65535 };

static const bl_parameter image_parameters[] = {
    BL_SPACING_PARAMETER(image_settings, "0", "between pixels; 0: from the file, else 1"),
    {"part", BL_REAL, offsetof(image_settings, part), "-1", "", .minimum = -1,
     .maximum = LARGEST_PART, .help = "of a multi-part file, from 0"},
    {"colourspace", BL_TEXT, offsetof(image_settings, colourspace), "linear", "",
     .choices = bl_colourspace_words,
     .help = "linear: the numbers as stored; else light is made of a channel of colours"},
    BL_MEMORY_PARAMETER(image_settings, "held at most; a larger image is read in blocks"),
    BL_WRAP_PARAMETERS(image_settings, "pixels"),
    {0}};

static const char *const image_keys[] = {"channel", "spacing", "part",   "colourspace",
                                         "memory",  "wrap",    "interp", NULL};

// The channel is a name of the file's own, which the grammar's kinds do not know; it is taken out
// of the list before the rest is read. Its string belongs to the caller then.
static bl_status take_channel(bl_spec *spec, char **channel, bl_message *message) {
    for (size_t i = 0; i < spec->count; i++) {
        bl_setting *setting = &spec->settings[i];
        if (strcmp(setting->key, "channel") != 0)
            continue;
        if (*channel)
            return bl_report(message, BL_USAGE, "'channel' at column %zu is given twice",
                             setting->key_column);
        *channel = setting->value;
        free(setting->key);
        memmove(setting, setting + 1, (spec->count - i - 1) * sizeof *setting);
        spec->count--;
        i--;
    }
    return BL_OK;
}

static bl_status check_values(const bl_spec *spec, const image_settings *settings,
                              bl_message *message) {
    for (size_t i = 0; i < spec->count; i++) {
        const bl_setting *setting = &spec->settings[i];
        if (strcmp(setting->key, "spacing") == 0 && !(settings->spacing > 0))
            return bl_report(message, BL_USAGE,
                             "spacing '%s' at column %zu: units between pixels are above 0",
                             setting->value, setting->value_column);
        if (strcmp(setting->key, "part") == 0 &&
            (settings->part < 0 || settings->part != (int)settings->part))
            return bl_report(message, BL_USAGE, "part '%s' at column %zu: parts count from 0",
                             setting->value, setting->value_column);
    }
    return BL_OK;
}

// Names an unknown key here, because the list of parameters lacks the channel.
static bl_status check_keys(const bl_spec *spec, bl_message *message) {
    for (size_t i = 0; i < spec->count; i++) {
        const char *key = spec->settings[i].key;
        int known = 0;
        for (int k = 0; image_keys[k]; k++)
            known |= strcmp(key, image_keys[k]) == 0;
        if (known)
            continue;
        char where[64];
        snprintf(where, sizeof where, " of an image at column %zu", spec->settings[i].key_column);
        const bl_unknown unknown = {
            .what = "key", .word = key, .where = where, .words = image_keys};
        return bl_report_unknown(&unknown, message);
    }
    return BL_OK;
}

// What stands in for a picture by mistake: code, which has a way of its own.
static bl_status refuse_code(const char *text, bl_message *message) {
    static const struct {
        const char *ending, *command;
    } kinds[] = {{".py", "python3 "}, {".sh", "sh "}, {".pl", "perl "}, {".c", NULL},
                 {".cc", NULL},       {".cpp", NULL}, {".cxx", NULL}};
    size_t length = access(text, F_OK) == 0 ? strlen(text) : strcspn(text, ":");
    char head[4] = "", path[BL_TEXT_SIZE];
    snprintf(path, sizeof path, "%.*s", (int)(length < sizeof path ? length : 0), text);
    struct stat info;
    FILE *stream = stat(path, &info) == 0 && S_ISREG(info.st_mode) ? fopen(path, "rb") : NULL;
    if (!stream)
        return BL_OK;
    size_t got = fread(head, 1, sizeof head, stream);
    fclose(stream);
    const char *here = strchr(path, '/') ? "" : "./";
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (!bl_source_ends_with(path, length, kinds[i].ending))
            continue;
        if (kinds[i].command)
            return bl_report(message, BL_USAGE, "'%s' is a program: ask it as 'cmd:%s%s'", path,
                             kinds[i].command, path);
        int stem = (int)(length - strlen(kinds[i].ending));
        return bl_report(message, BL_USAGE,
                         "'%s' is source text: build it (cc -O2 -fPIC -shared %s -o %.*s.so -lm) "
                         "and name its function as %s%.*s.so:FUNCTION",
                         path, path, stem, path, here, stem, path);
    }
    int runs = (got >= 2 && memcmp(head, "#!", 2) == 0) ||
               (got == 4 && memcmp(head, "\177ELF", 4) == 0 && access(path, X_OK) == 0);
    return runs ? bl_report(message, BL_USAGE, "'%s' is a program: ask it as 'cmd:%s%s'", path,
                            here, path)
                : BL_OK;
}

// --- the signal ---

// The parameter block.
typedef struct image_block {
    bl_sampled_grid grid;
    bl_pixels *pixels; // owned
    char note[256];    // of the pixels
} image_block;

static void image_span(const void *source, const size_t index[BL_AXES], size_t count, float *out) {
    bl_pixels_span(source, index[0], index[1], count, out);
}

static void image_row(const void *parameters, const double start[BL_AXES],
                      const double step[BL_AXES], size_t count, float *out) {
    bl_sampled_grid_row(&((const image_block *)parameters)->grid, start, step, count, out);
}

static double image_value(const void *parameters, const double at[BL_AXES]) {
    return bl_sampled_grid_value(&((const image_block *)parameters)->grid, at);
}

static void image_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                         float *out) {
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = (float)image_value(parameters, place);
    }
}

static void image_release(void *parameters) {
    bl_pixels_close(((image_block *)parameters)->pixels);
}

static void image_note(const void *parameters, char *text, size_t size) {
    snprintf(text, size, "%s", ((const image_block *)parameters)->note);
}

static const bl_signal_functions image_functions = {.row = image_row,
                                                    .points = image_points,
                                                    .value = image_value,
                                                    .release = image_release,
                                                    .note = image_note};

// The spacing that was asked for, else the file's own, else 1.
static bl_status find_spacing(const bl_pixels_facts *facts, const char *path, double *spacing,
                              bl_message *message) {
    if (*spacing > 0)
        return BL_OK;
    *spacing = 1;
    if (!facts->spacing[0] || (bl_read_real(facts->spacing, spacing) && *spacing > 0))
        return BL_OK;
    return bl_report(message, BL_MISMATCH,
                     "'%s' says bandlimit:spacing is '%s', which is no size of a pixel; give "
                     "spacing=REAL",
                     path, facts->spacing);
}

// Opens the file and makes the signal. `settings` may leave the spacing open, 0.
static bl_status open_image(const char *text, const char *path, const char *channel,
                            const image_settings *settings, bl_signal **out, bl_message *message) {
    bl_pixels_choice choice = {.path = path,
                               .channel = channel,
                               .channel_index = bl_channel_index(channel),
                               .part = (int)settings->part,
                               .memory_bytes = (size_t)(settings->memory * 1048576)};
    bl_pixels_facts facts;
    image_block block = {.grid = {.dims = 2,
                                  .spacing = settings->spacing,
                                  .wrap = settings->wrap,
                                  .reading = settings->reading,
                                  .span = image_span}};
    bl_status status = bl_colourspace_read(settings->colourspace, &choice.colourspace, message);
    if (status == BL_OK)
        status = bl_pixels_open(&choice, &block.pixels, &facts, message);
    if (status != BL_OK)
        return status;
    memcpy(block.note, facts.note, sizeof block.note);
    const size_t size[BL_AXES] = {facts.width, facts.height, 1, 1};
    memcpy(block.grid.size, size, sizeof size);
    block.grid.source = block.pixels;
    status = find_spacing(&facts, path, &block.grid.spacing, message);
    bl_signal *signal =
        status == BL_OK ? bl_signal_new(&image_functions, &block, sizeof block, text) : NULL;
    if (status == BL_OK && !signal)
        status = bl_report(message, BL_DEVICE, "out of memory opening '%s'", path);
    if (status != BL_OK) {
        bl_pixels_close(block.pixels);
        return status;
    }
    signal->name = "image";
    bl_sampled_grid_describe(&block.grid, signal);
    *out = signal;
    return BL_OK;
}

static bl_status open_text(const char *text, bl_signal **signal, bl_message *message) {
    static const image_settings usual = {.part = -1, .memory = 1024, .colourspace = "linear"};
    bl_status code = refuse_code(text, message);
    if (code != BL_OK)
        return code;
    if (access(text, F_OK) == 0) // a file whose own name holds a colon
        return open_image(text, text, NULL, &usual, signal, message);
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    char *channel = NULL;
    image_settings settings = {0};
    status = check_keys(&spec, message);
    if (status == BL_OK)
        status = take_channel(&spec, &channel, message);
    if (status == BL_OK)
        status = bl_parameters_read(image_parameters, &spec, text, &settings, message);
    if (status == BL_OK)
        status = check_values(&spec, &settings, message);
    if (status == BL_OK)
        status = open_image(text, spec.name, channel, &settings, signal, message);
    free(channel);
    bl_spec_free(&spec);
    return status;
}

// A picture stands at the end of the list, and takes whatever looks like a file.
static int takes(const char *text) {
    size_t length = strcspn(text, ":");
    char *name = strndup(text, length);
    int is_file = bl_source_is_whole_file(text) ||
                  (name && (strpbrk(name, "./") || (length > 0 && access(name, F_OK) == 0)));
    free(name);
    return is_file;
}

BL_SOURCE_DESCRIPTOR(image) = {
    .name = "image-file",
    .title = "a file of samples",
    .summary = "One channel of an image of any format that OpenImageIO reads; also channel=NAME.",
    .paper = "bandlimit",
    .kind = "file",
    .form = "FILE:KEY=VALUE",
    .example = "grain.exr:spacing=0.0625,channel=R",
    .parameters = image_parameters,
    .sampled = 1,
    .takes = takes,
    .open = open_text};
