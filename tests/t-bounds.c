// SPDX-License-Identifier: MIT
//
// The hard bounds of noises/bounds.c, each certified: the supremum over a cell of the sum of the
// largest sizes that the terms can take lies below the constant, and within a stated slack of it.
//
// Branch and bound: on a box the sum is at most the sum of the terms' own largest values there, and
// at least its value at the centre. Boxes whose upper value is below the constant are done; the
// others are halved along their longest side. All terms are bounded by monotone pieces, so the
// upper values hold but for rounding, below 1e-13. The sums are symmetric in the axes and about the
// middle of the cell, so x <= y <= z <= 1/2 does.
#include "tests/test.h"

#include "noises/closed_forms.h"

typedef struct box {
    double low[3], high[3];
} box;

// An upper value of the sum on a box; on a box of size 0 the value itself.
typedef double upper_value(const box *box, const void *context);

typedef struct search {
    upper_value *upper;
    const void *context;
    double limit; // to certify
    double found; // the largest value seen
    size_t boxes;
} search;

static int certify(search *in, const box *at, int depth) {
    if (at->low[0] > at->high[1] || at->low[1] > at->high[2])
        return 1; // outside x <= y <= z
    in->boxes++;
    box middle;
    int longest = 0;
    for (int a = 0; a < 3; a++) {
        middle.low[a] = middle.high[a] = (at->low[a] + at->high[a]) / 2;
        if (at->high[a] - at->low[a] > at->high[longest] - at->low[longest])
            longest = a;
    }
    in->found = fmax(in->found, in->upper(&middle, in->context));
    if (in->upper(at, in->context) < in->limit - 1e-13)
        return 1;
    if (depth == 0)
        return 0;
    box left = *at, right = *at;
    left.high[longest] = right.low[longest] = middle.low[longest];
    return certify(in, &left, depth - 1) && certify(in, &right, depth - 1);
}

// The constant is a bound, and the supremum is at most `slack` below it.
static void check(upper_value *upper, const void *context, bl_bound bound, double slack) {
    search in = {.upper = upper, .context = context, .limit = bound.value};
    const box cell = {{0, 0, 0}, {0.5, 0.5, 0.5}};
    int certified = certify(&in, &cell, 60);
    printf("# %.10g: %s, largest value seen %.10g, %zu boxes\n", bound.value,
           certified ? "certified" : "NOT certified", in.found, in.boxes);
    assert_true(certified);
    assert_near(in.found, bound.value, slack);
    assert_non_null(bound.proof);
}

// --- gradient noise ------------------------------------------------------------------------------

typedef struct gradient {
    bl_kernel weight;
    int edges;
} gradient;

// Largest g . d: the length of d for unit vectors, the two largest |d_a| for the edges (1, 1, 0).
static double largest_slope(const double d[3], int edges) {
    if (!edges)
        return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return d[0] + d[1] + d[2] - fmin(d[0], fmin(d[1], d[2]));
}

static double gradient_upper(const box *at, const void *context) {
    const gradient *noise = context;
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        double weight = 1, d[3];
        for (int a = 0; a < 3; a++) {
            int one = corner >> a & 1;
            double near = one ? 1 - at->high[a] : at->low[a];
            d[a] = one ? 1 - at->low[a] : at->high[a];
            weight *= bl_kernel_value(noise->weight, near); // falls with the distance
        }
        sum += weight * largest_slope(d, noise->edges);
    }
    return sum;
}

