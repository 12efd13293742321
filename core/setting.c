// SPDX-License-Identifier: MIT
#include "core/setting.h"

#include <stdlib.h>
#include <string.h>

const bl_parameter *bl_signal_parameter(const bl_signal *signal, const char *key) {
    const bl_parameter *parameter = signal->definition ? signal->definition->parameters : NULL;
    for (; parameter && parameter->key; parameter++)
        if (strcmp(parameter->key, key) == 0)
            return parameter;
    return NULL;
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
    *changed = NULL;
    if (!signal->definition)
        return bl_report(message, BL_USAGE,
                         "'%s' has no keys of the library; a noise, a primitive or a texture has",
                         signal->text);
    // From the block and not from signal->text, which does not tell the seed of a reseeded copy.
    char *text = bl_parameters_text(signal->definition->name, signal->definition->parameters,
                                    signal->parameters);
    char *edited = NULL;
    bl_status status =
        text ? bl_text_set(text, key, value, &edited, message)
             : bl_report(message, BL_DEVICE, "out of memory opening '%s'", signal->text);
    if (status == BL_OK)
        status = open_text(signal->definition, edited, signal->open, changed, message);
    free(edited);
    free(text);
    return status;
}
