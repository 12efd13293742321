// SPDX-License-Identifier: MIT
//
// Finds jumps of derivatives in samples of a line.
//
// On a line of samples h apart, the difference of order k+1 divided by h^k is of size h times the
// derivative of order k+1 where there is one, and of the size of the jump where the derivative of
// order k jumps. From 8 h to h the largest of a line shrinks to an eighth, or stays. On ten times
// as many lines as here it shrank to 0.23 at most, or stayed above 0.48; the limit is the root of
// 1/8.
#ifndef BL_TESTS_JUMPS_H
#define BL_TESTS_JUMPS_H

#include <math.h>
#include <stddef.h>

enum { BL_JUMP_FINER = 8, BL_JUMP_ORDERS = 4 };

static inline double bl_largest_difference(const double *value, size_t count, size_t stride,
                                           unsigned order) {
    static const double binomial[BL_JUMP_ORDERS][BL_JUMP_ORDERS + 1] = {
        {-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}, {1, -4, 6, -4, 1}};
    double largest = 0;
    for (size_t i = 0; i + (order + 1) * stride < count; i++) {
        double difference = 0;
        for (unsigned k = 0; k <= order + 1; k++)
            difference += binomial[order][k] * value[i + k * stride];
        largest = fmax(largest, fabs(difference));
    }
    return largest / pow((double)stride, order);
}

// Whether the derivative of this order jumps somewhere on the line. Differences of the size of the
// rounding of the values, as those of a noise whose waves are long, say nothing.
static inline int bl_jumps(const double *value, size_t count, unsigned order) {
    double size = 0, fine = bl_largest_difference(value, count, 1, order);
    for (size_t i = 0; i < count; i++)
        size = fmax(size, fabs(value[i]));
    // The sum of the binomials is 16 at most; 256 is for the rounding of phases and places.
    return fine > 256 * 16 * 0x1p-52 * size &&
           !(bl_largest_difference(value, count, BL_JUMP_FINER, order) >
             sqrt(BL_JUMP_FINER) * fine);
}

#endif
