// SPDX-License-Identifier: MIT
//
// What the walkers do not hold of simplex noise: the sum over the corners against the sum over all
// points of the lattice near by, near and far; the bound behind N; the closed forms against each
// other and against a sum by brute force; that facets lie a kernel's radius away; the two ways to
// the skew, and points of both in one batch.
#include "tests/test.h"

#include "core/random.h"
#include "noises/lattice.h"
#include "noises/simplex_place.h"
#include "noises/simplex_theory.h"
#include "tests/texts.h"

static double skew_of(unsigned dims) {
    return (sqrt(dims + 1) - 1) / dims;
}

static double unskew_of(unsigned dims) {
    return (1 - 1 / sqrt(dims + 1)) / dims;
}

static double normalisation(unsigned dims) {
    return (double[]){0, 0, 99, 76, 61}[dims];
}

// --- the sum over the lattice -------------------------------------------------------------------

static void gradient_of(unsigned dims, uint32_t word, double g[BL_AXES]) {
    static const double turns[8][2] = {{0, 1},  {1, -1},  {1, 0},  {1, 1},
                                       {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}};
    memset(g, 0, BL_AXES * sizeof *g);
    if (dims == 3) {
        bl_vector edge = bl_edge_gradient(word);
        g[0] = edge.x;
        g[1] = edge.y;
        g[2] = edge.z;
        return;
    }
    unsigned kind = word >> 30, place = 0;
    if (dims == 2) {
        const double *turn = turns[kind + (word >> 29 & 1) * 4];
        for (int a = 0; a < 2; a++)
            g[a] = turn[a] * (kind & 1 ? (double)0.70710678f : 1);
        if (kind == 1 && word >> 29 & 1) // the second component keeps its sign
            g[1] = -(double)0.70710678f;
        if (kind == 3)
            g[1] = (double)0.70710678f;
        return;
    }
    for (unsigned a = 0; a < 4; a++)
        if (a != kind)
            g[a] = word >> (29 - place++) & 1 ? -1 : 1;
}

// The sum over all points of the lattice with skewed numbers within 3 of the skewed place, in
// numbers of 64 bits: at 2^30 the skew is then good to 2^-32.
static double lattice_sum(uint64_t seed, unsigned dims, const double at[BL_AXES]) {
    bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_HASH);
    long double total = 0, u[BL_AXES], sum = 0;
    long double skew = (sqrtl(dims + 1) - 1) / dims, unskew = (1 - 1 / sqrtl(dims + 1)) / dims;
    for (unsigned a = 0; a < dims; a++)
        total += at[a];
    for (unsigned a = 0; a < dims; a++)
        u[a] = at[a] + skew * total;
    unsigned many = dims == 4 ? 1296 : dims == 3 ? 216 : 36;
    for (unsigned n = 0; n < many; n++) {
        long double v[BL_AXES], all = 0;
        uint32_t add = 0, exclusive = 0;
        for (unsigned a = 0, rest = n; a < dims; a++, rest /= 6) {
            long double cell = floorl(u[a]) + (long double)(rest % 6) - 2;
            bl_lattice_key key = bl_lattice_key_of(&lattice, a, (uint64_t)(int64_t)cell);
            add += key.add;
            exclusive ^= key.exclusive;
            v[a] = u[a] - cell;
            all += v[a];
        }
        double g[BL_AXES];
        long double dot = 0, square = 0;
        gradient_of(dims, add * exclusive, g);
        for (unsigned a = 0; a < dims; a++) {
            long double d = v[a] - unskew * all;
            dot += g[a] * d;
            square += d * d;
        }
        long double t = 0.5L - square;
        if (t > 0)
            sum += dot * t * t * t * t;
    }
    return (double)(normalisation(dims) * sum);
}

static void test_the_corners_are_all_that_reach_a_point(void **state) {
    (void)state;
    static const double scales[] = {1, 100, 0x1p30};
    bl_random random = bl_random_seed(1, 0);
    for (unsigned dims = 2; dims <= 4; dims++) {
        char text[64];
        snprintf(text, sizeof text, "simplex:seed=5,dims=%u", dims);
        bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
        for (int trial = 0; trial < 600; trial++) {
            double at[BL_AXES] = {0};
            for (unsigned a = 0; a < dims; a++) {
                at[a] = scales[trial % 3] * (2 * bl_random_unit(&random) - 1);
                if (trial % 7 == 0) // on facets, where ranks tie
                    at[a] = a ? at[0] + round(4 * bl_random_unit(&random)) : at[a];
            }
            // The slope is below 10; the long double loses 2^-32 at the far places.
            double tolerance = trial % 3 == 2 ? 1e-8 : 1e-12;
            assert_near(bl_signal_value(signal, at), lattice_sum(5, dims, at), tolerance);
        }
        bl_signal_free(signal);
    }
}

