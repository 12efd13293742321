// SPDX-License-Identifier: MIT
//
// Summed-area tables: the mean of an image over any box that stands along its axes, in a time that
// does not grow with the box.
//
// Pixel (i, j) covers [i, i+1] x [j, j+1] and is constant there, so that the mean of any box with
// real edges is defined, and exact: the integral of the image from (0, 0) is bilinear within a
// pixel. A box may be wider than the image and may stand outside of it; there the image is
// continued by its edge pixels, or starts again.
//
// What a table costs in digits: its entries grow with the area to the lower right corner, and a box
// is the difference of four of them. With the machine epsilon e of its numbers and a mean m of the
// image, the error of the mean over a box of area a is about e m W H / a for every box
// (reports/figures/summed_area_error.c measures it).
//
// Source: crow1984; peachey2003, p. 66.
#ifndef BL_FILTERS_SUMMED_AREA_H
#define BL_FILTERS_SUMMED_AREA_H

#include <stddef.h>

#include "core/status.h"

// What the sums are kept in.
typedef enum bl_sums {
    BL_SUMS_FLOAT,      // added up in float, too: what a table on a graphics card does
    BL_SUMS_ROUNDED,    // added up in double, rounded to float once
    BL_SUMS_DOUBLE,     // e = 2^-53
    BL_SUMS_COMPENSATED // pairs of doubles: e = 2^-100, so that only the result is rounded
} bl_sums;

typedef enum bl_continuation {
    BL_CLAMPED, // by the pixels of its edges
    BL_WRAPPED  // by itself
} bl_continuation;

typedef struct bl_summed_area bl_summed_area;

// Makes the table of an image of height rows of width pixels, row 0 first; height 1 is the 1-D
// table. The image is not kept. Errors: BL_USAGE for an empty image or a pixel that is not finite
// (the message names it), BL_DEVICE out of memory. The caller frees it.
bl_status bl_summed_area_make(const float *values, size_t width, size_t height, bl_sums sums,
                              bl_continuation continuation, bl_summed_area **table,
                              bl_message *message);
void bl_summed_area_free(bl_summed_area *table);

// The mean over the box of size[0] by size[1] pixels about (x, y). A size below 2^-20 of a pixel
// means the pixel itself along that axis. An infinite size is the limit: the mean of the image
// along that axis where it wraps, half of each edge where it is clamped. NaN and infinite places
// and NaN sizes give NaN. Thread-safe.
double bl_summed_area_mean(const bl_summed_area *table, double x, double y, const double size[2]);

#endif
