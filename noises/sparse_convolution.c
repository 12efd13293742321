// SPDX-License-Identifier: MIT
//
// scnoise: sparse convolution noise, impulses at random places convolved with a radial kernel.
//
//   n(p) = 1/N  sum over cells c, impulses k of  a_ck K(|p - c - x_ck|)
//
// x_ck uniform in the cell, a_ck uniform in (-1, 1), K a radial kernel of radius 2; cells within
// two of p's cell can reach it.
//
// Parameters
//   seed      any 64-bit number
//   impulses  N, 1 to 64 impulses a cell; the sum is divided by N, as in the text, so the standard
//             deviation falls as 1/sqrt(N)
//   lattice   hash: no period; perm256: the text's index of 256 entries, period 256
//   component, period   noises/common_parameters.h; with a period no closed form
//   count     fixed: N in every cell, as in the text; poisson: a true Poisson number of mean N
//             (impulses.h). Both have the same covariance
//   kernel    exact: the radial Catmull-Rom kernel (radial_kernel.h); table:R: the text's table of
//             it, R entries a unit of squared distance, nearest entry (1 to 1000000, 100 in the
//             text), evaluated in double, without the fast paths; cosine: (1 + cos(pi r/2))/2, the
//             window of lewis1989; gaussian: of standard deviation 0.5774, less its tangent at
//             r = 2 (impulse_profiles.h)
//
// Range: bounded by the number of impulses in reach (closed_forms.h, impulse_profiles.h), for
// poisson by the largest count that occurs; not [-1, 1].
// Band: that of the kernel's transform: low pass, most of it below 1 cycle a cell, and a tail that
// falls as f^-4 in amplitude as for every C1 radial kernel in space; DC is not 0.
// The spectrum is E[a^2]/N |K^|^2, of variance E[a^2]/N int K^2, E[a^2] = (1 - 2^-40)/3:
// 0.0603939328 with the default settings.
// Known defects: a fixed number of impulses in a cell is not Poisson, though the spectrum is the
// same since amplitudes are independent with mean 0; fourth moments tell (t-impulses). With
// kernel=table the noise is discontinuous.
// Deviations from peachey2003, pp. 80-83: random numbers come from a hash of cell and seed; with
// perm256 every index has N entries of its own, where the text lets impulse k+1 of entry h be
// impulse k of entry h+1, so that cells share impulses.
//
// Float results are within 1e-6 of the double reference at any coordinate below 2^62 (N = 3);
// beyond, for NaN and for infinity the noise is NaN, and from 2^52 on the fraction within a cell is
// lost.
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "core/hash.h"
#include "noises/common_parameters.h"
#include "noises/closed_forms.h"
#include "noises/impulses/convolution_cells.h"
#include "noises/impulses/convolution_row.h"
#include "noises/impulses/impulse_profiles.h"
#include "noises/impulses/impulses.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/impulses/profile_float.h"
#include "noises/lattice/radial_kernel.h"
#include "noises/impulses/sparse_impulses.h"
#include "noises/impulses/sparse_points.h"
#include "noises/impulses/sparse_row.h"
#include "noises/textbook_loops.h"

typedef struct sparse_parameters {
    bl_lattice_settings lattice;
    uint32_t impulses;
    uint32_t count;
    uint32_t kernel;
    uint32_t table_rate;
} sparse_parameters;

enum { KERNEL_EXACT, KERNEL_TABLE, KERNEL_COSINE, KERNEL_GAUSSIAN };

static const char *const kernels[] = {"exact", "table:N", "cosine", "gaussian", NULL};