// The moments that the closed form rests on, over all values of the bits that pick a gradient.
static void test_the_gradients_have_the_moments_stated(void **state) {
    (void)state;
    for (unsigned dims = 2; dims <= 4; dims++) {
        double mean[BL_AXES] = {0}, moment[BL_AXES][BL_AXES] = {{0}};
        const unsigned kinds = dims == 2 ? 8 : dims == 3 ? 12 : 32;
        unsigned found = 0;
        for (unsigned n = 0; n < 32; n++) {
            // All values of the top bits; in 3-D words whose multiple has the edge asked for.
            uint32_t word = n << 27;
            if (dims == 2 && n % 4)
                continue;
            if (dims == 3) {
                if (n >= 12)
                    break;
                uint32_t inverse = 1; // of the odd multiplier of bl_lattice_mixed, by Newton
                for (int i = 0; i < 5; i++)
                    inverse *= 2 - bl_lattice_mixed(inverse);
                word = (uint32_t)(((uint64_t)n << 32) / 12 + 1000) * inverse;
            }
            double g[BL_AXES];
            gradient_of(dims, word, g);
            found++;
            for (unsigned a = 0; a < dims; a++) {
                mean[a] += g[a];
                for (unsigned b = 0; b < dims; b++)
                    moment[a][b] += g[a] * g[b];
            }
        }
        assert_int_equal(found, kinds);
        const double expected = (double[]){0, 0, 1.0 / 2, 2.0 / 3, 3.0 / 4}[dims];
        for (unsigned a = 0; a < dims; a++) {
            assert_near(mean[a], 0, 1e-15);
            for (unsigned b = 0; b < dims; b++)
                assert_near(moment[a][b] / kinds, a == b ? expected : 0, 1e-7);
        }
    }
}

// --- the bound ----------------------------------------------------------------------------------
//
// Branch and bound over the skewed fractions u_0 >= u_1 >= ..., which are one simplex; all others
// are as that one up to signs and the order of the axes, which the sets of gradients do not see. In
// a box with half sizes h no offset is farther than |h| from that of the centre (unskewing
// stretches nothing), so a term is at most the kernel at |d| - |h| times the largest g . d plus |g|
// |h|.

typedef struct search {
    unsigned dims;
    double radius2, limit, found;
    size_t boxes;
} search;

static double largest_dot(unsigned dims, const double d[]) {
    double sum = 0, least = INFINITY, most = 0;
    for (unsigned a = 0; a < dims; a++) {
        sum += fabs(d[a]);
        least = fmin(least, fabs(d[a]));
        most = fmax(most, fabs(d[a]));
    }
    return dims == 2 ? fmax(most, (double)0.70710678f * sum) : sum - least;
}

static double upper(const search *in, const double centre[], double around) {
    const double length = (double[]){0, 0, 1, M_SQRT2, sqrt(3)}[in->dims];
    double sum = 0;
    for (unsigned k = 0; k <= in->dims; k++) {
        double d[BL_AXES], total = 0, square = 0;
        for (unsigned a = 0; a < in->dims; a++) {
            d[a] = centre[a] - (a < k);
            total += d[a];
        }
        for (unsigned a = 0; a < in->dims; a++) {
            d[a] -= unskew_of(in->dims) * total;
            square += d[a] * d[a];
        }
        double near = fmax(0, sqrt(square) - around), far = sqrt(square) + around;
        double t = fmax(0, in->radius2 - near * near);
        sum += t * t * t * t * fmin(length * far, largest_dot(in->dims, d) + length * around);
    }
    return sum;
}

static int certify(search *in, const double low[], const double high[], int depth) {
    double centre[BL_AXES], square = 0;
    unsigned longest = 0;
    for (unsigned a = 0; a < in->dims; a++) {
        if (a + 1 < in->dims && high[a] < low[a + 1])
            return 1; // another simplex
        centre[a] = (low[a] + high[a]) / 2;
        square += (high[a] - low[a]) * (high[a] - low[a]) / 4;
        if (high[a] - low[a] > high[longest] - low[longest])
            longest = a;
    }
    in->boxes++;
    int ordered = 1;
    for (unsigned a = 0; a + 1 < in->dims; a++)
        ordered &= centre[a] >= centre[a + 1];
    if (ordered)
        in->found = fmax(in->found, upper(in, centre, 0));
    if (upper(in, centre, sqrt(square)) < in->limit)
        return 1;
    if (depth == 0)
        return 0;
    double middle_high[BL_AXES], middle_low[BL_AXES];
    memcpy(middle_high, high, in->dims * sizeof *high);
    memcpy(middle_low, low, in->dims * sizeof *low);
    middle_high[longest] = middle_low[longest] = centre[longest];
    return certify(in, low, middle_high, depth - 1) && certify(in, middle_low, high, depth - 1);
}

