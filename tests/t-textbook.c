// SPDX-License-Identifier: MIT
//
// The yardsticks of the benchmark are honest: every noise has a plain loop, and the loop is the
// noise that the facts describe, in its range, its mean, its variance and its continuity, and not
// something cheaper.
//
// Error rate. A batch is a fresh filling of the tables and 64 random places; batches are
// independent. A true loop fails the tests of all means and variances with probability 1e-6. Tables
// of 256 numbers meet again within a kernel and between octaves: on top of the error, 3 % of the
// variance are allowed for that.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "noises/textbook.h"
#include "tests/texts.h"

#define ERROR_RATE 1e-6

static float random_place(bl_random *random) {
    return (float)(1000 * bl_random_unit(random) - 500);
}

static void check_moments(const bl_noise *noise, uint64_t stream, double limit) {
    enum { BATCH = 64 };
    bl_signal *signal = bl_test_open(noise->name, BL_ISA_BEST);
    const bl_facts *facts = &signal->facts;
    bl_random random = bl_random_seed(11, stream);
    bl_moments values = {.n = 0}, squares = {.n = 0};
    for (size_t batch = 0; batch < bl_test_scaled(512, 256); batch++) {
        double sum = 0, square = 0;
        bl_textbook_refill(bl_random_bits(&random));
        for (int i = 0; i < BATCH; i++) {
            float x = random_place(&random), y = random_place(&random), z = random_place(&random);
            double value = (double)noise->textbook(x, y, z);
            if (!(value >= facts->lower - 1e-5 && value <= facts->upper + 1e-5))
                fail_msg("%s: %g is out of its range", noise->name, value);
            sum += value / BATCH;
            square += value * value / BATCH;
        }
        bl_moments_add(&values, sum);
        bl_moments_add(&squares, square);
    }
    double error = limit * sqrt(bl_moments_variance(&values) / values.n);
    if (!isnan(facts->mean) && !(fabs(values.mean - facts->mean) <= error + 1e-6))
        fail_msg("%s: mean %g +- %g, stated %g", noise->name, values.mean, error, facts->mean);
    double expected = facts->variance + facts->mean * facts->mean;
    error = limit * sqrt(bl_moments_variance(&squares) / squares.n) + 0.03 * facts->variance;
    if (!isnan(expected) && !(fabs(squares.mean - expected) <= error))
        fail_msg("%s: mean square %g +- %g, stated %g", noise->name, squares.mean, error, expected);
    bl_signal_free(signal);
}

static void test_every_noise_has_a_plain_loop_of_its_statistics(void **state) {
    (void)state;
    double limit = -bl_normal_quantile(ERROR_RATE / (2 * (double)bl_noise_count()) / 2);
    for (size_t n = 0; n < bl_noise_count(); n++) {
        const bl_noise *noise = bl_noise_at(n, BL_ISA_BEST);
        if (!noise->textbook)
            fail_msg("%s has no plain loop", noise->name);
        check_moments(noise, n, limit);
    }
}

// The last float below a plane of the lattice lies in the cell below it. Tables of a kernel jump
// between their entries, but seldom just there: the mean jump counts.
static void test_plain_loops_are_continuous_across_a_plane(void **state) {
    (void)state;
    enum { TRIALS = 600 };
    bl_textbook_refill(665);
    for (size_t n = 0; n < bl_noise_count(); n++) {
        const bl_noise *noise = bl_noise_at(n, BL_ISA_BEST);
        bl_signal *signal = bl_test_open(noise->name, BL_ISA_BEST);
        bl_random random = bl_random_seed(12, n);
        double jump = 0, square = 0;
        for (int trial = 0; trial < TRIALS; trial++) {
            float at[3] = {random_place(&random), random_place(&random), random_place(&random)};
            at[trial % 3] = floorf(at[trial % 3] / 8);
            double on = (double)noise->textbook(at[0], at[1], at[2]);
            at[trial % 3] = nextafterf(at[trial % 3], -INFINITY);
            jump += fabs((double)noise->textbook(at[0], at[1], at[2]) - on) / TRIALS;
            square += on * on / TRIALS;
        }
        if (signal->facts.continuity >= 0 && !(jump < 2e-3 * sqrt(square) + 1e-5))
            fail_msg("%s: jumps by %g across planes", noise->name, jump);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_noise_has_a_plain_loop_of_its_statistics),
        cmocka_unit_test(test_plain_loops_are_continuous_across_a_plane),
    };
    return bl_run_tests(tests);
}
