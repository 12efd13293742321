// SPDX-License-Identifier: MIT
//
// All noises of the registry as a gallery, for the figures that show every one.
#ifndef BL_REPORTS_FIGURES_ALL_NOISES_H
#define BL_REPORTS_FIGURES_ALL_NOISES_H

#include "reports/figures/gallery.h"

// Opens every noise with its default settings and the seed of the run.
bl_gallery bl_all_noises_open(bl_run *run);

#endif
