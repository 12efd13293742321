// SPDX-License-Identifier: MIT
//
// wiener: value noise by Wiener interpolation, after Lewis.
//
//   n(p) = sum over the 4x4x4 lattice points c around p of v_c k(x - c_x) k(y - c_y) k(z - c_z)
//
// with independent values v_c, weighted as if they were samples of a field with the covariance rho
// and the field at p were to be estimated with the least mean square error: w = C^-1 c(p), where C
// has the covariances of the points with one another and c(p) theirs with p. Here rho is a product
// rho(d) = r(d_x) r(d_y) r(d_z), so that C = C1 x C1 x C1 and c = c1(x) x c1(y) x c1(z) are
// Kronecker products, of the 4 by 4 covariances on a line. The inverse of a Kronecker product is
// that of its factors: C^-1 c = C1^-1 c1(x) x C1^-1 c1(y) x C1^-1 c1(z). The 64 weights are
// products of four numbers an axis, and these are an even kernel k of two pieces
// (noises/lattice/wiener_weights.h).
//
// Parameters
//   seed, lattice, component, period   of the values (noises/lattice/lattice.h)
//   covariance  r: gaussian exp(-(d/width)^2/2), exponential exp(-|d|/width), sinc
//               sin(pi d/width)/(pi d/width). Only the gaussian's product is isotropic
//   width       1/2 to 2 cells, default 1
//
// Units: coordinates in cells. Values v_c are uniform in (-1, 1); the noise is v_c at the lattice
// points. Because they are independent, the covariance of the noise is not rho: rho says how smooth
// the field between them is taken to be. Small widths fall to the mean, 0, between the points; wide
// gaussians come near to the cubic polynomial through four points.
//
// Bound: values below 1; (max_t sum_i |k(t - i)|)^3, by a grid and a bound of the slope, when the
// noise is opened. Mean 0; variance, covariance, density and band of a sum over a lattice (as in
// noises/closed_forms.h), by quadrature of k's polynomials, which is exact for the covariance; the
// polynomials are within 3e-9 of k.
// Class C0: the weights are continuous, because a point met exactly has the weight 1; but their
// slopes are those of other four points on the other side of a plane.
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
//
// Known defects: creases on the lattice planes; more variance at the lattice points than between.
// Source: Lewis 1989. Deviations: the covariance is a product and the neighbourhood 4 an axis, so
// that weights need no table of the place in the cell; rows and points take k as two polynomials of
// degree 13, the reference in double solves for the weights.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/noise.h"
#include "noises/textbook.h"
#include "noises/lattice/value_loops.h"
#include "noises/lattice/wiener_weights.h"

typedef struct wiener_parameters {
    bl_lattice_settings lattice;
    uint32_t covariance;
    double width;
    bl_wiener_kernel kernel; // made by build
} wiener_parameters;

static const char *const covariance_choices[] = {"gaussian", "exponential", "sinc", NULL};

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    wiener_parameters *p = block;
    (void)message;
    p->kernel = bl_wiener_kernel_of((bl_wiener_covariance)p->covariance, p->width);
    return BL_OK;
}

// --- weights ------------------------------------------------------------------------------------

enum { POWERS = (BL_WIENER_DEGREE + 1) / 2 };

// A piece as even(s^2) + s odd(s^2), s = t - 1/2: its mirror has the other sign.
typedef struct wiener_piece {
    float even[POWERS], odd[POWERS];
} wiener_piece;

static wiener_piece piece_of(const wiener_parameters *p, int piece) {
    wiener_piece result;
    for (int k = 0; k < POWERS; k++) {
        result.even[k] = (float)p->kernel.piece[piece][2 * k];
        result.odd[k] = (float)p->kernel.piece[piece][2 * k + 1];
    }
    return result;
}

// The weights of two mirrored points: `left` is that of x = t (inner piece) or t + 1 (outer).
static void fill_pair(const wiener_piece *piece, const float *restrict fraction, size_t lanes,
                      float *restrict left, float *restrict right) {
    const wiener_piece c = *piece;
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        float s = fraction[i] - 0.5f, q = s * s, even = c.even[POWERS - 1], odd = c.odd[POWERS - 1];
        for (int k = POWERS - 2; k >= 0; k--) {
            even = c.even[k] + q * even;
            odd = c.odd[k] + q * odd;
        }
        left[i] = even + s * odd;
        right[i] = even - s * odd;
    }
}

// --- points -------------------------------------------------------------------------------------

