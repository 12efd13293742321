// SPDX-License-Identifier: MIT
//
// The depth of a flat look at a solid signal.
//
// A view that runs along two axes of a signal of three or four stands somewhere along the others.
// The place 0 is the worst to take: it is a lattice plane, where gradient noise has its zeros. So
// the depth is random, of the seed, unless the view is asked for one (its keys z and w).
#ifndef BL_ALIASING_DEPTH_H
#define BL_ALIASING_DEPTH_H

#include <stdint.h>

#include "aliasing/view.h"
#include "core/signal.h"

// A random place along an axis: whole ten-thousandths of the signal's cell (of a unit, where none
// is stated) below 64 cells, so that it can be written down and asked for. An image has a depth of
// 0.
double bl_depth_place(const bl_signal *signal, unsigned axis, uint64_t seed);

// Whether the view runs along no part of this axis of the signal.
int bl_depth_is_flat(const bl_signal *signal, const bl_view *view, unsigned axis);

// Moves the view to a random depth along the axes that it does not run along and was not asked for.
void bl_depth_draw(const bl_signal *signal, uint64_t seed, bl_view *view);

#endif
