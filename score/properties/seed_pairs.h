// SPDX-License-Identifier: MIT
//
// The seeds that people use: 0 to 31, each against each other.
//
// A pair of seeds is one correlation over many places, and says what it is by chance only beside
// other pairs: as many seeds drawn at random are compared with each other at the same places. The
// deviation of their correlations about 0 is what chance does to two signals of this kind, which
// may share a table or a mean that depends on the place; Student's t with it tests every pair of
// small seeds.
#ifndef BL_SCORE_PROPERTIES_SEED_PAIRS_H
#define BL_SCORE_PROPERTIES_SEED_PAIRS_H

#include "score/properties/places.h"

typedef struct bl_seed_pairs {
    size_t places;      // of each pair
    double correlation; // the one that is farthest from 0
    uint64_t seeds[2];  // of it
    double deviation;   // of the correlations of random seeds
    double limit;       // beyond which a correlation is no chance
} bl_seed_pairs;

// Tests all pairs with the probability alpha. `mean` and `deviation` come from the look. Errors:
// BL_DEVICE out of memory, or where a signal could not be made.
bl_status bl_seed_pairs_measure(const bl_signal *signal, const bl_score_look *look,
                                const bl_score_settings *settings, double alpha,
                                bl_seed_pairs *pairs, bl_message *message);

#endif