static void points(const void *block_of_parameters, const double *const at[BL_AXES], size_t count,
                   float *out) {
    const wiener_parameters *p = block_of_parameters;
    const bl_lattice lattice = bl_lattice_open(&p->lattice);
    const wiener_piece inner = piece_of(p, 0), outer = piece_of(p, 1);
    bl_point_block block;
    bl_value_weight_block weight;
    float value[BL_BLOCK];
    bl_point_block_begin(&block, &lattice, -1, 4);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        for (unsigned axis = 0; axis < 3; axis++) {
            const float *fraction = block.axis[axis].fraction;
            fill_pair(&inner, fraction, block.lanes, weight[axis][1], weight[axis][2]);
            fill_pair(&outer, fraction, block.lanes, weight[axis][0], weight[axis][3]);
        }
        if (lattice.kind == BL_LATTICE_HASH)
            bl_value_block_of_64(&block, weight, value);
        else
            bl_value_block_of_any(&block, weight, value);
        bl_point_block_store(&block, value, (float)BL_LATTICE_UNIT, here, out + done);
    }
}

// --- rows ---------------------------------------------------------------------------------------

// The planes lie as those of the Catmull-Rom spline.
static int prepare_row(bl_value_row_plan *plan, const wiener_parameters *p,
                       const bl_lattice *lattice, unsigned axis, const double start[BL_AXES]) {
    plan->shape = &bl_interp_shapes[BL_INTERP_CATMULL_ROM];
    plan->hashed = lattice->kind == BL_LATTICE_HASH;
    if (!plan->hashed)
        bl_perm256_words(lattice, 0, plan->words256);
    if (!bl_row_cross_load(&plan->cross, lattice, axis, start, -1, 4, 0))
        return 0;
    for (int b = 0; b < 2; b++)
        for (int knot = 0; knot < 4; knot++) {
            double k = bl_wiener_value(&p->kernel, plan->cross.fraction[b] - (knot - 1));
            plan->weight[b][knot] = (float)(k * (b == 1 ? BL_LATTICE_UNIT : 1));
        }
    return 1;
}

static void row_samples(const bl_row_block *block, const wiener_piece *inner,
                        const wiener_piece *outer, const float *restrict plane,
                        float *restrict out) {
    float weight[4][BL_ROW];
    const uint32_t *restrict index = block->index;
    fill_pair(inner, block->fraction, block->count, weight[1], weight[2]);
    fill_pair(outer, block->fraction, block->count, weight[0], weight[3]);
#pragma omp simd
    for (size_t i = 0; i < block->count; i++) {
        uint32_t m = index[i];
        out[i] = (plane[m] * weight[0][i] + plane[m + 1] * weight[1][i]) +
                 (plane[m + 2] * weight[2][i] + plane[m + 3] * weight[3][i]);
    }
}

static void row(const void *block_of_parameters, const double start[BL_AXES],
                const double step[BL_AXES], size_t count, float *out) {
    const wiener_parameters *p = block_of_parameters;
    const bl_lattice lattice = bl_lattice_open(&p->lattice);
    bl_value_row_plan plan;
    bl_row_block block;
    float plane[BL_PLANES];
    int axis = bl_row_axis(step, 2);
    if (axis < 0 || !prepare_row(&plan, p, &lattice, (unsigned)axis, start)) {
        bl_row_by_points(points, p, start, step, 0, count, out);
        return;
    }
    const wiener_piece inner = piece_of(p, 0), outer = piece_of(p, 1);
    for (size_t done = 0; done < count; done += block.count) {
        if (!bl_row_block_load(&block, start[axis], step[axis], done, count - done, 0)) {
            bl_row_nan(&block, out + done);
            continue;
        }
        bl_value_row_planes(&block, &plan, &lattice, plane);
        row_samples(&block, &inner, &outer, plane, out + done);
    }
}

// --- the reference in double --------------------------------------------------------------------

