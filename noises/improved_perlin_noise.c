// SPDX-License-Identifier: MIT
//
// perlin2002: Perlin's improved noise of 2002.
//
//   n(p) = sum over the 8 corners c of the cell of (g_c . d) w(d_x) w(d_y) w(d_z),  d = p - c
//   w(d) = 1 - (6 |d|^5 - 15 d^4 + 10 |d|^3)
//
// with g_c one of the 12 edge midpoints (+-1, +-1, 0) of a cube and its turns, of length sqrt 2,
// picked by four bits: 16 entries, in which (1,1,0), (-1,1,0), (0,-1,1) and (0,-1,-1) stand twice.
//
// Parameters
//   seed       64 bits, chooses the gradients
//   lattice    perm256, a nested permutation of 256 as Perlin has it: the noise repeats after 256
//              cells; or hash, which never does
//   component  0 to 3, independent noises of one seed
//   period     in cells, one number or one an axis; 0: that of the lattice
//
// Units: coordinates in cells. The noise is 0 at the lattice points, and its gradient there is g_c.
//
// Against gnoise:fade=quintic,gradients=edges: the same fade and the same 12 vectors, with other
// chances. There each has 1/12 and E[g g^T] = 2/3 I. Here the 12 give diag(8, 8, 8) and the four
// again diag(2, 4, 2), of 16: E[g g^T] = diag(5/8, 3/4, 5/8), the mean and the mixed moments are 0.
// The y axis has 6/5 of the slope of the two others (0.79 dB): a small anisotropy that the choice
// of 16 costs; the trace, 2, is the same.
//
// Bound: that of the 12 edges with the quintic fade, 1.04, certified (noises/lattice/bounds.c; the
// largest value is 1.0363538): |n| may pass 1. Mean 0, variance, band: exact for lattice=hash
// (noises/closed_forms.h). Class C2: the quintic has two derivatives of 0 at both ends.
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
//
// Known defects: zeros on the whole lattice; few directions, so that runs along the axes and the
// face diagonals show; the anisotropy above; and with perm256 rows that are shifts of one another.
// Source: Perlin 2002. Deviations: the permutation is that of peachey2003, p. 70, nested z, y, x
// where Perlin nests x, y, z; the four bits are the top ones of a word drawn for the index from the
// seed, where Perlin takes the low ones of the index itself (each of 16 then stands exactly 16
// times among the 256).
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/lattice/gradient_loops.h"
#include "noises/noise.h"
#include "noises/textbook.h"

typedef struct improved_parameters {
    bl_lattice_settings lattice;
} improved_parameters;

static bl_gradient_noise gradient_noise_of(const void *block) {
    const improved_parameters *p = block;
    return bl_gradient_noise_of(&p->lattice, BL_FADE_QUINTIC, BL_GRADIENTS_EDGES16);
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    bl_gradient_noise noise = gradient_noise_of(block);
    bl_gradient_row(&noise, start, step, 0, count, out);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    bl_gradient_noise noise = gradient_noise_of(block);
    bl_gradient_points(&noise, at, count, out);
}

static double value_at(const void *block, const bl_gradient_noise *noise,
                       const double at[BL_AXES]) {
    (void)block;
    return bl_gradient_reference(noise, at, NULL);
}

BL_VALUES_OF_OPENED(bl_gradient_noise, gradient_noise_of)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    bl_gradient_noise noise = gradient_noise_of(block);
    bl_gradient_reference(&noise, at, out);
}

// E[g_a^2] of the 16 entries; the mixed moments are 0, so one term an axis.
static const double second_moment[3] = {5.0 / 8, 3.0 / 4, 5.0 / 8};

static bl_terms terms_of(const void *block) {
    (void)block;
    bl_terms terms = {0};
    bl_terms_add_gradient(&terms, 1, BL_KERNEL_RAMP_QUINTIC, BL_KERNEL_QUINTIC);
    for (int axis = 0; axis < 3; axis++)
        terms.term[axis].variance = second_moment[axis];
    return terms;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const improved_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_terms_describe(&terms, 1, &p->lattice, facts);
    bl_lattice_describe(bl_bound_gradient(BL_KERNEL_QUINTIC, 1), 2, &p->lattice, facts);
}

static float textbook_fade(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

// The product with one of the 16 gradients.
static float textbook_corner(int index, float x, float y, float z) {
    const bl_vector g = bl_edge16_gradient((uint32_t)bl_textbook_data.edges[index] << 28);
    return g.x * x + g.y * y + g.z * z;
}

static float textbook(float x, float y, float z) {
    int ix = bl_textbook_floor(x), iy = bl_textbook_floor(y), iz = bl_textbook_floor(z);
    float fx = x - (float)ix, fy = y - (float)iy, fz = z - (float)iz;
    float wx = textbook_fade(fx), wy = textbook_fade(fy), wz = textbook_fade(fz), plane[2];
    for (int k = 0; k <= 1; k++) {
        float line[2];
        for (int j = 0; j <= 1; j++) {
            float dy = fy - (float)j, dz = fz - (float)k;
            float left = textbook_corner(bl_textbook_index(ix, iy + j, iz + k), fx, dy, dz);
            float right =
                textbook_corner(bl_textbook_index(ix + 1, iy + j, iz + k), fx - 1, dy, dz);
            line[j] = bl_lerp(wx, left, right);
        }
        plane[k] = bl_lerp(wy, line[0], line[1]);
    }
    return bl_lerp(wz, plane[0], plane[1]);
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS_WITH(improved_parameters, "the gradients", "perm256"), {0}};

BL_NOISE_DESCRIPTOR(improved_perlin_noise) = {
    .name = "perlin2002",
    .title = "Perlin's improved noise",
    .summary = "Gradients to the edges of a cube at the lattice points, blended by a quintic.",
    .formula =
        "n(p) = sum_c (g_c . (p-c)) w(x-c_x) w(y-c_y) w(z-c_z), "
        "w(d) = 1 - 6|d|^5 + 15d^4 - 10|d|^3, g_c of 12 edges, four of them twice",
    .paper = "perlin2002",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(improved_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_GRADIENTS,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
