// SPDX-License-Identifier: MIT
//
// How much memory a measurement may take: asked before it allocates, because an allocation that
// succeeds and is paid for later ends the process without a message.
#ifndef BL_CORE_MEMORY_H
#define BL_CORE_MEMORY_H

#include <stddef.h>

#include "core/status.h"

// Bytes that can be had now without swapping; an estimate.
size_t bl_memory_available(void);

// BL_MISMATCH with a message that names the bytes if `bytes` (a double, so that products need no
// check for overflow) are not available. `what` finishes "... of memory for ".
bl_status bl_memory_check(double bytes, const char *what, bl_message *message);

#endif
