// SPDX-License-Identifier: MIT
//
// The numbers by which filters are compared, measured from their functions.
#ifndef BL_FILTERS_RESPONSE_H
#define BL_FILTERS_RESPONSE_H

#include "filters/filter.h"

// Frequencies are in cycles per width; the samples stand a width apart, so that 1/2 is their
// Nyquist frequency. NAN is "there is none".
typedef struct bl_filter_numbers {
    double half_power;     // the lowest frequency at which the power is a half: -3 dB
    double nyquist;        // the response at 1/2
    double first_zero;     // the lowest, below 8
    double lobe_frequency; // of the largest response beyond the first zero, below 8 ...
    double lobe;           // ... and its size, with its sign
    double overshoot;      // how far the step rises above 1 ...
    double overshoot_at;   // ... and where, in widths
    // Of white noise with the power 1 per cycle per width on both sides: the power above the
    // Nyquist frequency that is left, to be alias, and the power of what is changed below it.
    double alias, blur;
} bl_filter_numbers;

// Pure; about a millisecond. Frequencies and places are good to 1e-7, powers to 1e-9.
bl_filter_numbers bl_filter_measure(const bl_filter *filter);

#endif
