// SPDX-License-Identifier: MIT
//
// The power spectral density of a signal along a line, in a slice, or in a volume, averaged over
// independent places (and seeds, where the signal has one), with confidence bands.
//
// Each average takes a fresh random place and, where the signal can be reseeded, a fresh seed. The
// grand mean over all averages is removed first. Every average yields one profile: the power in
// each frequency bin (a line's bin; a ring or shell of a slice or volume), and the power in the
// corners beyond the Nyquist circle. Everything else is computed from the profiles.
//
// A signal with a grid (an image) is measured on its own samples: averages are segments (lines) or
// patches (slices) that overlap by at most half and span the whole grid; there are as many as fit,
// up to the number asked for.
//
// Lines are transformed in double, slices and volumes in float. The same settings give the same
// bits for any number of threads.
#ifndef BL_SPECTRA_PSD_H
#define BL_SPECTRA_PSD_H

#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"
#include "core/size.h"
#include "core/statistics.h"
#include "core/verdict.h"
#include "spectra/resolution.h"
#include "spectra/window.h"

typedef enum bl_place {
    BL_PLACE_RANDOM, // anywhere: the stationarised signal
    BL_PLACE_LATTICE // on a lattice edge (line) or lattice plane (slice); no closed form is given
} bl_place;

typedef struct bl_psd_settings {
    unsigned dims;   // 1 line, 2 slice, 3 volume
    double rate;     // samples per unit; 0: from the signal's grid, or 16, 8, 4 by dims
    size_t size;     // samples along each axis; 0: from the grid, or 2048, 512, 64 by dims
    size_t averages; // 0: 256, 16, 8 by dims; of a grid: 256 lines at most, all patches. A grid may
                     // have fewer than asked for; the settings of a result say how many were taken
    bl_window window;
    double axis[3]; // direction of the line; normal of the slice; unused for a volume
    bl_place place; // a grid has only its own place
    uint64_t seed;  // of the places and the fresh seeds
    double level;   // of the confidence intervals, e.g. 0.95
    int threads;    // 0: as many as OpenMP gives
} bl_psd_settings;

typedef struct bl_psd {
    bl_psd_settings settings; // as used, nothing left 0
    size_t count;             // bins, from frequency 0 to Nyquist
    double *frequency;        // centre (line) or mean radius (ring) of the bin, cycles per unit
    double *width;            // of the bin, cycles per unit
    double *measure;          // length, area or volume of the bin in frequency space (one-sided
                              // for a line): power = psd * measure
    double *psd;              // line: one-sided; ring, shell: mean of the two-sided density
    double *lower, *upper;    // confidence limits of psd
    double *dof;              // degrees of freedom behind each bin's limits (which are wider where
                              // these are themselves estimated); 0: no limits
    double *theory;           // expectation of psd for this window and rate, or NULL
    double *theory_corners;   // one number: the power beyond the Nyquist circle, or NULL
    double *anisotropy_db;    // rings and shells (Ulichney 1987), NAN for one-cell rings; else NULL
    double *anisotropy_floor_db;
    double *profiles;         // [averages][count + 1] power; the last column is the corners'
    double inflation;         // mean ratio of the variance between averages to that of exponential
                              // bins: 1 for a stationary Gaussian signal
    double correlation;       // variance of the mean of the averages, over that of as many
                              // independent ones: above 1 where the segments of a grid overlap,
                              // stand too near each other, or are alike
    double alike;             // the part of the power that the averages of a grid have in common:
                              // 1 where all are the same, and count as one; 0 off a grid
    double broadening;        // by which the window divides the number of independent bins in a
                              // wide band
    double mean;              // removed
    bl_estimate variance;     // of the samples, over places, each with the same weight; its limits
                              // are positive where it is
    double windowed_variance; // of the samples weighted by the window, the mean over the averages
                              // of sum (w x)^2 / sum w^2: the sum of psd * measure over the bins,
                              // and the corners. It differs from `variance` by chance, because
                              // the window sees fewer of the samples
    double variance_theory;   // NAN if unknown
    double parseval_residual; // |sum(P df) / windowed variance - 1|, the largest of all averages
    double *plane;            // slice: psd of the half plane [size][size/2+1], row-major, row 0 is
                              // fy = 0; else NULL
} bl_psd;

bl_psd_settings bl_psd_default_settings(unsigned dims);
// Averages for a size of work, for the settings; 0 where they follow from the signal's grid.
size_t bl_psd_usual_averages(const bl_signal *signal, unsigned dims, bl_size size);

// Measures. On success the caller frees the result with bl_psd_free.
// Errors: BL_USAGE for sizes below 8, a zero axis, or a setting out of its range; BL_MISMATCH for a
// rate or size that does not fit the signal's grid or the memory, for more dimensions than the
// signal has, and for values that are not finite; BL_DEVICE out of memory; BL_FAIL if Parseval's
// equation does not hold to 1e-12 (lines) or 1e-5. Thread-safe.
bl_status bl_psd_measure(const bl_signal *signal, const bl_psd_settings *settings, bl_psd *psd,
                         bl_message *message);
