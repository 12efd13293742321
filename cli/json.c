// SPDX-License-Identifier: MIT
#include "cli/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

json_t *bl_json_text(const char *text) {
    if (!text)
        return json_null();
    json_t *plain = json_string(text);
    if (plain)
        return plain;
    // Not UTF-8 (a file name may be any bytes): every byte above ASCII becomes U+FFFD.
    char *safe = malloc(3 * strlen(text) + 1), *at = safe;
    if (!safe)
        return NULL;
    for (; *text; text++) {
        if ((unsigned char)*text < 0x80) {
            *at++ = *text;
        } else {
            memcpy(at, "\xEF\xBF\xBD", 3);
            at += 3;
        }
    }
    *at = '\0';
    json_t *replaced = json_string(safe);
    free(safe);
    return replaced;
}

json_t *bl_json_number(double number) {
    return isfinite(number) ? json_real(number + 0.0) : json_null();
}

json_t *bl_json_numbers(const double *numbers, size_t count) {
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, bl_json_number(numbers[i]));
    return array;
}

void bl_json_set_text(json_t *object, const char *key, const char *text) {
    json_object_set_new(object, key, bl_json_text(text));
}

void bl_json_set_number(json_t *object, const char *key, double number) {
    json_object_set_new(object, key, bl_json_number(number));
}

void bl_json_set_count(json_t *object, const char *key, uint64_t count) {
    if (count <= INT64_MAX) {
        json_object_set_new(object, key, json_integer((json_int_t)count));
        return;
    }
    char digits[24];
    snprintf(digits, sizeof digits, "%llu", (unsigned long long)count);
    bl_json_set_text(object, key, digits);
}

void bl_json_set_numbers(json_t *object, const char *key, const double *numbers, size_t count) {
    json_object_set_new(object, key, numbers ? bl_json_numbers(numbers, count) : json_null());
}

void bl_json_set_estimate(json_t *object, const char *key, const bl_estimate *estimate) {
    char name[64];
    bl_json_set_number(object, key, estimate->value);
    snprintf(name, sizeof name, "%s_lower", key);
    bl_json_set_number(object, name, estimate->lower);
    snprintf(name, sizeof name, "%s_upper", key);
    bl_json_set_number(object, name, estimate->upper);
}

json_t *bl_json_head(const char *name, int argument_count, char *const *arguments) {
    char schema[64];
    snprintf(schema, sizeof schema, "bandlimit.%s/1", name);
    json_t *object = json_object(), *list = json_array();
    bl_json_set_text(object, "schema", schema);
    bl_json_set_text(object, "version", BL_VERSION);
    for (int i = 0; i < argument_count; i++)
        json_array_append_new(list, bl_json_text(arguments[i]));
    json_object_set_new(object, "arguments", list);
    return object;
}

json_t *bl_json_start(bl_call *call) {
    if (!call->common.json)
        return NULL;
    json_decref(call->json);
    call->json = bl_json_head(call->verb->name, call->argument_count, call->arguments);
    return call->json;
}

int bl_json_print(const json_t *object, FILE *out) {
    return object && json_dumpf(object, out, JSON_INDENT(1) | JSON_REAL_PRECISION(16)) == 0 &&
           fputc('\n', out) != EOF;
}
