// SPDX-License-Identifier: MIT
//
// Curves of signals along x, all in one panel: what the figures of the regular primitives show.
#ifndef BL_REPORTS_FIGURES_CURVES_H
#define BL_REPORTS_FIGURES_CURVES_H

#include "reports/figures/gallery.h"

typedef struct bl_curve {
    const char *text;  // of the signal
    const char *label; // in the legend
    bl_ink ink;
    bl_stroke stroke;
} bl_curve;

typedef struct bl_curves {
    const char *title, *alternative;
    const bl_curve *curves;
    size_t count; // at most BL_CURVES_MOST
    bl_axis x, y; // with their limits
    const bl_limit *limits;
    size_t limit_count;
} bl_curves;

enum { BL_CURVES_MOST = 8, BL_CURVES_STEPS = 1200 };

// Opens the signals, writes curves.csv, with the values in double at 1201 places of the x axis, and
// the plot "curves".
bl_gallery bl_curves_draw(bl_run *run, const bl_curves *curves);

// The value of signal `index` at x.
double bl_curves_at(const bl_gallery *gallery, size_t index, double x);

// The largest |a(x, data)| at 1201 places evenly from `from` to `to`: how far a law is broken.
double bl_curves_largest(double (*a)(const bl_gallery *gallery, double x),
                         const bl_gallery *gallery, double from, double to);

// A claim that this largest deviation is at most `limit`.
void bl_curves_claim(bl_run *run, const char *source, const char *sentence, const char *reading,
                     double limit, double measured);

#endif
