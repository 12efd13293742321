// SPDX-License-Identifier: MIT
//
// Gradient noise as loops that noises share: rows, points and the reference in double of
//
//   n(p) = sum over the 8 corners c of the cell of (g_c . d) w(d_x) w(d_y) w(d_z),  d = p - c
//
// with the weight w = 1 - fade(|d|) of gnoise's key `fade`. Along a row the gradients of a plane
// enter by two numbers only, the noise on the plane (level) and its slope along the row; between
// two planes the noise is a blend of two lines.
#ifndef BL_NOISES_LATTICE_GRADIENT_LOOPS_H
#define BL_NOISES_LATTICE_GRADIENT_LOOPS_H

#include "noises/closed_forms.h"
#include "noises/lattice/reference.h"
#include "noises/lattice/separable.h"

typedef enum bl_fade { BL_FADE_CUBIC, BL_FADE_QUINTIC, BL_FADE_LINEAR } bl_fade;

static const char *const bl_gradient_fades[] = {"cubic", "quintic", "linear", NULL};
static const char *const bl_gradient_modes[] = {"sphere", "rejection", "edges", NULL};
static const bl_kernel bl_gradient_weights[] = {BL_KERNEL_SMOOTH, BL_KERNEL_QUINTIC,
                                                BL_KERNEL_LINEAR};
static const bl_kernel bl_gradient_ramps[] = {BL_KERNEL_RAMP_SMOOTH, BL_KERNEL_RAMP_QUINTIC,
                                              BL_KERNEL_RAMP_LINEAR};

typedef struct bl_gradient_noise {
    bl_lattice lattice;
    bl_fade fade;
    bl_gradients gradients;
} bl_gradient_noise;

static inline bl_gradient_noise bl_gradient_noise_of(const bl_lattice_settings *lattice,
                                                     uint32_t fade, uint32_t gradients) {
    return (bl_gradient_noise){bl_lattice_open(lattice), (bl_fade)fade, (bl_gradients)gradients};
}

// The fast path: the default lattice and gradients, with any fade.
static inline int bl_gradient_is_fast(const bl_gradient_noise *noise) {
    return noise->lattice.kind == BL_LATTICE_HASH && noise->gradients == BL_GRADIENTS_SPHERE;
}

static inline double bl_fade_value(bl_fade fade, double t, double *slope) {
    switch (fade) {
    case BL_FADE_QUINTIC:
        *slope = 30 * t * t * (t - 1) * (t - 1);
        return t * t * t * (10 + t * (6 * t - 15));
    case BL_FADE_LINEAR:
        *slope = 1;
        return t;
    default:
        *slope = 6 * t * (1 - t);
        return t * t * (3 - 2 * t);
    }
}

static inline void bl_fade_floats(bl_fade fade, const float *restrict fraction, size_t count,
                                  float *restrict out) {
    if (fade == BL_FADE_CUBIC) {
#pragma omp simd
        for (size_t i = 0; i < count; i++)
            out[i] = fraction[i] * fraction[i] * (3 - 2 * fraction[i]);
    } else if (fade == BL_FADE_QUINTIC) {
#pragma omp simd
        for (size_t i = 0; i < count; i++) {
            // From the nearer end: near 1 the terms would cancel and lose 4 bits.
            float t = fraction[i], near = t < 0.5f ? t : 1 - t;
            float fade_near = near * near * near * (10 + near * (6 * near - 15));
            out[i] = t < 0.5f ? fade_near : 1 - fade_near;
        }
    } else {
        memcpy(out, fraction, count * sizeof *out);
    }
}

// The gradient of a word as plain numbers, for the paths that need not be the fastest.
static inline bl_vector bl_any_gradient(bl_gradients gradients, uint32_t word) {
    if (gradients == BL_GRADIENTS_EDGES)
        return bl_edge_gradient(word);
    if (gradients == BL_GRADIENTS_EDGES16)
        return bl_edge16_gradient(word);
    if (gradients == BL_GRADIENTS_REJECTION)
        return bl_rejection_gradient(word);
    const float scale = (float)(BL_SPHERE_SCALE * BL_LATTICE_UNIT);
    bl_sphere g = bl_sphere_gradient(word);
    return (bl_vector){g.radius * g.x * scale, g.radius * g.y * scale,
                       g.z * (float)BL_LATTICE_UNIT};
}

// --- points -------------------------------------------------------------------------------------