// Certified by search for the edges. For unit vectors the proof is in noises/bounds.c; here each of
// its steps: e(t) <= 1/4 for every fade, and the middle reaches sqrt(3)/2.
static void test_gradient_bounds(void **state) {
    (void)state;
    const bl_kernel weights[] = {BL_KERNEL_LINEAR, BL_KERNEL_SMOOTH, BL_KERNEL_QUINTIC};
    for (size_t i = 0; i < 3; i++) {
        gradient edges = {weights[i], 1}, unit = {weights[i], 0};
        check(gradient_upper, &edges, bl_bound_gradient(weights[i], 1), 6e-3);
        for (int j = 0; j <= 1024; j++) {
            double t = j / 1024.0;
            double e = bl_kernel_value(weights[i], t) * t * t +
                       bl_kernel_value(weights[i], 1 - t) * (1 - t) * (1 - t);
            assert_true(e <= 0.25 + 1e-15);
        }
        const box middle = {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
        assert_near(gradient_upper(&middle, &unit), sqrt(0.75), 1e-15);
        assert_near(bl_bound_gradient(weights[i], 0).value, sqrt(0.75), 1e-5);
    }
}

static void test_value_bounds(void **state) {
    (void)state;
    const bl_kernel kernels[] = {BL_KERNEL_CATMULL_ROM, BL_KERNEL_LINEAR, BL_KERNEL_SMOOTH,
                                 BL_KERNEL_BSPLINE2, BL_KERNEL_BSPLINE3};
    for (size_t k = 0; k < 5; k++) {
        double most = 0;
        for (int i = 0; i <= 512; i++) {
            double sum = 0;
            for (int n = -2; n <= 3; n++)
                sum += fabs(bl_kernel_value(kernels[k], i / 512.0 - n));
            most = fmax(most, sum);
        }
        assert_near(bl_bound_value(kernels[k]).value, most * most * most, 1e-14);
    }
}

static void test_hermite_bound(void **state) {
    (void)state;
    double most = 0;
    for (int i = 0; i <= 512; i++)
        most = fmax(most, fabs(bl_kernel_value(BL_KERNEL_TANGENT, i / 512.0)) +
                              fabs(bl_kernel_value(BL_KERNEL_TANGENT, i / 512.0 - 1)));
    assert_near(bl_bound_hermite().value, 1 + 3 * most, 1e-15);
}

// --- convolution noises --------------------------------------------------------------------------

// Largest |K| on [near, far]: K falls to 0 at 1, to -2/27 at 4/3, and rises to 0 at 2.
static double largest_kernel(double near, double far) {
    double most = fmax(fabs(bl_radial_value(near)), fabs(bl_radial_value(far)));
    return near < 4.0 / 3 && far > 4.0 / 3 ? fmax(most, 2.0 / 27) : most;
}

// The least and the largest distance between points of the box and of [cell, cell + size]^3.
static void distances(const box *at, const int cell[3], double size, double *near, double *far) {
    double near2 = 0, far2 = 0;
    for (int a = 0; a < 3; a++) {
        double above = cell[a] - at->high[a], below = at->low[a] - (cell[a] + size);
        double gap = fmax(0, fmax(above, below));
        double span = fmax(cell[a] + size - at->low[a], at->high[a] - cell[a]);
        near2 += gap * gap;
        far2 += span * span;
    }
    *near = sqrt(near2);
    *far = sqrt(far2);
}

// context: the size of what each impulse may be in: a point of the lattice (0), or the cell (1).
static double convolution_upper(const box *at, const void *context) {
    double size = *(const double *)context, sum = 0;
    for (int i = -2; i <= 3; i++)
        for (int j = -2; j <= 3; j++)
            for (int k = -2; k <= 3; k++) {
                double near, far;
                distances(at, (int[]){i, j, k}, size, &near, &far);
                if (near < 2)
                    sum += largest_kernel(near, far);
            }
    return sum;
}

static void test_convolution_bounds(void **state) {
    (void)state;
    const double point = 0, cell = 1;
    check(convolution_upper, &point, bl_bound_lattice_convolution(0), 1e-2);
    check(convolution_upper, &cell, bl_bound_sparse_convolution(0), 2e-2);
}

// The allowance for a table: no rounding of the squared distance by 1/(2N) changes K by more.
static void test_table_allowance(void **state) {
    (void)state;
    for (unsigned rate = 1; rate < 300; rate = 3 * rate + 1)
        for (double r = 0; r < 2.3; r += 1.0 / 512) {
            double rounded = sqrt(floor(r * r * rate + 0.5) / rate);
            double change = fabs(bl_radial_value(rounded) - bl_radial_value(r));
            assert_true(change <= 1.25 / rate + 1e-15);
            if (r >= 1 && rounded >= 1)
                assert_true(change <= 0.125 / rate + 1e-15);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value_bounds),    cmocka_unit_test(test_gradient_bounds),
        cmocka_unit_test(test_hermite_bound),   cmocka_unit_test(test_convolution_bounds),
        cmocka_unit_test(test_table_allowance),
    };
    return bl_run_tests(tests);
}
