// SPDX-License-Identifier: MIT
//
// Gradient noise in one, two and four dimensions: rows, points and the reference in double of
//
//   n(p) = sum over the 2^d corners c of the cell of (g_c . e) prod_a w(e_a),  e = p - c, a < d
//
// with the gradients of lattice_dimensions.h and the weights of gradient_loops.h, which has three
// dimensions.
#ifndef BL_NOISES_LATTICE_GRADIENT_DIMENSIONS_H
#define BL_NOISES_LATTICE_GRADIENT_DIMENSIONS_H

#include "noises/lattice/gradient_loops.h"
#include "noises/lattice/separable_dimensions.h"

typedef struct bl_gradient_in {
    const bl_gradient_noise *noise;
    unsigned dimensions;
} bl_gradient_in;

// --- points -------------------------------------------------------------------------------------

// What a corner sees of the points of a block: their offsets from it.
typedef struct bl_corner {
    const uint32_t *word, *second;
    float offset[BL_AXES][BL_BLOCK], weight[BL_BLOCK];
} bl_corner;

// Adds a corner; gradients and dimensions are constants where this is inlined.
BL_INLINE void bl_corner_add(bl_gradients gradients, unsigned dimensions,
                             const bl_corner *restrict corner, size_t lanes, float *restrict out) {
    const uint32_t *restrict word = corner->word, *restrict second = corner->second;
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        bl_direction g = bl_direction_of(gradients, dimensions, word[i], second[i]);
        float dot = g.x * corner->offset[0][i];
        if (dimensions > 1)
            dot += g.y * corner->offset[1][i];
        if (dimensions > 2)
            dot += g.z * corner->offset[2][i] + g.w * corner->offset[3][i];
        out[i] += dot * corner->weight[i];
    }
}

static inline void bl_corner_add_any(const bl_gradient_in *in, const bl_corner *corner,
                                     size_t lanes, float *out) {
    if (in->noise->gradients != BL_GRADIENTS_SPHERE)
        bl_corner_add(in->noise->gradients, in->dimensions, corner, lanes, out);
    else if (in->dimensions == 1)
        bl_corner_add(BL_GRADIENTS_SPHERE, 1, corner, lanes, out);
    else if (in->dimensions == 2)
        bl_corner_add(BL_GRADIENTS_SPHERE, 2, corner, lanes, out);
    else
        bl_corner_add(BL_GRADIENTS_SPHERE, 4, corner, lanes, out);
}

static inline void bl_gradient_in_points(const void *parameters, const double *const at[BL_AXES],
                                         size_t count, float *out) {
    const bl_gradient_in *in = parameters;
    const bl_gradient_noise *noise = in->noise;
    bl_point_block block;
    bl_corner corner = {.word = NULL};
    uint32_t words[2][BL_BLOCK];
    float fade[BL_AXES][BL_BLOCK], value[BL_BLOCK];
    const int two = bl_directions_need_two(noise->gradients, in->dimensions);
    corner.word = words[0];
    corner.second = words[two];
    bl_point_block_begin_in(&block, &noise->lattice, in->dimensions, 0, 2);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        for (unsigned axis = 0; axis < in->dimensions; axis++)
            bl_fade_floats(noise->fade, block.axis[axis].fraction, block.lanes, fade[axis]);
        memset(value, 0, sizeof value);
        for (int n = 0; n >> in->dimensions == 0; n++) {
            int knot[BL_AXES];
            for (unsigned axis = 0; axis < in->dimensions; axis++) {
                const float *restrict fraction = block.axis[axis].fraction;
                const float away = (float)(n >> axis & 1);
                knot[axis] = n >> axis & 1;
#pragma omp simd
                for (size_t i = 0; i < block.lanes; i++) {
                    float weight = knot[axis] ? fade[axis][i] : 1 - fade[axis][i];
                    corner.weight[i] = axis ? corner.weight[i] * weight : weight;
                    corner.offset[axis][i] = fraction[i] - away;
                }
            }
            for (unsigned component = 0; component <= (unsigned)two; component++)
                bl_point_block_words_in(&block, knot, component, words[component]);
            bl_corner_add_any(in, &corner, block.lanes, value);
        }
        bl_point_block_store(&block, value, 1, here, out + done);
    }
}

static inline void bl_gradient_points_in(const bl_gradient_noise *noise, unsigned dimensions,
                                         const double *const at[BL_AXES], size_t count,
                                         float *out) {
    const bl_gradient_in in = {noise, dimensions};
    bl_gradient_in_points(&in, at, count, out);
}

// --- rows ---------------------------------------------------------------------------------------

// What the gradients of a line weigh in the level of a plane and in its slope along the row.
typedef struct bl_line_weights {
    bl_direction level, slope;
} bl_line_weights;

static inline bl_line_weights bl_line_weights_of(const bl_row_lines *lines, bl_fade fade, int n) {
    double weight = 1, slope, level[BL_AXES] = {0};
    float along[BL_AXES] = {0};
    for (unsigned a = 0; a < lines->dimensions; a++) {
        if (a == lines->axis)
            continue;
        double blend = bl_fade_value(fade, lines->fraction[a], &slope);
        weight *= lines->knot[n][a] ? blend : 1 - blend;
    }
    for (unsigned a = 0; a < lines->dimensions; a++)
        level[a] = a == lines->axis ? 0 : weight * (lines->fraction[a] - lines->knot[n][a]);
    along[lines->axis] = (float)weight;
    return (bl_line_weights){{(float)level[0], (float)level[1], (float)level[2], (float)level[3]},
                             {along[0], along[1], along[2], along[3]}};
}

