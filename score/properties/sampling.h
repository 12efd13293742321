// SPDX-License-Identifier: MIT
//
// Where the properties look at a signal.
#ifndef BL_SCORE_PROPERTIES_SAMPLING_H
#define BL_SCORE_PROPERTIES_SAMPLING_H

#include "core/random.h"
#include "score/score.h"
#include "spectra/psd.h"

// Whether the signal has values on a grid alone (an image).
int bl_score_on_grid(const bl_signal *signal);

// A random place: a sample of the grid, or uniform in +-reach on every axis.
void bl_score_place(const bl_signal *signal, double reach, bl_random *random, double at[BL_AXES]);

// The distance of the planes of the lattice, in units: what is stated or was found; 1 where neither.
double bl_score_cell(const bl_signal *signal);

// Whether it states a band, with a leak or without.
int bl_score_states_band(const bl_signal *signal);

// "(0.25, -3, 7.125)": the coordinates that the signal has, with all their digits.
typedef struct bl_score_text {
    char text[128];
} bl_score_text;
bl_score_text bl_score_place_text(const bl_signal *signal, const double at[BL_AXES]);

// The larger of the sizes of the stated bounds; NAN if they are not stated.
double bl_score_bound(const bl_signal *signal);

// Whether the signal states anything that could be checked. That it is a function of the place is
// stated by being a signal; more than that must be stated, and a grid has no values between its
// samples of which more could be true.
int bl_score_states_something(const bl_signal *signal);

// Notes whether the samples of a spectrum that the property measures resolve the signal.
void bl_score_note_detail(bl_score_property *result, const bl_signal *signal,
                          const bl_psd_settings *settings);

#endif
