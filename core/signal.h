// SPDX-License-Identifier: MIT
//
// A signal: anything with values over space. Every analysis takes a signal and nothing else.
//
// A signal is a table of functions (its abilities), a flat block of parameters, and a few facts
// stated as data. Signals are immutable after creation: all functions may be called from several
// threads at once. Coordinates are in the unit of the signal's domain (a lattice cell for a
// noise); a signal of fewer dimensions ignores the coordinates it does not use.
//
// In every picture x (of a texture s) runs to the right and y (t) downwards, as in peachey2003, so
// that row 0 of an image, the upper one, has the least t: so do slices, views, the pictures of
// figures, and image files that are read. A slice with another normal is seen along that normal.
#ifndef BL_CORE_SIGNAL_H
#define BL_CORE_SIGNAL_H

#include <stddef.h>
#include <stdint.h>

#include "core/footprint.h"
#include "core/status.h"

typedef struct bl_signal bl_signal;

// Opens a signal by its text. One that is made of another of its own kind, as a sum of octaves of
// any noise, is given the way to open that: its file does not know the list that it stands in.
typedef bl_status bl_opener(const char *text, bl_signal **signal, bl_message *message);

// The abilities. A function gets the signal's parameter block; the ones marked optional may be
// NULL.
typedef struct bl_signal_functions {
    // Optional, as `points`: without it a row is its points, and these are values made float.
    // Fills out[i] with the value at start + i*step, each coordinate computed in double as
    // start[a] + (double)i * step[a]. NaN, infinite or too large coordinates give NaN.
    void (*row)(const void *parameters, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out);
    // Fills out[i] with the value at (at[0][i], at[1][i], ...); all BL_AXES arrays are readable.
    void (*points)(const void *parameters, const double *const at[BL_AXES], size_t count,
                   float *out);
    // The reference: the value at one point, in double throughout. Optional where `values` is
    // there.
    double (*value)(const void *parameters, const double at[BL_AXES]);
    // Optional: the same at many places, for signals that make something once for all of them; bit
    // for bit what each place gives alone. Fills out[i] with the value at (at[0][i], ...); all
    // BL_AXES arrays are readable.
    void (*values)(const void *parameters, const double *const at[BL_AXES], size_t count,
                   double *out);
    // Optional: the analytic gradient at one point.
    void (*gradient)(const void *parameters, const double at[BL_AXES], double out[BL_AXES]);
    // Optional (see bl_signal.closed_form): the autocovariance E[n(p) n(p+lag)] over places and
    // seeds, a closed form. It is zero for every lag with a component of size >=
    // facts.covariance_reach; where that is infinite, as of a noise that repeats, the spectrum is
    // one of lines and has no density, but what a window of a finite length sees is known.
    double (*covariance)(const void *parameters, const double lag[BL_AXES]);
    // Optional: the closed-form power spectral density of the stationarised signal in all its
    // dimensions, two-sided, value^2 per (cycle per unit)^dims; its integral is the variance. Not
    // to be asked for where bl_signal_has_density says that there is none.
    double (*density)(const void *parameters, const double frequency[BL_AXES]);
    // Optional: fills out[i] with the value as the signal's own means filter it for the footprint
    // of sample i, centred at its place. A point gives the value itself, a whole footprint the
    // mean. A sample's value does not depend on the others of its batch.
    void (*filtered)(const void *parameters, const bl_samples *samples, double *out);
    // Optional: fills rgb[3 i] and the two behind it with the linear red, green and blue that the
    // value is a component of, filtered likewise.
    void (*colour)(const void *parameters, const bl_samples *samples, double *rgb);
    // Optional: makes what the parameter block refers to (a tile, another signal, which `open`
    // opens) from the settings in it. The library calls it once for a block, on opening and on
    // reseeding; a failed call
    // leaves nothing to release.
    bl_status (*build)(void *parameters, bl_opener *open, bl_message *message);
    // Optional: releases what `build` made (not the block itself). A signal that has it, and no
    // `build`, cannot be reseeded or copied.
    void (*release)(void *parameters);
    // Optional: what was assumed of the source of the values, in words.
    void (*note)(const void *parameters, char *text, size_t size);
    // Optional: what went wrong while values were asked for, of a signal whose source can fail (a
    // program), and of all its copies: BL_OK for nothing; BL_DEVICE if values are NaN because the
    // source failed; BL_MISMATCH if the source itself gave what is no number.
    bl_status (*complaint)(const void *parameters, bl_message *message);
} bl_signal_functions;

// What a signal states about itself, as data that tests read. NAN stands for "not stated".
typedef struct bl_facts {
    double lower, upper;       // hard bound of the range
    const char *bound_proof;   // how it is proved, in words; NULL if there is no bound
    double mean, variance;     // over places and seeds
    double band_from, band_to; // the band, cycles per unit, of a spectrum along an axis ...
    double leak_db;            // ... and the share of variance outside of it, dB of the variance
    int continuity;            // -2 not stated, -1 discontinuous, 0 for C0, 1 for C1, ...
    double period[BL_AXES];    // the smallest period along each axis; 0: none
    double cell;               // the distance of the planes of its lattice; 0: it has none
    double far;                // the coordinate beyond which the fraction within a cell is lost
    double covariance_reach;   // lags with a component beyond it have no covariance; or INFINITY
    int stationary;            // 1: the same mean and variance all over its cell
    int isotropic;             // 1: a spectrum without a direction in all its dimensions
} bl_facts;

