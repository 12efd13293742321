// SPDX-License-Identifier: MIT
//
// The average of a periodic pulse under a filter: the integral that bricks, checks and stripes are
// filtered by.
#ifndef BL_FILTERS_PULSE_TRAIN_H
#define BL_FILTERS_PULSE_TRAIN_H

#include "filters/filter.h"

// The pulse of period 1 that is 1 for low <= frac(x) < high (0 <= low <= high <= 1), averaged by
// the filter over samples of this width about x. Width 0 is the pulse itself, infinity its mean
// high - low. It keeps its digits at any |x| < 2^52, since only distances to edges are subtracted.
// NaN and infinite x give NaN. Pure; source: peachey2003, p. 68.
double bl_pulse_train_average(const bl_filter *filter, double low, double high, double x,
                              double width);

#endif