static void test_the_normalisation_keeps_the_bound(void **state) {
    (void)state;
    static const double numbers[2][5] = {{0, 0, 99, 76, 61}, {0, 0, 34, 32, 26}};
    static const double zero[BL_AXES] = {0}, one[BL_AXES] = {1, 1, 1, 1};
    for (int wide = 0; wide < 2; wide++)
        for (unsigned dims = 2; dims <= 4; dims++) {
            search in = {.dims = dims,
                         .radius2 = wide ? 0.6 : 0.5,
                         .limit = 1 / numbers[wide][dims] - 1e-13};
            int certified = certify(&in, zero, one, 80);
            printf("# %u-D, r2 = %g: %s, largest sum seen %.9g, times N %.6g, %zu boxes\n", dims,
                   in.radius2, certified ? "certified" : "NOT certified", in.found,
                   in.found * numbers[wide][dims], in.boxes);
            assert_true(certified);
            assert_true(in.found * numbers[wide][dims] > 0.95); // and not too much
        }
}

// The factor that the noise has is the one certified: on a corner all others are out of reach, and
// the gradient there is N r2^4 times one of its gradients, of length 1, sqrt 2 or sqrt 3.
static void test_the_noise_is_normalised_by_what_is_certified(void **state) {
    (void)state;
    static const double numbers[2][5] = {{0, 0, 99, 76, 61}, {0, 0, 34, 32, 26}};
    for (int wide = 0; wide < 2; wide++)
        for (unsigned dims = 2; dims <= 4; dims++) {
            char text[64];
            const double zero[BL_AXES] = {0}, radius2 = wide ? 0.6 : 0.5;
            double gradient[BL_AXES] = {0}, square = 0;
            snprintf(text, sizeof text, "simplex:dims=%u,radius2=%g", dims, radius2);
            bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
            signal->functions->gradient(signal->parameters, zero, gradient);
            for (unsigned a = 0; a < dims; a++)
                square += gradient[a] * gradient[a];
            double expected = numbers[wide][dims] * pow(radius2, 4) * sqrt(dims - 1);
            assert_near(sqrt(square), expected, 1e-7 * expected); // a diagonal is a float
            bl_signal_free(signal);
        }
}

// --- the closed forms ---------------------------------------------------------------------------

// int f over [0, to] by Simpson's rule.
static double simpson(double (*f)(unsigned dims, double x), unsigned dims, double to, int panels) {
    double sum = f(dims, 0) + f(dims, to);
    for (int i = 1; i < panels; i++)
        sum += f(dims, to * i / panels) * (i & 1 ? 4 : 2);
    return sum * to / panels / 3;
}

static double shell(unsigned dims, double r) {
    static const double sphere[] = {0, 0, 2 * M_PI, 4 * M_PI, 2 * M_PI * M_PI};
    return sphere[dims] * pow(r, dims - 1);
}

static double density_of_shell(unsigned dims, double f) {
    return bl_simplex_density(dims, f) * shell(dims, f);
}

static double covariance_of_shell(unsigned dims, double r) {
    return bl_simplex_covariance(dims, r) * shell(dims, r);
}

// sqrt(n+1) int r^2 w^2 dV: what the covariance is at 0.
static double square_of_shell(unsigned dims, double r) {
    double t = fmax(0, 0.5 - r * r);
    return sqrt(dims + 1) * r * r * pow(t, 8) * shell(dims, r);
}

static void test_the_closed_forms_agree(void **state) {
    (void)state;
    for (unsigned dims = 2; dims <= 4; dims++) {
        double variance = simpson(square_of_shell, dims, M_SQRT1_2, 4096);
        assert_near(bl_simplex_covariance(dims, 0), variance, 1e-13 * variance);
        // The density of a shell falls as f^-10: a share of less than 1e-13 is beyond 50.
        assert_near(simpson(density_of_shell, dims, 50, 50000), variance, 1e-12 * variance);
        // No power at 0: gradients have mean 0 and a ramp has no mean.
        assert_near(bl_simplex_density(dims, 0), 0, 0);
        assert_near(simpson(covariance_of_shell, dims, M_SQRT2, 16384), 0, 1e-12 * variance);
        // At a lag: the integral over space by a fine grid, in 2-D and 3-D.
        for (double lag = 0.25; dims < 4 && lag < 1.3; lag += 0.3) {
            const double h = dims == 2 ? 1 / 512.0 : 1 / 96.0;
            double sum = 0;
            for (double z = -0.75; dims == 3 ? z < 0.75 : z == -0.75; z += h)
                for (double y = -0.75; y < 0.75; y += h)
                    for (double x = -0.75 - lag; x < 0.75; x += h) {
                        double across = y * y + (dims == 3 ? z * z : 0), ahead = x + lag;
                        double t = 0.5 - x * x - across, s = 0.5 - ahead * ahead - across;
                        if (t > 0 && s > 0)
                            sum += (x * ahead + across) * t * t * t * t * s * s * s * s;
                    }
            sum *= sqrt(dims + 1) * pow(h, dims);
            assert_near(bl_simplex_covariance(dims, lag), sum, 1e-9 * variance);
        }
        // The two ways to the Bessel function meet.
        double z = 8 / (2 * M_PI * M_SQRT1_2);
        double below = bl_simplex_density(dims, nextafter(z, 0)),
               above = bl_simplex_density(dims, nextafter(z, 9));
        assert_near(below, above, 1e-12 * bl_simplex_density(dims, 0.8));
    }
}

