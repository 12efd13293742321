// SPDX-License-Identifier: MIT
//
// The noise of stb_perlin.h (Debian: libstb-dev), after Perlin 2002. It takes floats and repeats
// every 256 cells, so places are brought there first: far from 0 a float has no fraction left.
#include <math.h>

#include "bandlimit_plugin.h"

#define STB_PERLIN_IMPLEMENTATION
#include <stb/stb_perlin.h>

static float place(double coordinate) {
    return (float)(coordinate - 256 * floor(coordinate / 256));
}

// Of the seed stb takes the low 8 bits.
BANDLIMIT_EXPORT double noise(const double p[4], unsigned dims, uint64_t seed, void *user) {
    (void)dims, (void)user;
    return (double)stb_perlin_noise3_seed(place(p[0]), place(p[1]), place(p[2]), 0, 0, 0,
                                          (int)(seed & 255));
}

BANDLIMIT_EXPORT void noise_claims(struct bandlimit_claims *claims) {
    claims->dims = 3;
    // The largest sum over the corners of weight times |gradient . offset|, found numerically:
    // 1.03636 at (0.355, 0.5, 0.481).
    claims->lower = -1.0364;
    claims->upper = 1.0364;
    claims->mean = 0;
    claims->band_from = 0; // measured: -21.5 dB of the variance lie above 1
    claims->band_to = 1;
    claims->leak_db = -20;
    // No class of continuity is stated, though the quintic fade is C2: places are floats, which
    // between 128 and 256 are 1.5e-5 apart, so the value goes in steps.
    claims->cell = 1;
    for (int a = 0; a < 4; a++)
        claims->period[a] = a < 3 ? 256 : 0;
}
