// SPDX-License-Identifier: MIT
//
// The random numbers of the lattice, noises/lattice/lattice.h. Error rate: a true random function
// passes every statistical limit below with probability above 1 - 1e-9 for all its comparisons
// together (a normal deviate beyond `limit` standard deviations, Bonferroni over the comparisons).
#include "tests/test.h"

#include "core/hash.h"
#include "core/quadrature.h"
#include "core/random.h"
#include "core/statistics.h"
#include "noises/lattice/kernel.h"
#include "noises/lattice/lattice.h"
#include "noises/lattice/lattice_repeats.h"
#include "tests/texts.h"

// The bits of a word that are used bare, and those of a mixed word.
#define WORD_BITS 0xfffff000u
#define MIXED_BITS 0xc07ffc00u

static double deviation_limit(double comparisons) {
    return -bl_normal_quantile(1e-9 / comparisons / 2);
}

// Half of the trials are near the origin, half anywhere within |c| < 2^61.
static void choose_cell(bl_random *random, size_t trial, uint64_t cell[3]) {
    for (int axis = 0; axis < 3; axis++) {
        uint64_t bits = bl_random_bits(random);
        cell[axis] = trial % 2 ? (bits & 63) - 32 : (bits >> 2) - (UINT64_C(1) << 61);
    }
}

static void count_bits(uint32_t bits, double counts[32]) {
    for (int b = 0; b < 32; b++)
        counts[b] += bits >> b & 1;
}

// The worst deviation of counts of fair coins, of the bits in the mask.
static double worst_of(const double counts[32], uint32_t mask, double trials) {
    double worst = 0;
    for (int b = 0; b < 32; b++)
        if (mask >> b & 1)
            worst = fmax(worst, fabs(counts[b] - trials / 2) / sqrt(trials / 4));
    return worst;
}

static void test_every_used_bit_is_balanced(void **state) {
    (void)state;
    size_t trials = bl_test_scaled(10000000, 100000);
    bl_random random = bl_random_seed(1, 0);
    double plain[32] = {0}, mixed[32] = {0};
    for (size_t t = 0; t < trials; t++) {
        uint64_t cell[3];
        bl_lattice lattice = bl_lattice_of(t / 1000, BL_LATTICE_HASH);
        choose_cell(&random, t, cell);
        uint32_t word = bl_lattice_word(&lattice, cell, (unsigned)t & 3);
        count_bits(word, plain);
        count_bits(bl_lattice_mixed(word), mixed);
    }
    assert_less(worst_of(plain, WORD_BITS, (double)trials), deviation_limit(64));
    assert_less(worst_of(mixed, MIXED_BITS, (double)trials), deviation_limit(64));
}

static void test_flipping_a_bit_of_the_cell_flips_half_of_the_word(void **state) {
    (void)state;
    size_t trials = bl_test_scaled(40000, 4000);
    bl_random random = bl_random_seed(2, 0);
    for (int in = 0; in < 62; in++) {
        double plain[32] = {0}, mixed[32] = {0};
        for (size_t t = 0; t < trials; t++) {
            uint64_t cell[3], other[3];
            bl_lattice lattice = bl_lattice_of(t, BL_LATTICE_HASH);
            choose_cell(&random, t, cell);
            memcpy(other, cell, sizeof other);
            other[t % 3] ^= UINT64_C(1) << in;
            uint32_t a = bl_lattice_word(&lattice, cell, 0),
                     b = bl_lattice_word(&lattice, other, 0);
            count_bits(a ^ b, plain);
            count_bits(bl_lattice_mixed(a) ^ bl_lattice_mixed(b), mixed);
        }
        uint32_t high_low_bits = in >= 28 && in <= 30 ? 0xffff0000u : WORD_BITS;
        double limit = deviation_limit(62 * 64);
        if (!(worst_of(plain, high_low_bits, (double)trials) < limit))
            fail_msg("bit %d of a cell leaves a bit of the word", in);
        if (!(worst_of(mixed, high_low_bits & MIXED_BITS & 0xffff0000u, (double)trials) < limit))
            fail_msg("bit %d of a cell leaves a bit of the mixed word", in);
    }
}

