// SPDX-License-Identifier: MIT
#include "core/random.h"

#include "core/hash.h"
#include "core/statistics.h"

bl_random bl_random_seed(uint64_t seed, uint64_t stream) {
    return (bl_random){bl_stream(seed, stream), 0};
}

uint64_t bl_random_bits(bl_random *random) {
    // Two mixes with the key between them: one would make the streams of two keys permutations of
    // each other with a visible shift where keys differ by a small number.
    return bl_mix(bl_mix(random->counter++ * BL_GOLDEN) ^ random->key);
}

double bl_random_unit(bl_random *random) {
    return (double)(bl_random_bits(random) >> 11) * 0x1p-53;
}

double bl_random_normal(bl_random *random) {
    // The half keeps p inside (0, 1): at least 2^-54.
    double p = ((double)(bl_random_bits(random) >> 11) + 0.5) * 0x1p-53;
    return bl_normal_quantile(p);
}
