// SPDX-License-Identifier: MIT
//
// The kernels' definitions. The coefficients are those of the textbook formulas in
// noises/lattice/kernel.h multiplied out; t-kernel holds them to those formulas.
#include "noises/lattice/kernel.h"

#include <pthread.h>

#include "noises/lattice/kernel_tables.h"

// clang-format off
const bl_piecewise bl_kernel_shapes[BL_KERNEL_COUNT] = {
    [BL_KERNEL_CATMULL_ROM] = BL_PIECEWISE_CATMULL_ROM,
    [BL_KERNEL_LINEAR] = BL_PIECEWISE_TENT,
    [BL_KERNEL_SMOOTH] = {0, 1, {1}, {{1, 0, -3, 2}}},
    [BL_KERNEL_QUINTIC] = {0, 1, {1}, {{1, 0, 0, -10, 15, -6}}},
    [BL_KERNEL_BSPLINE2] = {0, 8, {0.5, 1.5}, {{6, 0, -8}, {9, -12, 4}}},
    [BL_KERNEL_BSPLINE3] = {0, 6, {1, 2}, {{4, 0, -6, 3}, {8, -12, 6, -1}}},
    [BL_KERNEL_RAMP_LINEAR] = {1, 1, {1}, {{0, 1, -1}}},
    [BL_KERNEL_RAMP_SMOOTH] = {1, 1, {1}, {{0, 1, 0, -3, 2}}},
    [BL_KERNEL_RAMP_QUINTIC] = {1, 1, {1}, {{0, 1, 0, 0, -10, 15, -6}}},
    [BL_KERNEL_TANGENT] = {1, 1, {1}, {{0, 1, -2, 1}}},
    [BL_KERNEL_RADIAL] = {1, 2, {1, 2}, {{0, 2, 0, -5, 3}, {0, 4, -8, 5, -1}}},
};
// clang-format on

int bl_kernel_is_odd(bl_kernel kernel) {
    return bl_kernel_shapes[kernel].odd;
}

double bl_kernel_support(bl_kernel kernel) {
    return bl_piecewise_support(&bl_kernel_shapes[kernel]);
}

int bl_kernel_continuity(bl_kernel kernel) {
    return bl_piecewise_continuity(&bl_kernel_shapes[kernel]);
}

double bl_kernel_value(bl_kernel kernel, double x) {
    return bl_piecewise_value(&bl_kernel_shapes[kernel], x);
}

double bl_kernel_transform(bl_kernel kernel, double f) {
    const bl_kernel_tables *tables = bl_kernel_get_tables();
    return bl_piecewise_transform(&bl_kernel_shapes[kernel], &tables->jumps[kernel], f);
}

static bl_kernel_tables tables;

static void fill_tables(void) {
    for (int k = 0; k < BL_KERNEL_COUNT; k++) {
        tables.jumps[k] = bl_piecewise_find_jumps(&bl_kernel_shapes[k]);
        bl_kernel_find_correlation((bl_kernel)k, &tables.correlation[k]);
    }
    bl_kernel_find_radial(&tables.correlation[BL_KERNEL_RADIAL], &tables.radial);
}

const bl_kernel_tables *bl_kernel_get_tables(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill_tables);
    return &tables;
}
