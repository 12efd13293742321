// SPDX-License-Identifier: MIT
//
// How far the floats of a noise may lie from its double reference.
//
// A fraction within a cell is rounded to 2^-25 at most, which the slope turns into an error of the
// value; then the values of the kernels and their sum are rounded, which costs parts of the size of
// the values, not of the bound: that of a sum of a hundred impulses is a hundred times what the sum
// usually is, as random signs cancel. With r the root of the mean square of the values and s that
// of the slope, the error is some 2^-24 (1 + r + s); 12 times that are allowed, and never more
// than 32 halves of a unit in the last place of the bound.
#ifndef BL_TESTS_FLOAT_ERROR_H
#define BL_TESTS_FLOAT_ERROR_H

#include "core/signal.h"

// The largest error allowed. Values and slopes are those of the double reference at 512 places.
double bl_test_float_error(const bl_signal *signal);

#endif
