// SPDX-License-Identifier: MIT
//
// How two images differ: squared and largest error, peak signal to noise, structural similarity.
// All functions are pure; images are `width` x `height` luminances, row by row.
#ifndef BL_ALIASING_METRICS_H
#define BL_ALIASING_METRICS_H

#include <stddef.h>

#include "core/statistics.h"

typedef struct bl_image_error {
    double mse;     // mean squared error
    double largest; // largest absolute error
} bl_image_error;

bl_image_error bl_image_compare(const double *image, const double *reference, size_t count);

// 10 log10(1 / mse): of a full scale of 1; INFINITY for no error.
double bl_psnr_db(double mse);

// The mean structural similarity of a full scale of 1, over all places of a Gaussian window of 11 x
// 11 pixels with a standard deviation of 1.5, which lies wholly within the image; K1 = 0.01, K2 =
// 0.03 (Wang, Bovik, Sheikh and Simoncelli 2004). NaN for an image that is smaller than the window.
// The interval is that of a mean over places; those one window apart count as independent.
bl_estimate bl_ssim(const double *image, const double *reference, size_t width, size_t height,
                    double level);

#endif
