// SPDX-License-Identifier: MIT
//
// The effective edges of a band: the lowest and the highest frequency whose density, smoothed over
// 0.1 cycles per unit, is within so many dB of its peak.
#ifndef BL_SCORE_PROPERTIES_BAND_EDGES_H
#define BL_SCORE_PROPERTIES_BAND_EDGES_H

#include "core/statistics.h"
#include "spectra/psd.h"

typedef struct bl_band_edges {
    bl_estimate low, high; // cycles per unit; NAN without any power; level 0 of a single average
} bl_band_edges;

// Fills one pair of edges for each of the `count` distances below the peak, in dB, above 0, with
// intervals at `level` from the profiles. An edge is a bin: nothing finer is told. Pure.
// Errors: BL_DEVICE out of memory.
bl_status bl_find_band_edges(const bl_psd *psd, const double *below_db, size_t count, double level,
                             bl_band_edges *edges, bl_message *message);

#endif
