// SPDX-License-Identifier: MIT
#include "core/definition.h"

#include <stdlib.h>
#include <string.h>

const bl_parameter *bl_definition_seed(const bl_definition *definition) {
    for (const bl_parameter *p = definition->parameters; p->key; p++)
        if (p->kind == BL_SEED)
            return p;
    return NULL;
}

static unsigned own_dimensions(const bl_definition *definition, const void *block) {
    uint32_t dimensions = definition->dimensions;
    for (const bl_parameter *p = definition->parameters; p->key; p++)
        if (p->kind == BL_INTEGER && strcmp(p->key, "dims") == 0)
            memcpy(&dimensions, (const char *)block + p->offset, sizeof dimensions);
    return dimensions;
}

// Makes the signal of a block that was read.
static bl_status make_signal(const bl_definition *definition, const void *block, bl_opener *open,
                             bl_signal **signal, bl_message *message) {
    char *canonical = bl_parameters_text(definition->name, definition->parameters, block);
    bl_signal *made = canonical ? bl_signal_new(&definition->functions, block,
                                                definition->parameters_size, canonical)
                                : NULL;
    free(canonical);
    if (!made)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", definition->name);
    made->open = open;
    bl_status status = bl_signal_build(made, message);
    if (status != BL_OK)
        return status;
    made->definition = definition;
    const bl_parameter *seed = bl_definition_seed(definition);
    if (seed)
        made->seed_offset = seed->offset;
    made->dimensions = definition->dimensions_of ? definition->dimensions_of(made->parameters)
                                                 : own_dimensions(definition, made->parameters);
    made->name = definition->name;
    definition->describe(made->parameters, &made->facts);
    made->closed_form =
        definition->functions.covariance &&
        (!definition->has_closed_form || definition->has_closed_form(made->parameters));
    *signal = made;
    return BL_OK;
}

bl_status bl_definition_open(const bl_definition *definition, const bl_spec *spec, const char *text,
                             bl_opener *open, bl_signal **signal, bl_message *message) {
    void *block = calloc(1, definition->parameters_size);
    if (!block)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    bl_status status = bl_parameters_read(definition->parameters, spec, text, block, message);
    if (status == BL_OK && definition->validate)
        status = definition->validate(block, message);
    if (status == BL_OK)
        status = make_signal(definition, block, open, signal, message);
    if (status == BL_USAGE)
        bl_parameters_place(definition->parameters, spec, text, block, message);
    free(block);
    return status;
}

static const bl_parameter *find_choice(const bl_signal *signal, const char *key) {
    const bl_parameter *parameter = signal->definition ? signal->definition->parameters : NULL;
    for (; parameter && parameter->key; parameter++)
        if (parameter->kind == BL_CHOICE && strcmp(parameter->key, key) == 0)
            return parameter;
    return NULL;
}

const char *const *bl_signal_choices(const bl_signal *signal, const char *key) {
    const bl_parameter *parameter = find_choice(signal, key);
    return parameter ? parameter->choices : NULL;
}

double bl_signal_own_width(const bl_signal *signal) {
    const bl_parameter *parameter = signal->definition ? signal->definition->parameters : NULL;
    double width = 0;
    for (; parameter && parameter->key; parameter++)
        if (parameter->kind == BL_REAL && strcmp(parameter->key, "width") == 0)
            memcpy(&width, (const char *)signal->parameters + parameter->offset, sizeof width);
    return width;
}
