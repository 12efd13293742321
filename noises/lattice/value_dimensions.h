// SPDX-License-Identifier: MIT
//
// Value noise in one, two and four dimensions: rows, points and the reference in double of
//
//   n(p) = sum over cells c of v_c prod_a k(p_a - c_a),  a < d
//
// with the kernels of value_loops.h, which has three dimensions. A point costs 4^d or 2^d lattice
// points, a plane across a row 4^(d-1), 3^(d-1) or 2^(d-1).
#ifndef BL_NOISES_LATTICE_VALUE_DIMENSIONS_H
#define BL_NOISES_LATTICE_VALUE_DIMENSIONS_H

#include "noises/lattice/separable_dimensions.h"
#include "noises/lattice/value_loops.h"

// --- points -------------------------------------------------------------------------------------

BL_INLINE bl_value_x bl_value_x_of(const bl_axis_block *restrict x, float (*restrict w)[BL_BLOCK],
                                   size_t i) {
    return (bl_value_x){x->add[0][i],
                        x->add[1][i],
                        x->add[2][i],
                        x->add[3][i],
                        x->exclusive[0][i],
                        x->exclusive[1][i],
                        x->exclusive[2][i],
                        x->exclusive[3][i],
                        w[0][i],
                        w[1][i],
                        w[2][i],
                        w[3][i]};
}

static inline void bl_value_block_of_4(const bl_point_block *restrict block,
                                       float (*restrict weight)[BL_KNOTS][BL_BLOCK],
                                       float *restrict out) {
    const bl_lattice_key rest = bl_lattice_rest(block->lattice, 1, 0);
    const bl_axis_block *restrict x = &block->axis[0];
#pragma omp simd
    for (size_t i = 0; i < block->lanes; i++)
        out[i] = bl_value_line(bl_value_x_of(x, weight[0], i), rest.add, rest.exclusive);
}

static inline void bl_value_block_of_16(const bl_point_block *restrict block,
                                        float (*restrict weight)[BL_KNOTS][BL_BLOCK],
                                        float *restrict out) {
    const bl_lattice_key rest = bl_lattice_rest(block->lattice, 2, 0);
    const bl_axis_block *restrict x = &block->axis[0], *restrict y = &block->axis[1];
#pragma omp simd
    for (size_t i = 0; i < block->lanes; i++)
        out[i] = bl_value_plane(bl_value_x_of(x, weight[0], i), y, weight[1], rest.add,
                                rest.exclusive, i);
}

static inline void bl_value_block_of_256(const bl_point_block *restrict block,
                                         float (*restrict weight)[BL_KNOTS][BL_BLOCK],
                                         float *restrict out) {
    const bl_axis_block *restrict x = &block->axis[0], *restrict y = &block->axis[1],
                                  *restrict z = &block->axis[2], *restrict w = &block->axis[3];
    memset(out, 0, BL_BLOCK * sizeof *out);
    for (int n = 0; n < 16; n++) {
        const uint32_t *restrict add_z = z->add[n & 3], *restrict add_w = w->add[n >> 2];
        const uint32_t *restrict exclusive_z = z->exclusive[n & 3], *restrict exclusive_w =
                                                                        w->exclusive[n >> 2];
        const float *restrict wz = weight[2][n & 3], *restrict ww = weight[3][n >> 2];
#pragma omp simd
        for (size_t i = 0; i < block->lanes; i++) {
            float plane = bl_value_plane(bl_value_x_of(x, weight[0], i), y, weight[1],
                                         add_z[i] + add_w[i], exclusive_z[i] ^ exclusive_w[i], i);
            out[i] += plane * (wz[i] * ww[i]);
        }
    }
}

// Any lattice and any number of planes.
static inline void bl_value_block_in(const bl_point_block *restrict block,
                                     float (*restrict weight)[BL_KNOTS][BL_BLOCK],
                                     float *restrict out) {
    uint32_t words[BL_BLOCK];
    float product[BL_BLOCK];
    int corners = 1;
    for (unsigned axis = 0; axis < block->dimensions; axis++)
        corners *= block->knots;
    memset(out, 0, BL_BLOCK * sizeof *out);
    for (int corner = 0; corner < corners; corner++) {
        int knot[BL_AXES] = {0}, rest = corner;
        for (unsigned axis = 0; axis < block->dimensions; axis++, rest /= block->knots) {
            knot[axis] = rest % block->knots;
            const float *restrict w = weight[axis][knot[axis]];
#pragma omp simd
            for (size_t i = 0; i < block->lanes; i++)
                product[i] = axis ? product[i] * w[i] : w[i];
        }
        bl_point_block_words_in(block, knot, 0, words);
#pragma omp simd
        for (size_t i = 0; i < block->lanes; i++)
            out[i] += bl_lattice_value(words[i]) * product[i];
    }
}

static inline void bl_value_points_in(const bl_value_noise *noise, unsigned dimensions,
                                      const double *const at[BL_AXES], size_t count, float *out) {
    const bl_interp_shape *shape = &bl_interp_shapes[noise->interp];
    bl_point_block block;
    float weight[BL_AXES][BL_KNOTS][BL_BLOCK], value[BL_BLOCK];
    bl_point_block_begin_in(&block, &noise->lattice, dimensions, shape->first,
                            shape->knots == 2 ? 2 : 4);
    const int fast = block.knots == 4 && noise->lattice.kind == BL_LATTICE_HASH;
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        for (unsigned axis = 0; axis < dimensions; axis++)
            bl_value_weights(noise->interp, block.axis[axis].fraction, block.lanes, weight[axis]);
        if (!fast)
            bl_value_block_in(&block, weight, value);
        else if (dimensions == 1)
            bl_value_block_of_4(&block, weight, value);
        else if (dimensions == 2)
            bl_value_block_of_16(&block, weight, value);
        else
            bl_value_block_of_256(&block, weight, value);
        bl_point_block_store(&block, value, (float)BL_LATTICE_UNIT, here, out + done);
    }
}

