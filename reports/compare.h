// SPDX-License-Identifier: MIT
//
// The comparison of any signals: the three figures of the text (along a line, in a slice, the power
// spectrum) and the histogram, for the signals in the settings of the reproduction.
#ifndef BL_REPORTS_COMPARE_H
#define BL_REPORTS_COMPARE_H

#include "reports/figure.h"

enum { BL_COMPARISONS = 4 };

// For bl_reproduce_settings.figures.
extern const bl_figure *const bl_comparisons[BL_COMPARISONS];

#endif
