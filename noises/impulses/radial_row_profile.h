// SPDX-License-Identifier: MIT
//
// The kernels of radial_row.h, of radius 2, by squared distance.
#ifndef BL_NOISES_IMPULSES_RADIAL_ROW_PROFILE_H
#define BL_NOISES_IMPULSES_RADIAL_ROW_PROFILE_H

#include <math.h>

#include "noises/impulses/impulse_profiles.h"
#include "noises/impulses/profile_float.h"
#include "noises/lattice/radial_kernel.h"

// 2 K for Catmull-Rom's kernel, K for the others; exactly 0 from a squared distance of 4 on.
// `profile` is a constant where it is called.
static inline __attribute__((always_inline)) float radial_row_kernel(const bl_profile profile,
                                                                     float square) {
    if (profile == BL_PROFILE_CATMULL_ROM)
        return radial_twice(sqrtf(square));
    return profile_float(profile, square * 0.25f);
}

#endif
