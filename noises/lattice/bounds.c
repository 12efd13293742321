// SPDX-License-Identifier: MIT
//
// Hard bounds of the range, in exact arithmetic: the lattice numbers at the worst place with the
// worst signs. A row in float may pass a bound by its rounding, below 1e-6.
//
// Value noise. |n| < product over the axes of max_t sum_c |k(t - c)|, and values are below 1 in
// size. Kernels without negative lobes sum to 1. For Catmull-Rom the lobes at t add up to
// t (1-t)^2/2 + t^2 (1-t)/2 = t (1-t)/2, and the sum of sizes is 1 + t (1-t) <= 5/4.
//
// Gradient noise. |n| <= sum_c w_c max_g |g . d_c|. For unit vectors the maximum is |d_c|, and
// since the weights sum to 1 the square of the sum is at most sum_c w_c |d_c|^2 = sum over the axes
// of e(t) = w(t) t^2 + w(1-t) (1-t)^2. With c = 1-2t and w = (1+q)/2, e = (1 + c^2 - 2qc)/4, and 2q
// >= c: for the linear fade q = c, for the cubic q = c (3-c^2)/2, for the quintic q = c (15 - 10c^2
// + 3c^4)/8, and c^2 <= 1. So e <= 1/4, the bound is sqrt(3)/2, and it is reached in the middle of
// the cell. For the edges of the cube the maximum is the sum of the two largest |d_a|; the middle
// gives 1 and is not the worst.
//
// In d dimensions. Value noise: the sum of sizes to the power d. Unit gradients: d axes have
// e <= 1/4 each, so the bound is sqrt(d)/2, again reached in the middle; in one dimension numbers
// below 1 in size serve as unit vectors. The edges: +-1 in one dimension, as before 1/2; the
// diagonals in two, whose maximum is |d_x| + |d_y|: each axis adds at most the root of its e, 1/2;
// the 32 edges in four, of length sqrt(3): sqrt(3) times the bound of unit vectors, not reached
// (the middle has 3/2). Rounded up by 1e-5 where the number is exact, because rows in float may
// round past it.
//
// Hermite noise. sum_c h0 h0 h0 = 1, and the tangents of one axis add h1(t) + h1(1-t) = t (1-t)
// <= 1/4: 1 + 3/4, reached in the middle.
//
// Convolution noises. sum_c |K(|x-c|)| over the lattice points; for impulses anywhere in their
// cells, the largest |K| in each cell, summed over the cells: N impulses of size below 1 in a cell,
// divided by N, add at most that for every N. A table of squared distances, N entries a unit,
// rounds the squared distance by at most 1/(2N); K falls by at most 5/2 of it below r = 1 and by
// 1/4 of it beyond.
//
// The constants were found by a grid and random steps uphill from its best point, and rounded up in
// the third digit; t-bounds certifies each by branch and bound:
//   edges, linear fade   1.0648281623  at (0.260, 0.463, 0.5)
//   edges, cubic fade    1.0449051896  at (0.324, 0.476, 0.5)
//   edges, quintic fade  1.0363538112  at (0.355, 0.481, 0.5)
//   lattice convolution  2.2819966495  at (0.136, 0.136, 0.136)
//   sparse convolution   11.811856421  at (0, 0, 0.5)
#include <math.h>

#include "noises/closed_forms.h"

bl_bound bl_bound_value(bl_kernel kernel) {
    if (kernel == BL_KERNEL_CATMULL_ROM)
        return (bl_bound){1.953125,
                          "values below 1; the sizes of the spline's weights sum to at "
                          "most 5/4 along each axis: (5/4)^3"};
    return (bl_bound){1, "values below 1; weights are not negative and sum to 1"};
}

bl_bound bl_bound_gradient(bl_kernel weight, int edges) {
    if (!edges)
        return (bl_bound){0.86603,
                          "unit gradients; the mean of |d| over the corners is at most the "
                          "root of the mean of d^2, sqrt(3)/2, reached in the middle"};
    double most = weight == BL_KERNEL_LINEAR ? 1.07 : weight == BL_KERNEL_SMOOTH ? 1.05 : 1.04;
    return (bl_bound){most,
                      "the sum over the corners of weight times the two largest |d|, certified "
                      "over the cell by branch and bound"};
}

bl_bound bl_bound_value_in(bl_kernel kernel, unsigned dimensions) {
    if (kernel == BL_KERNEL_CATMULL_ROM && dimensions != 3)
        return (bl_bound){pow(1.25, dimensions),
                          "values below 1; the sizes of the spline's weights sum to at most 5/4 "
                          "along each axis: 5/4 to the power of the dimensions"};
    return bl_bound_value(kernel);
}

bl_bound bl_bound_gradient_in(bl_kernel weight, int edges, unsigned dimensions) {
    static const double unit[] = {0, 0.50001, 0.70711, 0, 1.00001};
    if (dimensions == 3)
        return bl_bound_gradient(weight, edges);
    if (!edges || dimensions == 1)
        return (bl_bound){unit[dimensions],
                          "gradients of length 1 at most; the mean of |d| over the corners is at "
                          "most the root of the mean of d^2, half the root of the dimensions"};
    if (dimensions == 2)
        return (bl_bound){1.00001,
                          "|g . d| = |d_x| + |d_y| at most for the diagonals, and the mean of "
                          "either over the corners is at most 1/2"};
    return (bl_bound){1.73206,
                      "gradients of length sqrt(3); the mean of |d| over the corners is at most "
                      "the root of the mean of d^2, which is 1"};
}

bl_bound bl_bound_hermite(void) {
    return (bl_bound){1.75,
                      "values and tangents below 1; 1 from the values and t(1-t) <= 1/4 from "
                      "the tangents of each axis"};
}

bl_bound bl_bound_lattice_convolution(unsigned table) {
    // Within 1 of a place there are at most 8 lattice points, of 64 in all.
    double rounding = table ? (8 * 1.25 + 56 * 0.125) / table : 0;
    return (bl_bound){2.29 + rounding,
                      "values below 1; the sum of |K| over the lattice points, "
                      "certified over the cell by branch and bound"};
}

bl_bound bl_bound_sparse_convolution(unsigned table) {
    // Within 1 of a place there are points of at most 27 cells, of 125 in all.
    double rounding = table ? (27 * 1.25 + 98 * 0.125) / table : 0;
    return (bl_bound){11.83 + rounding,
                      "amplitudes below 1; the sum over the cells of the largest "
                      "|K| in each, certified by branch and bound"};
}

int bl_lattice_has_closed_form(const void *block) {
    return bl_lattice_is_hash(block);
}

void bl_lattice_describe(bl_bound bound, int continuity, const bl_lattice_settings *lattice,
                         bl_facts *facts) {
    facts->lower = -bound.value;
    facts->upper = bound.value;
    facts->bound_proof = bound.proof;
    facts->continuity = continuity;
    for (int axis = 0; axis < BL_AXES; axis++) {
        uint32_t period = lattice->period[axis];
        if (lattice->kind == BL_LATTICE_PERM256 && period % 256 == 0)
            period = 256; // of the index of the text, whose argument is taken modulo 256
        facts->period[axis] = period;
    }
    facts->cell = 1;
    facts->far = 0x1p52; // from here on doubles are whole numbers
}
