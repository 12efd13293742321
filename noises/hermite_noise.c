// SPDX-License-Identifier: MIT
//
// hermite: value-gradient noise by cubic Hermite interpolation, after Ward.
//
//   n(p) = sum over the 8 corners c of the cell, d = p - c, of
//          v_c h0(d_x) h0(d_y) h0(d_z) + sum over axes a of g_ca h1(d_a) prod_{b != a} h0(d_b)
//   h0(t) = 1 - 3 t^2 + 2 |t|^3,  h1(t) = t (1 - |t|)^2
//
// Parameters
//   seed     64 bits, chooses values and tangents
//   lattice  hash, or the text's perm256, which repeats after 256 cells (noises/lattice/lattice.h)
//   component, period   noises/common_parameters.h; with a period no closed form
//
// v_c and the three tangent components g_ca are independent and uniform in (-1, 1). At a lattice
// point the noise is v_c and its gradient g_c. Units: coordinates in cells. C1 across every face:
// on a face both sides blend the same corners, and so do their slopes across it. Bound:
// noises/lattice/bounds.c. Mean 0, variance 0.147156463; these and the band are exact,
// noises/closed_forms.h.
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
//
// Source: peachey2003, p. 77, which names Ward (1991) and prints no code. Deviations: Ward's
// program was not at hand; this is the tensor form of cubic Hermite interpolation with the mixed
// derivatives at the corners 0, and tangents uniform in a cube.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/closed_forms.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/textbook.h"
#include "noises/lattice/separable.h"

typedef struct hermite_parameters {
    bl_lattice_settings lattice;
} hermite_parameters;

static bl_lattice lattice_of(const void *block) {
    const hermite_parameters *p = block;
    return bl_lattice_open(&p->lattice);
}

static double value_weight(double t, double *slope) {
    double d = fabs(t);
    *slope = 6 * t * (d - 1);
    return 1 - d * d * (3 - 2 * d);
}

static double tangent_weight(double t, double *slope) {
    double d = fabs(t);
    *slope = (1 - d) * (1 - 3 * d);
    return t * (1 - d) * (1 - d);
}

// --- points -------------------------------------------------------------------------------------

// Weights of the two planes of an axis, for values and for tangents.
typedef struct axis_weights {
    float value[2][BL_BLOCK], tangent[2][BL_BLOCK];
} axis_weights;

static void fill_weights(const float *restrict fraction, size_t lanes,
                         axis_weights *restrict weights) {
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        float t = fraction[i], rest = 1 - t, right = t * t * (3 - 2 * t);
        weights->value[0][i] = 1 - right;
        weights->value[1][i] = right;
        weights->tangent[0][i] = t * (rest * rest);
        weights->tangent[1][i] = -rest * (t * t);
    }
}

// Adds one corner; the words are those of its value and its three tangent components.
static void add_corner(uint32_t (*restrict words)[BL_BLOCK], const int knot[3], size_t lanes,
                       const axis_weights *restrict weights, float *restrict out) {
    const float *restrict vx = weights[0].value[knot[0]], *restrict vy = weights[1].value[knot[1]],
                          *restrict vz = weights[2].value[knot[2]],
                          *restrict tx = weights[0].tangent[knot[0]],
                          *restrict ty = weights[1].tangent[knot[1]],
                          *restrict tz = weights[2].tangent[knot[2]];
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        float along_x =
            bl_lattice_value(words[0][i]) * vx[i] + bl_lattice_value(words[1][i]) * tx[i];
        float along_y = bl_lattice_value(words[2][i]) * ty[i];
        float along_z = bl_lattice_value(words[3][i]) * tz[i];
        out[i] += (along_x * vy[i] + along_y * vx[i]) * vz[i] + along_z * (vx[i] * vy[i]);
    }
}

static void lattice_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                           float *out) {
    bl_point_block block;
    axis_weights weights[3];
    uint32_t words[BL_COMPONENTS][BL_BLOCK];
    float value[BL_BLOCK];
    bl_point_block_begin(&block, parameters, 0, 2);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        for (unsigned axis = 0; axis < 3; axis++)
            fill_weights(block.axis[axis].fraction, block.lanes, &weights[axis]);
        memset(value, 0, sizeof value);
        for (int corner = 0; corner < 8; corner++) {
            const int knot[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
            for (unsigned component = 0; component < BL_COMPONENTS; component++)
                bl_point_block_words(&block, knot, component, words[component]);
            add_corner(words, knot, block.lanes, weights, value);
        }
        bl_point_block_store(&block, value, (float)BL_LATTICE_UNIT, here, out + done);
    }
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    bl_lattice lattice = lattice_of(block);
    lattice_points(&lattice, at, count, out);
}

