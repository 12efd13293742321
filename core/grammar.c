// SPDX-License-Identifier: MIT
#include "core/grammar.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int bl_read_unsigned(const char *word, unsigned long long *out) {
    if (!isdigit((unsigned char)*word)) // strtoull would take blanks and a sign
        return 0;
    char *end;
    errno = 0;
    int base = word[0] == '0' && (word[1] == 'x' || word[1] == 'X') ? 16 : 10;
    *out = strtoull(word, &end, base);
    return errno == 0 && *end == '\0';
}

static int read_plain_real(const char *word, size_t length, double *out) {
    char buffer[64];
    if (length == 0 || length >= sizeof buffer || isspace((unsigned char)*word))
        return 0;
    memcpy(buffer, word, length);
    buffer[length] = '\0';
    char *end;
    *out = strtod(buffer, &end);
    return *end == '\0' && isfinite(*out);
}

int bl_read_real(const char *word, double *out) {
    const char *slash = strchr(word, '/');
    if (!slash)
        return read_plain_real(word, strlen(word), out);
    double top, bottom;
    if (!read_plain_real(word, (size_t)(slash - word), &top) ||
        !read_plain_real(slash + 1, strlen(slash + 1), &bottom) || bottom == 0)
        return 0;
    *out = top / bottom;
    return isfinite(*out);
}

int bl_read_count(const char *word, unsigned long long *out) {
    double number;
    if (bl_read_unsigned(word, out))
        return 1;
    if (!isdigit((unsigned char)*word) || !strpbrk(word, "eE") || strpbrk(word, "/xX") ||
        !bl_read_real(word, &number) || number < 0 || number > 0x1p53 || number != floor(number))
        return 0;
    *out = (unsigned long long)number;
    return 1;
}

void bl_spec_free(bl_spec *spec) {
    for (size_t i = 0; i < spec->count; i++) {
        free(spec->settings[i].key);
        free(spec->settings[i].value);
    }
    free(spec->settings);
    free(spec->name);
    *spec = (bl_spec){0};
}

static int is_number(const char *at, size_t length) {
    char buffer[64];
    double unused;
    if (length >= sizeof buffer)
        return 0;
    memcpy(buffer, at, length);
    buffer[length] = '\0';
    return bl_read_real(buffer, &unused);
}

// Appends a comma and a number to the value: a list.
static int extend_value(bl_setting *setting, const char *at, size_t length) {
    size_t old = strlen(setting->value);
    char *longer = realloc(setting->value, old + length + 2);
    if (!longer)
        return 0;
    longer[old] = ',';
    memcpy(longer + old + 1, at, length);
    longer[old + 1 + length] = '\0';
    setting->value = longer;
    return 1;
}

static bl_status add_setting(bl_spec *spec, const char *text, const char *at, size_t length,
                             bl_message *message) {
    size_t column = (size_t)(at - text) + 1;
    const char *equals = memchr(at, '=', length);
    if (length == 0)
        return bl_report(message, BL_USAGE, "column %zu of '%s': expected key=value, found nothing",
                         column, text);
    if (!equals && spec->count > 0 && is_number(at, length))
        return extend_value(&spec->settings[spec->count - 1], at, length)
                   ? BL_OK
                   : bl_report(message, BL_DEVICE, "out of memory reading '%s'", text);
    if (!equals || equals == at || equals + 1 == at + length)
        return bl_report(message, BL_USAGE, "'%.*s' at column %zu of '%s': expected key=value",
                         (int)length, at, column, text);
    bl_setting *settings = realloc(spec->settings, (spec->count + 1) * sizeof *settings);
    if (!settings)
        return bl_report(message, BL_DEVICE, "out of memory reading '%s'", text);
    spec->settings = settings;
    size_t key_length = (size_t)(equals - at);
    bl_setting *added = &settings[spec->count];
    added->key = strndup(at, key_length);
    added->value = strndup(equals + 1, length - key_length - 1);
    added->key_column = column;
    added->value_column = column + key_length + 1;
    spec->count++;
    if (!added->key || !added->value)
        return bl_report(message, BL_DEVICE, "out of memory reading '%s'", text);
    return BL_OK;
}

