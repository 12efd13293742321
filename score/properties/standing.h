// SPDX-License-Identifier: MIT
//
// What stands at places that are fixed for all seeds: the origin, where octaves of one seed meet,
// and waves of the variance that are longer than a cell.
//
// Origin. The value at the origin, and at three places near it, is compared with that at the same
// place of a random cell, by batch: the differences, of values and of squared deviations, are
// symmetric about 0 if the signal is stationary, or varies within its cell alone.
//
// Waves. Three rows of half cells stand still while the seed changes. The squared deviations of a
// row, summed with the cosine and the sine of each whole number of waves in it, are 0 over seeds
// unless the variance has that wave; whole waves a cell, which a lattice may have, are left out. A
// wave in any direction shows along some axis. Student's t over the batches tests both.
#ifndef BL_SCORE_PROPERTIES_STANDING_H
#define BL_SCORE_PROPERTIES_STANDING_H

#include "score/properties/places.h"

typedef struct bl_standing {
    double t;      // the largest, of `tests`; at the origin if that is beyond its limit
    double tests;  // how many there are
    double ratio;  // where it is a variance at the origin, over that elsewhere; else NAN
    char what[96]; // it is: "the variance at the origin"
} bl_standing;

// The largest deviate of `count` batches of a signal with a seed; NaN where a value is not finite.
// The origin comes first: waves of a lattice whose cell is not stated are many and larger.
// Errors: BL_DEVICE out of memory.
bl_status bl_standing_measure(const bl_signal *signal, const bl_score_look *look,
                              const bl_score_settings *settings, size_t count, double alpha,
                              bl_standing *found, bl_message *message);

#endif
