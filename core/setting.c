// SPDX-License-Identifier: MIT
#include "core/setting.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const bl_parameter *bl_signal_parameter(const bl_signal *signal, const char *key) {
    const bl_parameter *parameter = signal->definition ? signal->definition->parameters : NULL;
    for (; parameter && parameter->key; parameter++)
        if (strcmp(parameter->key, key) == 0)
            return parameter;
    return NULL;
}

// "name:a=1,b=2" with the key's value replaced, or added at the end.
static char *changed_text(const bl_spec *spec, const char *key, const char *value) {
    size_t size = strlen(spec->name) + strlen(key) + strlen(value) + 4;
    for (size_t i = 0; i < spec->count; i++)
        size += strlen(spec->settings[i].key) + strlen(spec->settings[i].value) + 2;
    char *text = malloc(size), *end = text;
    if (!text)
        return NULL;
    end += sprintf(end, "%s:", spec->name);
    for (size_t i = 0; i < spec->count; i++)
        if (strcmp(spec->settings[i].key, key) != 0)
            end += sprintf(end, "%s=%s,", spec->settings[i].key, spec->settings[i].value);
    sprintf(end, "%s=%s", key, value);
    return text;
}

static bl_status open_text(const bl_definition *definition, const char *text, bl_opener *open,
                           bl_signal **signal, bl_message *message) {
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    status = bl_definition_open(definition, &spec, text, open, signal, message);
    bl_spec_free(&spec);
    return status;
}

bl_status bl_signal_with_setting(const bl_signal *signal, const char *key, const char *value,
                                 bl_signal **changed, bl_message *message) {
    bl_spec spec;
    *changed = NULL;
    if (!signal->definition)
        return bl_report(message, BL_USAGE,
                         "'%s' has no keys of the library; a noise, a primitive or a texture has",
                         signal->text);
    bl_status status = bl_spec_parse(signal->text, &spec, message);
    if (status != BL_OK)
        return status;
    char *text = changed_text(&spec, key, value);
    bl_spec_free(&spec);
    if (!text)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", signal->text);
    status = open_text(signal->definition, text, signal->open, changed, message);
    free(text);
    return status;
}
