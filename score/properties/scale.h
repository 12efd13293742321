// SPDX-License-Identifier: MIT
//
// The scale of a signal, found from its values: over what distance they are related, and where the
// planes of its lattice are. Properties that look within a cell and across cells need it; a signal
// that states no cell gets the one that is found.
//
// Distance. For h = 4^k units, r(h) = E |n(x + h') - n(x)|^2 / (2 var n), with h' drawn from h to
// 2h along one axis, x within 256 h of 0, and a fresh seed for each of several blocks. r is near 0
// where neighbours are related, and 1 where they are not, whatever the values are farther out: each
// h has its own variance. The correlation length is where r passes 1/2 and stays above.
//
// Lattice. Noises of a lattice vary in their mean square with the place in the cell. The mean of
// squares about the mean, over fresh seeds and places across, along a row of correlation lengths,
// has a line at one cycle a cell, which stands far above its surroundings. Its phase over longer
// and longer distances gives the cell to many digits; the shortest decimal within the error is it.
#ifndef BL_SCORE_PROPERTIES_SCALE_H
#define BL_SCORE_PROPERTIES_SCALE_H

#include "score/score.h"

// Deterministic for given settings. The lattice is not sought where a cell is stated, and a grid of
// samples has no scale of its own.
bl_score_scale bl_score_find_scale(const bl_signal *signal, const bl_score_settings *settings);

// The distance that properties take for a cell where none is stated: the lattice; else the power of
// two at or below twice the correlation length, which is the cell of value noise; else 1.
double bl_score_cell_of(const bl_score_scale *scale);

#endif