// The product of a sphere gradient and an offset, whose z is in units of BL_SPHERE_SCALE.
BL_INLINE float bl_sphere_dot(uint32_t word, float x, float y, float scaled_z) {
    bl_sphere g = bl_sphere_gradient(word);
    return g.radius * (g.x * x + g.y * y) + g.z * scaled_z;
}

BL_INLINE float bl_lerp(float t, float a, float b) {
    return a + t * (b - a);
}

// lattice=hash and gradients=sphere. The values are in units of BL_SPHERE_SCALE * 2^-31.
static inline void bl_gradient_block_of_spheres(const bl_point_block *restrict block,
                                                float (*restrict fade)[BL_BLOCK],
                                                float *restrict out) {
    const bl_axis_block *restrict x = &block->axis[0], *restrict y = &block->axis[1],
                                  *restrict z = &block->axis[2];
    const float to_scale = (float)(1 / BL_SPHERE_SCALE);
#pragma omp simd
    for (size_t i = 0; i < block->lanes; i++) {
        float dx0 = x->fraction[i], dx1 = dx0 - 1, dy0 = y->fraction[i], dy1 = dy0 - 1;
        float dz0 = z->fraction[i] * to_scale, dz1 = (z->fraction[i] - 1) * to_scale;
        uint32_t a0 = x->add[0][i], a1 = x->add[1][i];
        uint32_t e0 = x->exclusive[0][i], e1 = x->exclusive[1][i];
        uint32_t a00 = y->add[0][i] + z->add[0][i], e00 = y->exclusive[0][i] ^ z->exclusive[0][i];
        uint32_t a10 = y->add[1][i] + z->add[0][i], e10 = y->exclusive[1][i] ^ z->exclusive[0][i];
        uint32_t a01 = y->add[0][i] + z->add[1][i], e01 = y->exclusive[0][i] ^ z->exclusive[1][i];
        uint32_t a11 = y->add[1][i] + z->add[1][i], e11 = y->exclusive[1][i] ^ z->exclusive[1][i];
        float n00 = bl_lerp(fade[0][i], bl_sphere_dot((a0 + a00) * (e0 ^ e00), dx0, dy0, dz0),
                            bl_sphere_dot((a1 + a00) * (e1 ^ e00), dx1, dy0, dz0));
        float n10 = bl_lerp(fade[0][i], bl_sphere_dot((a0 + a10) * (e0 ^ e10), dx0, dy1, dz0),
                            bl_sphere_dot((a1 + a10) * (e1 ^ e10), dx1, dy1, dz0));
        float n01 = bl_lerp(fade[0][i], bl_sphere_dot((a0 + a01) * (e0 ^ e01), dx0, dy0, dz1),
                            bl_sphere_dot((a1 + a01) * (e1 ^ e01), dx1, dy0, dz1));
        float n11 = bl_lerp(fade[0][i], bl_sphere_dot((a0 + a11) * (e0 ^ e11), dx0, dy1, dz1),
                            bl_sphere_dot((a1 + a11) * (e1 ^ e11), dx1, dy1, dz1));
        float n0 = bl_lerp(fade[1][i], n00, n10), n1 = bl_lerp(fade[1][i], n01, n11);
        out[i] = bl_lerp(fade[2][i], n0, n1);
    }
}

// Adds a corner with gradients=edges16, which has no branches.
static inline void bl_gradient_add_edges16(const bl_point_block *restrict block, const int knot[3],
                                           const uint32_t *restrict words,
                                           float (*restrict fade)[BL_BLOCK], float *restrict out) {
    const float *restrict x = block->axis[0].fraction, *restrict y = block->axis[1].fraction,
                          *restrict z = block->axis[2].fraction;
    const float at_x = (float)knot[0], at_y = (float)knot[1], at_z = (float)knot[2];
    // 1 - fade, or fade.
    const float base_x = 1 - at_x, base_y = 1 - at_y, base_z = 1 - at_z;
    const float sign_x = 2 * at_x - 1, sign_y = 2 * at_y - 1, sign_z = 2 * at_z - 1;
#pragma omp simd
    for (size_t i = 0; i < block->lanes; i++) {
        bl_vector g = bl_edge16_gradient(words[i]);
        float weight = (base_x + sign_x * fade[0][i]) * (base_y + sign_y * fade[1][i]) *
                       (base_z + sign_z * fade[2][i]);
        out[i] += weight * (g.x * (x[i] - at_x) + g.y * (y[i] - at_y) + g.z * (z[i] - at_z));
    }
}