// The distance of the corner 0 from the facet u_0 = 1 is one over the length of the normal.
static void test_a_corner_is_a_radius_from_its_facet(void **state) {
    (void)state;
    for (unsigned dims = 2; dims <= 4; dims++) {
        double skew = skew_of(dims), square = 0;
        for (unsigned a = 0; a < dims; a++) {
            double component = (a == 0) + skew;
            square += component * component;
        }
        assert_near(1 / sqrt(square), M_SQRT1_2, 1e-15);
    }
}

// --- near and far -------------------------------------------------------------------------------

// Three parts of F in doubles against 128 bits of it, up to the largest sum of near cells.
static void test_the_skew_of_near_cells_is_that_of_128_bits(void **state) {
    (void)state;
    bl_random random = bl_random_seed(11, 0);
    for (unsigned dims = 2; dims <= 4; dims++)
        for (int trial = 0; trial < 30000; trial++) {
            double size = trial & 1 ? 0x1p29 : 1000;
            double sum = trial < 2 ? (trial ? -0x1p29 : 0x1p29)
                                   : floor(size * (2 * bl_random_unit(&random) - 1));
            double down, near = simplex_skew_near(dims, sum, &down);
            uint64_t whole;
            double far = simplex_skew_far(dims, (__int128)sum, &whole);
            double apart = (double)((int64_t)down - (int64_t)whole) + (near - far);
            assert_true(fabs(apart) <= 0x1p-51);
            assert_true(fabs(near) < 2);
        }
}

// Points on both sides of 2^27, and outside of the domain, in one batch: each has the bits that it
// has alone, and agrees with the reference, with the kernel that jumps at the facets too.
static void test_near_and_far_points_may_stand_in_one_batch(void **state) {
    (void)state;
    enum { POINTS = 300 };
    static const char *const texts[] = {"simplex:dims=2",      "simplex",
                                        "simplex:dims=4",      "simplex:dims=2,radius2=0.6",
                                        "simplex:radius2=0.6", "simplex:dims=4,radius2=0.6"};
    static const double centres[] = {0, 0x1p27, -0x1p27, 0x1p40, INFINITY};
    static double x[BL_AXES][POINTS];
    bl_random random = bl_random_seed(12, 0);
    for (int i = 0; i < POINTS; i++)
        for (int a = 0; a < BL_AXES; a++)
            x[a][i] = centres[bl_random_bits(&random) >> 32 & (i % 7 == 0 ? 3 : 1)] +
                      10 * (2 * bl_random_unit(&random) - 1);
    x[1][17] = NAN;
    x[0][130] = centres[4];
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        bl_signal *signal = bl_test_open(texts[t], BL_ISA_BEST);
        const double *const at[BL_AXES] = {x[0], x[1], x[2], x[3]};
        float together[POINTS], alone;
        bl_signal_points(signal, at, POINTS, together);
        for (int i = 0; i < POINTS; i++) {
            const double *const one[BL_AXES] = {x[0] + i, x[1] + i, x[2] + i, x[3] + i};
            const double place[BL_AXES] = {x[0][i], x[1][i], x[2][i], x[3][i]};
            bl_signal_points(signal, one, 1, &alone);
            assert_memory_equal(&alone, together + i, sizeof alone);
            double truth = bl_signal_value(signal, place);
            assert_int_equal(isnan(truth), isnan(alone));
            if (!isnan(truth))
                assert_near(alone, truth, 32 * 0x1p-24);
        }
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_corners_are_all_that_reach_a_point),
        cmocka_unit_test(test_the_gradients_have_the_moments_stated),
        cmocka_unit_test(test_the_normalisation_keeps_the_bound),
        cmocka_unit_test(test_the_noise_is_normalised_by_what_is_certified),
        cmocka_unit_test(test_the_closed_forms_agree),
        cmocka_unit_test(test_a_corner_is_a_radius_from_its_facet),
        cmocka_unit_test(test_the_skew_of_near_cells_is_that_of_128_bits),
        cmocka_unit_test(test_near_and_far_points_may_stand_in_one_batch),
    };
    return bl_run_tests(tests);
}
