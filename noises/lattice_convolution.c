// SPDX-License-Identifier: MIT
//
// vcnoise: lattice convolution noise, random values at the lattice points convolved with a radial
// kernel.
//
//   n(p) = sum over lattice points c of  v_c K(|p - c|)
//
// v_c uniform in (-1, 1), K the radial Catmull-Rom kernel of radius 2 (radial_kernel.h); the points
// within 2 of p are among the 4 x 4 x 4 around its cell.
//
// Parameters
//   seed      any 64-bit number
//   lattice   hash: no period; perm256: the text's index of 256 entries, period 256
//   component, period   noises/common_parameters.h; with a period no closed form
//   kernel    exact; table:R: the text's table, R entries a unit of squared distance, nearest entry
//             (1 to 1000000, 100 in the text); evaluated in double, without the fast paths
//
// Range: |n| is below the sum of |K| over the lattice points, 2.29 at most (bounds.c).
// Variance 0.181181799 over places, mean 0: exact, E[v^2] int K^2, E[v^2] = (1 - 2^-40)/3.
// Band: the same kernel, hence the same mean spectrum, as scnoise.
// Known defects: the kernel is no interpolant in space, K(sqrt 2) is not 0 and K does not sum to 1
// over the lattice, so the variance depends on the place in the cell: the noise is cyclostationary,
// and its lattice shows. With kernel=table it is discontinuous.
// Deviations from peachey2003, pp. 78-80: random numbers come from a hash of cell and seed; with
// perm256 from the text's index and the project's generator. The listing is named vnoise once.
//
// Float results are within 1e-6 of the double reference at any coordinate below 2^62; beyond, for
// NaN and for infinity the noise is NaN, and from 2^52 on the fraction within a cell is lost.
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/common_parameters.h"
#include "noises/closed_forms.h"
#include "noises/impulses/convolution_cells.h"
#include "noises/impulses/convolution_row.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/lattice/radial_kernel.h"
#include "noises/impulses/radial_row.h"
#include "noises/textbook_loops.h"

typedef struct convolution_parameters {
    bl_lattice_settings lattice;
    uint32_t kernel;
    uint32_t table_rate;
} convolution_parameters;

enum { KERNEL_EXACT, KERNEL_TABLE };

static const char *const kernels[] = {"exact", "table:N", NULL};

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(convolution_parameters, "the lattice values"),
    {"kernel", BL_CHOICE, offsetof(convolution_parameters, kernel), "exact", "entries a unit",
     .minimum = 1, .maximum = 1000000, .choices = kernels,
     .number_offset = offsetof(convolution_parameters, table_rate),
     .help = "exact, or the text's table in squared distance"},
    {0}};

// --- the reference ------------------------------------------------------------------------------

// The value and, if `gradient` is not NULL, the gradient.
static double reference(const convolution_parameters *p, const bl_lattice *lattice,
                        const double at[BL_AXES], double gradient[BL_AXES]) {
    bl_reference_cells cells;
    double sum = 0, slope[BL_AXES] = {0};
    int inside = bl_reference_cells_load(&cells, lattice, 3, at, -1, 4);
    for (unsigned i = 0; inside && i < 64; i++) {
        const unsigned knot[BL_AXES] = {i / 16, i / 4 % 4, i % 4};
        double d[3], square = 0;
        for (int a = 0; a < 3; a++) {
            d[a] = cells.fraction[a] - ((int)knot[a] - 1);
            square += d[a] * d[a];
        }
        double r = sqrt(square);
        double random = (double)bl_lattice_value(bl_reference_word(&cells, knot, 0));
        sum += random * (p->kernel == KERNEL_EXACT ? radial_kernel(r)
                                                   : radial_kernel_table(square, p->table_rate));
        for (int a = 0; gradient && a < 3; a++)
            slope[a] += random * radial_kernel_slope(r) * d[a];
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slope[a] * BL_LATTICE_UNIT : a < 3 ? NAN : 0;
    return inside ? sum * BL_LATTICE_UNIT : NAN;
}

static bl_lattice open_lattice(const void *block) {
    const convolution_parameters *p = block;
    return bl_lattice_open(&p->lattice);
}

static double value_at(const void *block, const bl_lattice *lattice, const double at[BL_AXES]) {
    return reference(block, lattice, at, NULL);
}

BL_VALUES_OF_OPENED(bl_lattice, open_lattice)

// The gradient of the exact kernel, for the table too, which has none.
static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_lattice lattice = open_lattice(block);
    reference(block, &lattice, at, out);
}

