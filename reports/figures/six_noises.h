// SPDX-License-Identifier: MIT
//
// The six noises that figures 2.35 to 2.37 of peachey2003 show in panels (a) to (f).
#ifndef BL_REPORTS_FIGURES_SIX_NOISES_H
#define BL_REPORTS_FIGURES_SIX_NOISES_H

#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

enum { BL_SIX = 6 };
enum { BL_VNOISE, BL_GNOISE, BL_VGNOISE, BL_HERMITE, BL_VCNOISE, BL_SCNOISE };

extern const char *const bl_six_names[BL_SIX];

// Opens the six with the seed of the run and notes their texts as settings.
bl_gallery bl_six_open(bl_run *run);

#endif
