// SPDX-License-Identifier: MIT
//
// vnoise: value noise, interpolation of independent uniform numbers at the lattice points.
//
//   n(x,y,z) = sum over cells c of v_c k(x - c_x) k(y - c_y) k(z - c_z)
//
// and the same product over one, two or four axes with dims=1, 2, 4: the fourth may be time.
//
// Parameters
//   seed     64 bits, chooses the lattice numbers
//   dims     1 to 4, default 3. With a kernel that interpolates, 1 and 2 are the line y = z = 0 and
//            the slice z = 0 of the noise in space, for the cost of 4 and 16 lattice points; 4 is
//            another noise, of 256. dims=4,interp=bspline2 is the text's note 13.
//   interp   the kernel k:
//              catmull-rom  the text's spline, C1, support 2: 64 lattice points a sample
//              linear       1 - |x|, C0, support 1: 8 points; the boxy one the text warns of
//              smooth       1 - 3 x^2 + 2 |x|^3, C1, support 1
//              bspline2     quadratic B-spline, C1, support 3/2, knots at the half integers
//              bspline3     cubic B-spline, C2, support 2; the B-splines do not interpolate
//   lattice  hash, or the text's perm256, which repeats after 256 cells (noises/lattice/lattice.h)
//   component, period   noises/common_parameters.h; with a period no closed form, and
//            periods of 1 and 2 may be smoother than the class (a period of 1 is a constant)
//
// Units: coordinates in cells. Values v_c are uniform in (-1, 1). Bound: the largest sum of |k|
// over the lattice, to the power of the dimensions (noises/lattice/bounds.c). Mean 0, variance
// 0.179973761 with the default settings; these and the band are exact, noises/closed_forms.h.
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
//
// Known defects: the spectrum is not isotropic, and energy below and around 0 cycles per cell is
// not removed. The text calls Catmull-Rom's second derivative continuous; it jumps.
// Source: peachey2003, pp. 70-72. Deviations: lattice numbers by hash of 64-bit cells, not by a
// table of 256; kernels in closed form, not `spline`; perm256 draws its words by the same hash.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/noise.h"
#include "noises/textbook_loops.h"
#include "noises/lattice/value_dimensions.h"

typedef struct value_parameters {
    bl_lattice_settings lattice;
    uint32_t interp, dimensions;
} value_parameters;

static bl_value_noise value_noise_of(const void *block) {
    const value_parameters *p = block;
    return bl_value_noise_of(&p->lattice, p->interp);
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    const value_parameters *p = block;
    bl_value_noise noise = value_noise_of(block);
    if (p->dimensions == 3)
        bl_value_row(&noise, start, step, 0, count, out);
    else
        bl_value_row_in(&noise, p->dimensions, start, step, count, out);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const value_parameters *p = block;
    bl_value_noise noise = value_noise_of(block);
    if (p->dimensions == 3)
        bl_value_points(&noise, at, count, out);
    else
        bl_value_points_in(&noise, p->dimensions, at, count, out);
}

static double reference(const void *block, const bl_value_noise *noise, const double at[BL_AXES],
                        double gradient[BL_AXES]) {
    const value_parameters *p = block;
    if (p->dimensions == 3)
        return bl_value_reference(noise, at, gradient);
    return bl_value_reference_in(noise, p->dimensions, at, gradient);
}

static double value_at(const void *block, const bl_value_noise *noise, const double at[BL_AXES]) {
    return reference(block, noise, at, NULL);
}

BL_VALUES_OF_OPENED(bl_value_noise, value_noise_of)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_value_noise noise = value_noise_of(block);
    reference(block, &noise, at, out);
}

static bl_terms terms_of(const void *block) {
    const value_parameters *p = block;
    bl_terms terms = {.dimensions = p->dimensions};
    bl_terms_add_value(&terms, BL_VALUE_VARIANCE(BL_LATTICE_VALUES), bl_value_kernels[p->interp]);
    return terms;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const value_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_kernel kernel = bl_value_kernels[p->interp];
    bl_bound bound = bl_bound_value_in(kernel, p->dimensions);
    bl_terms_describe(&terms, 1, &p->lattice, facts);
    bl_lattice_describe(bound, bl_kernel_continuity(kernel), &p->lattice, facts);
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(value_parameters, "the lattice numbers"),
    {"interp", BL_CHOICE, offsetof(value_parameters, interp), "catmull-rom", "",
     .choices = bl_value_interps, .help = "the kernel between the lattice points"},
    BL_DIMENSIONS_PARAMETER(value_parameters, 1, 4, "3"),
    {0}};

BL_NOISE_DESCRIPTOR(value_noise) = {
    .name = "vnoise",
    .title = "value noise",
    .summary = "Uniform random values at the lattice points, interpolated by a spline.",
    .formula = "n(p) = sum_c v_c k(x-c_x) k(y-c_y) k(z-c_z), v_c uniform in (-1,1)",
    .paper = "peachey2003, pp. 70-72",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(value_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = bl_textbook_value,
    .textbook_settings = BL_TEXTBOOK_VALUES,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
