// SPDX-License-Identifier: MIT
//
// The fraction of x, averaged: what mod, floor and ceil are filtered by.
#ifndef BL_FILTERS_SAWTOOTH_H
#define BL_FILTERS_SAWTOOTH_H

#include "filters/filter.h"

// frac(x) for -1 < x < 1, averaged by the filter over samples of this width about x. Width 0 is the
// fraction, infinity its mean 1/2. Errors: NaN for the ideal filter narrower than 1/8192
// (filters/average.h), and for NaN. Pure.
double bl_sawtooth_average(const bl_filter *filter, double x, double width);

#endif
