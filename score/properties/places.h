// SPDX-License-Identifier: MIT
//
// What the properties of the scorecard that draw random places share: a first look at the signal,
// signals of fresh seeds, and tests on batches.
//
// A batch is a set of samples of one fresh seed at one fresh place. Batches are independent and
// equally distributed whatever the signal does within one, so a mean over batches is tested by
// Student's t. A contrast, which is a difference of equally distributed parts, is symmetric; for
// symmetric numbers P(|t| > u) is below 2 exp(-u^2/2 n/(n-1+u^2)), however heavy their tails are
// (Efron 1969), so that the tests keep their rate far out where the central limit theorem gives
// little.
#ifndef BL_SCORE_PROPERTIES_PLACES_H
#define BL_SCORE_PROPERTIES_PLACES_H

#include "core/random.h"
#include "score/score.h"

// Random numbers of settings->seed for a property, by its name: streams 0 to 2^24 - 1 of its own,
// so that no property moves another.
bl_random bl_score_random(const bl_score_settings *settings, const char *property, uint64_t stream);

typedef struct bl_score_look {
    unsigned dimensions;
    double cell;            // of the lattice, in units; 1 where the signal states none
    double finest;          // of the finest lattice of a sum of octaves, which ends first far out
    double mean, deviation; // of a thousand values
    double range;           // the largest of them less the smallest
} bl_score_look;

// Looks at a thousand places. Returns 0 where nothing can be measured, and judges "not run" with
// the reason: the signal has a grid, is constant, or has a value that is not finite.
int bl_score_look_at(const bl_score_subject *subject, const bl_score_settings *settings,
                     bl_score_property *result, bl_score_look *look);

// Looks at signals of fresh seeds, which most properties draw. Returns 0 where most of them have
// one value within eight cells, and judges "not run", against what the result is, with the reason:
// a seed that is added to a coordinate leaves no digits to it.
int bl_score_varies(const bl_signal *signal, const bl_score_settings *settings,
                    bl_score_property *result);

// Whether places far from each other are alike, over seeds or over periods. Returns 0 for a
// function of the registries that neither repeats nor has a seed, and judges "not run" with that
// reason.
int bl_score_has_statistics(const bl_signal *signal, bl_score_property *result);

// Judges "not run" for a signal whose values were not finite somewhere.
void bl_score_not_finite(bl_score_property *result);

// Judges "not run" out of memory, for one property, and returns BL_DEVICE with a message.
bl_status bl_score_no_memory(bl_score_property *result, bl_message *message);

// The signal of a fresh seed, or, where it has none, the signal itself.
typedef struct bl_score_fresh {
    const bl_signal *signal;
    bl_signal *own; // NULL: borrowed
} bl_score_fresh;

bl_score_fresh bl_score_fresh_open(const bl_signal *signal, uint64_t seed);
void bl_score_fresh_close(bl_score_fresh *fresh);

// Random places, every second one within 16 cells of 0 and the others within 1000.
void bl_score_spread(bl_random *random, double cell, size_t count, double *const at[BL_AXES]);

// A whole number of cells within 2^15 of 0, in units: near enough for noises of float coordinates,
// whose resolution far out is the question of another property.
double bl_score_base(bl_random *random, double cell);

// Mean of n numbers, `stride` apart, over its standard error: 0 for numbers that are all 0, and
// infinite for others that are all equal.
double bl_score_t(const double *values, size_t n, size_t stride);

// The t that a correct signal exceeds in size with probability alpha in one of `tests` tests.
double bl_score_t_limit(double alpha, double tests, size_t n);

// A power ratio with its limits, in dB.
bl_estimate bl_score_db(bl_estimate ratio);

#endif
