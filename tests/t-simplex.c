// SPDX-License-Identifier: MIT
//
// What the walkers do not hold of simplex noise: the sum over the corners against the sum over all
// points of the lattice near by, near and far; the bound behind N; the closed forms against each
// other and against a sum by brute force; that facets lie a kernel's radius away; the two ways to
// the skew, and points of both in one batch.
#include "tests/test.h"

#include "core/random.h"
#include "noises/lattice/lattice.h"
#include "noises/lattice/simplex_place.h"
#include "noises/lattice/simplex_theory.h"
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

// The word of a cell. With periods (three dimensions): after as many steps of one period along each
// axis as lead into the box from 0 on, found by walking.
static uint32_t word_of(const bl_lattice *lattice, unsigned dims, const uint32_t period[BL_AXES],
                        const int64_t from[BL_AXES]) {
    int64_t cell[BL_AXES] = {from[0], from[1], from[2], from[3]};
    for (unsigned a = 0; dims == 3 && a < 3; a++) {
        int64_t step = period[a] / 3, sum = cell[0] + cell[1] + cell[2];
        int64_t place = 6 * cell[a] - sum, whole = 6 * (int64_t)period[a];
        for (; whole && (place < 0 || place >= whole); place += place < 0 ? whole : -whole)
            for (unsigned b = 0; b < 3; b++)
                cell[b] += (place < 0 ? step : -step) * (b == a ? 4 : 1);
    }
    uint32_t add = 0, exclusive = 0, index = 0;
    for (unsigned a = dims; a-- > 0;)
        index = bl_permutation[(uint64_t)(cell[a] + index) & 255];
    if (dims == 2) // as in the plane z = 0 of three
        index = bl_permutation[(uint64_t)(cell[1] + bl_permutation[0]) & 255],
        index = bl_permutation[(uint64_t)(cell[0] + index) & 255];
    if (lattice->kind == BL_LATTICE_PERM256)
        return bl_perm256_word(lattice, index, 0);
    for (unsigned a = 0; a < dims; a++) {
        bl_lattice_key key = bl_lattice_key_of(lattice, a, (uint64_t)cell[a]);
        add += key.add;
        exclusive ^= key.exclusive;
    }
    return add * exclusive;
}

// The sum over all points of the lattice with skewed numbers within 3 of the skewed place, in
// numbers of 64 bits: at 2^30 the skew is then good to 2^-32.
static double lattice_sum(const bl_lattice_settings *settings, unsigned dims,
                          const double at[BL_AXES]) {
    bl_lattice lattice = bl_lattice_open(settings);
    memset(lattice.period, 0, sizeof lattice.period); // cells are moved here
    long double total = 0, u[BL_AXES], sum = 0;
    long double skew = (sqrtl(dims + 1) - 1) / dims, unskew = (1 - 1 / sqrtl(dims + 1)) / dims;
    for (unsigned a = 0; a < dims; a++)
        total += at[a];
    for (unsigned a = 0; a < dims; a++)
        u[a] = at[a] + skew * total;
    unsigned many = dims == 4 ? 1296 : dims == 3 ? 216 : 36;
    for (unsigned n = 0; n < many; n++) {
        long double v[BL_AXES], all = 0;
        int64_t cell[BL_AXES] = {0};
        for (unsigned a = 0, rest = n; a < dims; a++, rest /= 6) {
            cell[a] = (int64_t)(floorl(u[a]) + (long double)(rest % 6) - 2);
            v[a] = u[a] - (long double)cell[a];
            all += v[a];
        }
        double g[BL_AXES];
        long double dot = 0, square = 0;
        gradient_of(dims, word_of(&lattice, dims, settings->period, cell), g);
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
            assert_near(bl_signal_value(signal, at),
                        lattice_sum(&(bl_lattice_settings){.seed = 5}, dims, at), tolerance);
        }
        bl_signal_free(signal);
    }
}

