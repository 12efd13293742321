// SPDX-License-Identifier: MIT
//
// Shared objects: opened with all checks that the loader leaves out, and searched for functions of
// their own.
#ifndef BL_SOURCES_SHARED_OBJECT_H
#define BL_SOURCES_SHARED_OBJECT_H

#include "core/status.h"

// Loads a shared object; a path without '/' is one in the working folder. Errors: BL_DEVICE for a
// file that is missing, damaged, cut short, of another machine, or that needs what is not there.
// Its constructors run. The caller ends with dlclose.
bl_status bl_shared_object_open(const char *path, void **handle, bl_message *message);

typedef void bl_any_function(void);

// Finds a function that the object itself exports: *function is NULL if it has none of that name.
// BL_USAGE if the name is data.
bl_status bl_shared_object_find(void *handle, const char *path, const char *symbol,
                                bl_any_function **function, bl_message *message);

// The names of all functions that the object exports, ended by NULL; the caller frees the list, and
// the names belong to the object. NULL out of memory.
const char **bl_shared_object_functions(void *handle);

#endif
