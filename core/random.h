// SPDX-License-Identifier: MIT
//
// A seeded generator for choosing places and for tests: a counter run through the hash, so that
// the k-th number of a seed is known without the ones before it. State is in the caller's hands;
// one generator must not be shared between threads.
#ifndef BL_CORE_RANDOM_H
#define BL_CORE_RANDOM_H

#include <stdint.h>

typedef struct bl_random {
    uint64_t key;
    uint64_t counter;
} bl_random;

// A generator at its first number. Equal seeds and streams give equal numbers; streams of one seed,
// and equal streams of different seeds, are independent as far as the tests can tell. Never fails.
bl_random bl_random_seed(uint64_t seed, uint64_t stream);
uint64_t bl_random_bits(bl_random *random); // 64 uniform bits
double bl_random_unit(bl_random *random);   // uniform on [0, 1), multiples of 2^-53
double bl_random_normal(bl_random *random); // standard normal, by inversion

#endif
