// SPDX-License-Identifier: MIT
//
// The hard bounds of noises/lattice/bounds.c, each certified: the supremum over a cell of the sum
// of the largest sizes that the terms can take lies below the constant, and within a stated slack
// of it.
//
// Branch and bound: on a box the sum is at most the sum of the terms' own largest values there, and
// at least its value at the centre. Boxes whose upper value is below the constant are done; the
// others are halved along their longest side. All terms are bounded by monotone pieces, so the
// upper values hold except for rounding, below 1e-13. The sums are symmetric in the axes and about
// the middle of the cell, so x <= y <= z <= 1/2 does.
#include "tests/test.h"

#include <gsl/gsl_cdf.h>

#include "noises/closed_forms.h"
#include "noises/impulses/impulse_profiles.h"
#include "noises/lattice/wiener_weights.h"
#include "tests/texts.h"

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

// Certified by search for the edges. For unit vectors the proof is in noises/lattice/bounds.c; here
// each of its steps: e(t) <= 1/4 for every fade, and the middle reaches sqrt(3)/2.
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

// --- what the noises state -----------------------------------------------------------------------
//
// Walks hold values to the stated range, and seldom come near its ends: a range that is too wide,
// or too narrow by a third, passes them. Here each is derived once more.

static void expect_range(const char *text, double lower, double upper, double slack) {
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    double most = slack * fmax(fabs(lower), fabs(upper));
    if (!(fabs(signal->facts.lower - lower) <= most && fabs(signal->facts.upper - upper) <= most))
        fail_msg("%s: states %.9g to %.9g; it is %.9g to %.9g", text, signal->facts.lower,
                 signal->facts.upper, lower, upper);
    bl_signal_free(signal);
}

