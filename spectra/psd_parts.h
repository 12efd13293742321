// SPDX-License-Identifier: MIT
//
// The parts of a PSD measurement; private to spectra/psd*.c and autocorrelation.c.
//
//   sampler    where each average stands, with which seed; fills buffers        psd_sampler.c
//   bins       which cell of the spectrum belongs to which line bin or ring     psd_bins.c
//   transform  window, FFT, |.|^2 and the sums over bins, of one average        psd_transform.c
//   spread     how much the averages of each bin differ, and are alike         psd_spread.c
//   limits     degrees of freedom and confidence limits                         psd_limits.c
//   bands      shares of the variance, and verdicts on band limits              psd_band*.c
#ifndef BL_SPECTRA_PSD_PARTS_H
#define BL_SPECTRA_PSD_PARTS_H

#include "core/fft.h"
#include "spectra/psd.h"

// --- sampler ---

typedef struct bl_sampler {
    const bl_signal *signal;
    bl_psd_settings settings;      // resolved: nothing left 0 but threads
    double directions[3][BL_AXES]; // orthonormal
    double spacing;                // units between samples: 1/rate
    int on_grid;
    size_t patches[BL_AXES];      // on a grid: averages along each axis
    size_t patch_length[BL_AXES]; // samples of a patch along each axis
    double overlap;               // variance factor of overlapped patches of white noise
} bl_sampler;

// Checks and resolves the settings for this signal.
bl_status bl_sampler_open(const bl_signal *signal, const bl_psd_settings *settings,
                          bl_sampler *sampler, bl_message *message);
// The place of sample 0 of an average.
void bl_sampler_start(const bl_sampler *sampler, size_t average, double start[BL_AXES]);
// Fills all samples of an average, rows along directions[0], `pitch` floats apart.
void bl_sampler_fill(const bl_sampler *sampler, size_t average, float *out, size_t pitch,
                     int threads);
// The samples of one average: size^dims.
size_t bl_sampler_samples(const bl_sampler *sampler);
// BL_MISMATCH that says where, if one of the `rows` rows of `size` samples is not finite.
bl_status bl_sampler_check(const bl_sampler *sampler, size_t average, const float *samples,
                           size_t pitch, bl_message *message);

// --- bins ---

typedef struct bl_bins {
    unsigned dims;
    size_t size;
    size_t count;       // bins from 0 to size/2; bin `count` is the corners
    double *cells;      // [count + 1] cells of the full spectrum in the bin: pairs are two
    double *radius;     // [count + 1] mean radius, in steps of the transform
    double *broadening; // [count + 1] the window divides the independent cells of the bin by it
    double broad;       // the same for a region much wider than the window's main lobe
} bl_bins;

bl_status bl_bins_open(unsigned dims, size_t size, bl_window window, int threads, bl_bins *bins,
                       bl_message *message);
void bl_bins_close(bl_bins *bins);

typedef struct bl_bin_sum {
    double sum, square; // over the cells of the full spectrum
} bl_bin_sum;

// Sums a half spectrum, [size^(dims-1)][size/2+1], over its bins; sums has count + 1 entries.
void bl_bins_reduce(const bl_bins *bins, const double *half, bl_bin_sum *sums);

// The bin of a squared radius: the nearest integer of its root, the corners as one bin. The root
// of an integer is never nearer than 1/(8r) to a half, so the double root decides rightly.
static inline size_t bl_bin_of(double square, double count) {
    double nearest = __builtin_sqrt(square) + 0.5;
    return (size_t)(nearest < count ? nearest : count);
}

// The signed frequency of an index, as a magnitude.
static inline size_t bl_folded(size_t index, size_t size) {
    return index <= size - index ? index : size - index;
}

// --- loops ---

enum { BL_CELLS_AT_ONCE = 16 };

