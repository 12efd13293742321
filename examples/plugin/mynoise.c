// SPDX-License-Identifier: MIT
//
// A noise of your own as a plugin: the mean of 16 plane waves of random direction, phase and
// frequency, the last between 0.5 and 1 cycles per unit. Its band is a fact of its construction.
#include <math.h>
#include <stdlib.h>

#include "bandlimit_plugin.h"

enum { WAVES = 16 };

struct wave {
    double vector[3], phase; // cycles per unit; cycles
};

// A stream of uniform numbers below 1 (splitmix64, Steele 2014).
static double next(uint64_t *state) {
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

BANDLIMIT_EXPORT int waves_init(uint64_t seed, void **user) {
    struct wave *waves = malloc(WAVES * sizeof *waves);
    uint64_t state = seed * 0xD1342543DE82EF95u;
    if (!waves)
        return 1;
    for (int i = 0; i < WAVES; i++) { // a uniform direction: height and longitude (Archimedes)
        double height = 2 * next(&state) - 1, longitude = 6.283185307179586 * next(&state);
        double frequency = 0.5 + 0.5 * next(&state), across = sqrt(1 - height * height);
        waves[i].vector[0] = frequency * across * cos(longitude);
        waves[i].vector[1] = frequency * across * sin(longitude);
        waves[i].vector[2] = frequency * height;
        waves[i].phase = next(&state);
    }
    *user = waves;
    return 0;
}

BANDLIMIT_EXPORT void waves_free(void *user) {
    free(user);
}

BANDLIMIT_EXPORT double waves(const double p[4], unsigned dims, uint64_t seed, void *user) {
    const struct wave *wave = user;
    double sum = 0;
    (void)dims, (void)seed; // the waves know the seed
    for (int i = 0; i < WAVES; i++) {
        double cycles = wave[i].phase;
        for (int a = 0; a < 3; a++)
            cycles += wave[i].vector[a] * p[a];
        sum += cos(6.283185307179586 * (cycles - floor(cycles)));
    }
    return sum / WAVES;
}

BANDLIMIT_EXPORT void waves_claims(struct bandlimit_claims *claims) {
    claims->dims = 3;
    claims->lower = -1;
    claims->upper = 1;
    claims->mean = 0;
    claims->variance = 0.5 / WAVES; // of a cosine 1/2, of a mean of WAVES independent ones
    claims->band_from = 0;          // along a line a wave may look as slow as can be
    claims->band_to = 1;
    claims->leak_db = -INFINITY;
    claims->continuity = 4; // and more
    claims->cell = 0;
    claims->stationary = 1;
    claims->isotropic = 1;
    for (int a = 0; a < 4; a++)
        claims->period[a] = 0;
}