#define AT(field) offsetof(sparse_parameters, field)
static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(sparse_parameters, "the impulses"),
    {"impulses", BL_INTEGER, AT(impulses), "3", "a cell", .minimum = 1, .maximum = IMPULSES_MOST,
     .help = "impulses in each cell; the sum is divided by it"},
    IMPULSE_COUNT_PARAMETER(sparse_parameters, "fixed"),
    {"kernel", BL_CHOICE, AT(kernel), "exact", "entries a unit", .minimum = 1, .maximum = 1000000,
     .choices = kernels, .number_offset = AT(table_rate),
     .help = "exact Catmull-Rom, the text's table of it, or another window"},
    {0}};
#undef AT

static bl_profile profile_of(const sparse_parameters *p) {
    return p->kernel == KERNEL_COSINE     ? BL_PROFILE_COSINE
           : p->kernel == KERNEL_GAUSSIAN ? BL_PROFILE_GAUSSIAN
                                          : BL_PROFILE_CATMULL_ROM;
}

// The text's own noise, which has a faster path for points.
static int is_plain(const sparse_parameters *p) {
    return p->kernel == KERNEL_EXACT && p->count == IMPULSE_COUNT_FIXED;
}

// --- the reference ------------------------------------------------------------------------------

// Value and gradient at once.
typedef struct sparse_sum {
    const sparse_parameters *p;
    double value, slope[3];
} sparse_sum;

static void add_kernel(void *context, const double d[IMPULSE_AXES], uint32_t third,
                       uint32_t fourth) {
    (void)third;
    sparse_sum *sum = context;
    const sparse_parameters *p = sum->p;
    double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (!(square < 4))
        return;
    double amplitude = (double)bl_lattice_value(fourth) * BL_LATTICE_UNIT, slope;
    if (p->kernel == KERNEL_COSINE || p->kernel == KERNEL_GAUSSIAN) {
        sum->value += amplitude * bl_profile_value(profile_of(p), square / 4);
        slope = bl_profile_slope(profile_of(p), square / 4) / 2;
    } else {
        double r = sqrt(square);
        sum->value +=
            amplitude * (p->kernel == KERNEL_EXACT ? radial_kernel(r)
                                                   : radial_kernel_table(square, p->table_rate));
        slope = radial_kernel_slope(r);
    }
    for (int a = 0; a < 3; a++)
        sum->slope[a] += amplitude * slope * d[a];
}

static sparse_sum evaluate(const sparse_parameters *p, const impulse_source *source,
                           const double at[BL_AXES]) {
    sparse_sum sum = {.p = p};
    if (!impulse_visit(source, 3, 2, at, add_kernel, &sum))
        sum.value = sum.slope[0] = sum.slope[1] = sum.slope[2] = NAN;
    sum.value /= p->impulses;
    for (int a = 0; a < 3; a++)
        sum.slope[a] /= p->impulses;
    return sum;
}

static impulse_source open_source(const void *block) {
    const sparse_parameters *p = block;
    impulse_source source;
    impulse_source_open(&source, &p->lattice, p->impulses, p->count == IMPULSE_COUNT_POISSON);
    return source;
}

static double value_at(const void *block, const impulse_source *source, const double at[BL_AXES]) {
    return evaluate(block, source, at).value;
}

BL_VALUES_OF_OPENED(impulse_source, open_source)

// The gradient of the exact kernel, for the table too, which has none.
static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const impulse_source source = open_source(block);
    const sparse_sum sum = evaluate(block, &source, at);
    for (int a = 0; a < 3; a++)
        out[a] = sum.slope[a];
    out[3] = 0;
}

// --- points -------------------------------------------------------------------------------------

// A table jumps between its entries: only the exact squared distance finds the reference's entry.
static void points_by_value(const void *block, const double *const at[BL_AXES], size_t count,
                            float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = (float)value(block, (double[BL_AXES]){at[0][i], at[1][i], at[2][i], 0});
}

// The other kernels and counts, by impulse_points.h.
typedef struct impulse_kernel {
    int unused;
} impulse_kernel;

typedef struct impulse_mark {
    float amplitude; // in BL_LATTICE_UNIT
} impulse_mark;

