// SPDX-License-Identifier: MIT
//
// scnoise: sparse convolution noise, impulses at random places convolved with a radial kernel.
//
//   n(p) = 1/N  sum over cells c, impulses k = 1..N of  a_ck K(|p - c - x_ck|)
//
// x_ck uniform in the cell, a_ck uniform in (-1, 1), K the radial Catmull-Rom kernel of radius 2
// (radial_kernel.h); cells within two of p's cell can reach it.
//
// Parameters
//   seed      any 64-bit number
//   impulses  N, 1 to 64 impulses a cell; the sum is divided by N, as in the text, so the standard
//             deviation falls as 1/sqrt(N)
//   lattice   hash: no period; perm256: the text's index of 256 entries, period 256
//   kernel    exact; table:R: the text's table, R entries a unit of squared distance, nearest entry
//             (1 to 1000000, 100 in the text); evaluated in double, without the fast paths
//
// Range: bounded by the number of impulses in reach (closed_forms.h); not [-1, 1].
// Band: that of the kernel's transform: low pass, most of it below 1 cycle a cell, and a tail that
// falls as f^-4 in amplitude as for every C1 radial kernel in space; DC is not 0.
// Known defects: the number of impulses in a cell is fixed, which is not Poisson, though the
// spectrum is the same since amplitudes are independent with mean 0. With kernel=table the noise is
// discontinuous.
// Deviations from peachey2003, pp. 80-83: random numbers come from a hash of cell and seed; with
// perm256 every index has N entries of its own, where the text lets impulse k+1 of entry h be
// impulse k of entry h+1, so that cells share impulses.
//
// Float results are within 1e-6 of the double reference at any coordinate below 2^31 (N = 3).
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "core/hash.h"
#include "noises/common_parameters.h"
#include "noises/closed_forms.h"
#include "noises/convolution_cells.h"
#include "noises/convolution_row.h"
#include "noises/noise.h"
#include "noises/radial_kernel.h"
#include "noises/sparse_impulses.h"
#include "noises/sparse_points.h"
#include "noises/sparse_row.h"
#include "noises/textbook.h"

typedef struct sparse_parameters {
    bl_lattice_settings lattice;
    uint32_t impulses;
    uint32_t kernel;
    uint32_t table_rate;
} sparse_parameters;

enum { KERNEL_EXACT, KERNEL_TABLE };

static const char *const kernels[] = {"exact", "table:N", NULL};

#define AT(field) offsetof(sparse_parameters, field)
static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(sparse_parameters, "the impulses"),
    {.key = "impulses",
     .kind = BL_INTEGER,
     .offset = AT(impulses),
     .minimum = 1,
     .maximum = IMPULSES_MOST,
     .fallback = "3",
     .unit = "a cell",
     .help = "impulses in each cell; the sum is divided by it"},
    BL_KERNEL_PARAMETER(sparse_parameters, kernels),
    {.key = NULL}};
#undef AT

// --- the reference ------------------------------------------------------------------------------

// Value and gradient at once.
static void evaluate(const sparse_parameters *p, const double at[BL_AXES], double *value_out,
                     double gradient_out[3]) {
    bl_lattice lattice = bl_lattice_open(&p->lattice);
    impulse_factors factors;
    impulse_factors_open(&factors, p->impulses);
    uint64_t cell[3];
    double fraction[3], sum = 0, slope[3] = {0};
    for (int a = 0; a < 3; a++)
        if (!bl_lattice_split(at[a], &cell[a], &fraction[a])) {
            *value_out = gradient_out[0] = gradient_out[1] = gradient_out[2] = NAN;
            return;
        }
    for (int i = 0; i < 125; i++) {
        int offset[3] = {i / 25 - 2, i / 5 % 5 - 2, i % 5 - 2};
        uint64_t visited[3];
        for (int a = 0; a < 3; a++)
            visited[a] = cell[a] + (uint64_t)(int64_t)offset[a];
        cell_words words = cell_words_at(&lattice, visited);
        for (uint32_t n = 0; n < p->impulses; n++) {
            impulse one = impulse_of(&factors, words, n);
            double d[3], square = 0;
            for (int a = 0; a < 3; a++) {
                d[a] = fraction[a] - offset[a] - one.place[a];
                square += d[a] * d[a];
            }
            double r = sqrt(square);
            sum += one.amplitude * (p->kernel == KERNEL_EXACT
                                        ? radial_kernel(r)
                                        : radial_kernel_table(square, p->table_rate));
            for (int a = 0; a < 3; a++)
                slope[a] += one.amplitude * radial_kernel_slope(r) * d[a];
        }
    }
    *value_out = sum / p->impulses;
    for (int a = 0; a < 3; a++)
        gradient_out[a] = slope[a] / p->impulses;
}

static double value(const void *block, const double at[BL_AXES]) {
    double result, unused[3];
    evaluate(block, at, &result, unused);
    return result;
}