void bl_psd_free(bl_psd *psd);

// Whether these samples resolve the signal, of settings that are resolved, as those of a result.
bl_resolution bl_psd_resolution(const bl_signal *signal, const bl_psd_settings *settings,
                                double allowed);

// The degrees of freedom of the median bin, NAN out of memory; the index of the highest bin.
double bl_psd_median_dof(const bl_psd *psd);
size_t bl_psd_peak(const bl_psd *psd);

// The floats between the rows of a buffer for bl_psd_of_buffer.
size_t bl_psd_pitch(size_t size);

// The radial spectrum, with its band, of one slice that the caller has sampled already: as
// bl_psd_measure with one average, but without plane and theory. Of the settings it takes rate,
// size, window, level and threads. `samples` has `size` rows of `size` floats, bl_psd_pitch(size)
// apart, starts at a multiple of 64 bytes (bl_fft_buffer), and is overwritten.
bl_status bl_psd_of_buffer(float *samples, const bl_psd_settings *settings, bl_psd *psd,
                           bl_message *message);

// A share of the variance.
typedef struct bl_band {
    double from, to;      // cycles per unit, to may be INFINITY
    bl_estimate fraction; // of the variance, over averages; 0 of a signal without any
    double theory;        // that the window and the bins make of the closed form; NAN if unknown
    double exact;         // the closed form's own share; NAN if unknown
} bl_band;

// Fills fraction and theory of a band from the profiles, which the window has smeared, so that it
// is `theory` that the interval of the fraction covers: `exact` is another number where bins are
// wide, as in a volume of 64 samples an axis (bl_psd_exact_share); here it is NAN. Bins cut by an
// edge count in proportion. The corners count where `to` takes in all of them: from sqrt(dims)
// times Nyquist on.
void bl_psd_band(const bl_psd *psd, bl_band *band);

// The share of the variance of the signal itself that lies in the band, by its closed form: along
// the same line, in the same slice or volume, without window, bins and folding. NAN if unknown, as
// on a grid or on lattice planes.
double bl_psd_exact_share(const bl_signal *signal, const bl_psd_settings *settings, double from,
                          double to);

// The verdict on a band limit.
typedef struct bl_band_limit {
    double from, to, limit_db;
    double guard;                       // cycles per unit beyond both edges that are not judged
    double missed;                      // by each one-sided limit, a probability; 0: 1 - the level
    double leak_db, lower_db, upper_db; // share outside of band and guard, dB of the variance
    double edge_db;                     // share within the smear of the edges, which may be on
                                        // either side of them, dB of the variance
    size_t needed_averages;             // that would settle an inconclusive verdict; else 0, as
                                        // where the averages are alike
    size_t needed_size;                 // of longer lines that would; else 0
    bl_verdict verdict;
} bl_band_limit;

// One-sided limits each at the level of the settings, or that miss with the probability `missed`,
// for levels that double cannot tell from 1. Fills what stands below these inputs.
// No leak at all is -INFINITY dB.
//
// The limits are of the true leak outside of the band itself. The window smears power over an edge,
// so what is measured beyond it may come from within, and the other way round. All that lies
// outside is seen beyond the edge less the smear, but for the side lobes; nothing that lies inside
// is seen beyond the edge and the smear, but for the side lobes. So the upper limit is that of the
// power beyond the nearer bound, and the lower limit that beyond the farther one. leak_db, between
// them, is the power beyond the edge itself: of a smooth density exact to the second order of the
// width of a bin.
//
// A line on the edge itself, to a two-thousandth of a bin, belongs to the band. It is told by its
// shape along a line of samples, and taken from the upper limit but for what does not fit.
void bl_psd_band_limit(const bl_psd *psd, bl_band_limit *limit);

// Measures and judges. Where the limits straddle the leak allowed because of the smear rather than
// by chance, lines (slices, volumes) that are longer, up to BL_PSD_LONGER times as many samples,
// are measured and judged instead; both looks together miss as `missed` says. `is_fixed`: the size
// is, as of a grid. Errors: those of bl_psd_measure and bl_psd_check_limit; on success the caller
// frees the psd.
enum { BL_PSD_LONGER = 16 };
bl_status bl_psd_judge_band(const bl_signal *signal, const bl_psd_settings *settings, int is_fixed,
                            bl_psd *psd, bl_band_limit *limit, bl_message *message);

// Whether anything is left to judge outside of the band: a bin that lies wholly outside of the band
// and its guard. That of frequency 0 does not count: it holds only what remains of the mean.
int bl_psd_has_outside(const bl_psd *psd, const bl_band_limit *limit);

// Whether a verdict on this limit makes sense. Errors: BL_MISMATCH for a constant signal, and where
// nothing was measured in the band or outside of it.
bl_status bl_psd_check_limit(const bl_psd *psd, const bl_band_limit *limit, bl_message *message);

// How far the window and the bins smear power, side lobes aside, in cycles per unit: half the main
// lobe, across in a slice or a volume, and half a bin.
double bl_psd_smear(const bl_psd *psd);

#endif
