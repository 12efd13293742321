// SPDX-License-Identifier: MIT
//
// The energies of an image as a function of a continuous place: what lies within half a cycle per
// pixel, and what lies beyond and folds.
//
// An image is sampled on a grid of several samples a pixel, its border is faded by a Hann window
// (whose side lobes fall as the sixth power of the distance in bins, so that the jump from one
// border to the other does not read as alias), and transformed. Energies are mean squares, weighted
// by the square of the window: those of the middle of the image count most. A frequency of exactly
// half a cycle per pixel counts as beyond.
//
// What varies faster than the grid shows, as an edge does, comes into every coefficient. So there
// are several grids, each moved by a random part of a step. Foreign power has another random phase
// on each; the product of a coefficient on two grids is then on average the power that belongs
// there, and the total is the mean square whatever the grid. The energies are thus right on average
// for any image and any number of samples, and their spread over places is their whole error.
#ifndef BL_ALIASING_ENERGY_H
#define BL_ALIASING_ENERGY_H

#include <stddef.h>

#include "core/status.h"

// The transform of a windowed image: coefficients such that the sum of their squared sizes over all
// frequencies is the weighted mean square.
typedef struct bl_image_spectrum {
    size_t width, height; // of the image, pixels
    size_t oversample;    // samples a pixel along each axis
    double *coefficient;  // rows of width*oversample/2 + 1 complex numbers; owned
} bl_image_spectrum;

// Fills out[i] with the value of the image at (x[i], y[i]), in pixels.
typedef void (*bl_image_values)(const void *user, const double *x, const double *y, size_t count,
                                double *out);

// Samples the image at (x, y) = shift + ((i, j) + jitter) / oversample, minus `level`, in `threads`
// threads (0: all), and transforms it. Images of the same size and shift share their window, and
// below half a cycle per pixel their phases, whatever their oversampling and jitter, which is in
// steps, 0 <= jitter < 1. On success the caller ends with bl_image_spectrum_free. Errors:
// BL_MISMATCH for a size that the transform or the memory does not hold, and where the image is not
// finite; BL_DEVICE out of memory.
bl_status bl_image_spectrum_take(bl_image_values values, const void *user, size_t width,
                                 size_t height, size_t oversample, const double shift[2],
                                 const double jitter[2], double level, int threads,
                                 bl_image_spectrum *spectrum, bl_message *message);
void bl_image_spectrum_free(bl_image_spectrum *spectrum);

typedef struct bl_energies {
    double alias;        // of the sampled image, beyond half a cycle per pixel
    double blur;         // of its difference from the true one, within
    double within;       // of the sampled one, within
    double total;        // of the sampled one
    double first_alias;  // cycles per pixel at which the strongest alias shows: the distance of its
                         // frequency from the nearest whole ones; NAN without alias
    double strongest[2]; // that frequency itself, before it folds, cycles per pixel; NAN
} bl_energies;

enum { BL_IMAGE_GRIDS = 4 }; // at most

// Compares the image that a method gives with the true one, both on `grids` grids of the same
// size, shift, oversampling and jitters. With one grid the power beyond it is not told apart. Blur
// is a mean of products, and may fall below 0 by its error. An image that is the true one has a
// blur of 0.
//
// `ring` is the energy of the error, alias and blur together, by the distance of the frequency from
// 0 before anything folds: `rings` rings of equal width up to bl_image_highest, the last with all
// beyond the grid, which sum to alias + blur; none if `rings` is 0. Pure.
bl_energies bl_image_energies(const bl_image_spectrum *sampled, const bl_image_spectrum *truth,
                              size_t grids, size_t rings, double *ring);

// The highest frequency of a grid of so many samples a pixel, in its corners; cycles per pixel.
double bl_image_highest(size_t oversample);

#endif
