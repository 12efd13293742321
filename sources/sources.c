// SPDX-License-Identifier: MIT
//
// The list of all sources.
#include "sources/kind.h"

#define BL_SOURCE(stem) extern const bl_source bl_source_##stem;
#include "sources/sources.def"
#undef BL_SOURCE

static const void *const list[] = {
#define BL_SOURCE(stem) &bl_source_##stem,
#include "sources/sources.def"
#undef BL_SOURCE
};

const bl_registry bl_sources = {"source", "sources", list, sizeof list / sizeof *list};
