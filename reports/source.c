// SPDX-License-Identifier: MIT
//
// From the text of a signal to the one who opens it.
#include "reports/source.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/grammar.h"
#include "reports/image.h"

int bl_source_is_file(const char *text) {
    size_t length = strcspn(text, ":");
    char *name = strndup(text, length);
    if (!name)
        return 0;
    int is_file = strpbrk(name, "./") != NULL || (length > 0 && access(name, F_OK) == 0) ||
                  (*text && access(text, F_OK) == 0);
    free(name);
    return is_file;
}

// The settings of an image, as the grammar reads them. Indices may be left out: -1.
typedef struct image_settings {
    double spacing, part, memory;
} image_settings;

enum { LARGEST_PART = 65535 };

static const bl_parameter image_parameters[] = {
    {.key = "spacing",
     .kind = BL_REAL,
     .offset = offsetof(image_settings, spacing),
     .minimum = 0,
     .maximum = 1e12,
     .fallback = "0",
     .unit = "units",
     .help = "between pixels; 0: from the file, else 1"},
    {.key = "part",
     .kind = BL_REAL,
     .offset = offsetof(image_settings, part),
     .minimum = -1,
     .maximum = LARGEST_PART,
     .fallback = "-1",
     .unit = "",
     .help = "of a multi-part file, from 0"},
    {.key = "memory",
     .kind = BL_REAL,
     .offset = offsetof(image_settings, memory),
     .minimum = 0,
     .maximum = 1 << 24,
     .fallback = "1024",
     .unit = "MiB",
     .help = "held at most; a larger image is read in blocks"},
    {.key = NULL}};

static const char *const image_keys[] = {"channel", "spacing", "part", "memory", NULL};

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
        const char *near = known ? NULL : bl_nearest(key, image_keys);
        if (!known)
            return bl_report(message, BL_USAGE,
                             "unknown key '%s' of an image at column %zu%s%s%s the keys are "
                             "channel, spacing, part and memory",
                             key, spec->settings[i].key_column, near ? "; did you mean '" : "",
                             near ? near : "", near ? "'?" : ";");
    }
    return BL_OK;
}

static bl_status open_image(const char *text, bl_signal **signal, bl_message *message) {
    bl_image_source source = {.path = text, .part = -1, .text = text};
    source.memory_bytes = (size_t)1 << 30;
    if (access(text, F_OK) == 0) // a file whose own name holds a colon
        return bl_image_open(&source, signal, message);
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
    if (status == BL_OK) {
        source.path = spec.name;
        source.channel = channel;
        source.spacing = settings.spacing;
        source.part = (int)settings.part;
        source.memory_bytes = (size_t)(settings.memory * 1048576);
        status = bl_image_open(&source, signal, message);
    }
    free(channel);
    bl_spec_free(&spec);
    return status;
}

bl_status bl_source_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message) {
    return bl_source_is_file(text) ? open_image(text, signal, message)
                                   : bl_noise_open(text, isa, signal, message);
}
