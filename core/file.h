// SPDX-License-Identifier: MIT
//
// Files appear whole or not at all: a bl_file is written beside its target under a temporary name
// and renamed when it is committed. Functions may be called from several threads at once for
// different files.
#ifndef BL_CORE_FILE_H
#define BL_CORE_FILE_H

#include <stdio.h>

#include "core/status.h"

typedef struct bl_file {
    FILE *stream; // write here; a regular file can also be read back and sought in
    char *path;   // the target
    char *temporary;
} bl_file;

// Opens a temporary file beside `path`; behind a symbolic link, beside the file that it points to.
// A device, a pipe, and a file that is open as standard output cannot be replaced and are written
// in place. On success end with exactly one of commit and discard.
bl_status bl_file_create(const char *path, bl_file *file, bl_message *message);
// Flushes, checks every earlier write, syncs and renames; on failure the temporary is removed and
// an earlier file at `path` is untouched.
bl_status bl_file_commit(bl_file *file, bl_message *message);
void bl_file_discard(bl_file *file);

// For writers that need a name, not a stream (an image library): a fresh temporary name beside
// `path` with the same ending; the caller frees it. NULL if out of memory.
char *bl_file_temporary_name(const char *path);
// Renames a finished temporary onto its target; on failure removes it.
bl_status bl_file_install(const char *temporary, const char *path, bl_message *message);

// Makes a folder and its parents; fine if it exists.
bl_status bl_make_folder(const char *path, bl_message *message);

#endif
