// SPDX-License-Identifier: MIT
//
// Warns of a rendered slice whose pixels are coarser than the signal, and says what would do.
#ifndef BL_CLI_RENDER_WARNING_H
#define BL_CLI_RENDER_WARNING_H

#include "cli/verb.h"
#include "core/grid.h"

// `spacing` is the units between the pixels of the grid, which is the same to the right and down.
void bl_render_warn(bl_call *call, const bl_signal *signal, const bl_grid *grid, double spacing);

#endif
