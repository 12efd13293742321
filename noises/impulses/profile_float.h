// SPDX-License-Identifier: MIT
//
// The radial kernels of impulse_profiles.h in float, for the loops over points: no library function
// but the root.
#ifndef BL_NOISES_IMPULSES_PROFILE_FLOAT_H
#define BL_NOISES_IMPULSES_PROFILE_FLOAT_H

#include <math.h>

#include "noises/float_functions.h"
#include "noises/impulses/impulse_profiles.h"
#include "noises/lattice/radial_kernel.h"

// K of the squared distance in radii, q >= 0; 0 from q = 1 on. `profile` is a constant where it is
// called. The cosine is w^2 P(w) with w = 1 - q, |error| <= 1.4e-8 (w^2 + 1/100) by Remez's
// exchange in 30 digits; the Gaussians are powers of 2, 0 outside by choice. All are good to 3e-7.
static inline float profile_float(const bl_profile profile, float q) {
    const float log2e = 1.44269504089f;
    if (profile == BL_PROFILE_DISC)
        return q < 1 ? 1 : 0;
    if (profile == BL_PROFILE_CATMULL_ROM)
        return 0.5f * radial_twice(2 * sqrtf(q));
    float w = 1 - q > 0 ? 1 - q : 0;
    if (profile == BL_PROFILE_COSINE) {
        float u = w * w;
        return u * ((0.616851605305f + 0.308406786202f * w) +
                    u * ((0.0660101831324f + 0.00795280373609f * w) + u * 0.000778608454261f));
    }
    float e = bl_float_exp2((float)-BL_GAUSSIAN_RATE * log2e * q), value;
    if (profile == BL_PROFILE_GAUSSIAN) {
        const float edge = (float)BL_GAUSSIAN_EDGE,
                    bend = (float)(BL_GAUSSIAN_RATE * BL_GAUSSIAN_EDGE),
                    scale = (float)(1 / (1 - BL_GAUSSIAN_EDGE * (1 + BL_GAUSSIAN_RATE)));
        value = (e - edge - bend * w) * scale;
    } else {
        const float edge = (float)(BL_GAUSSIAN_EDGE - BL_GAUSSIAN_EDGE_4);
        const float bend = (float)(BL_GAUSSIAN_RATE * (BL_GAUSSIAN_EDGE - 4 * BL_GAUSSIAN_EDGE_4));
        value = 2 * (e - (e * e) * (e * e) - edge - bend * w);
    }
    return w > 0 ? value : 0;
}

#endif