// The same with the other lattice, with periods, and with a component.
static void test_lattices_and_periods_are_those_of_the_points(void **state) {
    (void)state;
    static const struct {
        const char *text;
        unsigned dims;
        bl_lattice_settings settings;
    } cases[] = {
        {"simplex:seed=5,lattice=perm256,dims=2", 2, {5, BL_LATTICE_PERM256, 0, {0}}},
        {"simplex:seed=5,lattice=perm256", 3, {5, BL_LATTICE_PERM256, 0, {0}}},
        {"simplex:seed=5,lattice=perm256,dims=4", 4, {5, BL_LATTICE_PERM256, 0, {0}}},
        {"simplex:seed=5,component=2", 3, {5, BL_LATTICE_HASH, 2, {0}}},
        {"simplex:seed=5,period=3", 3, {5, BL_LATTICE_HASH, 0, {3, 3, 3, 3}}},
        {"simplex:seed=5,period=6,9,12", 3, {5, BL_LATTICE_HASH, 0, {6, 9, 12}}},
        {"simplex:seed=5,period=0,9,0", 3, {5, BL_LATTICE_HASH, 0, {0, 9}}},
        {"simplex:seed=5,period=12,lattice=perm256", 3, {5, BL_LATTICE_PERM256, 0, {12, 12, 12}}}};
    bl_random random = bl_random_seed(21, 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        for (int trial = 0; trial < 300; trial++) {
            double at[BL_AXES] = {0};
            for (unsigned a = 0; a < cases[i].dims; a++)
                at[a] = 400 * (2 * bl_random_unit(&random) - 1);
            assert_near(bl_signal_value(signal, at),
                        lattice_sum(&cases[i].settings, cases[i].dims, at), 1e-12);
        }
        bl_signal_free(signal);
    }
}

// After the period it is the same except for the rounding of the place (2^-52 of a cell, slopes
// below 10), after every smaller multiple of 3 it is not, and within it is the noise without one.
static void test_it_repeats_after_multiples_of_3(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double period[3];
    } cases[] = {{"simplex:period=9,12,15", {9, 12, 15}},
                 {"simplex:period=4294967295", {4294967295, 4294967295, 4294967295}},
                 {"simplex:lattice=perm256", {768, 768, 768}},
                 {"simplex:lattice=perm256,period=1536,384,9", {768, 384, 9}}};
    bl_random random = bl_random_seed(22, 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        for (unsigned axis = 0; axis < 3; axis++) {
            double period = cases[i].period[axis];
            assert_near(signal->facts.period[axis], period, 0);
            for (double shift = 3; shift <= period; shift += shift < 30 ? 3 : period - shift) {
                int same = 0;
                for (int trial = 0; trial < 100; trial++) {
                    double at[BL_AXES], there[BL_AXES];
                    for (unsigned a = 0; a < BL_AXES; a++)
                        there[a] = at[a] = 3000 * (2 * bl_random_unit(&random) - 1);
                    there[axis] = at[axis] + (trial % 3 - 1) * shift;
                    at[axis] = there[axis] - (trial % 3 - 1) * shift; // after the rounding
                    same +=
                        fabs(bl_signal_value(signal, at) - bl_signal_value(signal, there)) < 1e-12;
                }
                if (shift == period ? same < 100 : same > 60) // a third is shifted by 0
                    fail_msg("%s: %d of 100 places are the same %g along %c", cases[i].text, same,
                             shift, "xyz"[axis]);
                if (shift == period)
                    break;
            }
        }
        bl_signal_free(signal);
    }
    bl_signal *plain = bl_test_open("simplex", BL_ISA_BEST);
    bl_signal *repeated = bl_test_open("simplex:period=42,39,300", BL_ISA_BEST);
    for (int trial = 0; trial < 500; trial++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = 2 + 35 * bl_random_unit(&random);
        assert_true(bl_signal_value(plain, at) == bl_signal_value(repeated, at));
    }
    bl_signal_free(plain);
    bl_signal_free(repeated);
}

static void test_periods_that_the_simplices_lack_are_refused(void **state) {
    (void)state;
    static const char *const cases[][2] = {{"simplex:period=4", "6"},
                                           {"simplex:period=3,3,1", "along z"},
                                           {"simplex:dims=2,period=3", "take dims=3"},
                                           {"simplex:dims=4,period=0,0,0,3", "take dims=3"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = NULL;
        bl_message message = {""};
        assert_int_equal(bl_noise_open(cases[i][0], BL_ISA_BEST, &signal, &message), BL_USAGE);
        if (!strstr(message.text, "period=") || !strstr(message.text, cases[i][1]))
            fail_msg("%s: %s", cases[i][0], message.text);
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
        cmocka_unit_test(test_lattices_and_periods_are_those_of_the_points),
        cmocka_unit_test(test_it_repeats_after_multiples_of_3),
        cmocka_unit_test(test_periods_that_the_simplices_lack_are_refused),
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
