// SPDX-License-Identifier: MIT
//
// Rows of a noise that is a sum of radial kernels: samples along a line, impulses around it.
//
// Along a line only the impulses within the kernel's radius 2 of it matter, and each touches only
// its chord of half length sqrt(4 - h^2), h its distance from the line. A sample at distance t
// along the line from the foot of an impulse sees K(sqrt(t^2 + h^2)). Two ways to add these up:
//
//   splat    for each impulse, over the samples of its chord, 16 at a time: pays where a chord
//            holds several blocks (radial_row_splat.h)
//   gather   for each sample, over the impulses of the cells within two of it, 16 at a time: pays
//            with few samples a cell (radial_row_gather.h)
//
// The step alone chooses, so that a row in pieces has the bits of the whole.
#ifndef BL_NOISES_IMPULSES_RADIAL_ROW_H
#define BL_NOISES_IMPULSES_RADIAL_ROW_H

#include <stddef.h>

#include "noises/impulses/radial_row_gather.h"
#include "noises/impulses/radial_row_line.h"
#include "noises/impulses/radial_row_splat.h"

#define SPLAT_LONGEST_STEP (1.0 / 5) // GATHER_MOST relies on it

static inline __attribute__((always_inline)) void
radial_row_of(const bl_profile profile, const radial_line *line, size_t count, float *out) {
    if (line->row->step > SPLAT_LONGEST_STEP)
        gather_row(profile, line, count, out);
    else
        splat_row(profile, line, count, out);
    if (line->row->reversed)
        reverse(out, count);
}

static inline void radial_row(const radial_line *line, size_t count, float *out) {
    radial_row_of(BL_PROFILE_CATMULL_ROM, line, count, out);
}

#endif
