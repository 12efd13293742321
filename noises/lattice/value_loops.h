// SPDX-License-Identifier: MIT
//
// Value noise as loops that noises share: rows, points and the reference in double of
//
//   n(p) = sum over cells c of v_c k(x - c_x) k(y - c_y) k(z - c_z)
//
// for the kernels of vnoise's key `interp`. Between two planes every one of them is a cubic in the
// fraction; those of the quadratic B-spline lie at half integers, which the rows shift by 1/2 and
// the points reach with four weights of which one is 0.
#ifndef BL_NOISES_LATTICE_VALUE_LOOPS_H
#define BL_NOISES_LATTICE_VALUE_LOOPS_H

#include "noises/closed_forms.h"
#include "noises/lattice/reference.h"
#include "noises/lattice/separable.h"

typedef enum bl_interp {
    BL_INTERP_CATMULL_ROM,
    BL_INTERP_LINEAR,
    BL_INTERP_SMOOTH,
    BL_INTERP_BSPLINE2,
    BL_INTERP_BSPLINE3
} bl_interp;

static const char *const bl_value_interps[] = {"catmull-rom", "linear",   "smooth",
                                               "bspline2",    "bspline3", NULL};
static const bl_kernel bl_value_kernels[] = {BL_KERNEL_CATMULL_ROM, BL_KERNEL_LINEAR,
                                             BL_KERNEL_SMOOTH, BL_KERNEL_BSPLINE2,
                                             BL_KERNEL_BSPLINE3};

typedef struct bl_value_noise {
    bl_lattice lattice;
    bl_interp interp;
} bl_value_noise;

static inline bl_value_noise bl_value_noise_of(const bl_lattice_settings *lattice,
                                               uint32_t interp) {
    return (bl_value_noise){bl_lattice_open(lattice), (bl_interp)interp};
}

// How a kernel sits on the planes: in cells between planes shifted by `shift`, the planes from
// `first` on weigh sum_r coefficient[r][k] t^r.
typedef struct bl_interp_shape {
    double shift;
    int first, knots;
    float coefficient[4][BL_KNOTS];
} bl_interp_shape;

static const bl_interp_shape bl_interp_shapes[] = {
    {0, -1, 4, {{0, 1, 0, 0}, {-.5f, 0, .5f, 0}, {1, -2.5f, 2, -.5f}, {-.5f, 1.5f, -1.5f, .5f}}},
    {0, 0, 2, {{1, 0}, {-1, 1}, {0}, {0}}},
    {0, 0, 2, {{1, 0}, {0}, {-3, 3}, {2, -2}}},
    {.5, -1, 3, {{.5f, .5f, 0}, {-1, 1, 0}, {.5f, -1, .5f}, {0}}},
    {0,
     -1,
     4,
     {{1 / 6.f, 2 / 3.f, 1 / 6.f, 0},
      {-.5f, 0, .5f, 0},
      {.5f, -1, .5f, 0},
      {-1 / 6.f, .5f, -.5f, 1 / 6.f}}}};

// --- points -------------------------------------------------------------------------------------

// The weights of the planes for points; the quadratic B-spline's are those of the planes -1 to 2
// of the cell, of which the one farther than 3/2 has the weight 0.
static inline void bl_value_weights(bl_interp interp, const float *restrict fraction, size_t lanes,
                                    float (*restrict weight)[BL_BLOCK]) {
    if (interp == BL_INTERP_BSPLINE2) {
        for (int knot = 0; knot < 4; knot++)
#pragma omp simd
            for (size_t i = 0; i < lanes; i++) {
                float d = fabsf(fraction[i] - (float)(knot - 1));
                float rest = 1.5f - d > 0 ? 1.5f - d : 0;
                float inner = 0.75f - d * d, outer = 0.5f * rest * rest;
                weight[knot][i] = d < 0.5f ? inner : outer;
            }
        return;
    }
    const bl_interp_shape *shape = &bl_interp_shapes[interp];
    for (int knot = 0; knot < shape->knots; knot++) {
        float c0 = shape->coefficient[0][knot], c1 = shape->coefficient[1][knot],
              c2 = shape->coefficient[2][knot], c3 = shape->coefficient[3][knot];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            float t = fraction[i];
            weight[knot][i] = c0 + t * (c1 + t * (c2 + t * c3));
        }
    }
}

