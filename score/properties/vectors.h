// SPDX-License-Identifier: MIT
//
// Repeats by a vector: n(p + v) = n(p) for whole numbers of cells v in any direction, which is what
// a hash of i + 57 j does.
//
// Near. Every v whose parts are at most NEAR cells is 16 k - a, with k and a small: the values at
// the places a of a small block and those at multiples of 16 cells are sorted and compared, so that
// some 40,000 values stand for a hundred million vectors. Two values at each place are the same in
// floats; what is left is compared in double (sameness.h).
//
// Far. Along all diagonals of the axes the shifts 2^k and 3 2^k are tried, up to 2^40 cells.
#ifndef BL_SCORE_PROPERTIES_VECTORS_H
#define BL_SCORE_PROPERTIES_VECTORS_H

#include "score/properties/places.h"

// The shortest vector that is found, in cells, which is not made of the repeats along the axes
// (`along`, in cells; 0: none). All 0: none. Errors: BL_DEVICE out of memory.
bl_status bl_score_find_vector(const bl_signal *signal, const bl_score_look *look,
                               const bl_score_settings *settings, const double along[BL_AXES],
                               double vector[BL_AXES], bl_message *message);

#endif
