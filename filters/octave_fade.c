// SPDX-License-Identifier: MIT
#include "filters/octave_fade.h"

#include <stddef.h>

const char *const bl_octave_clamps[] = {"none", "hard", "fade", NULL};

double bl_octave_kept(double t, bl_octave_clamp clamp, double width) {
    // Products, not quotients: no width but NaN makes a NaN of them, for t > 0.
    if (clamp == BL_CLAMP_NONE)
        return 1;
    if (clamp == BL_CLAMP_HARD)
        return 2 * t * width < 1;
    double fade = 2 - 4 * t * width;
    return fade >= 1 ? 1 : fade > 0 ? fade : 0;
}
