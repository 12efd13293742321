// SPDX-License-Identifier: MIT
//
// The arithmetic of estimates that the claims of figures share.
#ifndef BL_REPORTS_FIGURES_ESTIMATES_H
#define BL_REPORTS_FIGURES_ESTIMATES_H

#include "core/statistics.h"
#include "reports/run.h"

// A number that is computed, not sampled: it has no interval because it needs none.
bl_estimate bl_exactly(double value, double samples);
// The extreme of all that was looked at, or the largest of several deviations: a number whose
// interval is not estimated, and that more samples may pass.
bl_estimate bl_observed(double value, double samples);
// a - b of independent estimates: half widths add in squares. `samples` is that of the poorer one.
bl_estimate bl_difference(bl_estimate a, bl_estimate b);
// 10 log10(a / b) of independent positive estimates, to first order; the level is that of a.
bl_estimate bl_ratio_db(bl_estimate a, bl_estimate b);

// Times a positive factor that is known.
bl_estimate bl_scaled(bl_estimate estimate, double factor);

// The slope of y over x by least squares.
double bl_slope(const double *x, const double *y, size_t count);

// Makes and keeps a claim; the texts are literals or made by bl_run_text. `counted` says
// what the samples of the estimate are.
void bl_make_claim(bl_run *run, const char *source, const char *sentence, const char *reading,
                   const char *unit, double lower, double upper, bl_estimate measured,
                   const char *counted);

#endif
