// SPDX-License-Identifier: MIT
//
// gnoise: gradient noise, Perlin's noise of 1985 as the text tells it.
//
//   n(p) = sum over the 8 corners c of the cell of (g_c . d) w(d_x) w(d_y) w(d_z),  d = p - c
//   w(d) = 1 - fade(|d|)
//
// and the same over the 2, 4 or 16 corners in one, two or four dimensions with dims=1, 2, 4, the
// gradients being those of as many dimensions: the fourth may be time.
//
// Parameters
//   seed       64 bits, chooses the gradients
//   dims       1 to 4, default 3
//   fade       cubic 3 t^2 - 2 t^3 (the text's smoothstep, C1), quintic 6 t^5 - 15 t^4 + 10 t^3
//              (Perlin 2002, C2), linear t (C0)
//   gradients  sphere (the text), rejection (Perlin's own scheme), edges (Perlin 2002: the 12 edge
//              midpoints of a cube, of length sqrt 2); noises/lattice/lattice_dimensions.h has
//              those of 1, 2 and 4 dimensions and their variances
//   lattice    hash, or the text's perm256, which repeats after 256 cells
//              (noises/lattice/lattice.h)
//   component, period   noises/common_parameters.h; with a period no closed form
//
// Units: coordinates in cells. The noise is 0 at the lattice points; its gradient there is g_c,
// except for fade=linear, which has a kink there.
// Bound: noises/lattice/bounds.c. Mean 0, variance 0.0332853903 with the default settings; these
// and the band are exact, noises/closed_forms.h.
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
//
// Known defects: zeros on the whole lattice, and weaker noise on the lattice planes; slices through
// the planes have another spectrum than slices between them.
// Source: peachey2003, pp. 72-77. Deviations: gradients by hash of 64-bit cells, not from a table
// of 256; the sphere's longitude in 2^15 steps; perm256 draws its words by the same hash.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/lattice/gradient_dimensions.h"
#include "noises/noise.h"
#include "noises/textbook_loops.h"

typedef struct gradient_parameters {
    bl_lattice_settings lattice;
    uint32_t fade, gradients, dimensions;
} gradient_parameters;

static bl_gradient_noise gradient_noise_of(const void *block) {
    const gradient_parameters *p = block;
    return bl_gradient_noise_of(&p->lattice, p->fade, p->gradients);
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    const gradient_parameters *p = block;
    bl_gradient_noise noise = gradient_noise_of(block);
    if (p->dimensions == 3)
        bl_gradient_row(&noise, start, step, 0, count, out);
    else
        bl_gradient_row_in(&noise, p->dimensions, start, step, count, out);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const gradient_parameters *p = block;
    bl_gradient_noise noise = gradient_noise_of(block);
    if (p->dimensions == 3)
        bl_gradient_points(&noise, at, count, out);
    else
        bl_gradient_points_in(&noise, p->dimensions, at, count, out);
}

static double reference(const void *block, const bl_gradient_noise *noise, const double at[BL_AXES],
                        double gradient[BL_AXES]) {
    const gradient_parameters *p = block;
    if (p->dimensions == 3)
        return bl_gradient_reference(noise, at, gradient);
    return bl_gradient_reference_in(noise, p->dimensions, at, gradient);
}

static double value_at(const void *block, const bl_gradient_noise *noise,
                       const double at[BL_AXES]) {
    return reference(block, noise, at, NULL);
}

BL_VALUES_OF_OPENED(bl_gradient_noise, gradient_noise_of)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_gradient_noise noise = gradient_noise_of(block);
    reference(block, &noise, at, out);
}

// E[g_a^2] of a component of the gradients.
static double component_variance(const gradient_parameters *p) {
    static const double edges[] = {0, 1, 1, 2.0 / 3, 3.0 / 4};
    if (p->gradients == BL_GRADIENTS_EDGES)
        return edges[p->dimensions];
    if (p->gradients == BL_GRADIENTS_SPHERE && p->dimensions == 1)
        return BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    return 1.0 / p->dimensions;
}

static bl_terms terms_of(const void *block) {
    const gradient_parameters *p = block;
    bl_terms terms = {.dimensions = p->dimensions};
    bl_terms_add_gradient(&terms, component_variance(p), bl_gradient_ramps[p->fade],
                          bl_gradient_weights[p->fade]);
    return terms;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const gradient_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_kernel weight = bl_gradient_weights[p->fade];
    bl_bound bound =
        bl_bound_gradient_in(weight, p->gradients == BL_GRADIENTS_EDGES, p->dimensions);
    bl_terms_describe(&terms, 1, &p->lattice, facts);
    bl_lattice_describe(bound, bl_kernel_continuity(weight), &p->lattice, facts);
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(gradient_parameters, "the gradients"),
    {"fade", BL_CHOICE, offsetof(gradient_parameters, fade), "cubic", "",
     .choices = bl_gradient_fades, .help = "the blend between the corners"},
    {"gradients", BL_CHOICE, offsetof(gradient_parameters, gradients), "sphere", "",
     .choices = bl_gradient_modes,
     .help = "how gradients are drawn: uniform on the sphere, by rejection, or edges of a cube"},
    BL_DIMENSIONS_PARAMETER(gradient_parameters, 1, 4, "3"),
    {0}};

BL_NOISE_DESCRIPTOR(gradient_noise) = {
    .name = "gnoise",
    .title = "gradient noise",
    .summary = "Random gradients at the lattice points, blended by a smooth fade.",
    .formula = "n(p) = sum_c (g_c . (p-c)) w(x-c_x) w(y-c_y) w(z-c_z), w(d) = 1 - fade(|d|)",
    .paper = "peachey2003, pp. 72-77",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(gradient_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = bl_textbook_gradient,
    .textbook_settings = BL_TEXTBOOK_GRADIENTS,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
