// SPDX-License-Identifier: MIT
#include "reports/figures/all_noises.h"

#include <stdlib.h>

#include "noises/noise.h"

bl_status bl_all_noises_open(bl_run *run, bl_gallery *gallery, bl_message *message) {
    size_t count = bl_noise_count();
    const char **names = calloc(count, sizeof *names);
    if (!names)
        return bl_report(message, BL_DEVICE, "out of memory");
    for (size_t i = 0; i < count; i++)
        names[i] = bl_noise_at(i, BL_ISA_BASELINE)->name;
    bl_status status = bl_gallery_open(run, names, count, gallery, message);
    free(names);
    return status;
}
