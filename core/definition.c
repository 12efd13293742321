// SPDX-License-Identifier: MIT
#include "core/definition.h"

#include <stdlib.h>
#include <string.h>

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
    for (const bl_parameter *p = definition->parameters; p->key; p++)
        if (p->kind == BL_SEED)
            made->seed_offset = p->offset;
    made->dimensions = definition->dimensions_of ? definition->dimensions_of(made->parameters)
                                                 : definition->dimensions;
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

bl_status bl_signal_with_choice(const bl_signal *signal, const char *key, const char *word,
                                bl_signal **copy, bl_message *message) {
    const bl_parameter *parameter = find_choice(signal, key);
    if (!parameter)
        return bl_report(message, BL_USAGE, "'%s' has no choice '%s'", signal->text, key);
    uint32_t index = 0;
    while (parameter->choices[index] && strcmp(parameter->choices[index], word) != 0)
        index++;
    if (!parameter->choices[index])
        return bl_report(message, BL_USAGE, "'%s': %s has no choice '%s'", signal->text, key, word);
    const bl_definition *definition = signal->definition;
    void *block = malloc(definition->parameters_size);
    if (!block)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", signal->text);
    memcpy(block, signal->parameters, definition->parameters_size);
    memcpy((char *)block + parameter->offset, &index, sizeof index);
    bl_status status = definition->validate ? definition->validate(block, message) : BL_OK;
    if (status == BL_OK)
        status = make_signal(definition, block, signal->open, copy, message);
    free(block);
    return status;
}

double bl_signal_own_width(const bl_signal *signal) {
    const bl_parameter *parameter = signal->definition ? signal->definition->parameters : NULL;
    double width = 0;
    for (; parameter && parameter->key; parameter++)
        if (parameter->kind == BL_REAL && strcmp(parameter->key, "width") == 0)
            memcpy(&width, (const char *)signal->parameters + parameter->offset, sizeof width);
    return width;
}
