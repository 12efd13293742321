// SPDX-License-Identifier: MIT
#include "filters/primitive.h"

#include <string.h>

#define BL_PRIMITIVE(stem) extern const bl_primitive bl_primitive_##stem;
#include "filters/primitives.def"
#undef BL_PRIMITIVE

static const bl_primitive *const registry[] = {
#define BL_PRIMITIVE(stem) &bl_primitive_##stem,
#include "filters/primitives.def"
#undef BL_PRIMITIVE
};

const char *const bl_anchor_words[] = {"centre", "start", NULL};

size_t bl_primitive_count(void) {
    return sizeof registry / sizeof *registry;
}

const bl_primitive *bl_primitive_at(size_t index) {
    return index < bl_primitive_count() ? registry[index] : NULL;
}

const bl_primitive *bl_primitive_find(const char *name) {
    for (size_t i = 0; i < bl_primitive_count(); i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}
