// SPDX-License-Identifier: MIT
//
// The files of a figure: how a name, its folder and its ending become a file.
#ifndef BL_REPORTS_OUTPUT_H
#define BL_REPORTS_OUTPUT_H

#include "core/file.h"

// "folder/name.ending"; NULL if out of memory. The caller frees it.
char *bl_output_path(const char *folder, const char *name, const char *ending);

// Opens it for writing; the caller ends with bl_file_commit or bl_file_discard. Errors: BL_DEVICE.
bl_status bl_output_create(const char *folder, const char *name, const char *ending, bl_file *file,
                           bl_message *message);

#endif