static inline __attribute__((always_inline)) impulse_mark
impulse_mark_of(const impulse_kernel *kernel, const int form, uint32_t third, uint32_t fourth) {
    (void)kernel, (void)form, (void)third;
    return (impulse_mark){bl_lattice_value(fourth)};
}

static inline __attribute__((always_inline)) float impulse_term(const impulse_kernel *kernel,
                                                                const int form, impulse_mark mark,
                                                                double x, double y, double z) {
    (void)kernel;
    float q = (float)((x * x + y * y + z * z) * 0.25);
    return mark.amplitude * profile_float((bl_profile)form, q);
}

#include "noises/impulses/impulse_points.h"

static inline __attribute__((always_inline)) void points_of(const sparse_parameters *p,
                                                            const bl_profile profile,
                                                            const double *const at[BL_AXES],
                                                            size_t count, float *out) {
    impulse_source source;
    const impulse_kernel kernel = {0};
    float scale = (float)(BL_LATTICE_UNIT / p->impulses);
    impulse_source_open(&source, &p->lattice, p->impulses, p->count == IMPULSE_COUNT_POISSON);
    impulse_points(&source, &kernel, (int)profile, 3, 2, scale, at, count, out);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const sparse_parameters *p = block;
    if (p->kernel == KERNEL_TABLE) {
        points_by_value(block, at, count, out);
        return;
    }
    if (!is_plain(p)) {
        if (p->kernel == KERNEL_COSINE)
            points_of(p, BL_PROFILE_COSINE, at, count, out);
        else if (p->kernel == KERNEL_GAUSSIAN)
            points_of(p, BL_PROFILE_GAUSSIAN, at, count, out);
        else
            points_of(p, BL_PROFILE_CATMULL_ROM, at, count, out);
        return;
    }
    sparse_source source;
    sparse_source_open(&source, &p->lattice, p->impulses);
    sparse_points(&source, at, count, out);
}

// --- rows ---------------------------------------------------------------------------------------

static void row_inside(const sparse_parameters *p, const axis_row *along, size_t count,
                       float *out) {
    sparse_source source;
    impulse_source counts, *poisson = p->count == IMPULSE_COUNT_POISSON ? &counts : NULL;
    sparse_source_open(&source, &p->lattice, p->impulses);
    if (poisson)
        impulse_source_open(poisson, &p->lattice, p->impulses, 1);
    if (p->kernel == KERNEL_COSINE)
        sparse_row(&source, poisson, BL_PROFILE_COSINE, along, count, out);
    else if (p->kernel == KERNEL_GAUSSIAN)
        sparse_row(&source, poisson, BL_PROFILE_GAUSSIAN, along, count, out);
    else
        sparse_row(&source, poisson, BL_PROFILE_CATMULL_ROM, along, count, out);
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    const sparse_parameters *p = block;
    axis_row along;
    size_t from, to;
    find_inside(start, step, count, &from, &to);
    if (p->kernel != KERNEL_TABLE && from < to &&
        axis_row_open(&along, start, step, from, to - from) &&
        quads_repeat(&p->lattice, along.axis))
        row_inside(p, &along, to - from, out + from);
    else
        to = from;
    row_by_points(points, block, start, step, 0, from, out);
    row_by_points(points, block, start, step, to, count - to, out + to);
}

// --- the text's own loops -----------------------------------------------------------------------

static float textbook(float x, float y, float z) {
    int cell_x = bl_textbook_floor(x), cell_y = bl_textbook_floor(y), cell_z = bl_textbook_floor(z);
    float fx = x - (float)cell_x, fy = y - (float)cell_y, fz = z - (float)cell_z, sum = 0;
    for (int i = -2; i <= 2; i++)
        for (int j = -2; j <= 2; j++)
            for (int k = -2; k <= 2; k++) {
                int entry = bl_textbook_index(cell_x + i, cell_y + j, cell_z + k);
                for (int n = 0; n < 3; n++, entry = (entry + 1) & 255) {
                    const float *one = bl_textbook_data.impulses + 4 * entry;
                    float dx = fx - ((float)i + one[0]), dy = fy - ((float)j + one[1]),
                          dz = fz - ((float)k + one[2]);
                    sum += bl_textbook_kernel(dx * dx + dy * dy + dz * dz) * one[3];
                }
            }
    return sum / 3;
}