typedef float bl_value_weight_block[3][BL_KNOTS][BL_BLOCK];

// One point's keys and weights along x. Members by name: the compilers take such a struct apart
// and keep it in registers, which they do not with arrays.
typedef struct bl_value_x {
    uint32_t add0, add1, add2, add3, exclusive0, exclusive1, exclusive2, exclusive3;
    float w0, w1, w2, w3;
} bl_value_x;

BL_INLINE float bl_value_line(bl_value_x x, uint32_t add, uint32_t exclusive) {
    float v0 = bl_lattice_value((x.add0 + add) * (x.exclusive0 ^ exclusive));
    float v1 = bl_lattice_value((x.add1 + add) * (x.exclusive1 ^ exclusive));
    float v2 = bl_lattice_value((x.add2 + add) * (x.exclusive2 ^ exclusive));
    float v3 = bl_lattice_value((x.add3 + add) * (x.exclusive3 ^ exclusive));
    return (v0 * x.w0 + v1 * x.w1) + (v2 * x.w2 + v3 * x.w3);
}

BL_INLINE float bl_value_plane(bl_value_x x, const bl_axis_block *restrict y,
                               float (*restrict wy)[BL_BLOCK], uint32_t add, uint32_t exclusive,
                               size_t i) {
    float line0 = bl_value_line(x, y->add[0][i] + add, y->exclusive[0][i] ^ exclusive);
    float line1 = bl_value_line(x, y->add[1][i] + add, y->exclusive[1][i] ^ exclusive);
    float line2 = bl_value_line(x, y->add[2][i] + add, y->exclusive[2][i] ^ exclusive);
    float line3 = bl_value_line(x, y->add[3][i] + add, y->exclusive[3][i] ^ exclusive);
    return (line0 * wy[0][i] + line1 * wy[1][i]) + (line2 * wy[2][i] + line3 * wy[3][i]);
}

// lattice=hash with four planes an axis.
static inline void bl_value_block_of_64(const bl_point_block *restrict block,
                                        float (*restrict weight)[BL_KNOTS][BL_BLOCK],
                                        float *restrict out) {
    const bl_axis_block *restrict x = &block->axis[0], *restrict y = &block->axis[1],
                                  *restrict z = &block->axis[2];
    const size_t lanes = block->lanes;
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        const bl_value_x keys = {x->add[0][i],       x->add[1][i],       x->add[2][i],
                                 x->add[3][i],       x->exclusive[0][i], x->exclusive[1][i],
                                 x->exclusive[2][i], x->exclusive[3][i], weight[0][0][i],
                                 weight[0][1][i],    weight[0][2][i],    weight[0][3][i]};
        float plane0 = bl_value_plane(keys, y, weight[1], z->add[0][i], z->exclusive[0][i], i);
        float plane1 = bl_value_plane(keys, y, weight[1], z->add[1][i], z->exclusive[1][i], i);
        float plane2 = bl_value_plane(keys, y, weight[1], z->add[2][i], z->exclusive[2][i], i);
        float plane3 = bl_value_plane(keys, y, weight[1], z->add[3][i], z->exclusive[3][i], i);
        out[i] = (plane0 * weight[2][0][i] + plane1 * weight[2][1][i]) +
                 (plane2 * weight[2][2][i] + plane3 * weight[2][3][i]);
    }
}

// Any lattice and any number of planes.
static inline void bl_value_block_of_any(const bl_point_block *restrict block,
                                         float (*restrict weight)[BL_KNOTS][BL_BLOCK],
                                         float *restrict out) {
    const int knots = block->knots;
    uint32_t words[BL_BLOCK];
    memset(out, 0, BL_BLOCK * sizeof *out);
    for (int corner = 0; corner < knots * knots * knots; corner++) {
        const int knot[3] = {corner % knots, corner / knots % knots, corner / knots / knots};
        const float *restrict wx = weight[0][knot[0]], *restrict wy = weight[1][knot[1]],
                              *restrict wz = weight[2][knot[2]];
        bl_point_block_words(block, knot, 0, words);
#pragma omp simd
        for (size_t i = 0; i < block->lanes; i++)
            out[i] += bl_lattice_value(words[i]) * (wx[i] * wy[i] * wz[i]);
    }
}

