// SPDX-License-Identifier: MIT
//
// Converged images on disk: one file an image, named by the hash of all that made it. See
// aliasing/reference.h.
#ifndef BL_ALIASING_REFERENCE_CACHE_H
#define BL_ALIASING_REFERENCE_CACHE_H

#include "aliasing/reference.h"

// Fills a reference of the right size, whose arrays stand; 0 if there is none, or none that can be
// trusted. Safe from several threads and processes.
int bl_reference_cache_read(const bl_scene *scene, const bl_reference_settings *settings,
                            bl_reference *reference);
// Errors: BL_DEVICE.
bl_status bl_reference_cache_write(const bl_scene *scene, const bl_reference_settings *settings,
                                   const bl_reference *reference, bl_message *message);

// The path of the file; the caller frees it. NULL out of memory.
char *bl_reference_cache_path(const bl_scene *scene, const bl_reference_settings *settings);

#endif