// The gradient of the exact kernel, for the table too, which has none.
static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    double unused;
    evaluate(block, at, &unused, out);
    out[3] = 0;
}

// --- points -------------------------------------------------------------------------------------

// A table jumps between its entries: only the exact squared distance finds the reference's entry.
static void points_by_value(const void *block, const double *const at[BL_AXES], size_t count,
                            float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = (float)value(block, (double[BL_AXES]){at[0][i], at[1][i], at[2][i], 0});
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const sparse_parameters *p = block;
    if (p->kernel != KERNEL_EXACT) {
        points_by_value(block, at, count, out);
        return;
    }
    sparse_source source;
    sparse_source_open(&source, &p->lattice, p->impulses);
    sparse_points(&source, at, count, out);
}

// --- rows ---------------------------------------------------------------------------------------

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    const sparse_parameters *p = block;
    axis_row along;
    size_t from, to;
    find_inside(start, step, count, &from, &to);
    if (p->kernel == KERNEL_EXACT && from < to &&
        axis_row_open(&along, start, step, from, to - from) &&
        tiles_repeat(&p->lattice, along.axis)) {
        sparse_source source;
        sparse_source_open(&source, &p->lattice, p->impulses);
        sparse_row(&source, &along, to - from, out + from);
    } else {
        to = from;
    }
    row_by_points(points, block, start, step, 0, from, out);
    row_by_points(points, block, start, step, to, count - to, out + to);
}

// --- the text's own loops -----------------------------------------------------------------------

static float textbook_kernel(const bl_textbook *tables, float squared) {
    if (squared >= 4)
        return 0;
    int entry = bl_textbook_floor(squared * 100 + 0.5f);
    return entry > 400 ? 0 : tables->kernel[entry];
}

static float textbook(float x, float y, float z) {
    const bl_textbook *tables = bl_textbook_tables();
    int cell_x = bl_textbook_floor(x), cell_y = bl_textbook_floor(y), cell_z = bl_textbook_floor(z);
    float fx = x - (float)cell_x, fy = y - (float)cell_y, fz = z - (float)cell_z, sum = 0;
    for (int i = -2; i <= 2; i++)
        for (int j = -2; j <= 2; j++)
            for (int k = -2; k <= 2; k++) {
                int entry = bl_textbook_index(cell_x + i, cell_y + j, cell_z + k);
                for (int n = 0; n < 3; n++, entry = (entry + 1) & 255) {
                    const float *one = tables->impulses + 4 * entry;
                    float dx = fx - ((float)i + one[0]), dy = fy - ((float)j + one[1]),
                          dz = fz - ((float)k + one[2]);
                    sum += textbook_kernel(tables, dx * dx + dy * dy + dz * dz) * one[3];
                }
            }
    return sum / 3;
}

// --- what it states -----------------------------------------------------------------------------

static bl_terms terms_of(const sparse_parameters *p) {
    bl_terms terms = {.count = 0};
    // Each impulse is a radial term of variance E[a^2]/N^2, and a cell has N of them.
    bl_terms_add_radial(&terms, BL_VALUE_VARIANCE(1 << 20) / p->impulses);
    return terms;
}

static int has_closed_form(const void *block) {
    const sparse_parameters *p = block;
    return bl_lattice_is_hash(&p->lattice) && p->kernel == KERNEL_EXACT;
}

static double covariance(const void *block, const double lag[BL_AXES]) {
    bl_terms terms = terms_of(block);
    return bl_terms_covariance(&terms, lag);
}

static double density(const void *block, const double frequency[BL_AXES]) {
    bl_terms terms = terms_of(block);
    return bl_terms_density(&terms, frequency);
}

static void describe(const void *block, bl_facts *facts) {
    const sparse_parameters *p = block;
    bl_terms terms = terms_of(p);
    bl_terms_describe(&terms, has_closed_form(block), facts);
    facts->stationary = facts->isotropic = bl_lattice_is_hash(&p->lattice);
    bl_bound bound = bl_bound_sparse_convolution(p->kernel == KERNEL_EXACT ? 0 : p->table_rate);
    bl_lattice_describe(bound, p->kernel == KERNEL_EXACT ? 1 : -1, &p->lattice, facts);
}

BL_NOISE_DESCRIPTOR(sparse_convolution) = {
    .name = "scnoise",
    .title = "sparse convolution noise",
    .summary = "Random impulses at random places, convolved with a radial Catmull-Rom kernel.",
    .formula = "1/N sum over cells c and impulses k of a_ck K(|p - c - x_ck|)",
    .paper = "peachey2003, pp. 80-83",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(sparse_parameters),
    .seed_offset = offsetof(sparse_parameters, lattice.seed),
    .describe = describe,
    .has_closed_form = has_closed_form,
    .textbook = textbook,
    .functions = {.row = row,
                  .points = points,
                  .value = value,
                  .gradient = gradient,
                  .covariance = covariance,
                  .density = density},
};
