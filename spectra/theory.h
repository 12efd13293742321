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

// The bare closed form, two-sided: along a line in a unit direction at frequency f; in the slice
// spanned by two orthonormal directions at (fu, fv); in the volume. NaN without a closed form.
double bl_theory_line(const bl_signal *signal, const double direction[BL_AXES], double f);
double bl_theory_slice(const bl_signal *signal, const double u[BL_AXES], const double v[BL_AXES],
                       double fu, double fv);
double bl_theory_volume(const bl_signal *signal, const double f[BL_AXES]);

// The share of the variance between two frequencies (radii in a slice or volume), exact to
// rounding of the quadrature; `to` may be INFINITY. NaN without a closed form.
double bl_theory_band(const bl_signal *signal, unsigned dims, const double directions[3][BL_AXES],
                      double from, double to);

// Orthonormal directions from one axis: dims 1 the axis itself; dims 2 two directions normal to
// it (x and y for z); dims 3 x, y, z. False for a zero or non-finite axis.
int bl_directions(unsigned dims, const double axis[3], double directions[3][BL_AXES]);

#endif
