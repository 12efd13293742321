// SPDX-License-Identifier: MIT
//
// The power of a slice near the axes of the noise and near its diagonals.
//
// Two slices of 64 x 64 samples, 4 a cell, through places drawn at random: one along two axes, one
// turned by 45 degrees. Of each, under a Blackman-Harris window, the mean density within 15 degrees
// of the grid's axes and within 15 degrees of its diagonals, from 1 cycle a cell to Nyquist, 2.
// What is near the axes of one slice is near the diagonals of the other, on the same bins: the two
// sums over both slices are equally distributed for an isotropic noise, whatever the bins are.
#ifndef BL_SCORE_PROPERTIES_SECTORS_H
#define BL_SCORE_PROPERTIES_SECTORS_H

#include "core/fft.h"
#include "score/properties/places.h"

// The plan for bl_score_sectors. Errors: BL_DEVICE.
bl_status bl_score_sectors_plan(const bl_fft **plan, bl_message *message);

// Measures along two axes of the signal, in units of the density of white noise of the signal's
// deviation. Returns 0 out of memory. Thread-safe.
int bl_score_sectors(const bl_signal *signal, const bl_score_look *look, const bl_fft *plan,
                     const unsigned pair[2], bl_random *random, double *near_axes,
                     double *near_diagonals);

#endif
