// SPDX-License-Identifier: MIT
//
// MIP pyramids: an image at half its size, a quarter, and so on, each made of the one before with
// a filter, and looked up between two levels.
//
// A pixel of a level covers width/width' by height/height' pixels of the level before, about 2 by
// 2; its value is the mean of those under the filter, with samples so far apart, as if each pixel
// were constant over its square. The weights are differences of the filter's step, so that they add
// to 1. Sizes need not be powers of two: half of 5 is 3, and its pixels cover 5/3.
//
// Source: williams1983; peachey2003, p. 60.
#ifndef BL_FILTERS_PYRAMID_H
#define BL_FILTERS_PYRAMID_H

#include <stddef.h>

#include "filters/filter.h"
#include "filters/summed_area.h"

typedef struct bl_pyramid bl_pyramid;

// Makes all levels down to one pixel. The image, rows of width pixels, row 0 first, is copied.
// Errors: BL_USAGE for an empty image, or for a filter whose steps do not end (sinc); BL_DEVICE out
// of memory. The caller frees it.
bl_status bl_pyramid_make(const float *values, size_t width, size_t height, const bl_filter *filter,
                          bl_continuation continuation, bl_pyramid **pyramid, bl_message *message);
void bl_pyramid_free(bl_pyramid *pyramid);

// How many levels there are, and the size of one (level 0 is the image).
size_t bl_pyramid_levels(const bl_pyramid *pyramid);
void bl_pyramid_size(const bl_pyramid *pyramid, size_t level, size_t *width, size_t *height);
// A pixel of a level; NaN past its end.
double bl_pyramid_pixel(const bl_pyramid *pyramid, size_t level, size_t i, size_t j);

// The value for a sample of this width, in pixels of the image, about (x, y); pixel (i, j) covers
// [i, i+1] x [j, j+1]. The level is log2(width): bilinear between the pixels of the two
// levels about it, linear between them. Up to width 1 it is the image itself between its pixels,
// beyond the last level its one pixel. NaN and infinite places and a NaN width give NaN.
// Thread-safe.
double bl_pyramid_value(const bl_pyramid *pyramid, double x, double y, double width);

#endif
