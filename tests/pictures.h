// SPDX-License-Identifier: MIT
//
// Pictures that fit at their edges or do not, that have a direction or none, for the tests of what
// is asked of pictures. Each is a formula of the place, so that what is right is known.
#ifndef BL_TESTS_PICTURES_H
#define BL_TESTS_PICTURES_H

#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"

// A random field that repeats: white noise under a Gaussian kernel. Its spectrum is the Gaussian
// exp(-(2 pi f sigma)^2), whose sigma along the direction (from x towards y) is `stretch` times
// that across; 0 and 1: none.
typedef struct bl_test_tile {
    size_t width, height; // samples after which it repeats
    double sigma;         // samples; 0: white noise
    double stretch, degrees;
    uint64_t seed;
} bl_test_tile;

// A picture as a signal, from its samples, x fastest; `settings` as of a raw file: "wrap=periodic".
bl_signal *bl_test_picture(const float *values, size_t width, size_t height, const char *settings);

// Samples first to first + count - 1 along both axes of the tile.
void bl_test_tile_fill(const bl_test_tile *tile, const size_t first[2], const size_t count[2],
                       float *values);

#endif