// --- rows ---------------------------------------------------------------------------------------

typedef struct row_plan {
    bl_row_cross cross;
    double value[2][2], tangent[2][2]; // weights of the planes across
    uint32_t words256[BL_COMPONENTS][256];
} row_plan;

static int prepare_row(row_plan *plan, const bl_lattice *lattice, unsigned axis,
                       const double start[BL_AXES]) {
    if (lattice->kind == BL_LATTICE_PERM256)
        for (unsigned component = 0; component < BL_COMPONENTS; component++)
            bl_perm256_words(lattice, component, plan->words256[component]);
    if (!bl_row_cross_load(&plan->cross, lattice, axis, start, 0, 2, 0))
        return 0;
    for (int b = 0; b < 2; b++)
        for (int knot = 0; knot < 2; knot++) {
            double slope, t = plan->cross.fraction[b] - knot;
            plan->value[b][knot] = value_weight(t, &slope);
            plan->tangent[b][knot] = tangent_weight(t, &slope);
        }
    return 1;
}

static void add_words(size_t lanes, const uint32_t *restrict words, float weight,
                      float *restrict sum) {
#pragma omp simd
    for (size_t m = 0; m < lanes; m++)
        sum[m] += bl_lattice_value(words[m]) * weight;
}

static void hash_words(size_t lanes, const uint32_t *restrict add,
                       const uint32_t *restrict exclusive, uint32_t plus, uint32_t exor,
                       uint32_t *restrict words) {
#pragma omp simd
    for (size_t m = 0; m < lanes; m++)
        words[m] = (add[m] + plus) * (exclusive[m] ^ exor);
}

// The noise on each plane of a row, and its slope along the row there.
static void row_planes(const bl_row_block *block, const row_plan *plan, const bl_lattice *lattice,
                       float *level, float *slope) {
    uint32_t add[BL_PLANES], exclusive[BL_PLANES], words[BL_PLANES];
    const bl_row_cross *cross = &plan->cross;
    bl_row_keys(block, lattice, cross->axis, 0, add, exclusive);
    memset(level, 0, block->lanes * sizeof *level);
    memset(slope, 0, block->lanes * sizeof *slope);
    for (unsigned n = 0; n < 4 * BL_COMPONENTS; n++) {
        unsigned j = n & 1, k = n >> 1 & 1, component = n >> 2;
        // Component 0 is the value; 1 + a is the tangent along axis a.
        double first = component == 1 + cross->across[0] ? plan->tangent[0][j] : plan->value[0][j];
        double second = component == 1 + cross->across[1] ? plan->tangent[1][k] : plan->value[1][k];
        if (lattice->kind == BL_LATTICE_HASH)
            hash_words(block->lanes, add, exclusive,
                       cross->key[0][j].add + cross->key[1][k].add + lattice->add[component],
                       cross->key[0][j].exclusive ^ cross->key[1][k].exclusive ^
                           lattice->exclusive[component],
                       words);
        else
            bl_row_words256(block, cross, plan->words256[component], 0, (int)j, (int)k, words);
        add_words(block->lanes, words, (float)(first * second * BL_LATTICE_UNIT),
                  component == 1 + cross->axis ? slope : level);
    }
}

// The last two coefficients of the cubic between two levels and two slopes.
static void hermite_cubics(size_t cells, const float *restrict level, const float *restrict slope,
                           float *restrict square, float *restrict cube) {
#pragma omp simd
    for (size_t m = 0; m < cells; m++) {
        float rise = level[m + 1] - level[m];
        square[m] = 3 * rise - 2 * slope[m] - slope[m + 1];
        cube[m] = slope[m] + slope[m + 1] - 2 * rise;
    }
}

// A plane costs 16 words where a point costs 32.
static void row(const void *block_of_parameters, const double start[BL_AXES],
                const double step[BL_AXES], size_t count, float *out) {
    bl_lattice lattice = lattice_of(block_of_parameters);
    row_plan plan;
    bl_row_block block;
    float cubic[4][BL_PLANES];
    int axis = bl_row_axis(step, 1.5);
    if (axis < 0 || !prepare_row(&plan, &lattice, (unsigned)axis, start)) {
        bl_row_by_points(lattice_points, &lattice, start, step, 0, count, out);
        return;
    }
    for (size_t done = 0; done < count; done += block.count) {
        if (!bl_row_block_load(&block, start[axis], step[axis], done, count - done, 0)) {
            bl_row_nan(&block, out + done);
            continue;
        }
        row_planes(&block, &plan, &lattice, cubic[0], cubic[1]);
        hermite_cubics(block.cells, cubic[0], cubic[1], cubic[2], cubic[3]);
        bl_row_evaluate(&block, bl_row_cubic, cubic, block.fraction, out + done);
    }
}

