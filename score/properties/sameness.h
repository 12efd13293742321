// SPDX-License-Identifier: MIT
//
// Whether a signal takes the same values at a place and at the image of that place under a map: a
// shift, a mirror, an exchange of axes.
//
// Places are multiples of 2^-8 cells within 16 or 2048 cells of 0, so that a whole number of cells
// is added exactly; far shifts are also tried at eighths, quarters, halves and whole cells, for
// functions of float coordinates have no others there. The values are the same where the double
// reference gives them to 10^-6 of the range, at BL_SAME_PLACES places or more, at six of which it
// differs from the first; what the value changes by within two roundings of the image is let pass,
// so that a period that no double has is found at the nearest one. There is no chance in it: the
// places are many, and other values agree at none.
#ifndef BL_SCORE_PROPERTIES_SAMENESS_H
#define BL_SCORE_PROPERTIES_SAMENESS_H

#include "score/properties/places.h"

#define BL_SAME 1e-6            // of the range
#define BL_SILENT 1e-3          // of the range
enum { BL_SAME_PLACES = 1024 }; // so many, for two values alone agree at one of ten by chance

// Component a of the image is sign[a] at[axis[a]] + shift[a], in units.
typedef struct bl_score_map {
    unsigned axis[BL_AXES];
    int sign[BL_AXES];
    double shift[BL_AXES];
} bl_score_map;

extern const bl_score_map bl_score_identity;

typedef enum bl_score_likeness {
    BL_UNLIKE,
    BL_LIKE,    // the same values
    BL_OPPOSITE // the sum of both values is one number everywhere
} bl_score_likeness;

void bl_score_image(const bl_score_map *map, const double at[BL_AXES], double image[BL_AXES]);

// A place within 16 or 2048 cells of 0, a multiple of 2^-8 cells.
void bl_score_exact_place(const bl_score_look *look, bl_random *random, double at[BL_AXES]);

// Which maps leave the values at two places as they are, or turn them over, in floats, for all maps
// at once. The values at the places are far from the commonest one, so that sparse noises tell much
// at each. What is not likely is no map of the signal.
void bl_score_likely(const bl_signal *signal, const bl_score_look *look, const bl_score_map *maps,
                     size_t count, bl_random *random, unsigned char *is_likely);

// Compares the values at `places` places or more, from `random`, with those at their images.
// BL_UNLIKE too where the signal hardly ever differs from its first value.
bl_score_likeness bl_score_compare(const bl_signal *signal, const bl_score_look *look,
                                   const bl_score_map *map, int places, bl_random random);

// Whether the signal is so nearly constant that nothing could be told.
int bl_score_is_nearly_constant(const bl_signal *signal, const bl_score_look *look,
                                bl_random random);

// By how much the value changes within two roundings of each coordinate: of a shift and of the sum;
// no more than BL_SILENT of the range, where the place tells nothing. 0 where roundings are as long
// as features of the signal.
double bl_score_change_by_rounding(const bl_signal *signal, const bl_score_look *look,
                                   const double at[BL_AXES]);

#endif