bl_status bl_spec_parse(const char *text, bl_spec *spec, bl_message *message) {
    *spec = (bl_spec){0};
    const char *colon = strchr(text, ':');
    size_t name_length = colon ? (size_t)(colon - text) : strlen(text);
    if (name_length == 0)
        return bl_report(message, BL_USAGE,
                         "'%s' has no name; a signal reads name:key=value,key=value", text);
    spec->name = strndup(text, name_length);
    bl_status status =
        spec->name ? BL_OK : bl_report(message, BL_DEVICE, "out of memory reading '%s'", text);
    const char *at = colon ? colon + 1 : NULL;
    while (status == BL_OK && at) {
        const char *comma = strchr(at, ',');
        status = add_setting(spec, text, at, comma ? (size_t)(comma - at) : strlen(at), message);
        at = comma ? comma + 1 : NULL;
    }
    if (status != BL_OK)
        bl_spec_free(spec);
    return status;
}

static bl_status append(bl_spec *spec, const char *key, const char *value, bl_message *message) {
    bl_setting *more = realloc(spec->settings, (spec->count + 1) * sizeof *more);
    if (!more)
        return bl_report(message, BL_DEVICE, "out of memory setting '%s'", key);
    spec->settings = more;
    more[spec->count] = (bl_setting){.key = strdup(key), .value = strdup(value)};
    const bl_setting *added = &more[spec->count++];
    return added->key && added->value
               ? BL_OK
               : bl_report(message, BL_DEVICE, "out of memory setting '%s'", key);
}

static bl_setting *find_setting(const bl_spec *spec, const char *key) {
    for (size_t i = 0; i < spec->count; i++)
        if (strcmp(spec->settings[i].key, key) == 0)
            return &spec->settings[i];
    return NULL;
}

const char *bl_spec_get(const bl_spec *spec, const char *key) {
    const bl_setting *setting = find_setting(spec, key);
    return setting ? setting->value : NULL;
}

bl_status bl_spec_set(bl_spec *spec, const char *key, const char *value, bl_message *message) {
    bl_setting *setting = find_setting(spec, key);
    if (!setting)
        return append(spec, key, value, message);
    char *copy = strdup(value);
    if (!copy)
        return bl_report(message, BL_DEVICE, "out of memory setting '%s'", key);
    free(setting->value);
    setting->value = copy;
    return BL_OK;
}

// A key that is set twice stays so, and whoever opens the signal says it.
bl_status bl_spec_nest(bl_spec *spec, const char *key, const char *nested, bl_message *message) {
    bl_spec within;
    bl_status status = bl_spec_parse(nested, &within, message);
    if (status != BL_OK)
        return status;
    status = append(spec, key, within.name, message);
    for (size_t i = 0; i < within.count && status == BL_OK; i++) {
        char *dotted = NULL;
        status = asprintf(&dotted, "%s.%s", key, within.settings[i].key) < 0
                     ? bl_report(message, BL_DEVICE, "out of memory setting '%s'", key)
                     : append(spec, dotted, within.settings[i].value, message);
        free(dotted);
    }
    bl_spec_free(&within);
    return status;
}

char *bl_spec_text(const bl_spec *spec) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    fputs(spec->name, stream);
    for (size_t i = 0; i < spec->count; i++)
        fprintf(stream, "%c%s=%s", i ? ',' : ':', spec->settings[i].key, spec->settings[i].value);
    if (fclose(stream) == 0)
        return text;
    free(text);
    return NULL;
}

typedef bl_status change(bl_spec *spec, const char *key, const char *value, bl_message *message);

static bl_status change_text(const char *text, change *apply, const char *key, const char *value,
                             char **changed, bl_message *message) {
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    status = apply(&spec, key, value, message);
    if (status == BL_OK && !(*changed = bl_spec_text(&spec)))
        status = bl_report(message, BL_DEVICE, "out of memory setting '%s'", key);
    bl_spec_free(&spec);
    return status;
}

bl_status bl_text_set(const char *text, const char *key, const char *value, char **changed,
                      bl_message *message) {
    return change_text(text, bl_spec_set, key, value, changed, message);
}

bl_status bl_text_nest(const char *text, const char *key, const char *nested, char **changed,
                       bl_message *message) {
    return change_text(text, bl_spec_nest, key, nested, changed, message);
}

static bl_status drop(bl_spec *spec, const char *key, const char *value, bl_message *message) {
    bl_setting *setting = find_setting(spec, key);
    (void)value, (void)message;
    if (!setting)
        return BL_OK;
    free(setting->key);
    free(setting->value);
    size_t after = spec->count - 1 - (size_t)(setting - spec->settings);
    memmove(setting, setting + 1, after * sizeof *setting);
    spec->count--;
    return BL_OK;
}

bl_status bl_text_drop(const char *text, const char *key, char **changed, bl_message *message) {
    return change_text(text, drop, key, NULL, changed, message);
}
