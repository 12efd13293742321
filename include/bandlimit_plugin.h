// SPDX-License-Identifier: MIT
//
// Your own noise for bandlimit, in C or C++: a shared object that exports one function.
//
//   #include "bandlimit_plugin.h"
//
//   BANDLIMIT_EXPORT double mine(const double p[4], unsigned dims, uint64_t seed, void *user) {
//       return ...;
//   }
//
//   cc -O2 -fPIC -shared mine.c -o mine.so -lm
//   bandlimit spectrum ./mine.so:mine
//
// This header needs nothing else of bandlimit, and nothing of it is linked.
//
// A plugin has one function that gives the value at a point, here `mine`, and may have companions,
// found by their names: mine_init, mine_free, mine_rows and mine_claims.
#ifndef BANDLIMIT_PLUGIN_H
#define BANDLIMIT_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define BANDLIMIT_EXPORT extern "C" __attribute__((visibility("default")))
extern "C" {
#else
#define BANDLIMIT_EXPORT __attribute__((visibility("default")))
#endif

// The value at p. The coordinates p[0] .. p[dims - 1] are finite and at most 2^62 in size
// (bandlimit answers NaN for others itself), the rest are 0. `user` is what SYMBOL_init made, else
// NULL. The value must depend on p, dims and seed alone, and the function may be called from
// several threads at once, unless the claims have BANDLIMIT_NOT_THREAD_SAFE. A NaN says that there
// is no value.
//
// Seeds use all 64 bits: (double)seed added to a place leaves nothing of the place. Hash the seed.
typedef double bandlimit_function(const double p[4], unsigned dims, uint64_t seed, void *user);

// SYMBOL_init, optional: makes what the function needs for a seed (a table of random numbers, say)
// and leaves it in *user, which is NULL before. Returns 0, or another number if it fails. Many
// seeds may be alive at once, and many are made while measuring: be quick.
typedef int bandlimit_init(uint64_t seed, void **user);

// SYMBOL_free, optional: releases what SYMBOL_init made.
typedef void bandlimit_free(void *user);

// SYMBOL_rows, optional and faster: out[i] is the value at start + i * step for i below count, each
// coordinate computed in double as start[a] + (double)i * step[a]; the float nearest to what the
// function itself gives there, or nearly. Coordinates are as above.
typedef void bandlimit_rows(const double start[4], const double step[4], size_t count,
                            unsigned dims, uint64_t seed, void *user, float *out);

// What a noise states about itself. Every number comes as NaN, which means: not stated.
struct bandlimit_claims {
    size_t size;               // of this struct; filled in, leave it alone
    uint32_t dims;             // 1 to 4; 0 (as it comes): any number, 3 if nobody asks
    uint32_t flags;            // BANDLIMIT_NOT_THREAD_SAFE, ...; comes as 0
    double lower, upper;       // hard bound of the values
    double mean, variance;     // over places and seeds
    double band_from, band_to; // the band, cycles per unit, of a spectrum along an axis ...
    double leak_db;            // ... and the share of variance outside of it, dB of the variance
    double period[4];          // the smallest along each axis, units; 0: none
    double cell;               // the distance of the planes of its lattice; 0: it has none
    int32_t continuity; // 0 for C0, 1 for C1, ...; -1: discontinuous; comes as -2: not stated
    int32_t stationary; // 1: the same mean and variance all over its cell; comes as 0
    int32_t isotropic;  // 1: a spectrum without a direction; comes as 0
    int32_t reserved;   // leave it alone
};

enum { BANDLIMIT_NOT_THREAD_SAFE = 1 }; // one call at a time, of all functions of this plugin

// SYMBOL_claims, optional: writes into the struct what the noise states, and leaves the rest alone.
// They hold for every seed, and become the facts of the signal, which `bandlimit check --claims`
// and `bandlimit score` judge: each is then a claim that passes or fails.
typedef void bandlimit_claim(struct bandlimit_claims *claims);

#ifdef __cplusplus
}
#endif

#endif
