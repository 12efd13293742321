// SPDX-License-Identifier: MIT
//
// The class of continuity in words: how a number in facts.continuity (core/signal.h) reads.
#ifndef BL_CORE_CONTINUITY_H
#define BL_CORE_CONTINUITY_H

#include <stddef.h>

// What a signal states that has all derivatives.
enum { BL_CONTINUITY_ALL = 99 };

// Writes "not stated" (below -1), "discontinuous" (-1), "C0", "C1", ..., or "C-infinity" (from
// BL_CONTINUITY_ALL on) and returns `text`; 16 characters are enough for any class. Thread-safe.
const char *bl_continuity_text(int continuity, char *text, size_t size);

#endif