static void test_no_bit_of_the_seed_is_dead(void **state) {
    (void)state;
    size_t trials = bl_test_scaled(40000, 4000);
    bl_random random = bl_random_seed(3, 0);
    for (int in = 0; in < 64; in++) {
        double plain[32] = {0}, mixed[32] = {0};
        for (size_t t = 0; t < trials; t++) {
            uint64_t cell[3], seed = t % 2 ? t : bl_random_bits(&random);
            choose_cell(&random, t, cell);
            bl_lattice one = bl_lattice_of(seed, BL_LATTICE_HASH);
            bl_lattice other = bl_lattice_of(seed ^ UINT64_C(1) << in, BL_LATTICE_HASH);
            uint32_t a = bl_lattice_word(&one, cell, 0), b = bl_lattice_word(&other, cell, 0);
            count_bits(a ^ b, plain);
            count_bits(bl_lattice_mixed(a) ^ bl_lattice_mixed(b), mixed);
        }
        double limit = deviation_limit(64 * 64);
        if (!(worst_of(plain, WORD_BITS, (double)trials) < limit &&
              worst_of(mixed, MIXED_BITS, (double)trials) < limit))
            fail_msg("bit %d of the seed leaves a bit of the word", in);
    }
}

// Values of neighbouring seeds, cells, components and axes, as products in units of their standard
// deviation 1/3.
static void test_neighbours_are_uncorrelated(void **state) {
    (void)state;
    enum { KINDS = 10 };
    size_t trials = bl_test_scaled(2000000, 100000);
    double sums[KINDS] = {0};
    bl_random random = bl_random_seed(4, 0);
    for (size_t t = 0; t < trials; t++) {
        uint64_t cell[3], seed = t / 100;
        choose_cell(&random, t, cell);
        bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_HASH);
        bl_lattice next = bl_lattice_of(seed + 1, BL_LATTICE_HASH);
        double here = bl_lattice_value(bl_lattice_word(&lattice, cell, 0)) * BL_LATTICE_UNIT;
        for (int kind = 0; kind < KINDS; kind++) {
            uint64_t other[3] = {cell[0], cell[1], cell[2]};
            if (kind < 6)
                other[kind % 3] += kind < 3 ? 1 : 2;
            else if (kind == 6)
                other[0] = cell[1], other[1] = cell[0];
            uint32_t word = bl_lattice_word(kind == 7 ? &next : &lattice, other,
                                            kind >= 8 ? (unsigned)kind - 7 : 0);
            if (kind == 6 && cell[0] == cell[1])
                continue;
            sums[kind] += 3 * here * bl_lattice_value(word) * BL_LATTICE_UNIT;
        }
    }
    for (int kind = 0; kind < KINDS; kind++)
        if (!(fabs(sums[kind]) < deviation_limit(KINDS) * sqrt((double)trials)))
            fail_msg("neighbours of kind %d correlate: %g", kind, sums[kind] / (double)trials);
}

// The corners (i,j) (i',j) (i,j') (i',j'), where a hash that adds or xors its keys fails.
static void test_parallelograms_are_uncorrelated(void **state) {
    (void)state;
    size_t trials = bl_test_scaled(10000000, 200000);
    double plain[32] = {0}, mixed[32] = {0}, product = 0;
    bl_random random = bl_random_seed(5, 0);
    bl_lattice lattice = bl_lattice_of(0, BL_LATTICE_HASH);
    for (size_t t = 0; t < trials; t++) {
        uint64_t cell[3], to[2], bits = bl_random_bits(&random);
        if (t % 64 == 0)
            lattice = bl_lattice_of(t, BL_LATTICE_HASH);
        choose_cell(&random, 1, cell);
        unsigned a = (unsigned)t % 3, b = (a + 1) % 3;
        to[0] = cell[a] + 1 + (bits & 7);
        to[1] = cell[b] + 1 + (bits >> 8 & 7);
        double values = 1;
        uint32_t words = 0, mixes = 0;
        for (int corner = 0; corner < 4; corner++) {
            uint64_t there[3] = {cell[0], cell[1], cell[2]};
            if (corner & 1)
                there[a] = to[0];
            if (corner & 2)
                there[b] = to[1];
            uint32_t word = bl_lattice_word(&lattice, there, 0);
            words ^= word;
            mixes ^= bl_lattice_mixed(word);
            values *= bl_lattice_value(word) * BL_LATTICE_UNIT;
        }
        count_bits(words, plain);
        count_bits(mixes, mixed);
        product += 9 * values;
    }
    assert_less(worst_of(plain, WORD_BITS, (double)trials), deviation_limit(65));
    assert_less(worst_of(mixed, MIXED_BITS, (double)trials), deviation_limit(65));
    assert_less(fabs(product) / sqrt((double)trials), deviation_limit(65));
}

