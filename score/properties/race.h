// SPDX-License-Identifier: MIT
//
// A race between threads: the same answers alone and while others ask.
//
// More threads than there are processors ask without a pause, each at places of its own and every
// second one of another seed, so that what a function keeps between two lines (a place, a seed, the
// cell it was in last) belongs to somebody else as often as possible: on several processors at
// once, on one when a thread is set aside in the middle of a call. The first answers are asked for
// by all threads at once before any is asked for alone, so that what a function makes at its first
// call for a seed is made by several; then the same places are asked for alone, and again and again
// by all, until the time is spent. Points, rows and values in double take turns.
//
// A function that is one of the place shows no difference, so that its result does not depend on
// how far the threads came. Of one with a race the chance to be seen grows with the share of a call
// in which it can be disturbed: a tenth is seen within some ten changes of threads.
#ifndef BL_SCORE_PROPERTIES_RACE_H
#define BL_SCORE_PROPERTIES_RACE_H

#include "core/signal.h"

typedef struct bl_race {
    int is_found;
    const char *what; // "a row", "points", "a value"
    double at[BL_AXES];
    double alone, together;
} bl_race;

// Looks for a race for `seconds` of the processors' time, or four times as long on the wall, and
// longer only to ask for every place three times. The places follow from `seed`. A function that
// gives two answers to one thread alone has no race here. Returns 0 where threads or memory are
// missing.
int bl_race_find(const bl_signal *signal, uint64_t seed, double seconds, bl_race *race);

#endif
