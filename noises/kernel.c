// SPDX-License-Identifier: MIT
//
// The kernels' definitions, values and jumps. The coefficients are those of the textbook formulas
// in noises/kernel.h multiplied out; t-kernel holds them to those formulas.
#include "noises/kernel.h"

#include <math.h>
#include <pthread.h>

#include "noises/kernel_tables.h"

// clang-format off
const bl_kernel_shape bl_kernel_shapes[BL_KERNEL_COUNT] = {
    [BL_KERNEL_CATMULL_ROM] = {"catmull-rom", 0, 2, {1, 2}, {{2, 0, -5, 3}, {4, -8, 5, -1}}},
    [BL_KERNEL_LINEAR] = {"linear", 0, 1, {1}, {{1, -1}}},
    [BL_KERNEL_SMOOTH] = {"smooth", 0, 1, {1}, {{1, 0, -3, 2}}},
    [BL_KERNEL_QUINTIC] = {"quintic", 0, 1, {1}, {{1, 0, 0, -10, 15, -6}}},
    [BL_KERNEL_BSPLINE2] = {"bspline2", 0, 8, {0.5, 1.5}, {{6, 0, -8}, {9, -12, 4}}},
    [BL_KERNEL_BSPLINE3] = {"bspline3", 0, 6, {1, 2}, {{4, 0, -6, 3}, {8, -12, 6, -1}}},
    [BL_KERNEL_RAMP_LINEAR] = {"ramp linear", 1, 1, {1}, {{0, 1, -1}}},
    [BL_KERNEL_RAMP_SMOOTH] = {"ramp smooth", 1, 1, {1}, {{0, 1, 0, -3, 2}}},
    [BL_KERNEL_RAMP_QUINTIC] = {"ramp quintic", 1, 1, {1}, {{0, 1, 0, 0, -10, 15, -6}}},
    [BL_KERNEL_TANGENT] = {"tangent", 1, 1, {1}, {{0, 1, -2, 1}}},
    [BL_KERNEL_RADIAL] = {"radial ramp", 1, 2, {1, 2}, {{0, 2, 0, -5, 3}, {0, 4, -8, 5, -1}}},
};
// clang-format on

int bl_kernel_is_odd(bl_kernel kernel) {
    return bl_kernel_shapes[kernel].odd;
}

double bl_polynomial(const double *coefficient, int orders, double x) {
    double sum = 0;
    for (int i = orders - 1; i >= 0; i--)
        sum = sum * x + coefficient[i];
    return sum;
}

static int piece_count(const bl_kernel_shape *shape) {
    return shape->knot[1] > 0 ? 2 : 1;
}

double bl_kernel_support(bl_kernel kernel) {
    const bl_kernel_shape *shape = &bl_kernel_shapes[kernel];
    return shape->knot[piece_count(shape) - 1];
}

double bl_kernel_value(bl_kernel kernel, double x) {
    const bl_kernel_shape *shape = &bl_kernel_shapes[kernel];
    double size = fabs(x);
    for (int i = 0; i < piece_count(shape); i++)
        if (size < shape->knot[i]) {
            double value =
                bl_polynomial(shape->coefficient[i], BL_KERNEL_ORDERS, size) / shape->divisor;
            return shape->odd && x < 0 ? -value : value;
        }
    return isnan(x) ? x : 0;
}

// The m-th derivative at x of a polynomial with whole coefficients.
static double derivative(const double *coefficient, int m, double x) {
    double sum = 0;
    for (int i = BL_KERNEL_ORDERS - 1; i >= m; i--) {
        double falling = 1; // i (i-1) ... (i-m+1)
        for (int j = 0; j < m; j++)
            falling *= i - j;
        sum = sum * x + falling * coefficient[i];
    }
    return sum;
}

bl_kernel_jumps bl_kernel_find_jumps(bl_kernel kernel) {
    const bl_kernel_shape *shape = &bl_kernel_shapes[kernel];
    int pieces = piece_count(shape);
    bl_kernel_jumps jumps = {.count = pieces + 1};
    for (int m = 0; m < BL_KERNEL_ORDERS; m++) {
        // Left of 0 the m-th derivative is (-1)^m times the right one, and an odd kernel turns it.
        int flips = (m & 1) != shape->odd;
        jumps.jump[0][m] = flips ? 2 * derivative(shape->coefficient[0], m, 0) : 0;
        for (int i = 0; i < pieces; i++) {
            double x = shape->knot[i];
            double right = i + 1 < pieces ? derivative(shape->coefficient[i + 1], m, x) : 0;
            jumps.knot[i + 1] = x;
            jumps.jump[i + 1][m] = right - derivative(shape->coefficient[i], m, x);
        }
    }
    return jumps;
}

int bl_kernel_continuity(bl_kernel kernel) {
    bl_kernel_jumps jumps = bl_kernel_find_jumps(kernel);
    for (int m = 0; m < BL_KERNEL_ORDERS; m++)
        for (int i = 0; i < jumps.count; i++)
            if (jumps.jump[i][m] != 0)
                return m - 1;
    return BL_KERNEL_ORDERS;
}

static bl_kernel_tables tables;

static void fill_tables(void) {
    for (int k = 0; k < BL_KERNEL_COUNT; k++) {
        tables.jumps[k] = bl_kernel_find_jumps((bl_kernel)k);
        bl_kernel_find_correlation((bl_kernel)k, &tables.correlation[k]);
    }
    bl_kernel_find_radial(&tables.correlation[BL_KERNEL_RADIAL], &tables.radial);
}

const bl_kernel_tables *bl_kernel_get_tables(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill_tables);
    return &tables;
}
