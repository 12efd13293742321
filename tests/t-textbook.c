// SPDX-License-Identifier: MIT
//
// The yardsticks of the benchmark are honest: every noise has a plain loop, which computes the
// noise and not something cheaper. Most loops compute the field itself with the settings that the
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
    // The inverse of the covariances has sizes that sum to 12.2 in a row, so weights along each
    // axis lose 12.2 times a rounding: 3 * 12.2 in a product, of roundings of expf and of sums.
    {"wiener", 3 * 12.2 * 4},
    // Angles in radians: up to 2.54 (300 + 96) = 1006 for the last wave, rounded three times.
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
    double tolerance = rounding_of(noise, &signal->facts), worst = 0;
    for (size_t i = 0; i < bl_test_scaled(4000, 1000); i++) {
        const float x = exact_place(&random), y = exact_place(&random), z = exact_place(&random);
        const double at[BL_AXES] = {(double)x, (double)y, (double)z, 0};
        double expected = bl_signal_value(signal, at), value = (double)noise->textbook(x, y, z);
        worst = fmax(worst, fabs(value - expected));
        if (!(fabs(value - expected) <= tolerance))
            fail_msg("%s at %g, %g, %g: the plain loop has %.9g, the noise %.9g", text, at[0],
                     at[1], at[2], value, expected);
    }
    if (getenv("SHOW")) printf("%-12s worst %g of %g: %.3f\n", noise->name, worst, tolerance, worst/tolerance);
    bl_signal_free(signal);
}

static void test_plain_loops_compute_the_field_they_name(void **state) {
    (void)state;
    bl_textbook_tables();
    for (size_t n = 0; n < bl_noise_count(); n++) {
        const bl_noise *noise = bl_noise_at(n, BL_ISA_BEST);
        if (noise->textbook_settings)
            check_field(noise);
    }
}

static void test_every_noise_has_a_plain_loop(void **state) {
    (void)state;
    for (size_t n = 0; n < bl_noise_count(); n++)
        if (!bl_noise_at(n, BL_ISA_BEST)->textbook)
            fail_msg("%s has no plain loop", bl_noise_at(n, BL_ISA_BEST)->name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_noise_has_a_plain_loop),
        cmocka_unit_test(test_plain_loops_compute_the_field_they_name),
    };
    return bl_run_tests(tests);
}
