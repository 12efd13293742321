// SPDX-License-Identifier: MIT
//
// rayshade: the value noise of the ray tracer Rayshade, with random numbers in [0, 1].
//
//   n(s,t,r) = sum over the 8 corners c of the cell of h_c w(s - c_s) w(t - c_t) w(r - c_r)
//   w(d) = 1 - SCURVE(|d|),  SCURVE(u) = 3 u^2 - 2 u^3,  or  w(d) = 1 - |d|
//
// Parameters
//   seed, lattice, component, period   of the lattice numbers h_c (noises/lattice/lattice.h)
//   weights   scurve  the cubic of the ray tracer: C1
//             linear  what its version for graphics hardware has: C0
//
// Units: coordinates in cells. The numbers h_c are odd multiples of 2^-21 in (0, 1), uniform: mean
// 1/2. That is the one difference from vnoise: with v_c = 2 h_c - 1 in (-1, 1) and weights that sum
// to 1,
//   n = 1/2 + 1/2 (vnoise:interp=smooth, or interp=linear for weights=linear)
// seed by seed, and the file shares its loops (noises/lattice/value_loops.h).
//
// Bound: weights are not negative and sum to 1, so 0 < n < 1. Mean 1/2; variance, band: a quarter
// of those of the value noise, exact (noises/closed_forms.h). Closed forms are those of n - 1/2.
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
//
// Known defects: those of vnoise with narrow kernels: cells show as boxes, the spectrum is not
// isotropic, and half of the range is the mean.
// Source: hart2001, section 2. It calls the random numbers Hash3d(i, j, k), after Skinner and Kolb
// (1991), and says that its figure 2 draws them by drand48(), which is in [0, 1); section 3 keeps
// [0, 1]. Deviations: numbers by the hash of this project, with a seed, and never 0 or 1.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/noise.h"
#include "noises/lattice/value_loops.h"
#include "noises/textbook.h"

typedef struct rayshade_parameters {
    bl_lattice_settings lattice;
    uint32_t weights;
} rayshade_parameters;

static const char *const weight_choices[] = {"scurve", "linear", NULL};
static const bl_interp interps[] = {BL_INTERP_SMOOTH, BL_INTERP_LINEAR};

static bl_value_noise value_noise_of(const void *block) {
    const rayshade_parameters *p = block;
    return bl_value_noise_of(&p->lattice, interps[p->weights]);
}

// From (-1, 1) to (0, 1): half of the error of the value noise, and half a unit in the last place.
static void to_unit(float *restrict out, size_t count) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] = 0.5f + 0.5f * out[i];
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    bl_value_noise noise = value_noise_of(block);
    bl_value_row(&noise, start, step, 0, count, out);
    to_unit(out, count);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    bl_value_noise noise = value_noise_of(block);
    bl_value_points(&noise, at, count, out);
    to_unit(out, count);
}

static double value_at(const void *block, const bl_value_noise *noise, const double at[BL_AXES]) {
    (void)block;
    return 0.5 + 0.5 * bl_value_reference(noise, at, NULL);
}

BL_VALUES_OF_OPENED(bl_value_noise, value_noise_of)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    bl_value_noise noise = value_noise_of(block);
    bl_value_reference(&noise, at, out);
    for (int a = 0; a < BL_AXES; a++)
        out[a] *= 0.5;
}

static bl_terms terms_of(const void *block) {
    const rayshade_parameters *p = block;
    bl_terms terms = {0};
    bl_terms_add_value(&terms, BL_VALUE_VARIANCE(BL_LATTICE_VALUES) / 4,
                       bl_value_kernels[interps[p->weights]]);
    return terms;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const rayshade_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_kernel kernel = bl_value_kernels[interps[p->weights]];
    bl_terms_describe(&terms, 1, &p->lattice, facts);
    bl_lattice_describe(bl_bound_value(kernel), bl_kernel_continuity(kernel), &p->lattice, facts);
    facts->mean = 0.5;
    facts->lower = 0;
    facts->upper = 1;
    facts->bound_proof = "numbers in (0, 1); weights are not negative and sum to 1";
}

// One weight and one number a corner, as the sum is printed.
static float textbook_weight(float t, int bit) {
    float curve = t * t * (3 - 2 * t);
    return bit ? curve : 1 - curve;
}

static float textbook(float x, float y, float z) {
    int ix = bl_textbook_floor(x), iy = bl_textbook_floor(y), iz = bl_textbook_floor(z);
    float fx = x - (float)ix, fy = y - (float)iy, fz = z - (float)iz, sum = 0;
    for (int k = 0; k <= 1; k++)
        for (int j = 0; j <= 1; j++)
            for (int i = 0; i <= 1; i++) {
                int index = bl_textbook_index(ix + i, iy + j, iz + k);
                float number = 0.5f + 0.5f * bl_textbook_data.values[index];
                sum += number * textbook_weight(fx, i) * textbook_weight(fy, j) *
                       textbook_weight(fz, k);
            }
    return sum;
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(rayshade_parameters, "the lattice numbers"),
    {"weights", BL_CHOICE, offsetof(rayshade_parameters, weights), "scurve", "",
     .choices = weight_choices, .help = "the blend between the corners: 3u^2 - 2u^3, or linear"},
    {0}};

BL_NOISE_DESCRIPTOR(rayshade_noise) = {
    .name = "rayshade",
    .title = "Rayshade's noise",
    .summary = "Random numbers in [0, 1] at the lattice points, blended by a cubic S-curve.",
    .formula = "n(p) = sum_c h_c w(s-c_s) w(t-c_t) w(r-c_r), w(d) = 1 - SCURVE(|d|), h_c in (0,1)",
    .paper = "hart2001, section 2",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(rayshade_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_VALUES,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
