// SPDX-License-Identifier: MIT
#include "textures/noise_source.h"

#include "noises/noise.h"

bl_status bl_noise_source_open(bl_noise_source *source, const char *text, unsigned dimensions,
                               bl_message *message) {
    bl_signal *opened, *seeded;
    bl_status status = bl_noise_open(text, BL_ISA_BASELINE, &opened, message);
    if (status != BL_OK)
        return status;
    if (opened->seed_offset == SIZE_MAX || opened->dimensions < dimensions) {
        bl_signal_free(opened);
        return bl_report(message, BL_USAGE,
                         "the noise '%s' of this texture must have a seed and %u dimension%s", text,
                         dimensions, dimensions == 1 ? "" : "s");
    }
    seeded = bl_signal_reseed(opened, source->seed);
    bl_signal_free(opened);
    if (!seeded)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    source->signal = seeded;
    return BL_OK;
}

void bl_noise_source_close(bl_noise_source *source) {
    bl_signal_free(source->signal);
    source->signal = NULL;
}
