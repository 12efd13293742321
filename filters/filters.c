// SPDX-License-Identifier: MIT
//
// The list of all filters.
#include "filters/filter.h"

#define BL_FILTER(stem, name) extern const bl_filter bl_filter_##stem;
#include "filters/filters.def"
#undef BL_FILTER

static const void *const list[] = {
#define BL_FILTER(stem, name) &bl_filter_##stem,
#include "filters/filters.def"
#undef BL_FILTER
};

const bl_registry bl_filters = {"filter", "filters", list, sizeof list / sizeof *list};

const char *const bl_filter_words[] = {
#define BL_FILTER(stem, name) name,
#include "filters/filters.def"
#undef BL_FILTER
    NULL};