// --- what it states -----------------------------------------------------------------------------

// An impulse has the variance E[a^2]/N^2, and a cell has N of them.
static double variance_of(const sparse_parameters *p) {
    return BL_VALUE_VARIANCE(1 << 20) / p->impulses;
}

static bl_terms terms_of(const sparse_parameters *p) {
    bl_terms terms = {.count = 0};
    bl_terms_add_radial(&terms, variance_of(p));
    return terms;
}

static int has_closed_form(const void *block) {
    const sparse_parameters *p = block;
    return bl_lattice_is_hash(&p->lattice) && p->kernel != KERNEL_TABLE;
}

static double length(const double v[BL_AXES]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// A kernel of radius 2 is one of radius 1 scaled by 2: its volume by 8.
static double covariance(const void *block, const double lag[BL_AXES]) {
    bl_profile profile = profile_of(block);
    bl_terms terms = terms_of(block);
    if (profile == BL_PROFILE_CATMULL_ROM)
        return bl_terms_covariance(&terms, lag);
    return variance_of(block) * 8 * bl_profile_correlation(profile, 3, length(lag) / 2);
}

static double density(const void *block, const double frequency[BL_AXES]) {
    bl_profile profile = profile_of(block);
    bl_terms terms = terms_of(block);
    if (profile == BL_PROFILE_CATMULL_ROM)
        return bl_terms_density(&terms, frequency);
    double transform = 8 * bl_profile_transform(profile, 3, 2 * length(frequency));
    return variance_of(block) * transform * transform;
}

static void describe(const void *block, bl_facts *facts) {
    const sparse_parameters *p = block;
    bl_profile profile = profile_of(p);
    bl_terms terms = terms_of(p);
    if (profile == BL_PROFILE_CATMULL_ROM || !has_closed_form(p))
        bl_terms_describe(&terms, p->kernel != KERNEL_TABLE, &p->lattice, facts);
    else
        bl_impulses_describe(covariance, p, 3, BL_RADIAL_REACH, 1, facts);
    if (p->kernel != KERNEL_TABLE && bl_lattice_differs_within(&p->lattice, 3, BL_RADIAL_REACH))
        facts->variance = covariance(p, (const double[BL_AXES]){0});
    facts->stationary = facts->isotropic = bl_lattice_is_hash(&p->lattice);
    bl_bound bound = bl_bound_sparse_convolution(p->kernel == KERNEL_TABLE ? p->table_rate : 0);
    if (profile != BL_PROFILE_CATMULL_ROM)
        bound.value = bl_profile_sparse_bound(profile);
    int poisson = p->count == IMPULSE_COUNT_POISSON;
    bound.value *= (double)impulse_count_most(p->impulses, poisson) / p->impulses;
    if (poisson)
        bound.proof =
            "amplitudes below 1; the sum over the cells of the largest |K| in each, "
            "certified by branch and bound, times the largest count over its mean";
    bl_lattice_describe(bound, p->kernel == KERNEL_TABLE ? -1 : 1, &p->lattice, facts);
}

BL_NOISE_DESCRIPTOR(sparse_convolution) = {
    .name = "scnoise",
    .title = "sparse convolution noise",
    .summary = "Random impulses at random places, convolved with a radial kernel.",
    .formula = "1/N sum over cells c and impulses k of a_ck K(|p - c - x_ck|)",
    .paper = "peachey2003, pp. 80-83",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(sparse_parameters),
    .describe = describe,
    .has_closed_form = has_closed_form,
    .textbook = textbook,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