// --- the reference in double --------------------------------------------------------------------

static double reference(const bl_lattice *lattice, const double at[BL_AXES],
                        double gradient[BL_AXES]) {
    bl_reference_cells cells;
    double sum = 0, slopes[BL_AXES] = {0};
    double value[3][2], tangent[3][2], value_slope[3][2], tangent_slope[3][2];
    int inside = bl_reference_cells_load(&cells, lattice, 3, at, 0, 2);
    for (unsigned a = 0; inside && a < 3; a++)
        for (unsigned bit = 0; bit < 2; bit++) {
            value[a][bit] = value_weight(cells.fraction[a] - bit, &value_slope[a][bit]);
            tangent[a][bit] = tangent_weight(cells.fraction[a] - bit, &tangent_slope[a][bit]);
        }
    for (unsigned n = 0; inside && n < 8 * BL_COMPONENTS; n++) {
        unsigned corner = n & 7, component = n >> 3, knot[BL_AXES] = {0};
        double w[3], s[3];
        for (unsigned a = 0; a < 3; a++) {
            knot[a] = corner >> a & 1;
            w[a] = component == 1 + a ? tangent[a][knot[a]] : value[a][knot[a]];
            s[a] = component == 1 + a ? tangent_slope[a][knot[a]] : value_slope[a][knot[a]];
        }
        double number =
            bl_lattice_value(bl_reference_word(&cells, knot, component)) * BL_LATTICE_UNIT;
        sum += number * w[0] * w[1] * w[2];
        slopes[0] += number * s[0] * w[1] * w[2];
        slopes[1] += number * w[0] * s[1] * w[2];
        slopes[2] += number * w[0] * w[1] * s[2];
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

static double value_at(const void *block, const bl_lattice *lattice, const double at[BL_AXES]) {
    (void)block;
    return reference(lattice, at, NULL);
}

BL_VALUES_OF_OPENED(bl_lattice, lattice_of)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_lattice lattice = lattice_of(block);
    reference(&lattice, at, out);
}

static bl_terms terms_of(const void *block) {
    (void)block;
    bl_terms terms = {0};
    double variance = BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    bl_terms_add_value(&terms, variance, BL_KERNEL_SMOOTH);
    bl_terms_add_gradient(&terms, variance, BL_KERNEL_TANGENT, BL_KERNEL_SMOOTH);
    return terms;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const hermite_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_bound bound = bl_bound_hermite();
    bl_terms_describe(&terms, 1, &p->lattice, facts);
    bl_lattice_describe(bound, 1, &p->lattice, facts);
}

// One value and three tangents a corner, as the sum is written.
static float textbook(float x, float y, float z) {
    int ix = bl_textbook_floor(x), iy = bl_textbook_floor(y), iz = bl_textbook_floor(z);
    float fx = x - (float)ix, fy = y - (float)iy, fz = z - (float)iz, sum = 0;
    for (int k = 0; k <= 1; k++)
        for (int j = 0; j <= 1; j++)
            for (int i = 0; i <= 1; i++) {
                int index = bl_textbook_index(ix + i, iy + j, iz + k);
                const float *tangent = &bl_textbook_data.tangents[3 * index];
                const float d[3] = {fx - (float)i, fy - (float)j, fz - (float)k};
                float h0[3], h1[3];
                for (int a = 0; a < 3; a++) {
                    float r = fabsf(d[a]);
                    h0[a] = 1 - r * r * (3 - 2 * r);
                    h1[a] = d[a] * (1 - r) * (1 - r);
                }
                sum += bl_textbook_data.values[index] * h0[0] * h0[1] * h0[2] +
                       tangent[0] * h1[0] * h0[1] * h0[2] + tangent[1] * h0[0] * h1[1] * h0[2] +
                       tangent[2] * h0[0] * h0[1] * h1[2];
            }
    return sum;
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(hermite_parameters, "the values and the tangents"), {0}};

BL_NOISE_DESCRIPTOR(hermite_noise) = {
    .name = "hermite",
    .title = "Hermite noise",
    .summary = "Random values and tangents at the lattice points, by cubic Hermite interpolation.",
    .formula = "n(p) = sum_c [v_c prod_b h0(d_b) + sum_a g_ca h1(d_a) prod_{b!=a} h0(d_b)]",
    .paper = "peachey2003, p. 77",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(hermite_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_VALUES,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
