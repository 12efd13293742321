// SPDX-License-Identifier: MIT
//
// Noises that are broken on purpose, each in one respect, and state that they are not: what the
// scorecard must find.
#ifndef BL_TESTS_BROKEN_H
#define BL_TESTS_BROKEN_H

#include "core/signal.h"

typedef enum bl_broken {
    BL_BROKEN_NOTHING,        // the wrapper itself, around gnoise
    BL_BROKEN_RANGE,          // gnoise times 3/2, with its bound                       range
    BL_BROKEN_PERIOD_SHORT,   // scnoise that repeats after 2^8 cells along x           period
    BL_BROKEN_PERIOD_LONG,    // ... after 2^19 cells                                   period
    BL_BROKEN_JUMP,           // gnoise that jumps by 0.1 % of its range at x = k + 0.3 continuity
    BL_BROKEN_JUMP_ONCE,      // ... at the one plane x = 3                             continuity
    BL_BROKEN_KINK,           // gnoise plus a ridge along y = k + 0.6                  continuity
    BL_BROKEN_SEED_BIT,       // gnoise that does not read bit 37 of its seed           seeds
    BL_BROKEN_SEED_SHIFT,     // gnoise that adds its seed to the cell along x          seeds
    BL_BROKEN_STRETCH,        // scnoise, x times 1.02                                  isotropy
    BL_BROKEN_FLOAT,          // gnoise of coordinates rounded to floats                far
    BL_BROKEN_AMPLITUDE,      // scnoise, amplitude 1 + 5 % sin 2 pi y                  stationarity
    BL_BROKEN_MEAN,           // scnoise plus 5 % of its deviation in cos 2 pi z        stationarity
    BL_BROKEN_GRADIENT,       // gnoise whose gradient is 0.1 % too large               gradient
    BL_BROKEN_GRADIENT_SOME,  // gnoise whose gradient is twice as large in 1 of 16 cells gradient
    BL_BROKEN_PERIOD_MISSING, // gnoise that states a period of 7 along y               period
    BL_BROKEN_PERIOD_POINTS,  // ... of 16 along x, whose floats go on otherwise        period
    BL_BROKEN_PERIOD_BEHIND,  // ... and which does not hold below x = -20              period
    BL_BROKEN_PERIOD_HALF,    // gnoise of the period 12 along x that states 24         period
    BL_BROKEN_FAR_GAIN,       // gnoise, twice as large beyond 5e5                      far
    BL_BROKEN_FAR_NAN,        // gnoise, no number beyond 1e9                           far
    BL_BROKEN_NO_NAN,         // gnoise, 0 where a coordinate is no number              far
    BL_BROKEN_REGION,         // scnoise, twice as large beyond x = 5e4                 stationarity
    BL_BROKEN_COUNT
} bl_broken;

// The caller frees it. Fails the running test if it cannot be made.
bl_signal *bl_broken_signal(bl_broken which);
const char *bl_broken_name(bl_broken which);
// The property that must find it: its name in the registry of the scorecard; NULL for none.
const char *bl_broken_property(bl_broken which);
// Another property that may find it, or NULL: a wave along one axis is a direction too, and what it
// modulates has side bands along that axis, where scnoise has little power of its own.
const char *bl_broken_also(bl_broken which);
// The text of the noise inside.
const char *bl_broken_inner(bl_broken which);

#endif
