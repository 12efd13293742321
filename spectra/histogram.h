// SPDX-License-Identifier: MIT
//
// The distribution of a signal's values: histogram, moments, quantiles, observed range.
#ifndef BL_SPECTRA_HISTOGRAM_H
#define BL_SPECTRA_HISTOGRAM_H

#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"
#include "core/size.h"
#include "core/statistics.h"

enum { BL_QUANTILES = 9 }; // 0.001 0.01 0.05 0.25 0.5 0.75 0.95 0.99 0.999

typedef struct bl_histogram_settings {
    size_t samples;  // at independent random places; a signal with a grid gives all its samples
    size_t bins;     // 0: 64
    double from, to; // 0, 0: the observed range
    uint64_t seed;
    double level;
    double missed; // 0: 1 - level, which has no digits where it is small
    int threads;
} bl_histogram_settings;

typedef struct bl_histogram {
    bl_histogram_settings settings;
    size_t count;   // values seen
    size_t outside; // of [from, to]
    bl_moments moments;
    double skewness, kurtosis;  // of a constant NAN: 0/0
    bl_estimate mean, variance; // the limits of the variance are positive where it is
    double minimum, maximum;
    double minimum_at[BL_AXES], maximum_at[BL_AXES];
    double quantile_p[BL_QUANTILES];
    bl_estimate quantile[BL_QUANTILES]; // order statistics; interval by the binomial
    double *edges;                      // bins + 1
    size_t *counts;                     // bins
} bl_histogram;

// 2^20 samples, 64 bins over the observed range, seed 1, level 0.95, all threads.
bl_histogram_settings bl_histogram_default_settings(void);
size_t bl_histogram_usual_samples(bl_size size); // 2^16, 2^20, 2^26

// Measures the distribution of a signal's values. On success the caller frees the result with
// bl_histogram_free; on failure there is nothing to free. The result does not depend on the number
// of threads. Errors: BL_USAGE for no samples, an empty range, a level outside (0, 1)
// or `missed` outside [0, 1);
// BL_MISMATCH for a value that is not finite (the message says where) and for more than the memory
// holds; BL_DEVICE out of memory. Thread-safe.
bl_status bl_histogram_measure(const bl_signal *signal, const bl_histogram_settings *settings,
                               bl_histogram *histogram, bl_message *message);
void bl_histogram_free(bl_histogram *histogram);

// The share of all values seen that the bins [first, end) have; the density in one bin.
double bl_histogram_share(const bl_histogram *histogram, size_t first, size_t end);
double bl_histogram_density(const bl_histogram *histogram, size_t bin);

#endif