// --- rows ---------------------------------------------------------------------------------------

typedef struct bl_value_in {
    const bl_value_noise *noise;
    unsigned dimensions;
} bl_value_in;

static inline void bl_value_in_points(const void *parameters, const double *const at[BL_AXES],
                                      size_t count, float *out) {
    const bl_value_in *in = parameters;
    bl_value_points_in(in->noise, in->dimensions, at, count, out);
}

// The values of a row's planes, four lines at a time.
static inline void bl_value_lines_planes(const bl_row_lines *lines, const bl_row_block *block,
                                         const float *weight, float *restrict plane) {
    uint32_t add[BL_PLANES], exclusive[BL_PLANES], words[BL_PLANES];
    bl_row_keys(block, lines->lattice, lines->axis, lines->first, add, exclusive);
    memset(plane, 0, block->lanes * sizeof *plane);
    int n = 0;
    for (; n + 4 <= lines->count && lines->lattice->kind == BL_LATTICE_HASH; n += 4) {
        const bl_lattice_key k0 = lines->key[n], k1 = lines->key[n + 1], k2 = lines->key[n + 2],
                             k3 = lines->key[n + 3];
        const float w0 = weight[n], w1 = weight[n + 1], w2 = weight[n + 2], w3 = weight[n + 3];
#pragma omp simd
        for (size_t m = 0; m < block->lanes; m++) {
            float v0 = bl_lattice_value((add[m] + k0.add) * (exclusive[m] ^ k0.exclusive));
            float v1 = bl_lattice_value((add[m] + k1.add) * (exclusive[m] ^ k1.exclusive));
            float v2 = bl_lattice_value((add[m] + k2.add) * (exclusive[m] ^ k2.exclusive));
            float v3 = bl_lattice_value((add[m] + k3.add) * (exclusive[m] ^ k3.exclusive));
            plane[m] += (v0 * w0 + v1 * w1) + (v2 * w2 + v3 * w3);
        }
    }
    for (; n < lines->count; n++) {
        bl_row_line_words(lines, block, n, 0, add, exclusive, words);
#pragma omp simd
        for (size_t m = 0; m < block->lanes; m++)
            plane[m] += bl_lattice_value(words[m]) * weight[n];
    }
}

static inline void bl_value_row_in(const bl_value_noise *noise, unsigned dimensions,
                                   const double start[BL_AXES], const double step[BL_AXES],
                                   size_t count, float *out) {
    const bl_interp_shape *shape = &bl_interp_shapes[noise->interp];
    const bl_value_in in = {noise, dimensions};
    bl_row_lines lines;
    bl_row_block block;
    float weight[BL_LINES], plane[BL_PLANES], cubic[4][BL_PLANES];
    int axis = bl_row_axis_in(dimensions, step, 2);
    if (axis < 0 || !bl_row_lines_open(&lines, &noise->lattice, dimensions, (unsigned)axis, start,
                                       shape->first, shape->knots, shape->shift)) {
        bl_row_by_points(bl_value_in_points, &in, start, step, 0, count, out);
        return;
    }
    for (int n = 0; n < lines.count; n++) {
        double product = BL_LATTICE_UNIT;
        for (unsigned a = 0; a < dimensions; a++)
            product *=
                a == lines.axis ? 1 : bl_value_weight(shape, lines.knot[n][a], lines.fraction[a]);
        weight[n] = (float)product;
    }
    for (size_t done = 0; done < count; done += block.count) {
        if (!bl_row_block_load(&block, start[axis], step[axis], done, count - done, shape->shift)) {
            bl_row_nan(&block, out + done);
            continue;
        }
        bl_value_lines_planes(&lines, &block, weight, plane);
        for (int r = 0; r < 4; r++)
            bl_value_row_coefficient(block.cells, shape->coefficient[r], plane, plane + 1,
                                     plane + 2, plane + 3, cubic[r]);
        bl_row_evaluate(&block, bl_row_cubic, cubic, block.fraction, out + done);
    }
}

// --- the reference in double --------------------------------------------------------------------

// The value at a point and, if `gradient` is not NULL, its gradient.
static inline double bl_value_reference_in(const bl_value_noise *noise, unsigned dimensions,
                                           const double at[BL_AXES], double gradient[BL_AXES]) {
    bl_reference_cells cells;
    bl_value_kernels_at kernels;
    double sum = 0, slopes[BL_AXES] = {0};
    int inside = bl_value_reference_load(noise, dimensions, at, &cells, &kernels);
    for (unsigned corner = 0; inside && corner >> 2 * dimensions == 0; corner++) {
        double weight[1 + BL_AXES]; // of the value, and of its derivatives
        unsigned knot[BL_AXES] = {0};
        const unsigned weights = gradient ? 1 + dimensions : 1;
        for (unsigned n = 0; n < weights; n++)
            weight[n] = 1;
        for (unsigned a = 0; a < dimensions; a++) {
            knot[a] = corner >> 2 * a & 3;
            for (unsigned n = 0; n < weights; n++)
                weight[n] *= n == a + 1 ? kernels.slope[a][knot[a]] : kernels.value[a][knot[a]];
        }
        if (!gradient && weight[0] == 0)
            continue; // adding a zero of either sign leaves the sum, which began as +0
        double v = bl_lattice_value(bl_reference_word(&cells, knot, 0)) * BL_LATTICE_UNIT;
        sum += v * weight[0];
        for (unsigned a = 0; gradient && a < dimensions; a++)
            slopes[a] += v * weight[1 + a];
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

#endif
