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

#include "reports/figures/gallery.h"

enum { BL_CONTRAST_REPEATS = 64, BL_CONTRAST_SIGNALS = 6 }; // at most

// Independent estimates of each signal, each from two sets of random cells, of slices parallel to
// the xy plane: [0] at random heights, [1] on a plane of the lattice.
typedef struct bl_contrasts {
    size_t repeats;
    double values[2][BL_CONTRAST_SIGNALS][BL_CONTRAST_REPEATS];
} bl_contrasts;

// Measures all signals of a gallery and notes the settings; `cell` says what the cell is.
void bl_contrasts_measure(bl_run *run, const bl_gallery *gallery, size_t cells, const char *cell,
                          bl_contrasts *contrasts);

bl_estimate bl_contrast_of(const bl_contrasts *contrasts, int on_plane, int signal);
// Of one signal minus that of another, by pairs.
bl_estimate bl_contrast_difference(const bl_contrasts *contrasts, int on_plane, int one, int other);

#endif