static inline void bl_value_points(const bl_value_noise *noise, const double *const at[BL_AXES],
                                   size_t count, float *out) {
    const bl_interp_shape *shape = &bl_interp_shapes[noise->interp];
    bl_point_block block;
    bl_value_weight_block weight;
    float value[BL_BLOCK];
    bl_point_block_begin(&block, &noise->lattice, shape->first, shape->knots == 2 ? 2 : 4);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        for (unsigned axis = 0; axis < 3; axis++)
            bl_value_weights(noise->interp, block.axis[axis].fraction, block.lanes, weight[axis]);
        if (block.knots == 4 && noise->lattice.kind == BL_LATTICE_HASH)
            bl_value_block_of_64(&block, weight, value);
        else
            bl_value_block_of_any(&block, weight, value);
        bl_point_block_store(&block, value, (float)BL_LATTICE_UNIT, here, out + done);
    }
}

static inline void bl_value_points_function(const void *noise, const double *const at[BL_AXES],
                                            size_t count, float *out) {
    bl_value_points(noise, at, count, out);
}

// --- rows ---------------------------------------------------------------------------------------

static inline double bl_value_weight(const bl_interp_shape *shape, int knot, double t) {
    return shape->coefficient[0][knot] +
           t * ((double)shape->coefficient[1][knot] +
                t * ((double)shape->coefficient[2][knot] + t * shape->coefficient[3][knot]));
}

// What a row knows once: the shape, the planes across and their weights.
typedef struct bl_value_row_plan {
    const bl_interp_shape *shape;
    bl_row_cross cross;
    float weight[2][BL_KNOTS]; // those of the second axis in units of 2^-31
    uint32_t words256[256];
    int hashed;
} bl_value_row_plan;

// Adds a line of lattice points across, four at a time, to the values of a row's planes.
static inline void bl_value_row_add_line(const bl_row_block *restrict block,
                                         const bl_value_row_plan *restrict plan, int k,
                                         const uint32_t *restrict add,
                                         const uint32_t *restrict exclusive,
                                         float *restrict plane) {
    uint32_t plus[BL_KNOTS] = {0}, exor[BL_KNOTS] = {0};
    float weight[BL_KNOTS] = {0};
    for (int j = 0; j < plan->shape->knots; j++) {
        plus[j] = plan->cross.key[0][j].add + plan->cross.key[1][k].add;
        exor[j] = plan->cross.key[0][j].exclusive ^ plan->cross.key[1][k].exclusive;
        weight[j] = plan->weight[0][j] * plan->weight[1][k];
    }
    const uint32_t plus0 = plus[0], plus1 = plus[1], plus2 = plus[2], plus3 = plus[3];
    const uint32_t exor0 = exor[0], exor1 = exor[1], exor2 = exor[2], exor3 = exor[3];
    const float w0 = weight[0], w1 = weight[1], w2 = weight[2], w3 = weight[3];
#pragma omp simd
    for (size_t m = 0; m < block->lanes; m++) {
        float v0 = bl_lattice_value((add[m] + plus0) * (exclusive[m] ^ exor0));
        float v1 = bl_lattice_value((add[m] + plus1) * (exclusive[m] ^ exor1));
        float v2 = bl_lattice_value((add[m] + plus2) * (exclusive[m] ^ exor2));
        float v3 = bl_lattice_value((add[m] + plus3) * (exclusive[m] ^ exor3));
        plane[m] += (v0 * w0 + v1 * w1) + (v2 * w2 + v3 * w3);
    }
}

