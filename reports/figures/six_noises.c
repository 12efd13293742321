// SPDX-License-Identifier: MIT
#include "reports/figures/six_noises.h"

const char *const bl_six_names[BL_SIX] = {"vnoise",  "gnoise",  "vgnoise",
                                          "hermite", "vcnoise", "scnoise"};

bl_gallery bl_six_open(bl_run *run) {
    return bl_gallery_open(run, bl_six_names, BL_SIX);
}
