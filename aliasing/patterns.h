// SPDX-License-Identifier: MIT
//
// Sampling patterns: n x n places in the unit square, a fresh one for every key.
//
//   regular     the centres of n x n equal squares
//   jitter      a uniformly random place in each of these squares (Cook 1986)
//   stratified  the same, and each of n^2 equal columns and rows has one place too: multi-jittered
//               (Chiu, Shirley and Wang 1994)
//   halton      radical inverses of the index in base 2 and 3, shifted modulo 1 (Halton 1960; the
//               shift is Cranley and Patterson's, 1976)
//   sobol       the first two dimensions of Sobol's sequence, the digits of all places flipped
//               alike: any 2^k places from the start have one in each of the 2^k equal boxes of
//               2^-a x 2^-b (Sobol 1967; Kollig and Keller 2002)
//
// Over the keys each place is uniform in the square, except those of the regular pattern, so that
// averages are unbiased. All functions are pure.
#ifndef BL_ALIASING_PATTERNS_H
#define BL_ALIASING_PATTERNS_H

#include <stdint.h>

typedef enum bl_pattern {
    BL_PATTERN_REGULAR,
    BL_PATTERN_JITTER,
    BL_PATTERN_STRATIFIED,
    BL_PATTERN_HALTON,
    BL_PATTERN_SOBOL,
    BL_PATTERN_COUNT
} bl_pattern;

extern const char *const bl_pattern_words[]; // in this order, ended by NULL

// The place of index 0 .. n*n - 1, n up to 4096, in [0, 1) x [0, 1).
void bl_pattern_place(bl_pattern pattern, uint32_t n, uint32_t index, uint64_t key, double out[2]);

// A place of Sobol's sequence, its digits flipped as the key says.
void bl_sobol_place(uint32_t index, uint64_t key, double out[2]);

// The key of what stands at (x, y): independent for every place, no matter what came before.
uint64_t bl_pattern_key(uint64_t seed, double x, double y);

#endif
