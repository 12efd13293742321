// SPDX-License-Identifier: MIT
//
// The claims of figure 2.36: how much of the lattice is seen in slices of the six noises.
#ifndef BL_REPORTS_FIGURES_SIX_PATTERNS_H
#define BL_REPORTS_FIGURES_SIX_PATTERNS_H

#include "reports/figures/six_noises.h"

// Measures, claims, and writes grid-patterns.csv. Errors: BL_DEVICE, and what the measurements
// report.
void bl_six_patterns_claim(bl_run *run, const bl_gallery *six);

#endif
