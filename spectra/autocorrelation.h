// SPDX-License-Identifier: MIT
//
// The autocovariance of a signal along a line, measured and in closed form.
#ifndef BL_SPECTRA_AUTOCORRELATION_H
#define BL_SPECTRA_AUTOCORRELATION_H

#include "spectra/psd.h"

typedef struct bl_autocorrelation {
    bl_psd_settings settings; // as used; the window plays no part
    size_t count;             // lags 0, 1, ... samples; at most size/2
    double *lag;              // in units of the domain
    bl_estimate *covariance;  // E[(n(p) - mean) (n(p + lag) - mean)], interval over averages
    double *theory;           // the closed form at the lag, or NULL
    double mean;              // removed
} bl_autocorrelation;

// Measures along the line that bl_psd_measure would take with the same settings (dims is taken as
// 1), out to the lag `reach`; 0: half the line. Each average gives the unbiased sum over the pairs
// at each lag, by Fourier transform with zero padding (Wiener-Khinchin); the grand mean is removed
// first. On success the caller frees the result with bl_autocorrelation_free. Errors: those of
// bl_psd_measure, and BL_USAGE for a reach that is negative or not a number. Thread-safe; the same
// bits for any number of threads.
bl_status bl_autocorrelation_measure(const bl_signal *signal, const bl_psd_settings *settings,
                                     double reach, bl_autocorrelation *autocorrelation,
                                     bl_message *message);
void bl_autocorrelation_free(bl_autocorrelation *autocorrelation);

#endif