static void test_lattice_noises_state_these_bounds(void **state) {
    (void)state;
    const double spline = bl_bound_value(BL_KERNEL_CATMULL_ROM).value;
    const double edges = bl_bound_gradient(BL_KERNEL_QUINTIC, 1).value;
    const double unit = bl_bound_gradient(BL_KERNEL_SMOOTH, 0).value;
    const struct {
        const char *text;
        double bound;
    } cases[] = {{"vnoise", spline},
                 {"vnoise:interp=linear", 1},
                 {"vnoise:interp=bspline3", 1},
                 {"vnoise:dims=2", 1.5625},
                 {"gnoise", unit},
                 {"gnoise:fade=quintic,gradients=edges", edges},
                 {"perlin2002", edges},
                 {"perlin2002:lattice=hash", edges},
                 {"hermite", bl_bound_hermite().value},
                 {"vcnoise", bl_bound_lattice_convolution(0).value},
                 {"simplex", 1},
                 {"simplex:dims=4,radius2=0.6", 1},
                 {"white", 1},
                 {"white:cell=1", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_range(cases[i].text, -cases[i].bound, cases[i].bound, 0);
    expect_range("rayshade", 0, 1, 0);
    expect_range("rayshade:weights=linear", 0, 1, 0);
    bl_wiener_kernel kernel = bl_wiener_kernel_of(BL_WIENER_SINC, 0.7);
    double wiener = pow(bl_wiener_largest_sum(&kernel), 3);
    expect_range("wiener:covariance=sinc,width=0.7", -wiener, wiener, 0);
}

// In 4 dimensions: sqrt 4/2 for unit vectors, times the length sqrt 3 of the edges.
static void test_gradients_in_four_dimensions_state_these_bounds(void **state) {
    (void)state;
    expect_range("gnoise:dims=4", -1, 1, 2e-5);
    expect_range("gnoise:dims=4,gradients=edges", -sqrt(3), sqrt(3), 2e-5);
    expect_range("gnoise:dims=2", -sqrt(0.5), sqrt(0.5), 2e-5);
}

// What a table adds, from the lattice points within 1 and within 2 of a place: the most of a grid
// of places. The bound counts all of the 64 around a cell, so it may have a third more.
static void test_tables_widen_the_bound_by_their_rounding(void **state) {
    (void)state;
    double most = 0;
    for (int place = 0; place < 9 * 9 * 9; place++) {
        double sum = 0;
        for (int n = 0; n < 6 * 6 * 6; n++) {
            double x = n % 6 - 2 - place % 9 / 16.0, y = n / 6 % 6 - 2 - place / 9 % 9 / 16.0,
                   z = n / 36 - 2 - place / 81 / 16.0, square = x * x + y * y + z * z;
            sum += square < 1 ? 1.25 : square < 4 ? 0.125 : 0;
        }
        most = fmax(most, sum);
    }
    const double exact = bl_bound_lattice_convolution(0).value;
    bl_signal *signal = bl_test_open("vcnoise:kernel=table:100", BL_ISA_BEST);
    double added = 100 * (signal->facts.upper - exact);
    assert_true(added >= most && added <= 1.4 * most);
    bl_signal_free(signal);
}

// Values and weights that sum to 1 come as near to their ends as the most extreme of many lattice
// points: within 1e-3 of the range, but with a probability of 2 (1 - 1e-3)^20000 = 4e-9.
static void test_ranges_of_lattice_values_are_reached(void **state) {
    (void)state;
    static const char *const texts[] = {"rayshade:seed=4", "white:seed=4", "vnoise:interp=linear",
                                        "vnoise:interp=smooth,dims=2"};
    for (size_t n = 0; n < sizeof texts / sizeof *texts; n++) {
        enum { COUNT = 20000 };
        static float row[COUNT];
        bl_signal *signal = bl_test_open(texts[n], BL_ISA_BEST);
        double low = INFINITY, high = -INFINITY;
        double range = signal->facts.upper - signal->facts.lower;
        bl_signal_row(signal, (const double[BL_AXES]){0}, (const double[BL_AXES]){1}, COUNT, row);
        for (int i = 0; i < COUNT; i++) {
            low = fmin(low, (double)row[i]);
            high = fmax(high, (double)row[i]);
        }
        assert_near(low, signal->facts.lower, 1e-3 * range);
        assert_near(high, signal->facts.upper, 1e-3 * range);
        bl_signal_free(signal);
    }
}

// The count that all but less than 2^-33 of the cells have, from GSL's distribution.
static double most_impulses(double mean) {
    unsigned count = 0;
    while (gsl_cdf_poisson_Q(count, mean) > 0x1p-33)
        count++;
    return count;
}

static double largest_profile(bl_profile profile) {
    double most = 0;
    for (int i = 0; i <= 1000; i++)
        most = fmax(most, fabs(bl_profile_value(profile, i / 1000.0)));
    return most;
}

// All impulses of the cells in reach at their largest; profiles are rounded up by a thousandth.
static void test_impulse_noises_state_these_bounds(void **state) {
    (void)state;
    const struct {
        const char *text;
        double cells, count, mean;
        bl_profile profile;
    } cases[] = {
        {"spot", 9, most_impulses(4), 4, BL_PROFILE_GAUSSIAN},
        {"spot:count=fixed,impulses=3,shape=disc", 9, 3, 3, BL_PROFILE_DISC},
        {"spot:dims=3,impulses=1,shape=cosine", 27, most_impulses(1), 1, BL_PROFILE_COSINE},
        {"spot:dims=3,count=fixed,impulses=64,shape=ring", 27, 64, 64, BL_PROFILE_RING},
        {"gabor", 9, most_impulses(8), 8, BL_PROFILE_DISC},
        {"gabor:impulses=64,phase=zero", 9, most_impulses(64), 64, BL_PROFILE_DISC}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double bound = cases[i].cells * cases[i].count * largest_profile(cases[i].profile) /
                       sqrt(cases[i].mean);
        expect_range(cases[i].text, -bound, bound, 1e-3);
    }
    // Divided by the mean, not by its root.
    double sparse = bl_bound_sparse_convolution(0).value;
    expect_range("scnoise", -sparse, sparse, 0);
    expect_range("scnoise:impulses=7", -sparse, sparse, 0);
    sparse *= most_impulses(3) / 3;
    expect_range("scnoise:count=poisson,impulses=3", -sparse, sparse, 1e-12);
}

// fourier with one harmonic: a cosine of mean square 1 for harmonics, sqrt 2 high, over the
// transform of the B-spline at a quarter of the rate; amplitudes of normal numbers are the root of
// -ln u, u = 2^-54 at least. gardner: the squares of 0.3 0.707^i times the ends of the products.
static void test_tiles_and_waves_state_these_bounds(void **state) {
    (void)state;
    double transform = pow(sin(M_PI / 4) / (M_PI / 4), 4), square = 0;
    double wave = sqrt(2) / transform, highest = wave * sqrt(54 * log(2));
    expect_range("fourier:dims=1,from=1,to=1", -wave, wave, 2e-6);
    // 6.119 for 6.1180
    expect_range("fourier:dims=1,from=1,to=1,amplitudes=gaussian", -highest, highest, 2e-4);
    for (int i = 0; i < 5; i++)
        square += 0.09 * pow(0.707, 2 * i);
    expect_range("gardner", -0.75 * square, 2.25 * square, 1e-14);
    expect_range("gardner:terms=1", -0.75 * 0.09, 2.25 * 0.09, 1e-14);
    bl_signal *gardner = bl_test_open("gardner", BL_ISA_BEST);
    assert_near(gardner->facts.mean, 0.25 * square, 1e-15); // of both cosines 1/2
    bl_signal_free(gardner);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value_bounds),
        cmocka_unit_test(test_gradient_bounds),
        cmocka_unit_test(test_hermite_bound),
        cmocka_unit_test(test_convolution_bounds),
        cmocka_unit_test(test_table_allowance),
        cmocka_unit_test(test_lattice_noises_state_these_bounds),
        cmocka_unit_test(test_gradients_in_four_dimensions_state_these_bounds),
        cmocka_unit_test(test_tables_widen_the_bound_by_their_rounding),
        cmocka_unit_test(test_ranges_of_lattice_values_are_reached),
        cmocka_unit_test(test_impulse_noises_state_these_bounds),
        cmocka_unit_test(test_tiles_and_waves_state_these_bounds),
    };
    return bl_run_tests(tests);
}
