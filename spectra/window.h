// SPDX-License-Identifier: MIT
//
// Windows for spectral estimates (Harris 1978). Periodic form: w[n], n = 0..size-1, with period
// `size`. All functions are pure.
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

// "blackman-harris", "hann" or "rectangle"; "unknown" for a number that is no window.
const char *bl_window_name(bl_window window);
// BL_USAGE for any other word; the message names the nearest.
bl_status bl_window_read(const char *word, bl_window *window, bl_message *message);
// Fills out[0..size-1]; size 1 gives 1. Pure, so thread-safe.
void bl_window_fill(bl_window window, size_t size, double *out);

// Half the width of the main lobe, in bins: power at one frequency spreads no farther, except in
// side lobes.
double bl_window_half_lobe(bl_window window);
// The share of a line's power that a bin gets whose centre is so many bins from the line, of a long
// window: the shares of all bins add up to 1, wherever the line is between them.
double bl_window_kernel(bl_window window, double bins);
// The share of the power at one frequency that spreads farther than that.
double bl_window_side_lobes(bl_window window);

// White noise through the window: the correlation of the powers of two bins `offset` apart,
// |sum w^2 exp(2 pi i n offset/size)|^2 / (sum w^2)^2 (Percival and Walden 1993, section 6.6).
double bl_window_correlation(bl_window window, size_t size, size_t offset);

// White noise through the window: the correlation of one bin's powers in two segments that start
// `shift` samples apart, (sum w[n] w[n+shift])^2 / (sum w^2)^2 (Welch 1967).
double bl_window_overlap(bl_window window, size_t size, size_t shift);

#endif
