// SPDX-License-Identifier: MIT
//
// The contract of a filter, and the registry of all filters.
//
// A filter is one file, which ends with one descriptor, and one line in filters.def. It is a kernel
// k of one dimension, given for samples that stand one width apart: k(t), t in widths, with the
// integral 1. Filtered by it, a function f at x with the width w is
//
//   (int k(t) f(x - w t) dt),   so a step at 0 becomes step(x / w), and a ramp w ramp(x / w)
//
// All kernels are even. A filter in several dimensions is the product of one along each axis.
// All functions are pure, may be called from several threads, and give NaN for NaN.
#ifndef BL_FILTERS_FILTER_H
#define BL_FILTERS_FILTER_H

#include <stddef.h>

#include "core/registry.h"
#include "core/piecewise.h"

typedef struct bl_filter {
    BL_ENTRY(title, summary);
    const char *formula; // of the kernel, in plain text
    double support;      // the kernel is 0 beyond this distance, in widths; INFINITY
    int continuity;      // of the kernel: -1 it jumps, 0 C0, 1 C1, ...; 99: smooth
    double (*kernel)(double t);
    double (*step)(double t); // the integral of the kernel up to t: 0 at -inf, 1 at +inf
    double (*ramp)(double t); // the integral of the step up to t; 0 at -inf, t for large t
    // The Fourier transform at a frequency in cycles per width, a closed form; 1 at 0.
    double (*response)(double frequency);
    // The kernel as polynomials between knots; NULL for one that is none. Averages of periodic
    // functions are then finite sums at any width (filters/pulse_train.h).
    const bl_piecewise *pieces;
} bl_filter;

BL_REGISTRY(bl_filter, bl_filter, bl_filters)

// The names in the order of the registry, ended by NULL: the words of a key that chooses a filter.
extern const char *const bl_filter_words[];

// Names the descriptor of a filter file: BL_FILTER_DESCRIPTOR(catmull_rom) = {...};
#define BL_FILTER_DESCRIPTOR(stem)                                                                 \
    extern const bl_filter bl_filter_##stem;                                                       \
    const bl_filter bl_filter_##stem

#endif