// Any lattice and any gradients; the values are in units of 1.
static inline void bl_gradient_block_of_any(const bl_point_block *restrict block,
                                            bl_gradients gradients,
                                            float (*restrict fade)[BL_BLOCK], float *restrict out) {
    uint32_t words[BL_BLOCK];
    memset(out, 0, BL_BLOCK * sizeof *out);
    for (int corner = 0; corner < 8; corner++) {
        const int knot[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        bl_point_block_words(block, knot, 0, words);
        if (gradients == BL_GRADIENTS_EDGES16) {
            bl_gradient_add_edges16(block, knot, words, fade, out);
            continue;
        }
        for (size_t i = 0; i < block->lanes; i++) {
            bl_vector g = bl_any_gradient(gradients, words[i]);
            float weight = (knot[0] ? fade[0][i] : 1 - fade[0][i]) *
                           (knot[1] ? fade[1][i] : 1 - fade[1][i]) *
                           (knot[2] ? fade[2][i] : 1 - fade[2][i]);
            out[i] += weight * (g.x * (block->axis[0].fraction[i] - (float)knot[0]) +
                                g.y * (block->axis[1].fraction[i] - (float)knot[1]) +
                                g.z * (block->axis[2].fraction[i] - (float)knot[2]));
        }
    }
}

static inline void bl_gradient_points(const bl_gradient_noise *noise,
                                      const double *const at[BL_AXES], size_t count, float *out) {
    bl_point_block block;
    float fade[3][BL_BLOCK], value[BL_BLOCK];
    bl_point_block_begin(&block, &noise->lattice, 0, 2);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        for (unsigned axis = 0; axis < 3; axis++)
            bl_fade_floats(noise->fade, block.axis[axis].fraction, block.lanes, fade[axis]);
        float scale = 1;
        if (bl_gradient_is_fast(noise)) {
            bl_gradient_block_of_spheres(&block, fade, value);
            scale = (float)(BL_SPHERE_SCALE * BL_LATTICE_UNIT);
        } else {
            bl_gradient_block_of_any(&block, noise->gradients, fade, value);
        }
        bl_point_block_store(&block, value, scale, here, out + done);
    }
}

static inline void bl_gradient_points_function(const void *noise, const double *const at[BL_AXES],
                                               size_t count, float *out) {
    bl_gradient_points(noise, at, count, out);
}

// --- rows ---------------------------------------------------------------------------------------

// One line of lattice points parallel to the row: the weights of its gradients' x, y and z in the
// level, and the weight of the component along the row in the slope.
typedef struct bl_gradient_line {
    float x, y, z, along;
    uint32_t add, exclusive;
} bl_gradient_line;

typedef struct bl_gradient_row_plan {
    bl_row_cross cross;
    bl_gradient_line line[4]; // j + 2 k
    uint32_t words256[256];
} bl_gradient_row_plan;

static inline int bl_gradient_row_prepare(bl_gradient_row_plan *plan,
                                          const bl_gradient_noise *noise, unsigned axis,
                                          const double start[BL_AXES]) {
    bl_row_cross *cross = &plan->cross;
    // What the numbers of a gradient are in units of.
    double unit[3] = {1, 1, 1};
    if (bl_gradient_is_fast(noise)) {
        unit[0] = unit[1] = BL_SPHERE_SCALE * BL_LATTICE_UNIT;
        unit[2] = BL_LATTICE_UNIT;
    }
    if (noise->lattice.kind == BL_LATTICE_PERM256)
        bl_perm256_words(&noise->lattice, 0, plan->words256);
    if (!bl_row_cross_load(cross, &noise->lattice, axis, start, 0, 2, 0))
        return 0;
    for (int n = 0; n < 4; n++) {
        const int knot[2] = {n & 1, n >> 1};
        double weight = 1, slope, part[3] = {0};
        for (int b = 0; b < 2; b++) {
            double fade = bl_fade_value(noise->fade, cross->fraction[b], &slope);
            weight *= knot[b] ? fade : 1 - fade;
        }
        for (int b = 0; b < 2; b++)
            part[cross->across[b]] =
                weight * (cross->fraction[b] - knot[b]) * unit[cross->across[b]];
        plan->line[n] = (bl_gradient_line){
            .x = (float)part[0],
            .y = (float)part[1],
            .z = (float)part[2],
            .along = (float)(weight * unit[axis]),
            .add = cross->key[0][knot[0]].add + cross->key[1][knot[1]].add,
            .exclusive = cross->key[0][knot[0]].exclusive ^ cross->key[1][knot[1]].exclusive};
    }
    return 1;
}

