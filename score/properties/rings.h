// SPDX-License-Identifier: MIT
//
// The anisotropy of the rings of a slice's power spectrum (Ulichney 1987), an octave at a time.
//
// The anisotropy of a ring is the variance of its cells over the square of their mean. Of an
// isotropic signal it is 1 over the number of averages, the floor. The mean of an octave weighs
// each ring by its area, not by its power; the mean of all weighs them by their power. Several
// measurements with fresh seeds at fresh places are independent: their spread is the interval, of
// Student's t.
#ifndef BL_SCORE_PROPERTIES_RINGS_H
#define BL_SCORE_PROPERTIES_RINGS_H

#include "score/properties/places.h"

// Adds rings_below_2_db for the octave that ends at 2 cycles a cell, rings_below_1_db and so on,
// rings_anisotropy_db for all, and rings_floor_db. A signal whose spectrum cannot be measured gets
// none of them.
void bl_score_add_rings(const bl_signal *signal, const bl_score_settings *settings,
                        const bl_score_look *look, bl_score_property *result);

#endif
