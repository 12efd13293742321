// SPDX-License-Identifier: MIT
//
// The list of all textures.
#include "textures/texture.h"

#define BL_TEXTURE(stem) extern const bl_texture bl_texture_##stem;
#include "textures/textures.def"
#undef BL_TEXTURE

static const void *const list[] = {
#define BL_TEXTURE(stem) &bl_texture_##stem,
#include "textures/textures.def"
#undef BL_TEXTURE
};

const bl_registry bl_textures = {"texture", "textures", list, sizeof list / sizeof *list};
