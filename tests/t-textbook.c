// SPDX-License-Identifier: MIT
//
// The yardsticks of the benchmark are honest: a plain loop computes its noise and not something
// cheaper. Most loops compute the field itself with the settings that the
// descriptor names, so they are held to the double reference place by place; the others draw random
// numbers of their own, and are held to the closed form of their covariance.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "noises/textbook.h"
#include "tests/texts.h"

// Places are multiples of 1/128, on both sides of the origin and beyond the 256 entries of the
// tables. Their fractions and squared distances d^2 <= 12 are exact in float, and so is the text's
// 100 d^2 + 1/2 (14 bits behind the point and 11 before it), which chooses the entry of a table: a
// rounding there would choose another one.
enum { PLACE_PARTS = 128, PLACE_HALF = 300 };

static float exact_place(bl_random *random) {
    return (float)(floor(2.0 * PLACE_HALF * PLACE_PARTS * bl_random_unit(random)) / PLACE_PARTS) -
           PLACE_HALF;
}

// Rounding. A sum of numbers of size v with weights w is at most B = sum |w v|, the stated bound,
// and a loop rounds each of its parts on the way from the tables by 2^-24 of itself, k times at
// most. `ROUNDINGS` stands for k times what the intermediate results exceed B by (the text's spline
// sums coefficients of a size of 4). What a loop rounds more is stated by name.
#define ROUNDINGS 32

typedef struct rounding {
    const char *name;
    double more;
} rounding;

static const rounding more_roundings[] = {
    // The inverse of the covariances has sizes that sum to 8.8 in a row, so weights along each axis
    // lose 8.8 times a rounding: 3 * 8.8 in a product, each of expf, its argument and two sums.
    {"wiener", 3 * 8.8 * 4},
    // Angles in radians: below 2.54 (300 + 96) = 1006 for the last wave, rounded three times.
    {"gardner", 3 * 1006},
    {NULL, 0}};

static double rounding_of(const bl_noise *noise, const bl_facts *facts) {
    double count = ROUNDINGS;
    for (const rounding *more = more_roundings; more->name; more++)
        if (strcmp(more->name, noise->name) == 0)
            count += more->more;
    return count * 0x1p-24 * fmax(fabs(facts->lower), fabs(facts->upper));
}

static void check_field(const bl_noise *noise) {
    char text[256];
    snprintf(text, sizeof text, "%s%s%s", noise->name, *noise->textbook_settings ? ":" : "",
             noise->textbook_settings);
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    bl_random random = bl_random_seed(1, 0);
    double tolerance = rounding_of(noise, &signal->facts);
    for (size_t i = 0; i < bl_test_scaled(4000, 1000); i++) {
        const float x = exact_place(&random), y = exact_place(&random), z = exact_place(&random);
        const double at[BL_AXES] = {(double)x, (double)y, (double)z, 0};
        double expected = bl_signal_value(signal, at), value = (double)noise->textbook(x, y, z);
        if (!(fabs(value - expected) <= tolerance))
            fail_msg("%s at %g, %g, %g: the plain loop has %.9g, the noise %.9g", text, at[0],
                     at[1], at[2], value, expected);
    }
    bl_signal_free(signal);
}

static void test_plain_loops_compute_the_field_they_name(void **state) {
    (void)state;
    bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE));
    for (size_t n = 0; n < bl_noise_count(); n++) {
        const bl_noise *noise = bl_noise_at(n, BL_ISA_BEST);
        if (noise->textbook_settings)
            check_field(noise);
    }
}

// At a lattice point the cells beyond the 27 around are 1 away, so the loop must look there if it
// found nothing within 1. That is rare: 1 point of 300, and in 1 of 40 of those it matters.
static void test_the_plain_loop_of_cellular_looks_far_enough(void **state) {
    (void)state;
    const bl_noise *noise = bl_noise_find("cellular", BL_ISA_BEST);
    bl_signal *signal = bl_test_open("cellular:" BL_TEXTBOOK_VALUES, BL_ISA_BEST);
    int far = 0;
    bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE));
    for (int i = 0; i < 65536; i++) {
        const double at[BL_AXES] = {i % 256, i / 256, 0, 0};
        double value = (double)noise->textbook((float)at[0], (float)at[1], 0);
        if (!(value > 1))
            continue;
        far++;
        assert_near(value, bl_signal_value(signal, at), ROUNDINGS * 0x1p-24);
    }
    assert_true(far > 100);
    bl_signal_free(signal);
}

// --- loops with random numbers of their own -----------------------------------------------------

// A batch: fresh tables, and the means over random places of the value and of its products with the
// values at the lags. Tables or not, batches are independent.
enum { BATCH = 64, LAGS = 5, ESTIMATES = 1 + LAGS };
static const float lags[LAGS][3] = {
    {0, 0, 0}, {0.25f, 0, 0}, {0, 0.5f, 0}, {0, 0, 0.25f}, {0.25f, -0.375f, 0.125f}};

