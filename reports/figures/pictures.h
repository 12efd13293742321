// SPDX-License-Identifier: MIT
//
// Pictures of textures side by side, in colour, one panel each.
#ifndef BL_REPORTS_FIGURES_PICTURES_H
#define BL_REPORTS_FIGURES_PICTURES_H

#include "reports/measure.h"

// One panel. Its places are those of a square about `at`, s to the right and t downwards, unless
// `see` says what stands at (x, y) in [-1, 1] (y upwards): it fills the place, or gives 0 for the
// background, which is white.
typedef struct bl_shown {
    const char *key;           // of the file: letters, digits and '-'
    const char *title;         // of the panel
    const bl_signal *signal;   // NULL: opened from the text
    const char *text;          // of the signal; of one that is given, what the settings call it
    unsigned pixels;           // across; 0: those of the set. Fewer of them show what a filter does
    int filtered;              // the signal filters itself for the pixel's width
    double at[BL_AXES], scale; // of its own; scale 0: those of the set
    int (*see)(double x, double y, double at[BL_AXES]);
} bl_shown;

typedef struct bl_pictures {
    const char *name; // of the plot
    const char *title, *alternative;
    const bl_shown *shown;
    size_t count, columns;
    double at[BL_AXES], scale; // units across
    unsigned pixels;
    // What filters itself, or is coarse, is seen at the middle of a pixel; what has an exact
    // average over a pixel is that, and all else the mean of `samples` x `samples` places in it; 0:
    // one.
    unsigned samples;
    const char *unit; // of the axes, which run from 0 to 1 picture
} bl_pictures;

// Writes KEY.exr (linear) and KEY.png (sRGB) for each and the plot of all.
void bl_pictures_draw(bl_run *run, const bl_pictures *pictures);

#endif
