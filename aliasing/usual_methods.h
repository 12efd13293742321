// SPDX-License-Identifier: MIT
//
// The methods of sampling a signal that are worth comparing: its own filters, one point, more
// points, the mean.
#ifndef BL_ALIASING_USUAL_METHODS_H
#define BL_ALIASING_USUAL_METHODS_H

#include "core/signal.h"

enum { BL_METHODS_MOST = 32 };

// Fills `methods` (of BL_METHODS_MOST) with texts for bl_method_open, which live as long as the
// program, and returns how many there are. Thread-safe.
size_t bl_usual_methods(const bl_signal *signal, const char **methods);

#endif
