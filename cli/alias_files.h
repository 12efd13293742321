// SPDX-License-Identifier: MIT
//
// The files of the verb `alias`: images and a table.
#ifndef BL_CLI_ALIAS_FILES_H
#define BL_CLI_ALIAS_FILES_H

#include "aliasing/alias.h"
#include "cli/verb.h"
#include "core/table.h"

// Makes the folder call->path and writes alias.csv, reference.exr and .png, and of each method
// METHOD.exr, .png and METHOD-error.exr, .png (signed, of the luminance). Errors: BL_DEVICE.
bl_status bl_alias_files_write(bl_call *call, const bl_signal *signal, const bl_view *view,
                               const bl_alias_result *result);
// A row a method; valid as long as the result is.
bl_table bl_alias_table(const bl_alias_result *result);

// Warns where the signal is constant, or nearly so, in the image, and says where it varies.
void bl_alias_warn(bl_call *call, const bl_signal *signal, const bl_view *view,
                   const bl_constancy *same);

#endif
