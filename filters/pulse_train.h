// SPDX-License-Identifier: MIT
//
// The average of a periodic pulse under a filter: the integral that bricks, checks and stripes are
// filtered by.
//
// All functions are pure and take the same time at every x; source: peachey2003, p. 68.
#ifndef BL_FILTERS_PULSE_TRAIN_H
#define BL_FILTERS_PULSE_TRAIN_H

#include "filters/filter.h"

// The pulse of period 1 that is 1 for low <= frac(x) < high (0 <= low <= high <= 1), averaged by
// the filter over samples of this width about x. Width 0 is the pulse itself, infinity its mean
// high - low. NaN and infinite x give NaN.
//
// The error is below 1e-14 (Lanczos; of all others 4e-15) at every x and every width: only
// phases are subtracted, which are exact, and whole periods are never summed. The time does not
// grow with the width. For sinc, whose kernel has no integral of its size, the average is the
// limit of ever longer cuts; for a periodic function that is the sum of its harmonics below the
// Nyquist frequency.
double bl_pulse_train_average(const bl_filter *filter, double low, double high, double x,
                              double width);

// The same over the box [x, x + width], the way the text does it: the difference of two values of
// the integral from 0, over the width. The integral grows with x, so that the difference loses what
// the average keeps: its error is up to 2^-53 (2 |x| + |x + width|) / width + 2^-52.
double bl_pulse_train_difference(double low, double high, double x, double width);

// The text's own macro for the pulse from `edge` to 1 - edge, as printed: its integral goes on
// rising over the gap that ends each period and falls back by `edge` at the whole numbers. The
// average is therefore off by up to edge / width, unless both ends lie in the same part of a
// period.
double bl_pulse_train_printed(double edge, double x, double width);

#endif
