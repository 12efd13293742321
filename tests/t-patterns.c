// SPDX-License-Identifier: MIT
//
// Sampling patterns: their strata, their discrepancy, and that pixels share nothing.
#include "tests/test.h"

#include "aliasing/patterns.h"
#include "core/statistics.h"

enum { N = 8, COUNT = N * N };

static void fill(bl_pattern pattern, uint64_t key, double place[COUNT][2]) {
    for (uint32_t i = 0; i < COUNT; i++) {
        bl_pattern_place(pattern, N, i, key, place[i]);
        for (int a = 0; a < 2; a++)
            assert_true(place[i][a] >= 0 && place[i][a] < 1);
    }
}

// Whether each of columns x rows equal boxes (COUNT of them) has one place.
static int is_stratified(double place[COUNT][2], int columns, int rows) {
    int found[COUNT] = {0};
    for (int i = 0; i < COUNT; i++)
        found[(int)(place[i][0] * columns) + columns * (int)(place[i][1] * rows)]++;
    for (int i = 0; i < COUNT; i++)
        if (found[i] != 1)
            return 0;
    return 1;
}

static void test_patterns_have_one_place_in_each_of_their_strata(void **state) {
    (void)state;
    double place[COUNT][2];
    int loose = 0;
    for (uint64_t key = 0; key < 200; key++) {
        fill(BL_PATTERN_REGULAR, key, place);
        assert_true(is_stratified(place, N, N));
        fill(BL_PATTERN_JITTER, key, place);
        assert_true(is_stratified(place, N, N));
        loose += !is_stratified(place, COUNT, 1);
        fill(BL_PATTERN_STRATIFIED, key, place);
        assert_true(is_stratified(place, N, N));
        assert_true(is_stratified(place, COUNT, 1));
        assert_true(is_stratified(place, 1, COUNT));
        fill(BL_PATTERN_SOBOL, key, place);
        for (int columns = 1; columns <= COUNT; columns *= 2) // COUNT is a power of 2
            assert_true(is_stratified(place, columns, COUNT / columns));
    }
    assert_true(loose > 190); // jitter has no such strata: the check can fail
}

// The star discrepancy, by brute force: the supremum stands at a corner whose coordinates are those
// of places, taken closed or open.
static double discrepancy(double place[COUNT][2]) {
    double most = 0;
    for (int i = 0; i <= COUNT; i++)
        for (int j = 0; j <= COUNT; j++) {
            double x = i < COUNT ? place[i][0] : 1, y = j < COUNT ? place[j][1] : 1;
            int open = 0, closed = 0;
            for (int k = 0; k < COUNT; k++) {
                open += place[k][0] < x && place[k][1] < y;
                closed += place[k][0] <= x && place[k][1] <= y;
            }
            most = fmax(most, fmax(x * y - open / (double)COUNT, closed / (double)COUNT - x * y));
        }
    return most;
}

// The bounds of Niederreiter (1992): N D < 2 + prod((b - 1) log N / (2 log b) + (b + 1) / 2) over
// the bases b of Halton's sequence (theorem 3.6), of which a shift modulo 1 makes at most four
// boxes out of one; N D <= m/2 + 3/2 for nets of 2^m places with one in each elementary box.
static void test_halton_and_sobol_have_a_low_discrepancy(void **state) {
    (void)state;
    const double n = COUNT;
    double halton = (log(n) / (2 * log(2)) + 1.5) * (log(n) / log(3) + 2) + 2;
    double place[COUNT][2], mean[BL_PATTERN_COUNT] = {0};
    for (uint64_t key = 0; key < 40; key++)
        for (int p = 0; p < BL_PATTERN_COUNT; p++) {
            fill((bl_pattern)p, key, place);
            double d = discrepancy(place);
            mean[p] += d / 40;
            if (p == BL_PATTERN_SOBOL)
                assert_less(n * d, 0.5 * log2(n) + 1.5);
            if (p == BL_PATTERN_HALTON)
                assert_less(n * d, 4 * halton);
        }
    // Up to its last place, at 1 - 1/(2 N) along each axis, a regular grid has all of them.
    assert_less(mean[BL_PATTERN_SOBOL], mean[BL_PATTERN_JITTER]);
    assert_less(mean[BL_PATTERN_HALTON], mean[BL_PATTERN_JITTER]);
    assert_near(mean[BL_PATTERN_REGULAR], 1 - (1 - 0.5 / N) * (1 - 0.5 / N), 0.02);
}

// The sums of places over keys: uniform, so with mean 1/2 and variance 1/12 for each index, and
// uncorrelated from pixel to pixel. 6.5 standard errors fail once in 1e10.
static void test_places_are_uniform_and_pixels_independent(void **state) {
    (void)state;
    enum { KEYS = 4000 };
    for (int p = BL_PATTERN_JITTER; p < BL_PATTERN_COUNT; p++)
        for (int a = 0; a < 2; a++) {
            double mean = 0, product = 0;
            for (int k = 0; k < KEYS; k++) {
                double here[2], next[2];
                uint32_t index = (uint32_t)k % COUNT;
                bl_pattern_place((bl_pattern)p, N, index, bl_pattern_key(5, k + 0.5, 3.5), here);
                bl_pattern_place((bl_pattern)p, N, index, bl_pattern_key(5, k + 1.5, 3.5), next);
                mean += (here[a] - 0.5) / KEYS;
                if (p >= BL_PATTERN_HALTON) // the others move only within a square
                    product += (here[a] - 0.5) * (next[a] - 0.5) / KEYS;
            }
            assert_less(fabs(mean), 6.5 * sqrt(1.0 / 12 / KEYS));
            assert_less(fabs(product), 6.5 / 12 / sqrt(KEYS));
        }
}

static void test_a_pixel_does_not_depend_on_what_was_asked_before(void **state) {
    (void)state;
    double a[2], b[2], other[2];
    bl_pattern_place(BL_PATTERN_STRATIFIED, N, 13, bl_pattern_key(1, 2.5, 9.5), a);
    bl_pattern_place(BL_PATTERN_STRATIFIED, N, 12, bl_pattern_key(1, 9.5, 2.5), other);
    bl_pattern_place(BL_PATTERN_STRATIFIED, N, 13, bl_pattern_key(1, 2.5, 9.5), b);
    assert_memory_equal(a, b, sizeof a);
    assert_true(bl_pattern_key(1, 2.5, 9.5) != bl_pattern_key(1, 9.5, 2.5));
    assert_true(bl_pattern_key(1, 2.5, 9.5) != bl_pattern_key(2, 2.5, 9.5));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_patterns_have_one_place_in_each_of_their_strata),
        cmocka_unit_test(test_halton_and_sobol_have_a_low_discrepancy),
        cmocka_unit_test(test_places_are_uniform_and_pixels_independent),
        cmocka_unit_test(test_a_pixel_does_not_depend_on_what_was_asked_before),
    };
    return bl_run_tests(tests);
}
