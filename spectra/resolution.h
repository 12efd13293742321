// SPDX-License-Identifier: MIT
//
// Whether samples resolve a signal: how much of its variance lies beyond their Nyquist limit, where
// it folds back, and the rate that would do.
//
// What doubling the rate would find is measured at random places of the region that is sampled.
// At each, the value in the middle between two samples is compared with what the 16 samples around
// it say there (a half-band filter: a Kaiser window over a sine cardinal). With h between samples
// and N = 1/(2h) the Nyquist limit, the difference passes power between N and 3N, and whatever
// folds there at the doubled rate; below 0.8 N it passes nothing. The same is asked of rates that
// are doubled four times more; beyond those the second difference over random steps of up to h/32
// sees what is left. The share is the largest of these: at least half of what is beyond N for a
// spectrum that falls as edges make it fall, and all of it for a line.
//
// A rate is enough where all of them are within what is allowed. It is the given one times a power
// of 2, so that the same places give the same numbers when the answer is followed.
//
// Edges and cusps are never resolved: beyond N, jumps of the mean square J^2, k in a unit, leave
// k J^2 / (2 pi^2 N). So there is a share that is allowed. Images of the eye and statistics differ.
#ifndef BL_SPECTRA_RESOLUTION_H
#define BL_SPECTRA_RESOLUTION_H

#include "core/signal.h"

// Of pictures: brick has its mortar 5 pixels wide, and a checkerboard 8 pixels a square. Of spectra
// and what is judged by them: -20 dB, which one octave of four makes at the usual rate.
#define BL_RESOLUTION_PICTURE 0.05
#define BL_RESOLUTION_SPECTRUM 0.01

// Places are origin + u_0 side[0] + u_1 side[1] + ..., each u in [0, 1).
typedef struct bl_region {
    double origin[BL_AXES], side[BL_AXES][BL_AXES];
} bl_region;

typedef struct bl_resolution_settings {
    double allowed;  // the share of the variance that may lie beyond
    double variance; // that the share is allowed of, if it is larger than what is seen: that of the
                     // unfiltered texture, of one that filters itself; 0: what is seen
    double
        samples;  // that are taken anyway: of a user's own signal, whose values may cost anything,
                  // about as many more are asked for, or a few thousand; 0: enough
    int is_brief; // fewer places, and no other rate is looked for
    int threads;  // 0: all
} bl_resolution_settings;

typedef struct bl_resolution {
    double variance; // seen; 0 where that was not looked at
    double beyond;   // the share of it
    double allowed;  // as asked for
    double times;    // the rate that would do, a power of 2: 1 if it is resolved, or INFINITY: none
    double rate;     // that would do, samples per unit
} bl_resolution;

// Of samples `step` apart, as a vector. What the signal states of its band is taken where it is one
// of the registries', whose facts are held by tests. Places without a value are left out. A signal
// with a grid that is read at its own samples, or closer, is resolved. The result does not depend
// on the number of threads. Thread-safe.
bl_resolution bl_resolution_measure(const bl_signal *signal, const bl_region *region,
                                    const double step[BL_AXES],
                                    const bl_resolution_settings *settings);

#endif