BL_INLINE void bl_line_add(bl_gradients gradients, unsigned dimensions, size_t lanes,
                           bl_line_weights weights, const uint32_t *restrict word,
                           const uint32_t *restrict second, float *restrict level,
                           float *restrict slope) {
    const bl_direction p = weights.level, q = weights.slope;
#pragma omp simd
    for (size_t m = 0; m < lanes; m++) {
        bl_direction g = bl_direction_of(gradients, dimensions, word[m], second[m]);
        float a = g.x * p.x, b = g.x * q.x;
        if (dimensions > 1) {
            a += g.y * p.y;
            b += g.y * q.y;
        }
        if (dimensions > 2) {
            a += g.z * p.z + g.w * p.w;
            b += g.z * q.z + g.w * q.w;
        }
        level[m] += a;
        slope[m] += b;
    }
}

static inline void bl_gradient_lines_planes(const bl_gradient_in *in, const bl_row_lines *lines,
                                            const bl_row_block *block,
                                            const bl_line_weights *weights, float *level,
                                            float *slope) {
    uint32_t add[BL_PLANES], exclusive[BL_PLANES], words[2][BL_PLANES];
    const bl_gradients gradients = in->noise->gradients;
    const int two = bl_directions_need_two(gradients, in->dimensions);
    const size_t lanes = block->lanes;
    bl_row_keys(block, lines->lattice, lines->axis, 0, add, exclusive);
    memset(level, 0, lanes * sizeof *level);
    memset(slope, 0, lanes * sizeof *slope);
    for (int n = 0; n < lines->count; n++) {
        for (unsigned component = 0; component <= (unsigned)two; component++)
            bl_row_line_words(lines, block, n, component, add, exclusive, words[component]);
        const uint32_t *word = words[0], *second = words[two];
        if (gradients != BL_GRADIENTS_SPHERE)
            bl_line_add(gradients, in->dimensions, lanes, weights[n], word, second, level, slope);
        else if (in->dimensions == 1)
            bl_line_add(BL_GRADIENTS_SPHERE, 1, lanes, weights[n], word, second, level, slope);
        else if (in->dimensions == 2)
            bl_line_add(BL_GRADIENTS_SPHERE, 2, lanes, weights[n], word, second, level, slope);
        else
            bl_line_add(BL_GRADIENTS_SPHERE, 4, lanes, weights[n], word, second, level, slope);
    }
}

static inline void bl_gradient_row_in(const bl_gradient_noise *noise, unsigned dimensions,
                                      const double start[BL_AXES], const double step[BL_AXES],
                                      size_t count, float *out) {
    const bl_gradient_in in = {noise, dimensions};
    bl_row_lines lines;
    bl_row_block block;
    bl_line_weights weights[BL_LINES];
    float blend[4][BL_PLANES], fade[BL_ROW + BL_LANES];
    int axis = bl_row_axis_in(dimensions, step, 1.5);
    if (axis < 0 ||
        !bl_row_lines_open(&lines, &noise->lattice, dimensions, (unsigned)axis, start, 0, 2, 0)) {
        bl_row_by_points(bl_gradient_in_points, &in, start, step, 0, count, out);
        return;
    }
    for (int n = 0; n < lines.count; n++)
        weights[n] = bl_line_weights_of(&lines, noise->fade, n);
    for (size_t done = 0; done < count; done += block.count) {
        if (!bl_row_block_load(&block, start[axis], step[axis], done, count - done, 0)) {
            bl_row_nan(&block, out + done);
            continue;
        }
        bl_gradient_lines_planes(&in, &lines, &block, weights, blend[0], blend[1]);
        bl_gradient_row_blends(block.cells, blend[0], blend[1], blend[2], blend[3]);
        bl_fade_floats(noise->fade, block.fraction, block.count + BL_LANES, fade);
        bl_row_evaluate(&block, bl_row_blend, blend, fade, out + done);
    }
}

// --- the reference in double --------------------------------------------------------------------

// The value at a point and, if `gradient` is not NULL, its gradient.
static inline double bl_gradient_reference_in(const bl_gradient_noise *noise, unsigned dimensions,
                                              const double at[BL_AXES], double gradient[BL_AXES]) {
    bl_reference_cells cells;
    double fade[BL_AXES], rise[BL_AXES], sum = 0, slopes[BL_AXES] = {0};
    int inside = bl_reference_cells_load(&cells, &noise->lattice, dimensions, at, 0, 2);
    for (unsigned a = 0; inside && a < dimensions; a++)
        fade[a] = bl_fade_value(noise->fade, cells.fraction[a], &rise[a]);
    for (unsigned corner = 0; inside && corner >> dimensions == 0; corner++) {
        double product = 1, dot = 0, weight[BL_AXES];
        unsigned bit[BL_AXES] = {0};
        for (unsigned a = 0; a < dimensions; a++) {
            bit[a] = corner >> a & 1;
            weight[a] = bit[a] ? fade[a] : 1 - fade[a];
            product *= weight[a];
        }
        uint32_t word = bl_reference_word(&cells, bit, 0);
        uint32_t second = dimensions == 4 ? bl_reference_word(&cells, bit, 1) : 0;
        bl_direction g = bl_direction_of(noise->gradients, dimensions, word, second);
        const double of[BL_AXES] = {g.x, g.y, g.z, g.w};
        for (unsigned a = 0; a < dimensions; a++)
            dot += of[a] * (cells.fraction[a] - bit[a]);
        sum += dot * product;
        for (unsigned a = 0; gradient && a < dimensions; a++) {
            double others = 1;
            for (unsigned b = 0; b < dimensions; b++)
                others *= b == a ? 1 : weight[b];
            slopes[a] += of[a] * product + dot * (bit[a] ? rise[a] : -rise[a]) * others;
        }
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

#endif
