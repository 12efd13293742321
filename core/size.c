// SPDX-License-Identifier: MIT
#include "core/size.h"

const char *bl_size_word(bl_size size) {
    static const char *const words[] = {"quick", "normal", "full"};
    return words[size];
}
