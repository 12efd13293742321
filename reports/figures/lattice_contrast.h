// SPDX-License-Identifier: MIT
//
// How much of a lattice is seen in slices of a noise of mean 0.
//
// Let v(p) be the variance over cells and seeds at the place p within the unit cell. The lattice
// contrast is the variance of v over p, over the square of its mean: 0 for a noise that looks the
// same at every place. Two independent halves of the cells are multiplied, so that the scatter of
// the estimate of v does not count.
#ifndef BL_REPORTS_FIGURES_LATTICE_CONTRAST_H
#define BL_REPORTS_FIGURES_LATTICE_CONTRAST_H

#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"

enum { BL_CONTRAST_PHASES = 8 }; // places along each side of the cell

// Fills `repeats` independent estimates, each from two sets of `cells` random cells, of slices
// parallel to the xy plane: on a plane of the lattice, or at random heights.
void bl_lattice_contrast(const bl_signal *signal, int on_plane, size_t cells, size_t repeats,
                         uint64_t seed, double *out);

#endif
