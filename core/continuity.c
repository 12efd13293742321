// SPDX-License-Identifier: MIT
#include "core/continuity.h"

#include <stdio.h>

const char *bl_continuity_text(int continuity, char *text, size_t size) {
    if (continuity < -1)
        snprintf(text, size, "not stated");
    else if (continuity < 0)
        snprintf(text, size, "discontinuous");
    else if (continuity < BL_CONTINUITY_ALL)
        snprintf(text, size, "C%d", continuity);
    else
        snprintf(text, size, "C-infinity");
    return text;
}