static inline void bl_value_row_add_256(const bl_row_block *restrict block,
                                        const bl_value_row_plan *restrict plan, int k,
                                        float *restrict plane) {
    uint32_t words[BL_PLANES];
    for (int j = 0; j < plan->shape->knots; j++) {
        float weight = plan->weight[0][j] * plan->weight[1][k];
        bl_row_words256(block, &plan->cross, plan->words256, plan->shape->first, j, k, words);
#pragma omp simd
        for (size_t m = 0; m < block->lanes; m++)
            plane[m] += bl_lattice_value(words[m]) * weight;
    }
}

// The values of a row's planes: what interpolation across leaves.
static inline void bl_value_row_planes(const bl_row_block *restrict block,
                                       const bl_value_row_plan *restrict plan,
                                       const bl_lattice *lattice, float *restrict plane) {
    uint32_t add[BL_PLANES], exclusive[BL_PLANES];
    bl_row_keys(block, lattice, plan->cross.axis, plan->shape->first, add, exclusive);
    memset(plane, 0, block->lanes * sizeof *plane);
    for (int k = 0; k < plan->shape->knots; k++)
        if (plan->hashed)
            bl_value_row_add_line(block, plan, k, add, exclusive, plane);
        else
            bl_value_row_add_256(block, plan, k, plane);
}

// One coefficient of the cubics of a row's cells, from the values of the planes left of them, at
// them and right of them. Four pointers and no inlining: else clang 14 reuses the loads of one cell
// for the next and cannot vectorise.
static __attribute__((noinline)) void
bl_value_row_coefficient(size_t cells, const float weight[BL_KNOTS], const float *plane0,
                         const float *plane1, const float *plane2, const float *plane3,
                         float *restrict out) {
    const float w0 = weight[0], w1 = weight[1], w2 = weight[2], w3 = weight[3];
#pragma omp simd
    for (size_t m = 0; m < cells; m++)
        out[m] = (w0 * plane0[m] + w1 * plane1[m]) + (w2 * plane2[m] + w3 * plane3[m]);
}

static inline int bl_value_row_prepare(bl_value_row_plan *plan, const bl_value_noise *noise,
                                       unsigned axis, const double start[BL_AXES]) {
    const bl_interp_shape *shape = &bl_interp_shapes[noise->interp];
    plan->shape = shape;
    plan->hashed = noise->lattice.kind == BL_LATTICE_HASH;
    if (!plan->hashed)
        bl_perm256_words(&noise->lattice, 0, plan->words256);
    if (!bl_row_cross_load(&plan->cross, &noise->lattice, axis, start, shape->first, shape->knots,
                           shape->shift))
        return 0;
    for (int b = 0; b < 2; b++)
        for (int knot = 0; knot < shape->knots; knot++)
            plan->weight[b][knot] = (float)(bl_value_weight(shape, knot, plan->cross.fraction[b]) *
                                            (b == 1 ? BL_LATTICE_UNIT : 1));
    return 1;
}

// A row from its sample `first` on. A plane costs 16 lattice points where a point costs 64, so the
// row pays up to 2 cells a sample.
static inline void bl_value_row(const bl_value_noise *noise, const double start[BL_AXES],
                                const double step[BL_AXES], size_t first, size_t count,
                                float *out) {
    bl_value_row_plan plan;
    bl_row_block block;
    float plane[BL_PLANES], cubic[4][BL_PLANES];
    int axis = bl_row_axis(step, 2);
    if (axis < 0 || !bl_value_row_prepare(&plan, noise, (unsigned)axis, start)) {
        bl_row_by_points(bl_value_points_function, noise, start, step, first, count, out);
        return;
    }
    for (size_t done = 0; done < count; done += block.count) {
        if (!bl_row_block_load(&block, start[axis], step[axis], first + done, count - done,
                               plan.shape->shift)) {
            bl_row_nan(&block, out + done);
            continue;
        }
        bl_value_row_planes(&block, &plan, &noise->lattice, plane);
        for (int r = 0; r < 4; r++)
            bl_value_row_coefficient(block.cells, plan.shape->coefficient[r], plane, plane + 1,
                                     plane + 2, plane + 3, cubic[r]);
        bl_row_evaluate(&block, bl_row_cubic, cubic, block.fraction, out + done);
    }
}

