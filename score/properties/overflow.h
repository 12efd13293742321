// SPDX-License-Identifier: MIT
//
// Where a signal breaks far out: its cells overflow (2^31, 2^32), or its floats end (2^24, 2^53).
//
// At each power of two from 2^10 to 2^63, in units and in cells, with both signs, on each axis
// alone and on all together, values are taken at the power itself, a cell below it, a little to
// either side of both, and elsewhere in the cell: by points and by the reference. Three things are
// asked. Is the value outside of the stated range (where none is stated, of nine times what is seen
// near 0)? Is it no number? Do neighbours differ across the power, on two lines or more, by more
// than eight times what they do elsewhere, nearer, and across the planes near 0?
#ifndef BL_SCORE_PROPERTIES_OVERFLOW_H
#define BL_SCORE_PROPERTIES_OVERFLOW_H

#include "score/score.h"

typedef enum bl_overflow_kind {
    BL_OVERFLOW_RANGE,
    BL_OVERFLOW_NAN,
    BL_OVERFLOW_JUMP,
    BL_OVERFLOW_KINDS
} bl_overflow_kind;

// The first place in the order of the powers.
typedef struct bl_overflow_place {
    double from;        // the power; INFINITY: nowhere
    double at[BL_AXES]; // the place
    double value;       // there; of a jump its size
} bl_overflow_place;

// Deterministic for given settings, whatever the threads.
void bl_overflow_find(const bl_signal *signal, const bl_score_settings *settings,
                      bl_overflow_place found[BL_OVERFLOW_KINDS]);

// The coordinate up to which a claim is judged: the stated one, or `unstated`.
double bl_overflow_domain(const bl_signal *signal, double unstated);

// Beyond it a double has no fraction, and most noises no number.
#define BL_OVERFLOW_LAST 0x1p53

#endif