// --- points -------------------------------------------------------------------------------------

// The values of 16 lattice points.
static inline void lane_values(const cell_numbers *numbers, const lane_keys *const key[3],
                               float amplitude[LANES]) {
    if (numbers->lattice.kind == BL_LATTICE_PERM256) {
        for (int l = 0; l < LANES; l++) {
            uint32_t index = bl_perm256_index(key[0]->add[l], key[1]->add[l], key[2]->add[l]);
            amplitude[l] = bl_lattice_value(numbers->plain[index]);
        }
        return;
    }
    const lane_keys *x = key[0], *y = key[1], *z = key[2];
#pragma omp simd
    for (int l = 0; l < LANES; l++)
        amplitude[l] = bl_lattice_value((x->add[l] + y->add[l] + z->add[l]) *
                                        (x->exclusive[l] ^ y->exclusive[l] ^ z->exclusive[l]));
}

// LANES points; index 0..3 of an axis stands for the offsets -1..2.
typedef struct lattice_group {
    lane_keys key[3][4];
    float distance[3][4][LANES];
} lattice_group;

static void prepare_axis(const cell_numbers *numbers, const double place[LANES], int axis,
                         lattice_group *group) {
    for (int i = 0; i < 4; i++) {
        uint64_t cell[LANES];
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double lower = floor(place[l]);
            cell[l] = (uint64_t)(int64_t)lower + (uint64_t)i - 1;
            group->distance[axis][i][l] = (float)(place[l] - lower - (i - 1));
        }
        set_lane_keys(numbers, axis, cell, &group->key[axis][i]);
    }
}

static void sum_group(const cell_numbers *numbers, const lattice_group *group, float *sum) {
    float total[LANES] = {0};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++) {
                const lane_keys *const key[3] = {&group->key[0][i], &group->key[1][j],
                                                 &group->key[2][k]};
                float amplitude[LANES];
                lane_values(numbers, key, amplitude);
                const float *x = group->distance[0][i], *y = group->distance[1][j],
                            *z = group->distance[2][k];
#pragma omp simd
                for (int l = 0; l < LANES; l++) {
                    float r = sqrtf(x[l] * x[l] + y[l] * y[l] + z[l] * z[l]);
                    total[l] += amplitude[l] * radial_twice(r);
                }
            }
    for (int l = 0; l < LANES; l++)
        sum[l] = total[l] * (float)(BL_LATTICE_UNIT / 2);
}

static void lattice_points(const cell_numbers *numbers, const double *const at[BL_AXES],
                           size_t count, float *out) {
    for (size_t from = 0; from < count; from += LANES) {
        int n = count - from < LANES ? (int)(count - from) : LANES;
        lattice_group group;
        float sum[LANES];
        int valid[LANES];
        for (int l = 0; l < LANES; l++)
            valid[l] = 1;
        for (int a = 0; a < 3; a++) {
            double place[LANES] = {0};
            for (int l = 0; l < n; l++) {
                int inside = fabs(at[a][from + (size_t)l]) < 0x1p62; // false for NaN
                place[l] = inside ? at[a][from + (size_t)l] : 0;
                valid[l] &= inside;
            }
            prepare_axis(numbers, place, a, &group);
        }
        sum_group(numbers, &group, sum);
        for (int l = 0; l < n; l++)
            out[from + (size_t)l] = valid[l] ? sum[l] : NAN;
    }
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const convolution_parameters *p = block;
    if (p->kernel == KERNEL_EXACT) {
        cell_numbers numbers;
        cell_numbers_open(&numbers, &p->lattice);
        lattice_points(&numbers, at, count, out);
        return;
    }
    // A table jumps between its entries: only the exact squared distance finds the reference's.
    for (size_t i = 0; i < count; i++)
        out[i] = (float)value(block, (double[BL_AXES]){at[0][i], at[1][i], at[2][i], 0});
}

// --- rows ---------------------------------------------------------------------------------------

// The columns of lattice points around the row.
typedef struct lattice_columns {
    const cell_numbers *numbers;
    int axis;
    lane_keys key[3];    // of the columns, along the two axes across
    float square[LANES]; // distance of the column from the row
} lattice_columns;

static void open_columns(lattice_columns *columns, const axis_row *row) {
    for (int c = 0; c < LANES; c++) {
        int offset[2] = {c / 4 - 1, c % 4 - 1};
        double d0 = row->fraction[0] - offset[0], d1 = row->fraction[1] - offset[1];
        columns->square[c] = (float)(d0 * d0 + d1 * d1);
        for (int s = 0; s < 2; s++)
            set_lane_key(columns->numbers, row->across[s],
                         row->cell_across[s] + (uint64_t)(int64_t)offset[s],
                         &columns->key[row->across[s]], c);
    }
}