// The loops over every sample and every cell, compiled for more than one instruction set with the
// same bits.
typedef struct bl_loops {
    // Sum and sum of squares of a row.
    void (*sum_row)(const float *row, size_t size, double *sum, double *square);
    // out = (row - mean) * window * factor; returns the sum of its squares. out may be row.
    double (*weight_row)(const float *row, const float *window, size_t size, float mean,
                         float factor, float *out);
    // Cells x = from .. from+count-1 at ky^2 + kz^2 = rest, count at most BL_CELLS_AT_ONCE: adds
    // |X|^2 times weight to the bins, and leaves it (unweighted) in place of the real parts. The
    // cells of `mirror`, if not NULL, are in the same bins and are done along.
    void (*bin_cells)(float *cells, float *mirror, size_t from, size_t count, double rest,
                      const double *weight, size_t bin_count, bl_bin_sum *sums);
} bl_loops;

const bl_loops *bl_psd_loops(void);

// --- transform ---

typedef struct bl_transform {
    unsigned dims;
    size_t size, count, pitch; // pitch: floats between the rows of a slice or volume
    size_t line_pitch;         // doubles between the buffers of two lines
    double *window;            // [size]
    float *window_float;
    double scale;        // |X|^2 times it is the power of a cell: the variance it holds
    double window_power; // (sum of w^2)^dims
    const bl_loops *loops;
    const bl_fft *whole;                        // lines and volumes
    const bl_fft *row, *columns, *last_columns; // slices
} bl_transform;

bl_status bl_transform_open(unsigned dims, size_t size, bl_window window, bl_transform *transform,
                            bl_message *message);
void bl_transform_close(bl_transform *transform);

typedef struct bl_transformed {
    double windowed;  // sum (w x)^2 / sum w^2
    bl_bin_sum *sums; // [count + 1] powers, filled; room for twice as many
} bl_transformed;

// Transforms one average: samples (double for a line, else float) less their mean. With `keep` the
// powers of the half spectrum stay in the buffer, to be added by bl_transform_add.
bl_status bl_transform_run(const bl_transform *transform, void *samples, double mean, int threads,
                           int keep, bl_transformed *result, bl_message *message);
// Adds the powers that bl_transform_run with `keep` left in the buffer to a half spectrum.
void bl_transform_add(const bl_transform *transform, const void *samples, double *half);

// --- spread ---

typedef struct bl_spread {
    double relative;    // variance of one average over the square of its mean
    double freedom;     // degrees of freedom of `relative`; INFINITY: known
    double correlation; // variance of the mean of the averages, over that of independent ones
} bl_spread;

// Fills spread, one for each bin, and inflation, correlation and alike of the psd.
bl_status bl_psd_find_spread(bl_psd *psd, const bl_bins *bins, double overlap, int on_grid,
                             bl_spread *spread, bl_message *message);

// --- limits ---

// Limits of a mean of positive values with `dof` degrees of freedom, found from an estimate of the
// values' variance that has `freedom` of its own. They are positive where the value is.
void bl_psd_limits_of(double value, double dof, double freedom, double level, double *lower,
                      double *upper);

// The interval of the variance, whose value stands, from the variances of the averages (of one
// average none are needed), after bl_psd_fill_limits.
void bl_psd_fill_variance_limits(bl_psd *psd, const bl_bins *bins, const double *values);

// Fills psd, dof, lower, upper, broadening, inflation, correlation and alike from profiles and
// measure.
bl_status bl_psd_fill_limits(bl_psd *psd, const bl_bins *bins, double overlap, int on_grid,
                             bl_message *message);
// Quantile of chi-square over its degrees of freedom, fast for many of them.
double bl_chi_square_ratio(double p, double dof);

// Allocates the arrays of a psd and fills what follows from the bins and settings; the caller frees
// the psd, on failure too.
bl_status bl_psd_allocate(bl_psd *psd, const bl_bins *bins, bl_message *message);

// From the sums over the bins of the averaged spectrum, in any unit.
void bl_psd_fill_anisotropy(bl_psd *psd, const bl_bins *bins, const bl_bin_sum *sums);

// BL_FAIL if psd->parseval_residual is above its limit.
bl_status bl_psd_check_parseval(const bl_psd *psd, bl_message *message);

// --- bands ---

// The share in the band or outside of it, with its interval, which misses the truth with the
// probability `missed`, on both sides together. `less`: power of each average that does not count
// in that share, or NULL; it is not looked at where the averages are fewer than four.
bl_estimate bl_psd_band_share(const bl_psd *psd, double from, double to, int outside,
                              const double *less, double missed);

#endif
