// SPDX-License-Identifier: MIT
//
// A texture whose filtered forms are known: mean + amplitude cos(2 pi (fx s + fy t)) and its box
// average, for the tests of sampling.
#ifndef BL_TESTS_RIPPLE_H
#define BL_TESTS_RIPPLE_H

#include "core/signal.h"

// It has the words filter=none|exact|wrong, of which the last one is a third too small, so that a
// method that takes it can be told. The caller frees it with bl_signal_free.
bl_signal *bl_test_ripple(double mean, double amplitude, double fx, double fy);

#endif
