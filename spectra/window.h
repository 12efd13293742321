// SPDX-License-Identifier: MIT
//
// Windows for spectral estimates (Harris 1978). Periodic form: w[n], n = 0..size-1, with period
// `size`.
#ifndef BL_SPECTRA_WINDOW_H
#define BL_SPECTRA_WINDOW_H

#include <stddef.h>

#include "core/status.h"

typedef enum bl_window {
    BL_WINDOW_BLACKMAN_HARRIS, // 4-term, side lobes below -92 dB: the default
    BL_WINDOW_HANN,
    BL_WINDOW_RECTANGLE,
    BL_WINDOW_COUNT
} bl_window;

const char *bl_window_name(bl_window window);
bl_status bl_window_read(const char *word, bl_window *window, bl_message *message);
void bl_window_fill(bl_window window, size_t size, double *out);

#endif