// --- the reference in double --------------------------------------------------------------------

// The kernel and its derivative at a distance, straight from the definitions.
static inline double bl_interp_kernel(bl_interp interp, double x, double *slope) {
    double d = fabs(x), sign = x < 0 ? -1 : 1, k = 0, s = 0;
    switch (interp) {
    case BL_INTERP_CATMULL_ROM:
        if (d < 1) {
            k = 1 + d * d * (1.5 * d - 2.5);
            s = d * (4.5 * d - 5);
        } else if (d < 2) {
            k = 2 + d * (-4 + d * (2.5 - 0.5 * d));
            s = -4 + d * (5 - 1.5 * d);
        }
        break;
    case BL_INTERP_LINEAR:
        if (d < 1) {
            k = 1 - d;
            s = -1;
        }
        break;
    case BL_INTERP_SMOOTH:
        if (d < 1) {
            k = 1 - d * d * (3 - 2 * d);
            s = 6 * d * (d - 1);
        }
        break;
    case BL_INTERP_BSPLINE2:
        if (d < 0.5) {
            k = 0.75 - d * d;
            s = -2 * d;
        } else if (d < 1.5) {
            k = 0.5 * (1.5 - d) * (1.5 - d);
            s = d - 1.5;
        }
        break;
    case BL_INTERP_BSPLINE3:
        if (d < 1) {
            k = 2.0 / 3 + d * d * (0.5 * d - 1);
            s = d * (1.5 * d - 2);
        } else if (d < 2) {
            k = (2 - d) * (2 - d) * (2 - d) / 6;
            s = -(2 - d) * (2 - d) / 2;
        }
        break;
    }
    *slope = sign * s;
    return k;
}

// The kernel and its derivative at the planes -1 to 2 of a cell, along each axis.
typedef struct bl_value_kernels_at {
    double value[BL_AXES][BL_KNOTS], slope[BL_AXES][BL_KNOTS];
} bl_value_kernels_at;

// 0 for a place that is in no cell.
static inline int bl_value_reference_load(const bl_value_noise *noise, unsigned dimensions,
                                          const double at[BL_AXES], bl_reference_cells *cells,
                                          bl_value_kernels_at *kernels) {
    if (!bl_reference_cells_load(cells, &noise->lattice, dimensions, at, -1, BL_KNOTS))
        return 0;
    for (unsigned a = 0; a < dimensions; a++)
        for (int k = 0; k < BL_KNOTS; k++)
            kernels->value[a][k] = bl_interp_kernel(noise->interp, cells->fraction[a] - (k - 1),
                                                    &kernels->slope[a][k]);
    return 1;
}

// The value at a point and, if `gradient` is not NULL, its gradient.
static inline double bl_value_reference(const bl_value_noise *noise, const double at[BL_AXES],
                                        double gradient[BL_AXES]) {
    bl_reference_cells cells;
    bl_value_kernels_at kernels;
    double sum = 0, slopes[BL_AXES] = {0};
    int inside = bl_value_reference_load(noise, 3, at, &cells, &kernels);
    for (unsigned corner = 0; inside && corner < 64; corner++) {
        const unsigned knot[BL_AXES] = {corner & 3, corner >> 2 & 3, corner >> 4};
        const double k[3] = {kernels.value[0][knot[0]], kernels.value[1][knot[1]],
                             kernels.value[2][knot[2]]};
        if (!gradient && (k[0] == 0 || k[1] == 0 || k[2] == 0))
            continue; // adding a zero of either sign leaves the sum, which began as +0
        double v = bl_lattice_value(bl_reference_word(&cells, knot, 0)) * BL_LATTICE_UNIT;
        sum += v * k[0] * k[1] * k[2];
        if (!gradient)
            continue;
        slopes[0] += v * kernels.slope[0][knot[0]] * k[1] * k[2];
        slopes[1] += v * k[0] * kernels.slope[1][knot[1]] * k[2];
        slopes[2] += v * k[0] * k[1] * kernels.slope[2][knot[2]];
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

#endif
