// SPDX-License-Identifier: MIT
//
// The list of all primitives.
#include "filters/primitive.h"

#define BL_PRIMITIVE(stem) extern const bl_primitive bl_primitive_##stem;
#include "filters/primitives.def"
#undef BL_PRIMITIVE

static const void *const list[] = {
#define BL_PRIMITIVE(stem) &bl_primitive_##stem,
#include "filters/primitives.def"
#undef BL_PRIMITIVE
};

const bl_registry bl_primitives = {"primitive", "primitives", list, sizeof list / sizeof *list};
