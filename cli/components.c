// SPDX-License-Identifier: MIT
#include "cli/components.h"

#include <string.h>

#include "core/hash.h"

bl_status bl_vector_signal_open(const bl_signal *signal, size_t count, bl_vector_signal *vector,
                                bl_message *message) {
    *vector = (bl_vector_signal){.count = 1, .of = {signal}};
    if (count > 1 && signal->seed_offset == SIZE_MAX)
        return bl_report(message, BL_MISMATCH,
                         "--components %zu: '%s' has no seed, so there is only one of it", count,
                         signal->text);
    for (; vector->count < count; vector->count++) {
        uint64_t own = bl_component_seed(bl_signal_seed(signal), (unsigned)vector->count);
        vector->of[vector->count] = bl_signal_reseed(signal, own);
        if (!vector->of[vector->count]) {
            bl_vector_signal_free(vector);
            return bl_report(message, BL_DEVICE, "out of memory making %zu components of '%s'",
                             count, signal->text);
        }
    }
    return BL_OK;
}

void bl_vector_signal_free(bl_vector_signal *vector) {
    for (size_t k = 1; k < vector->count; k++)
        bl_signal_free((bl_signal *)vector->of[k]); // made above, and owned
    vector->count = 1;
}
