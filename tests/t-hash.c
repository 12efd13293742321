// SPDX-License-Identifier: MIT
//
// The hash and the generator. Error rate: every statistical limit below is passed by a true
// random function with probability above 1 - 1e-9 for all its comparisons together (a normal
// deviate beyond `limit` standard deviations, Bonferroni over the comparisons).
#include "tests/test.h"

#include "core/hash.h"
#include "core/random.h"
#include "core/statistics.h"

static double deviation_limit(double comparisons) {
    return -bl_normal_quantile(1e-9 / comparisons / 2);
}

// Flips each input bit of many inputs and counts how often each output bit changes.
typedef uint64_t (*hash_function)(uint64_t input, uint64_t other);

static double worst_avalanche(hash_function hash, size_t trials) {
    double worst = 0;
    for (unsigned in = 0; in < 64; in++) {
        size_t flips[64] = {0};
        for (size_t t = 0; t < trials; t++) {
            // Half of the inputs are small numbers, which is what cells and seeds are.
            uint64_t x = t % 2 ? t : bl_mix(t ^ UINT64_C(0x1234567));
            uint64_t change = hash(x, t) ^ hash(x ^ UINT64_C(1) << in, t);
            for (unsigned out = 0; out < 64; out++)
                flips[out] += change >> out & 1;
        }
        for (unsigned out = 0; out < 64; out++) {
            double z = fabs((double)flips[out] - (double)trials / 2) / sqrt((double)trials / 4);
            worst = z > worst ? z : worst;
        }
    }
    return worst;
}

static uint64_t mix_of(uint64_t input, uint64_t other) {
    (void)other;
    return bl_mix(input);
}

static uint64_t stream_by_seed(uint64_t input, uint64_t other) {
    return bl_stream(input, other & 7);
}

static uint64_t stream_by_number(uint64_t input, uint64_t other) {
    return bl_stream(other & 7, input);
}

static uint64_t bits_by_seed(uint64_t input, uint64_t other) {
    bl_random random = bl_random_seed(input, 0);
    random.counter = other;
    return bl_random_bits(&random);
}

static uint64_t bits_by_counter(uint64_t input, uint64_t other) {
    (void)other;
    bl_random random = {UINT64_C(0xabcdef), input};
    return bl_random_bits(&random);
}

static void test_every_input_bit_flips_every_output_bit_half_of_the_time(void **state) {
    (void)state;
    size_t trials = bl_test_scaled(1 << 16, 1 << 12);
    hash_function hashes[] = {mix_of, stream_by_seed, stream_by_number, bits_by_seed,
                              bits_by_counter};
    for (size_t i = 0; i < sizeof hashes / sizeof *hashes; i++)
        assert_less(worst_avalanche(hashes[i], trials), deviation_limit(5 * 64 * 64));
}

static uint64_t identity_with_a_dead_bit(uint64_t input, uint64_t other) {
    (void)other;
    return bl_mix(input & ~(UINT64_C(1) << 17));
}

static void test_a_dead_bit_would_be_found(void **state) {
    (void)state;
    double worst = worst_avalanche(identity_with_a_dead_bit, 1 << 12);
    assert_true(worst > deviation_limit(5 * 64 * 64));
}

static void test_mix_is_a_bijection(void **state) {
    (void)state;
    // Undo each step: an xor-shift by s >= 22 is undone by two shifts, an odd multiplier by its
    // inverse (Newton's iteration doubles the correct bits from 3).
    uint64_t inverse_golden = BL_GOLDEN, inverse_root = BL_ROOT_TWO;
    for (int i = 0; i < 6; i++) {
        inverse_golden *= 2 - BL_GOLDEN * inverse_golden;
        inverse_root *= 2 - BL_ROOT_TWO * inverse_root;
    }
    for (uint64_t i = 0; i < 100000; i++) {
        uint64_t x = i * UINT64_C(0x123456789abcdef1), y = bl_mix(x);
        y ^= y >> 32;
        y *= inverse_root;
        y ^= y >> 29 ^ y >> 58;
        y *= inverse_golden;
        y ^= y >> 32;
        assert_true(x == y);
    }
}

static double correlation(uint64_t seed_a, uint64_t seed_b, uint64_t shift, size_t n) {
    bl_random a = bl_random_seed(seed_a, 0), b = bl_random_seed(seed_b, 0);
    b.counter = shift;
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += (bl_random_unit(&a) - 0.5) * (bl_random_unit(&b) - 0.5) * 12;
    return sum / sqrt((double)n); // standard normal for independent uniforms
}

static void test_neighbouring_seeds_are_uncorrelated(void **state) {
    (void)state;
    size_t n = bl_test_scaled(20000, 2000);
    double limit = deviation_limit(64 * 3 + 64 * 3);
    for (uint64_t seed = 0; seed < 64; seed++)
        for (uint64_t shift = 0; shift < 3; shift++) {
            assert_less(fabs(correlation(seed, seed + 1, shift, n)), limit);
            assert_less(fabs(correlation(1, UINT64_C(1) << seed | 2, shift, n)), limit);
        }
}