// The grid of a sampled signal (an image); sizes 0 for a signal without one.
typedef struct bl_extent {
    size_t size[BL_AXES];    // samples along each axis; 0: unbounded
    double spacing[BL_AXES]; // units between samples
} bl_extent;

struct bl_signal {
    const bl_signal_functions *functions;
    const struct bl_definition *definition; // core/definition.h; NULL for a file and the user's own
    bl_opener *open;                        // what `build` gets; NULL for one that opens nothing
    void *parameters;                       // owned
    size_t parameters_size;
    size_t seed_offset; // of the uint64_t seed in the block, or SIZE_MAX for a signal without one
    unsigned dimensions;
    int is_serial;    // calls come one by one: its source takes no two at a time
    int closed_form;  // whether the covariance (and the density) hold for these parameters
    char *text;       // the canonical text that names it, owned
    const char *name; // the registry name, or the word "image"
    bl_facts facts;
    bl_extent extent;
    bl_extent picture; // the samples that it is made of: as extent, and also where they are wrapped
                       // and interpolated, so that it fills all space; sizes 0 without them
};

// Facts with nothing stated: every number NAN, continuity -2, no proof.
bl_facts bl_facts_unknown(void);

// Makes a signal around a copy of the parameter block and of the text; NULL if out of memory.
bl_signal *bl_signal_new(const bl_signal_functions *functions, const void *parameters,
                         size_t parameters_size, const char *text);

// Builds what the block refers to, for the one who just made the signal; on failure the signal is
// freed.
bl_status bl_signal_build(bl_signal *signal, bl_message *message);

// A copy of the signal, with what its block refers to built anew; for one that cannot be copied, or
// out of memory, NULL.
bl_signal *bl_signal_copy(const bl_signal *signal);

// A copy of the signal that draws from another seed; for a signal without a seed, one that cannot
// be copied, or out of memory, NULL and the caller goes on with the original (it moves to a fresh
// place).
bl_signal *bl_signal_reseed(const bl_signal *signal, uint64_t seed);

// The seed that it draws from; 0 of a signal without one.
uint64_t bl_signal_seed(const bl_signal *signal);

// Releases the signal and all it owns; NULL is fine.
void bl_signal_free(bl_signal *signal);

// Whether statistics over random places tell something of the signal. BL_MISMATCH for one of a
// registry that has no seed and states that it does not repeat: they would only tell how far out
// the places are.
bl_status bl_signal_check_statistics(const bl_signal *signal, bl_message *message);

// Shorthands for the abilities.
int bl_signal_has_closed_form(const bl_signal *signal);
int bl_signal_has_density(const bl_signal *signal); // a covariance that ends
void bl_signal_row(const bl_signal *signal, const double start[BL_AXES], const double step[BL_AXES],
                   size_t count, float *out);
// An array of columns, as the points take it.
#define BL_COLUMNS(at) ((const double *const[BL_AXES]){(at)[0], (at)[1], (at)[2], (at)[3]})
void bl_signal_points(const bl_signal *signal, const double *const at[BL_AXES], size_t count,
                      float *out);
double bl_signal_value(const bl_signal *signal, const double at[BL_AXES]);
void bl_signal_values(const bl_signal *signal, const double *const at[BL_AXES], size_t count,
                      double *out);
void bl_signal_values_gathered(const bl_signal *signal, const bl_gathered *places, double *out);
// The filtered values. A signal that cannot filter itself, such as a plugin, a program or an image
// of the user's, leaves the footprint alone: these are the plain values at the places.
void bl_signal_filtered_values(const bl_signal *signal, const bl_samples *samples, double *out);
// The filtered colours, 3 numbers a sample; of a signal without them its filtered value thrice.
void bl_signal_colours(const bl_signal *signal, const bl_samples *samples, double *rgb);
// The same of one sample, upright and of these widths.
double bl_signal_filtered(const bl_signal *signal, const double at[BL_AXES],
                          const double width[BL_AXES]);
void bl_signal_colour(const bl_signal *signal, const double at[BL_AXES],
                      const double width[BL_AXES], double rgb[3]);
// What was assumed of the source of the values; "" of a signal without one.
void bl_signal_note(const bl_signal *signal, char *text, size_t size);
bl_status bl_signal_complaint(const bl_signal *signal, bl_message *message);

// The ability `values` of a signal that is nothing but filtered for a width in its block: upright,
// the same along every axis and at every place.
void bl_values_of_width(void (*filtered)(const void *, const bl_samples *, double *),
                        const void *parameters, double width, const double *const at[BL_AXES],
                        size_t count, double *out);

// How large coordinates may be for a signal of the library to have values, by its facts: 2^62
// units, or less for one that scales coordinates up, whose finest cell, 2^-52 facts.far to a factor
// of 2, ends the sooner. Between it and 2^62 such a signal has values or NaN.
double bl_signal_domain(const bl_signal *signal);

#endif
