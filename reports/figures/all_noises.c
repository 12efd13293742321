// SPDX-License-Identifier: MIT
#include "reports/figures/all_noises.h"

#include "noises/noise.h"

bl_gallery bl_all_noises_open(bl_run *run) {
    size_t count = bl_noise_count();
    const char **names = bl_run_memory(run, count, sizeof *names);
    for (size_t i = 0; i < count; i++)
        names[i] = bl_noise_at(i, BL_ISA_BASELINE)->name;
    return bl_gallery_open(run, names, count);
}