static void test_numbers_fill_their_range_evenly(void **state) {
    (void)state;
    enum { CELLS = 4096 };
    size_t n = bl_test_scaled(1 << 20, 1 << 17);
    static double counts[3][CELLS];
    memset(counts, 0, sizeof counts);
    bl_random random = bl_random_seed(7, 3);
    for (size_t i = 0; i < n; i++) {
        uint64_t bits = bl_random_bits(&random), next = bl_mix(i);
        counts[0][bits >> 52]++;
        counts[1][bits & (CELLS - 1)]++;
        counts[2][(bits >> 58) << 6 | next >> 58]++;
    }
    for (int c = 0; c < 3; c++) {
        double expected = (double)n / CELLS, chi = 0;
        for (size_t i = 0; i < CELLS; i++)
            chi += (counts[c][i] - expected) * (counts[c][i] - expected) / expected;
        double p = bl_chi_square_cdf(chi, CELLS - 1);
        assert_true(p > 1e-9 / 6 && p < 1 - 1e-9 / 6);
    }
}

static void test_unit_and_normal_numbers_have_their_moments(void **state) {
    (void)state;
    size_t n = bl_test_scaled(1 << 18, 1 << 15);
    bl_random random = bl_random_seed(11, 0);
    bl_moments unit = {0}, normal = {0};
    for (size_t i = 0; i < n; i++) {
        double u = bl_random_unit(&random);
        assert_true(u >= 0 && u < 1);
        bl_moments_add(&unit, u);
        bl_moments_add(&normal, bl_random_normal(&random));
    }
    double limit = deviation_limit(4), root = sqrt((double)n);
    assert_near(unit.mean, 0.5, limit * sqrt(1.0 / 12) / root);
    assert_near(bl_moments_variance(&unit), 1.0 / 12, limit * sqrt(1.0 / 180) / root);
    assert_near(normal.mean, 0, limit / root);
    assert_near(bl_moments_variance(&normal), 1, limit * sqrt(2) / root);
}

// The streams of seeds are part of the definition of every noise. The numbers are the formulas in
// the heads of core/hash.h and core/random.h, worked out with the unlimited integers of another
// language (the constants from 60 digits of the roots):
//   G = int((sqrt(5) - 1)/2 2^64) | 1, R = int((sqrt(2) - 1) 2^64) | 1, all modulo 2^64
//   mix(x): x ^= x >> 32; x *= G; x ^= x >> 29; x *= R; x ^= x >> 32
//   stream(s, k) = mix(mix(s + G) ^ (k R + G)), bits(key, c) = mix(mix(c G) ^ key)
static void test_streams_are_their_formulas(void **state) {
    (void)state;
    static const struct {
        uint64_t seed, stream, key, bits[3];
    } known[] = {
        {0,
         0,
         UINT64_C(0xef180b7b810acd60),
         {UINT64_C(0x85df8cf67dbed90f), UINT64_C(0x2c0da228cab10a7a),
          UINT64_C(0x3cb711f9a7c5d9f8)}},
        {0,
         1,
         UINT64_C(0x85985f9844c1b825),
         {UINT64_C(0xce7d0dcdfd0f408d), UINT64_C(0x25486ff3e9222f96),
          UINT64_C(0xbbe2df57267d89d0)}},
        {1,
         0,
         UINT64_C(0x04819c7ba4339a81),
         {UINT64_C(0x1b3c0cd2843a13db), UINT64_C(0xd93ee78e21d46438),
          UINT64_C(0xba798aa6682dac7a)}},
        {7,
         3,
         UINT64_C(0x3801ca4ded0e4131),
         {UINT64_C(0x8058d310cc3e911a), UINT64_C(0x9f38e4650e4fb3da),
          UINT64_C(0x971ef108d1f255c9)}},
        {UINT64_MAX,
         UINT64_MAX,
         UINT64_C(0x57d345fe3bfccb25),
         {UINT64_C(0x6eae05fc6d8d9435), UINT64_C(0x526ff8dfdfd05d59),
          UINT64_C(0x70917940fb19c676)}},
    };
    assert_true(BL_GOLDEN == UINT64_C(0x9e3779b97f4a7c15));
    assert_true(BL_ROOT_TWO == UINT64_C(0x6a09e667f3bcc909));
    assert_true(bl_mix(1) == UINT64_C(0x4a47868c6e690842));
    assert_true(bl_mix(UINT64_C(0x123456789abcdef)) == UINT64_C(0x507959cea44a844c));
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        bl_random random = bl_random_seed(known[i].seed, known[i].stream);
        assert_true(bl_stream(known[i].seed, known[i].stream) == known[i].key);
        for (int n = 0; n < 3; n++) {
            bl_random same = random, unit = random;
            uint64_t bits = bl_random_bits(&random);
            assert_true(bits == known[i].bits[n]);
            assert_true(bl_random_unit(&unit) == ldexp((double)(bits >> 11), -53));
            // The middle of the step of 2^-53 that the number stands for.
            double p = ldexp((double)(bits >> 11) + 0.5, -53);
            assert_true(bl_random_normal(&same) == bl_normal_quantile(p));
            assert_true(same.counter == random.counter && unit.counter == random.counter);
        }
    }
    assert_true(bl_component_seed(7, 0) == 7);
    assert_true(bl_component_seed(7, 1) == UINT64_C(0xcb1a89b983652cb1));
    assert_true(bl_component_seed(7, 2) == UINT64_C(0x3ef6be179378ff29));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_input_bit_flips_every_output_bit_half_of_the_time),
        cmocka_unit_test(test_a_dead_bit_would_be_found),
        cmocka_unit_test(test_mix_is_a_bijection),
        cmocka_unit_test(test_neighbouring_seeds_are_uncorrelated),
        cmocka_unit_test(test_numbers_fill_their_range_evenly),
        cmocka_unit_test(test_unit_and_normal_numbers_have_their_moments),
        cmocka_unit_test(test_streams_are_their_formulas),
    };
    return bl_run_tests(tests);
}
