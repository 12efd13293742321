// SPDX-License-Identifier: MIT
#include "filters/filter.h"

#include <string.h>

#define BL_FILTER(stem, name) extern const bl_filter bl_filter_##stem;
#include "filters/filters.def"
#undef BL_FILTER

static const bl_filter *const registry[] = {
#define BL_FILTER(stem, name) &bl_filter_##stem,
#include "filters/filters.def"
#undef BL_FILTER
};

const char *const bl_filter_words[] = {
#define BL_FILTER(stem, name) name,
#include "filters/filters.def"
#undef BL_FILTER
    NULL};

size_t bl_filter_count(void) {
    return sizeof registry / sizeof *registry;
}

const bl_filter *bl_filter_at(size_t index) {
    return index < bl_filter_count() ? registry[index] : NULL;
}

const bl_filter *bl_filter_find(const char *name) {
    for (size_t i = 0; i < bl_filter_count(); i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}
