// SPDX-License-Identifier: MIT
//
// The 64-bit integer hash behind the generator, the streams of a seed, and everything that is drawn
// once. The lattices, which are drawn from at every sample, have a shorter hash of their own,
// seeded by this one (noises/lattice/lattice.h).
//
//   mix(x): three rounds of xor-shift, two odd multiplications between them; a bijection of the
//   64-bit integers. Every input bit flips every output bit with probability 1/2 to within what
//   2^16 trials can tell (t-hash).
//
// The multipliers are the fractional parts of the golden ratio and of sqrt(2) in units of 2^-64,
// rounded down and made odd. All functions are pure.
#ifndef BL_CORE_HASH_H
#define BL_CORE_HASH_H

#include <stdint.h>

#define BL_GOLDEN UINT64_C(0x9E3779B97F4A7C15)   // floor(2^64 (sqrt 5 - 1)/2) | 1
#define BL_ROOT_TWO UINT64_C(0x6A09E667F3BCC909) // floor(2^64 (sqrt 2 - 1)) | 1

static inline uint64_t bl_mix(uint64_t x) {
    x ^= x >> 32;
    x *= BL_GOLDEN;
    x ^= x >> 29;
    x *= BL_ROOT_TWO;
    x ^= x >> 32;
    return x;
}

// The seed of an independent stream: streams of one seed, and equal streams of neighbouring
// seeds, share nothing that the tests can find.
static inline uint64_t bl_stream(uint64_t seed, uint64_t stream) {
    return bl_mix(bl_mix(seed + BL_GOLDEN) ^ (stream * BL_ROOT_TWO + BL_GOLDEN));
}

// The seed of one of the independent components of a vector-valued noise: component 0 is the noise
// itself, the others are the same noise of other seeds. Streams from 2^32 on serve nothing else.
static inline uint64_t bl_component_seed(uint64_t seed, unsigned component) {
    return component ? bl_stream(seed, (UINT64_C(1) << 32) + component) : seed;
}

#endif
