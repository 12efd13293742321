// SPDX-License-Identifier: MIT
//
// The claims of figure 2.35: the values of the six noises at the lattice points and between them.
#ifndef BL_REPORTS_FIGURES_SIX_VALUES_H
#define BL_REPORTS_FIGURES_SIX_VALUES_H

#include "reports/figures/six_noises.h"

// Measures and claims. Errors: BL_DEVICE out of memory, and what the measurements report.
void bl_six_values_claim(bl_run *run, const bl_gallery *six);

#endif
