// SPDX-License-Identifier: MIT
//
// Signals for tests of the theory: bare sums of terms, which have a covariance and a density and
// cannot be evaluated. Their parameter block is the bl_terms.
#ifndef BL_TESTS_TERM_SIGNALS_H
#define BL_TESTS_TERM_SIGNALS_H

#include "noises/closed_forms.h"

enum { CATMULL_ROM, GRADIENT, GRADIENT_QUINTIC, LINEAR, HERMITE, RADIAL, SIGNALS };

// The caller frees it.
bl_signal *make_signal(int which);
double variance_of(const bl_signal *signal);

#endif
