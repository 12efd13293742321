// SPDX-License-Identifier: MIT
//
// The texts of all settings worth a test: every noise of the registry with its defaults, with each
// choice, the ends of each range and the examples of each key.
#ifndef BL_TESTS_TEXTS_H
#define BL_TESTS_TEXTS_H

#include <stddef.h>

#include "noises/noise.h"

enum { BL_TEXTS_MOST = 1024 };

typedef struct bl_texts {
    char text[BL_TEXTS_MOST][160];
    size_t count;
} bl_texts;

// The list, made once.
const bl_texts *bl_test_texts(void);

// Opens a noise for an instruction set, or fails the test.
bl_signal *bl_test_open(const char *text, bl_isa isa);

#endif
