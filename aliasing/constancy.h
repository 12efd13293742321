// SPDX-License-Identifier: MIT
//
// Is there anything to see? Where a signal has one value in all of the image, every method is
// right, and none can be judged.
#ifndef BL_ALIASING_CONSTANCY_H
#define BL_ALIASING_CONSTANCY_H

#include "aliasing/method.h"

typedef struct bl_constancy {
    double value;  // the luminance that most of the image has
    double varies; // share of 2^14 places all over the image that differ from it by more than the
                   // rounding of floats; what sees nothing has the background's colour
    int constant;  // none of them does
    int found;     // where varies < 0.01: the signal differs from the value at `place`
    double place[BL_AXES], reach; // units: found within +- reach of 0
} bl_constancy;

// Thread-safe.
bl_constancy bl_constancy_find(const bl_scene *scene);

#endif