// What one lattice point adds; `axis` is a constant where this is inlined.
BL_INLINE void bl_gradient_row_add(bl_vector g, unsigned axis, float x, float y, float z,
                                   float along, float *level, float *slope) {
    float other = axis == 0 ? g.y * y + g.z * z : axis == 1 ? g.x * x + g.z * z : g.x * x + g.y * y;
    *level += other;
    *slope += (axis == 0 ? g.x : axis == 1 ? g.y : g.z) * along;
}

BL_INLINE bl_vector bl_sphere_vector(uint32_t word) {
    bl_sphere g = bl_sphere_gradient(word);
    return (bl_vector){g.radius * g.x, g.radius * g.y, g.z};
}

BL_INLINE void bl_gradient_row_spheres_along(const bl_row_block *restrict block,
                                             const bl_gradient_line *restrict line, unsigned axis,
                                             const uint32_t *restrict add,
                                             const uint32_t *restrict exclusive,
                                             float *restrict level, float *restrict slope) {
    const bl_gradient_line p = line[0], q = line[1], r = line[2], s = line[3];
#pragma omp simd
    for (size_t m = 0; m < block->lanes; m++) {
        float a = 0, b = 0;
        bl_vector g0 = bl_sphere_vector((add[m] + p.add) * (exclusive[m] ^ p.exclusive));
        bl_gradient_row_add(g0, axis, p.x, p.y, p.z, p.along, &a, &b);
        bl_vector g1 = bl_sphere_vector((add[m] + q.add) * (exclusive[m] ^ q.exclusive));
        bl_gradient_row_add(g1, axis, q.x, q.y, q.z, q.along, &a, &b);
        bl_vector g2 = bl_sphere_vector((add[m] + r.add) * (exclusive[m] ^ r.exclusive));
        bl_gradient_row_add(g2, axis, r.x, r.y, r.z, r.along, &a, &b);
        bl_vector g3 = bl_sphere_vector((add[m] + s.add) * (exclusive[m] ^ s.exclusive));
        bl_gradient_row_add(g3, axis, s.x, s.y, s.z, s.along, &a, &b);
        level[m] = a;
        slope[m] = b;
    }
}

static inline void bl_gradient_row_spheres(const bl_row_block *block,
                                           const bl_gradient_row_plan *plan,
                                           const bl_lattice *lattice, float *level, float *slope) {
    uint32_t add[BL_PLANES], exclusive[BL_PLANES];
    bl_row_keys(block, lattice, plan->cross.axis, 0, add, exclusive);
    switch (plan->cross.axis) {
    case 0:
        bl_gradient_row_spheres_along(block, plan->line, 0, add, exclusive, level, slope);
        break;
    case 1:
        bl_gradient_row_spheres_along(block, plan->line, 1, add, exclusive, level, slope);
        break;
    default:
        bl_gradient_row_spheres_along(block, plan->line, 2, add, exclusive, level, slope);
        break;
    }
}

// Adds a line of lattice points with gradients=edges16 to a row along a constant axis.
BL_INLINE void bl_gradient_row_edges16(size_t lanes, const bl_gradient_line *restrict line,
                                       unsigned axis, const uint32_t *restrict words,
                                       float *restrict level, float *restrict slope) {
    const float x = line->x, y = line->y, z = line->z, along = line->along;
#pragma omp simd
    for (size_t m = 0; m < lanes; m++) {
        float a = level[m], b = slope[m];
        bl_gradient_row_add(bl_edge16_gradient(words[m]), axis, x, y, z, along, &a, &b);
        level[m] = a;
        slope[m] = b;
    }
}

static inline void bl_gradient_row_any(const bl_row_block *block, const bl_gradient_row_plan *plan,
                                       const bl_gradient_noise *noise, float *level, float *slope) {
    uint32_t add[BL_PLANES], exclusive[BL_PLANES], words[BL_PLANES];
    bl_row_keys(block, &noise->lattice, plan->cross.axis, 0, add, exclusive);
    memset(level, 0, block->lanes * sizeof *level);
    memset(slope, 0, block->lanes * sizeof *slope);
    for (int n = 0; n < 4; n++) {
        const bl_gradient_line *line = &plan->line[n];
        if (noise->lattice.kind == BL_LATTICE_PERM256)
            bl_row_words256(block, &plan->cross, plan->words256, 0, n & 1, n >> 1, words);
        else
            for (size_t m = 0; m < block->lanes; m++)
                words[m] = (add[m] + line->add) * (exclusive[m] ^ line->exclusive);
        if (noise->gradients == BL_GRADIENTS_EDGES16 && plan->cross.axis == 0)
            bl_gradient_row_edges16(block->lanes, line, 0, words, level, slope);
        else if (noise->gradients == BL_GRADIENTS_EDGES16 && plan->cross.axis == 1)
            bl_gradient_row_edges16(block->lanes, line, 1, words, level, slope);
        else if (noise->gradients == BL_GRADIENTS_EDGES16)
            bl_gradient_row_edges16(block->lanes, line, 2, words, level, slope);
        else
            for (size_t m = 0; m < block->lanes; m++)
                bl_gradient_row_add(bl_any_gradient(noise->gradients, words[m]), plan->cross.axis,
                                    line->x, line->y, line->z, line->along, &level[m], &slope[m]);
    }
}