static double reference(const wiener_parameters *p, const bl_lattice *lattice,
                        const double at[BL_AXES], double gradient[BL_AXES]) {
    bl_reference_cells cells;
    double sum = 0, slopes[BL_AXES] = {0}, w[3][4], s[3][4];
    int inside = bl_reference_cells_load(&cells, lattice, 3, at, -1, 4);
    for (int a = 0; inside && a < 3; a++)
        bl_wiener_weights(&p->kernel, cells.fraction[a], w[a], s[a]);
    for (unsigned corner = 0; inside && corner < 64; corner++) {
        const unsigned i = corner % 4, j = corner / 4 % 4, k = corner / 16;
        const unsigned knot[BL_AXES] = {i, j, k};
        double v = bl_lattice_value(bl_reference_word(&cells, knot, 0)) * BL_LATTICE_UNIT;
        sum += v * w[0][i] * w[1][j] * w[2][k];
        if (!gradient)
            continue;
        slopes[0] += v * s[0][i] * w[1][j] * w[2][k];
        slopes[1] += v * w[0][i] * s[1][j] * w[2][k];
        slopes[2] += v * w[0][i] * w[1][j] * s[2][k];
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

static bl_lattice open_lattice(const void *block) {
    const wiener_parameters *p = block;
    return bl_lattice_open(&p->lattice);
}

static double value_at(const void *block, const bl_lattice *lattice, const double at[BL_AXES]) {
    return reference(block, lattice, at, NULL);
}

BL_VALUES_OF_OPENED(bl_lattice, open_lattice)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_lattice lattice = open_lattice(block);
    reference(block, &lattice, at, out);
}

// --- closed forms and facts ---------------------------------------------------------------------

static double covariance(const void *block, const double lag[BL_AXES]) {
    const wiener_parameters *p = block;
    double product = BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    for (int a = 0; a < 3 && product != 0; a++)
        product *= bl_wiener_correlation(&p->kernel, lag[a]);
    return product;
}

static double density(const void *block, const double frequency[BL_AXES]) {
    const wiener_parameters *p = block;
    double product = BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    for (int a = 0; a < 3; a++) {
        double transform = bl_wiener_transform(&p->kernel, frequency[a]);
        product *= transform * transform;
    }
    return product;
}

// The covariance along x except for a factor.
static double along_x(const void *block, const double lag[BL_AXES]) {
    const wiener_parameters *p = block;
    return bl_wiener_correlation(&p->kernel, lag[0]);
}

static void describe(const void *block, bl_facts *facts) {
    const wiener_parameters *p = block;
    bl_bound bound = {pow(bl_wiener_largest_sum(&p->kernel), 3),
                      "values below 1; the sizes of the weights along an axis sum to no more than "
                      "at 4097 places and half a step of their steepest slope beyond, cubed"};
    bl_lattice_describe(bound, 0, &p->lattice, facts);
    facts->mean = 0;
    if (bl_lattice_differs_within(&p->lattice, 3, 4))
        facts->variance = covariance(block, (const double[BL_AXES]){0});
    if (!bl_lattice_has_closed_form(block))
        return;
    facts->covariance_reach = 4;
    facts->band_from = 0;
    facts->band_to = 1;
    facts->leak_db = ceil(1000 * log10(bl_covariance_share_above(along_x, block, 4, 1))) / 100;
}

static const char *const width_examples[] = {"0.7", NULL};

// Four covariances an axis times the inverse matrix, which is a table; then the 64 points.
static void textbook_weights(float t, float weight[4]) {
    float near[4];
    for (int i = 0; i < 4; i++) {
        float d = t - (float)(i - 1);
        near[i] = expf(-0.5f * d * d);
    }
    for (int i = 0; i < 4; i++) {
        weight[i] = 0;
        for (int j = 0; j < 4; j++)
            weight[i] += bl_textbook_data.inverse[i][j] * near[j];
    }
}

static float textbook(float x, float y, float z) {
    int ix = bl_textbook_floor(x), iy = bl_textbook_floor(y), iz = bl_textbook_floor(z);
    float wx[4], wy[4], wz[4], sum = 0;
    textbook_weights(x - (float)ix, wx);
    textbook_weights(y - (float)iy, wy);
    textbook_weights(z - (float)iz, wz);
    for (int k = 0; k < 4; k++)
        for (int j = 0; j < 4; j++)
            for (int i = 0; i < 4; i++) {
                int index = bl_textbook_index(ix + i - 1, iy + j - 1, iz + k - 1);
                sum += bl_textbook_data.values[index] * wx[i] * wy[j] * wz[k];
            }
    return sum;
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(wiener_parameters, "the lattice numbers"),
    {"covariance", BL_CHOICE, offsetof(wiener_parameters, covariance), "gaussian", "",
     .choices = covariance_choices,
     .help = "that the field between the lattice points is taken to have, along each axis"},
    {"width", BL_REAL, offsetof(wiener_parameters, width), "1", "cells", .minimum = 0.5,
     .maximum = 2, .examples = width_examples, .help = "of the covariance"},
    {0}};

BL_NOISE_DESCRIPTOR(wiener_noise) = {
    .name = "wiener",
    .title = "Wiener interpolation noise",
    .summary =
        "Random values at the lattice points, joined by the estimate of least mean square "
        "error.",
    .formula =
        "n(p) = sum_c v_c k(x-c_x) k(y-c_y) k(z-c_z), k(t - i) = (C^-1 c(t))_i, "
        "C_ij = rho(i-j), c_i = rho(t-i)",
    .paper = "lewis1989",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(wiener_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_VALUES,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM,
                  .build = build},
};
