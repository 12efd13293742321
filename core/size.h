// SPDX-License-Identifier: MIT
//
// How much work a measurement may take: seconds, a minute, a night. On the command line --quick and
// --full; every measurement says itself what the sizes mean to it.
#ifndef BL_CORE_SIZE_H
#define BL_CORE_SIZE_H

typedef enum bl_size { BL_QUICK, BL_NORMAL, BL_FULL } bl_size;

// "quick", "normal", "full".
const char *bl_size_word(bl_size size);

// The number for the size.
static inline double bl_size_pick(bl_size size, double quick, double normal, double full) {
    return size == BL_QUICK ? quick : size == BL_NORMAL ? normal : full;
}

#endif
