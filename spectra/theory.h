// SPDX-License-Identifier: MIT
//
// Closed-form spectra of a signal along lines, in slices and in volumes, from the covariance and
// the density that its descriptor states; and the expectation of a windowed estimate of them.
// Frequencies are in cycles per unit; all functions are pure, so thread-safe.
#ifndef BL_SPECTRA_THEORY_H
#define BL_SPECTRA_THEORY_H

#include <stddef.h>

#include "core/signal.h"
#include "spectra/window.h"

// The expectation of the periodogram of a line, slice or volume sampled at `rate` with `size`
// samples along each of `dims` orthonormal directions and weighted by the window, alias and leak
// included: the transform of the covariance at the lags of the grid times the window's own
// autocorrelation. `out` has size^(dims-1) * (size/2 + 1) two-sided densities, the last axis
// halved as in a real transform. Errors: BL_MISMATCH without a closed form, BL_DEVICE.
bl_status bl_theory_periodogram(const bl_signal *signal, unsigned dims,
                                const double directions[3][BL_AXES], double rate, size_t size,
                                bl_window window, double *out, bl_message *message);

// A signal whose covariance has no end (bl_signal_has_density) has a spectrum of lines: of it there
// is the periodogram above, and below NaN.
//
// Directions lie in the dimensions of the signal: those that leave them give NaN, or BL_MISMATCH.

// The bare closed form, two-sided: along a line in a unit direction at frequency f; in the slice
// spanned by two orthonormal directions at (fu, fv); in the volume of x, y and z, which of a signal
// of four dimensions is one of its volumes w = const: its density with the fourth frequency
// integrated out, to 1e-9 of the variance. NaN without a closed form, and the volume of a signal of
// one or two dimensions.
double bl_theory_line(const bl_signal *signal, const double direction[BL_AXES], double f);
double bl_theory_slice(const bl_signal *signal, const double u[BL_AXES], const double v[BL_AXES],
                       double fu, double fv);
double bl_theory_volume(const bl_signal *signal, const double f[BL_AXES]);

// The share of the variance between two frequencies (radii in a slice or volume), exact to
// rounding of the quadrature; `to` may be INFINITY. NaN without a closed form.
double bl_theory_band(const bl_signal *signal, unsigned dims, const double directions[3][BL_AXES],
                      double from, double to);

// Whether the first `dims` directions lie in the dimensions of the signal.
int bl_theory_reaches(const bl_signal *signal, unsigned dims, const double directions[3][BL_AXES]);

// Orthonormal directions from one axis: dims 1 the axis itself; dims 2 two directions normal to
// it (x and y for z); dims 3 x, y, z. False for a zero or non-finite axis.
int bl_directions(unsigned dims, const double axis[3], double directions[3][BL_AXES]);

#endif