// Chi-square of the height, the longitude and the signs together, 2^12 bins.
static void test_directions_are_equidistributed(void **state) {
    (void)state;
    // Half of the cells are among 64^3: of 500 of them under one seed hardly two are the same, whose
    // words would be too. (50000 of them would widen the distribution of the sum by a tenth.)
    enum { BINS = 1 << 12, OF_A_SEED = 1000 };
    static double counts[BINS];
    size_t trials = bl_test_scaled(10000000, 200000);
    bl_random random = bl_random_seed(6, 0);
    memset(counts, 0, sizeof counts);
    for (size_t t = 0; t < trials; t++) {
        uint64_t cell[3];
        bl_lattice lattice = bl_lattice_of(t / OF_A_SEED, BL_LATTICE_HASH);
        choose_cell(&random, t, cell);
        uint32_t word = bl_lattice_word(&lattice, cell, 0), mixed = bl_lattice_mixed(word);
        counts[word >> 27 | (mixed >> 18 & 31) << 5 | mixed >> 30 << 10]++;
    }
    double expected = (double)trials / BINS, sum = 0;
    for (int b = 0; b < BINS; b++)
        sum += (counts[b] - expected) * (counts[b] - expected) / expected;
    double p = bl_chi_square_cdf(sum, BINS - 1);
    assert_true(p > 1e-9 && p < 1 - 1e-9);
}