// The blend of each cell: on the left plane the line level + slope t, on the right one
// level' + slope' (t - 1).
static inline void bl_gradient_row_blends(size_t cells, const float *restrict level,
                                          const float *restrict slope, float *restrict to_level,
                                          float *restrict to_slope) {
#pragma omp simd
    for (size_t m = 0; m < cells; m++) {
        to_level[m] = (level[m + 1] - slope[m + 1]) - level[m];
        to_slope[m] = slope[m + 1] - slope[m];
    }
}

// A row from its sample `first` on. A plane costs 4 gradients where a point costs 8, so the row
// pays up to 1.5 cells a sample.
static inline void bl_gradient_row(const bl_gradient_noise *noise, const double start[BL_AXES],
                                   const double step[BL_AXES], size_t first, size_t count,
                                   float *out) {
    bl_gradient_row_plan plan;
    bl_row_block block;
    float blend[4][BL_PLANES], fade[BL_ROW + BL_LANES];
    float *level = blend[0], *slope = blend[1];
    int axis = bl_row_axis(step, 1.5);
    if (axis < 0 || !bl_gradient_row_prepare(&plan, noise, (unsigned)axis, start)) {
        bl_row_by_points(bl_gradient_points_function, noise, start, step, first, count, out);
        return;
    }
    for (size_t done = 0; done < count; done += block.count) {
        if (!bl_row_block_load(&block, start[axis], step[axis], first + done, count - done, 0)) {
            bl_row_nan(&block, out + done);
            continue;
        }
        if (bl_gradient_is_fast(noise))
            bl_gradient_row_spheres(&block, &plan, &noise->lattice, level, slope);
        else
            bl_gradient_row_any(&block, &plan, noise, level, slope);
        bl_gradient_row_blends(block.cells, level, slope, blend[2], blend[3]);
        bl_fade_floats(noise->fade, block.fraction, block.count + BL_LANES, fade);
        bl_row_evaluate(&block, bl_row_blend, blend, fade, out + done);
    }
}

// --- the reference in double --------------------------------------------------------------------

// The value at a point and, if `gradient` is not NULL, its gradient.
static inline double bl_gradient_reference(const bl_gradient_noise *noise, const double at[BL_AXES],
                                           double gradient[BL_AXES]) {
    bl_reference_cells cells;
    double d[3][2], w[3][2], s[3][2], sum = 0, slopes[BL_AXES] = {0};
    int inside = bl_reference_cells_load(&cells, &noise->lattice, 3, at, 0, 2);
    for (unsigned a = 0; inside && a < 3; a++) {
        double slope, fade = bl_fade_value(noise->fade, cells.fraction[a], &slope);
        for (unsigned bit = 0; bit < 2; bit++) {
            d[a][bit] = cells.fraction[a] - bit;
            w[a][bit] = bit ? fade : 1 - fade;
            s[a][bit] = bit ? slope : -slope;
        }
    }
    for (unsigned corner = 0; inside && corner < 8; corner++) {
        const unsigned bit[BL_AXES] = {corner & 1, corner >> 1 & 1, corner >> 2};
        const double wx = w[0][bit[0]], wy = w[1][bit[1]], wz = w[2][bit[2]];
        double g[3];
        bl_lattice_gradient(noise->gradients, bl_reference_word(&cells, bit, 0), g);
        double dot = g[0] * d[0][bit[0]] + g[1] * d[1][bit[1]] + g[2] * d[2][bit[2]];
        sum += dot * wx * wy * wz;
        if (!gradient)
            continue;
        slopes[0] += (g[0] * wx + dot * s[0][bit[0]]) * wy * wz;
        slopes[1] += (g[1] * wy + dot * s[1][bit[1]]) * wx * wz;
        slopes[2] += (g[2] * wz + dot * s[2][bit[2]]) * wx * wy;
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

#endif
