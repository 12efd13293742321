// SPDX-License-Identifier: MIT
//
// The sine and cosine integrals, by which the steps and ramps of sinc and Lanczos are written.
//
//   Si(x) = int_0^x sin(t)/t dt, odd, pi/2 at infinity
//   Cin(x) = int_0^x (1 - cos(t))/t dt, even, as ln|x| + gamma for large x
//
// All functions are pure; NaN gives NaN. Source: abramowitz1964, 5.2.
#ifndef BL_FILTERS_SINE_INTEGRAL_H
#define BL_FILTERS_SINE_INTEGRAL_H

// Within 1e-15 for |x| up to 1e6; beyond, x is only known to its own rounding.
double bl_sine_integral(double x);
// Within 1e-15, relative from 4 on.
double bl_entire_cosine_integral(double x);

// The auxiliary functions, for x > 0: the part of Si that remains without its waves,
//   Si(x) = pi/2 - f cos(x) - g sin(x),  f = int_0^oo e^(-x t) / (1 + t^2) dt,
//   Ci(x) = f sin(x) - g cos(x),         g = int_0^oo t e^(-x t) / (1 + t^2) dt.
// They fall as 1/x and 1/x^2. Who knows the phase of x better than x does can so use it. Within
// 2e-15.
typedef struct bl_sine_auxiliary {
    double f, g;
} bl_sine_auxiliary;
bl_sine_auxiliary bl_sine_integral_auxiliary(double x);

#endif