static int compare_keys(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void test_no_plane_of_cells_repeats(void **state) {
    (void)state;
    enum { PLANES = 1 << 18 };
    uint64_t *keys = malloc(PLANES * sizeof *keys);
    bl_lattice lattice = bl_lattice_of(9, BL_LATTICE_HASH);
    for (uint64_t i = 0; i < PLANES; i++) {
        // Around the origin, across the step of the high half, and far apart.
        uint64_t cell = i % 3 == 0 ? i : i % 3 == 1 ? i + 0x7ffff000u : i << 40;
        bl_lattice_key key = bl_lattice_key_of(&lattice, 0, cell);
        keys[i] = (uint64_t)key.add << 32 | key.exclusive;
    }
    qsort(keys, PLANES, sizeof *keys, compare_keys);
    for (int i = 1; i < PLANES; i++)
        assert_true(keys[i - 1] != keys[i]);
    free(keys);
}

static void test_values_are_odd_multiples_of_a_power_of_two(void **state) {
    (void)state;
    assert_true(bl_lattice_value(0x7fffffff) * BL_LATTICE_UNIT == 1 - 0x1p-20);
    assert_true(bl_lattice_value(0x80000000) * BL_LATTICE_UNIT == -1 + 0x1p-20);
    for (uint32_t word = 0; word < 0x80000000u - 4096; word += 4093) {
        double scaled = bl_lattice_value(word) * 0x1p-11;
        assert_true(scaled == floor(scaled) && fmod(scaled, 2) != 0);
        assert_true(bl_lattice_value(~word) == -bl_lattice_value(word));
    }
}

// Length, mean and second moments of each way to draw gradients, over evenly spread words (an odd
// step visits them all; its multiples fill the height evenly) and over words of the hash.
static void test_gradients_are_unit_and_isotropic(void **state) {
    (void)state;
    size_t trials = bl_test_scaled(4000000, 100000);
    for (int mode = 0; mode < 3; mode++) {
        double square = mode == BL_GRADIENTS_EDGES ? 2 : 1, mean[3] = {0}, second[3][3] = {{0}};
        for (size_t t = 0; t < trials; t++) {
            double g[3];
            bl_lattice_gradient((bl_gradients)mode, (uint32_t)bl_mix(t), g);
            double length = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
            assert_near(length, sqrt(square), 6e-7);
            for (int a = 0; a < 3; a++) {
                mean[a] += g[a] / (double)trials;
                for (int b = 0; b < 3; b++)
                    second[a][b] += g[a] * g[b] / (double)trials;
            }
        }
        // Twelve comparisons a mode; a component's square is below `square`.
        double tolerance = deviation_limit(36) * square / sqrt((double)trials);
        for (int a = 0; a < 3; a++) {
            assert_near(mean[a], 0, tolerance);
            for (int b = 0; b < 3; b++)
                assert_near(second[a][b], a == b ? square / 3 : 0, tolerance);
        }
    }
}

// Every longitude and both signs at one height: mean 0 and equal moments, to rounding.
static void test_longitudes_are_symmetric(void **state) {
    (void)state;
    double mean[2] = {0}, second[2] = {0}, mixed_second = 0;
    enum { STEPS = 1 << 13 };
    uint32_t inverse = 1; // of the multiplier, by Newton's iteration mod 2^32
    for (int i = 0; i < 5; i++)
        inverse *= 2 - bl_lattice_mixed(1) * inverse;
    for (uint32_t turn = 0; turn < 4; turn++)
        for (uint32_t step = 0; step < STEPS; step++) {
            bl_sphere g = bl_sphere_gradient((turn << 30 | step << 10) * inverse);
            double side = signbit(g.radius) ? -1 : 1, x = side * g.x, y = side * g.y;
            mean[0] += x;
            mean[1] += y;
            second[0] += x * x;
            second[1] += y * y;
            mixed_second += x * y;
        }
    assert_true(second[0] > 0);
    assert_near(mean[0] / sqrt(second[0]), 0, 1e-6);
    assert_near(mean[1] / sqrt(second[0]), 0, 1e-6);
    assert_near(second[0] / second[1], 1, 1e-6);
    assert_near(mixed_second / second[0], 0, 1e-6);
}

static void test_perm256_is_a_permutation_of_period_256(void **state) {
    (void)state;
    int seen[256] = {0};
    for (uint64_t z = 0; z < 256; z++)
        seen[bl_perm256_index(0, 0, z)]++;
    for (int i = 0; i < 256; i++)
        assert_int_equal(seen[i], 1);
    bl_random random = bl_random_seed(7, 0);
    bl_lattice lattice = bl_lattice_of(1, BL_LATTICE_PERM256);
    uint32_t words[256];
    bl_perm256_words(&lattice, 2, words);
    int moved = 0;
    for (size_t t = 0; t < 10000; t++) {
        uint64_t cell[3], other[3];
        choose_cell(&random, t, cell);
        memcpy(other, cell, sizeof other);
        other[t % 3] += 256 * (bl_random_bits(&random) & 0xffff);
        uint32_t word = bl_lattice_word(&lattice, cell, 2);
        assert_int_equal(word, bl_lattice_word(&lattice, other, 2));
        assert_int_equal(word, words[bl_perm256_index(cell[0], cell[1], cell[2])]);
        other[t % 3] += 128;
        moved += word != bl_lattice_word(&lattice, other, 2);
    }
    assert_true(moved > 9000);
}

static void test_splitting_knows_the_domain(void **state) {
    (void)state;
    uint64_t cell;
    double fraction;
    assert_true(bl_lattice_split(-0.25, &cell, &fraction));
    assert_true(cell == UINT64_MAX && fraction == 0.75);
    assert_true(bl_lattice_split(0x1.8p61, &cell, &fraction));
    assert_true(cell == UINT64_C(3) << 60 && fraction == 0);
    assert_false(bl_lattice_split(0x1p62, &cell, &fraction));
    assert_false(bl_lattice_split(-INFINITY, &cell, &fraction));
    assert_false(bl_lattice_split(NAN, &cell, &fraction));
}

// --- numbers that meet again --------------------------------------------------------------------

// Counted cell by cell over all 256^3.
static void test_repeats_are_counted_right(void **state) {
    (void)state;
    static const int lags[][3] = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0},
                                  {2, -1, 0}, {-3, 2, 1}, {0, 0, 3}};
    for (size_t n = 0; n < sizeof lags / sizeof *lags; n++) {
        const int *l = lags[n];
        double same = 0, in_plane = 0;
        for (unsigned z = 0; z < 256; z++)
            for (unsigned y = 0; y < 256; y++)
                for (unsigned x = 0; x < 256; x++) {
                    uint32_t there = bl_perm256_index(x + (unsigned)l[0], y + (unsigned)l[1],
                                                      z + (unsigned)l[2]);
                    int meet = bl_perm256_index(x, y, z) == there;
                    same += meet;
                    in_plane += meet && z == 0;
                }
        assert_near(bl_perm256_repeats(3, l), same / (256.0 * 256 * 256), 0);
        if (l[2] == 0)
            assert_near(bl_perm256_repeats(2, l), in_plane / (256.0 * 256), 0);
    }
    assert_near(bl_perm256_repeats(1, (const int[]){0, 0, 0}), 1, 0);
    assert_near(bl_perm256_repeats(1, (const int[]){2, 0, 0}), 0, 0);
}

