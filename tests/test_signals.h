// SPDX-License-Identifier: MIT
//
// Signals whose spectrum, covariance and distribution are known exactly, for the tests of the
// analyses. The caller frees each with bl_signal_free.
#ifndef BL_TESTS_TEST_SIGNALS_H
#define BL_TESTS_TEST_SIGNALS_H

#include "core/signal.h"

// Standard normal numbers, independent from sample to sample: a hash of the coordinates' bits.
bl_signal *bl_test_white(uint64_t seed);

// The same on a grid of width x height samples at a spacing; height 0: a grid of one axis.
bl_signal *bl_test_white_image(uint64_t seed, size_t width, size_t height, double spacing);

// On a grid: each row repeats the one above it for `repeat` rows.
bl_signal *bl_test_streaky_image(uint64_t seed, size_t width, size_t height, size_t repeat);

// mean + amplitude cos(2 pi f . p + phase), the phase drawn from the seed. The variance over phases
// is amplitude^2 / 2.
bl_signal *bl_test_cosine(double mean, double amplitude, const double frequency[3]);

// White noise on a lattice of one number a cell along x, joined by the hat kernel: covariance
// (the cubic B-spline) in closed form, variance 2/3; stationarised over places.
bl_signal *bl_test_hat(uint64_t seed);

// White noise times a gain that the seed draws from {1 - depth, 1 + depth}: all bins of one average
// share a random variance.
bl_signal *bl_test_flicker(double depth);

// The inner signal, which stays the caller's, seen through a function of it and the place. It
// states nothing, and its seed is fixed.
typedef double bl_test_view(const bl_signal *inner, const double at[BL_AXES]);
bl_signal *bl_test_seen_through(const bl_signal *inner, bl_test_view *view);

// A signal around a copy of the block, built, that draws from the seed at the offset. It has three
// axes, and states a cell of 1 and nothing else.
bl_signal *bl_test_built(const bl_signal_functions *functions, const void *block, size_t size,
                         size_t seed_offset, const char *text);

// A constant; and a signal that is not finite where x > 0.
bl_signal *bl_test_constant(double value);
bl_signal *bl_test_broken(void);

#endif
