// SPDX-License-Identifier: MIT
//
// The registry of figures.
#include <string.h>

#include "reports/figure.h"

#define BL_FIGURE(stem) extern const bl_figure bl_figure_##stem;
#include "reports/figures.def"
#undef BL_FIGURE

static const bl_figure *const registry[] = {
#define BL_FIGURE(stem) &bl_figure_##stem,
#include "reports/figures.def"
#undef BL_FIGURE
};

size_t bl_figure_count(void) {
    return sizeof registry / sizeof *registry;
}

const bl_figure *bl_figure_at(size_t index) {
    return index < bl_figure_count() ? registry[index] : NULL;
}

const bl_figure *bl_figure_find(const char *name) {
    for (size_t i = 0; i < bl_figure_count(); i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}