// Of value noise in a plane: at a place the variance is 1/3 of the sum over the 256 numbers of the
// square of all the weight that each has there. That is averaged over the cells one by one, and
// within a cell by quadrature of products of weights.
static void test_the_variance_of_a_permutation_is_the_mean_over_its_cells(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bl_kernel kernel;
    } cases[] = {{"vnoise:dims=2,lattice=perm256", BL_KERNEL_CATMULL_ROM},
                 {"vnoise:dims=2,lattice=perm256,interp=linear", BL_KERNEL_LINEAR},
                 {"vnoise:dims=2,lattice=perm256,interp=bspline3", BL_KERNEL_BSPLINE3}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        double product[4][4] = {{0}}, sum = 0; // the planes -1, 0, 1, 2 of a cell
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                for (int k = 0; k < BL_QUADRATURE_NODES; k++) {
                    double t = (1 + bl_quadrature_node[k]) / 2;
                    product[i][j] += bl_quadrature_weight[k] / 2 *
                                     bl_kernel_value(cases[n].kernel, t - (i - 1)) *
                                     bl_kernel_value(cases[n].kernel, t - (j - 1));
                }
        for (unsigned y = 0; y < 256; y++)
            for (unsigned x = 0; x < 256; x++) {
                uint32_t index[16];
                double cell = 0; // rounding does not add up over all cells
                for (unsigned i = 0; i < 16; i++)
                    index[i] = bl_perm256_index(x + i % 4, y + i / 4, 0);
                for (unsigned i = 0; i < 16; i++)
                    for (unsigned j = 0; j < 16; j++)
                        if (index[i] == index[j])
                            cell += product[i % 4][j % 4] * product[i / 4][j / 4];
                sum += cell / 65536;
            }
        bl_signal *signal = bl_test_open(cases[n].text, BL_ISA_BEST);
        assert_near(signal->facts.variance, sum * (1 - 0x1p-40) / 3, 1e-12);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_used_bit_is_balanced),
        cmocka_unit_test(test_flipping_a_bit_of_the_cell_flips_half_of_the_word),
        cmocka_unit_test(test_no_bit_of_the_seed_is_dead),
        cmocka_unit_test(test_neighbours_are_uncorrelated),
        cmocka_unit_test(test_parallelograms_are_uncorrelated),
        cmocka_unit_test(test_directions_are_equidistributed),
        cmocka_unit_test(test_no_plane_of_cells_repeats),
        cmocka_unit_test(test_values_are_odd_multiples_of_a_power_of_two),
        cmocka_unit_test(test_gradients_are_unit_and_isotropic),
        cmocka_unit_test(test_longitudes_are_symmetric),
        cmocka_unit_test(test_perm256_is_a_permutation_of_period_256),
        cmocka_unit_test(test_splitting_knows_the_domain),
        cmocka_unit_test(test_repeats_are_counted_right),
        cmocka_unit_test(test_the_variance_of_a_permutation_is_the_mean_over_its_cells),
    };
    return bl_run_tests(tests);
}