static void take_batch(const bl_noise *noise, bl_random *random, double mean[ESTIMATES]) {
    bl_textbook_draw(&bl_textbook_data, bl_random_bits(random));
    memset(mean, 0, ESTIMATES * sizeof *mean);
    for (int i = 0; i < BATCH; i++) {
        float x = (float)(600 * bl_random_unit(random) - 300);
        float y = (float)(600 * bl_random_unit(random) - 300);
        float z = (float)(600 * bl_random_unit(random) - 300);
        double value = (double)noise->textbook(x, y, z);
        mean[0] += value / BATCH;
        for (int l = 0; l < LAGS; l++)
            mean[1 + l] += value / BATCH *
                           (double)noise->textbook(x + lags[l][0], y + lags[l][1], z + lags[l][2]);
    }
}

// Error rate: all estimates of all loops together fail true loops with probability 1e-6, the means
// of some thousand batches being normal.
#define ERROR_RATE 1e-6

// What is not drawn anew for a batch is allowed for, as a share of the variance.
static const struct {
    const char *name;
    double share;
} allowances[] = {
    // Two cells share an impulse with the chance 3/256: R(lag) becomes R + (S - R) 3/256, S that of
    // a lattice with one set of impulses for all cells, about 0 because the kernel's integral is 0.
    {"scnoise", 3 / 256.0},
    // One table for all, in which 256 pairs of neighbours are all there are: the mean product of
    // their gradients, with the deviation sqrt(1/3) of one, is off by 3.6 %, and that times
    // R(lag + neighbour), less than a third of the variance, comes on top of R for each of the
    // nearest. At these lags it is 1.0 % at most.
    {"simplex", 0.02},
    // One field, of whose 600^2 cells the mean square has a deviation of 0.4 %.
    {"spot", 0.01},
    {"gabor", 0.01}};

// Noises without a closed form whose covariance is 0 all the same, at all lags but 0.
static const char *const uncorrelated[] = {"white"};

static int is_uncorrelated(const char *name) {
    for (size_t i = 0; i < sizeof uncorrelated / sizeof *uncorrelated; i++)
        if (strcmp(uncorrelated[i], name) == 0)
            return 1;
    return 0;
}

// What the noise states of an estimate: its mean, or the covariance at a lag; NAN for nothing.
static double stated(const bl_signal *signal, int estimate) {
    const float *lag = lags[estimate ? estimate - 1 : 0];
    const double far[BL_AXES] = {(double)lag[0], (double)lag[1],
                                 signal->dimensions > 2 ? (double)lag[2] : 0, 0};
    if (estimate == 0)
        return signal->facts.mean;
    if (bl_signal_has_closed_form(signal))
        return signal->functions->covariance(signal->parameters, far);
    if (estimate == 1)
        return signal->facts.variance;
    return is_uncorrelated(signal->name) ? 0 : NAN;
}

static double allowance_of(const char *name) {
    for (size_t i = 0; i < sizeof allowances / sizeof *allowances; i++)
        if (strcmp(allowances[i].name, name) == 0)
            return allowances[i].share;
    return 0;
}

static void check_statistics(const bl_noise *noise, uint64_t stream, double limit) {
    bl_signal *signal = bl_test_open(noise->name, BL_ISA_BEST);
    const bl_facts *facts = &signal->facts;
    bl_random random = bl_random_seed(2, stream);
    bl_moments moments[ESTIMATES] = {{.n = 0}};
    for (size_t batch = 0; batch < bl_test_scaled(2000, 500); batch++) {
        double mean[ESTIMATES];
        take_batch(noise, &random, mean);
        for (int e = 0; e < ESTIMATES; e++)
            bl_moments_add(&moments[e], mean[e]);
    }
    for (int e = 0; e < ESTIMATES; e++) {
        double expected = stated(signal, e);
        double error = limit * sqrt(bl_moments_variance(&moments[e]) / moments[e].n) +
                       (e ? allowance_of(noise->name) * facts->variance : 0);
        if (isnan(expected) && !(e && bl_signal_has_closed_form(signal)))
            continue; // not stated
        if (!(fabs(moments[e].mean - expected) <= error))
            fail_msg("%s: the plain loop has %g, the noise %g +- %g, estimate %d", noise->name,
                     moments[e].mean, expected, error, e);
    }
    bl_signal_free(signal);
}

static int has_numbers_of_its_own(const bl_noise *noise) {
    return noise->textbook && !noise->textbook_settings;
}

static void test_plain_loops_with_numbers_of_their_own_have_the_covariance(void **state) {
    (void)state;
    size_t count = 0;
    bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE));
    for (size_t n = 0; n < bl_noise_count(); n++)
        count += has_numbers_of_its_own(bl_noise_at(n, BL_ISA_BEST));
    double limit = -bl_normal_quantile(ERROR_RATE / (2.0 * ESTIMATES * (double)count));
    for (size_t n = 0; n < bl_noise_count(); n++) {
        const bl_noise *noise = bl_noise_at(n, BL_ISA_BEST);
        if (has_numbers_of_its_own(noise))
            check_statistics(noise, n, limit);
    }
    bl_textbook_draw(&bl_textbook_data, BL_TEXTBOOK_SEED);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain_loops_compute_the_field_they_name),
        cmocka_unit_test(test_the_plain_loop_of_cellular_looks_far_enough),
        cmocka_unit_test(test_plain_loops_with_numbers_of_their_own_have_the_covariance),
    };
    return bl_run_tests(tests);
}