static void fill_quad(const void *context, int64_t quad, int part, radial_quad *impulses) {
    const lattice_columns *columns = context;
    const lane_keys *key[3] = {&columns->key[0], &columns->key[1], &columns->key[2]};
    (void)part;
    impulses->columns = LANES;
    impulses->impulses = 1;
    for (int s = 0; s < QUAD_CELLS; s++) {
        lane_keys along;
        uint64_t cell = (uint64_t)quad * QUAD_CELLS + (uint64_t)s;
        bl_lattice_key one = lane_key(columns->numbers, columns->axis, cell);
        for (int l = 0; l < LANES; l++) {
            along.add[l] = one.add;
            along.exclusive[l] = one.exclusive;
            impulses->along[s * LANES + l] = (float)(s - QUAD_CELLS / 2);
            impulses->square[s * LANES + l] = columns->square[l];
        }
        key[columns->axis] = &along;
        lane_values(columns->numbers, key, impulses->amplitude + s * LANES);
    }
}

static void row_along_axis(const cell_numbers *numbers, const axis_row *row, size_t count,
                           float *out) {
    lattice_columns columns = {.numbers = numbers, .axis = row->axis};
    open_columns(&columns, row);
    radial_line line = {.row = row,
                        .fill = fill_quad,
                        .context = &columns,
                        .parts = 1,
                        .scale = (float)(BL_LATTICE_UNIT / 2)};
    radial_row(&line, count, out);
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    const convolution_parameters *p = block;
    axis_row along;
    size_t from, to;
    find_inside(start, step, count, &from, &to);
    if (p->kernel == KERNEL_EXACT && from < to &&
        axis_row_open(&along, start, step, from, to - from) &&
        quads_repeat(&p->lattice, along.axis)) {
        cell_numbers numbers;
        cell_numbers_open(&numbers, &p->lattice);
        row_along_axis(&numbers, &along, to - from, out + from);
    } else {
        to = from;
    }
    row_by_points(points, block, start, step, 0, from, out);
    row_by_points(points, block, start, step, to, count - to, out + to);
}

// --- the text's own loops -----------------------------------------------------------------------

static float textbook(float x, float y, float z) {
    int cell_x = bl_textbook_floor(x), cell_y = bl_textbook_floor(y), cell_z = bl_textbook_floor(z);
    float fx = x - (float)cell_x, fy = y - (float)cell_y, fz = z - (float)cell_z, sum = 0;
    for (int k = -1; k <= 2; k++) {
        float dz = (float)k - fz;
        for (int j = -1; j <= 2; j++) {
            float dy = (float)j - fy;
            for (int i = -1; i <= 2; i++) {
                float dx = (float)i - fx;
                int entry = bl_textbook_index(cell_x + i, cell_y + j, cell_z + k);
                sum += bl_textbook_data.values[entry] *
                       bl_textbook_kernel(dx * dx + dy * dy + dz * dz);
            }
        }
    }
    return sum;
}

// --- what it states -----------------------------------------------------------------------------

static bl_terms terms_of(const void *block) {
    (void)block;
    bl_terms terms = {.count = 0};
    bl_terms_add_radial(&terms, BL_VALUE_VARIANCE(1 << 20));
    return terms;
}

static int has_closed_form(const void *block) {
    const convolution_parameters *p = block;
    return bl_lattice_is_hash(&p->lattice) && p->kernel == KERNEL_EXACT;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const convolution_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_terms_describe(&terms, p->kernel == KERNEL_EXACT, &p->lattice, facts);
    facts->isotropic = has_closed_form(block); // a kernel of the distance, numbers that are white
    bl_bound bound = bl_bound_lattice_convolution(p->kernel == KERNEL_EXACT ? 0 : p->table_rate);
    bl_lattice_describe(bound, p->kernel == KERNEL_EXACT ? 1 : -1, &p->lattice, facts);
}

BL_NOISE_DESCRIPTOR(lattice_convolution) = {
    .name = "vcnoise",
    .title = "lattice convolution noise",
    .summary = "Random values at the lattice points, convolved with a radial Catmull-Rom kernel.",
    .formula = "sum over lattice points c of v_c K(|p - c|)",
    .paper = "peachey2003, pp. 78-80",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(convolution_parameters),
    .describe = describe,
    .has_closed_form = has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_VALUES ",kernel=table:100",
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
