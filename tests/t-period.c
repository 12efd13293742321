// SPDX-License-Identifier: MIT
//
// Lattices that repeat: a period moves no bit, is the smallest one, changes nothing within it, and
// has no seam. (t-facts and t-registry walk the examples of the key; here are the hard numbers: 1
// and 2, primes, 2^32 - 1, both lattices, far places, four dimensions.)
#include "tests/test.h"

#include "core/random.h"
#include "tests/texts.h"

enum { PROBES = 48, ROW = 40 };

static const char *const noises[] = {"vnoise",
                                     "vnoise:interp=bspline2",
                                     "vnoise:interp=linear",
                                     "gnoise",
                                     "gnoise:gradients=edges",
                                     "vgnoise",
                                     "hermite",
                                     "vcnoise",
                                     "scnoise",
                                     "vnoise:dims=1",
                                     "vnoise:dims=2",
                                     "vnoise:dims=4",
                                     "gnoise:dims=1",
                                     "gnoise:dims=2,gradients=rejection",
                                     "gnoise:dims=4"};
enum { NOISES = sizeof noises / sizeof *noises };

static const uint32_t periods[] = {1, 2, 3, 7, 64, 256, 1021, 65537, 4294967295u};
enum { PERIODS = sizeof periods / sizeof *periods };

static bl_signal *open_with(const char *noise, const char *lattice, const char *period) {
    char text[128];
    snprintf(text, sizeof text, "%s%clattice=%s,period=%s", noise, strchr(noise, ':') ? ',' : ':',
             lattice, period);
    return bl_test_open(text, BL_ISA_BEST);
}

typedef struct probe {
    double value[PROBES];
    float points[PROBES], row[5][ROW]; // along each axis, and oblique
} probe;

// The same places, multiples of 2^-8 near `base`, shifted along an axis.
static void take_probe(const bl_signal *signal, double base, unsigned axis, double shift,
                       probe *result) {
    double column[BL_AXES][PROBES], at[BL_AXES];
    bl_random random = bl_random_seed(7, 0);
    for (unsigned i = 0; i < PROBES; i++) {
        for (unsigned a = 0; a < BL_AXES; a++)
            at[a] = column[a][i] = base + (double)(int64_t)(bl_random_bits(&random) % 4096) / 256 -
                                   8 + (a == axis ? shift : 0);
        result->value[i] = bl_signal_value(signal, at);
    }
    for (unsigned along = 0; along < 5; along++) {
        double step[BL_AXES] = {0};
        for (unsigned a = 0; a < BL_AXES; a++)
            step[a] = along == 4 ? 0.125 * (a + 1) : a == along ? 0.4375 : 0;
        bl_signal_row(signal, at, step, ROW, result->row[along]);
    }
    bl_signal_points(signal, BL_COLUMNS(column), PROBES, result->points);
}

static void test_a_period_moves_no_bit(void **state) {
    (void)state;
    static const char *const lattices[] = {"hash", "perm256"};
    static const double bases[] = {0, -300, 1e9};
    static probe here, there;
    for (int n = 0; n < NOISES; n++)
        for (int p = 0; p < PERIODS; p++)
            for (int l = 0; l < 2; l++) {
                char period[16];
                snprintf(period, sizeof period, "%u", periods[p]);
                bl_signal *signal = open_with(noises[n], lattices[l], period);
                for (int b = 0; b < 3; b++)
                    for (unsigned axis = 0; axis < signal->dimensions; axis++) {
                        take_probe(signal, bases[b], axis, 0, &here);
                        for (int times = -1; times <= 2; times += times ? 1 : 2) {
                            double shift = times * (double)periods[p];
                            take_probe(signal, bases[b], axis, shift, &there);
                            if (memcmp(&here, &there, sizeof here) != 0)
                                fail_msg("%s: not the same %g along %c near %g", signal->text,
                                         shift, "xyzw"[axis], bases[b]);
                        }
                    }
                bl_signal_free(signal);
            }
}

// Far from its origin too a multiple of the period is no shift at all.
static void test_a_far_period_moves_no_bit(void **state) {
    (void)state;
    static probe here, there;
    for (int n = 0; n < NOISES; n++) {
        bl_signal *signal = open_with(noises[n], "hash", "40,24,56,8");
        for (unsigned axis = 0; axis < signal->dimensions; axis++) {
            double shift = floor(1e9 / signal->facts.period[axis]) * signal->facts.period[axis];
            take_probe(signal, 0, axis, 0, &here);
            for (int sign = -1; sign <= 1; sign += 2) {
                take_probe(signal, 0, axis, sign * shift, &there);
                assert_memory_equal(&here, &there, sizeof here);
            }
        }
        bl_signal_free(signal);
    }
}

// Every other whole shift is another noise: of the values, hardly one is the same.
static void test_no_smaller_shift_repeats(void **state) {
    (void)state;
    static probe here, there;
    for (int n = 0; n < NOISES; n++) {
        bl_signal *signal = open_with(noises[n], "hash", "12,7,12,7");
        for (unsigned axis = 0; axis < signal->dimensions; axis++) {
            take_probe(signal, 0, axis, 0, &here);
            for (double shift = 1; shift < signal->facts.period[axis]; shift++) {
                take_probe(signal, 0, axis, shift, &there);
                int same = 0;
                for (int i = 0; i < PROBES; i++)
                    same += here.value[i] == there.value[i];
                // On lattice planes across gradient noises may be 0 at both.
                if (same > PROBES / 8)
                    fail_msg("%s: repeats after %g along %c", signal->text, shift, "xyzw"[axis]);
            }
        }
        bl_signal_free(signal);
    }
}

// Where no cell in reach is beyond the seam, a period changes no bit of values and points.
static void test_the_inside_is_that_of_the_noise_without_a_period(void **state) {
    (void)state;
    static const char *const lattices[] = {"hash", "perm256"};
    for (int n = 0; n < NOISES; n++)
        for (int l = 0; l < 2; l++) {
            bl_signal *plain = open_with(noises[n], lattices[l], "0");
            bl_signal *repeated = open_with(noises[n], lattices[l], "40,37,41,211");
            bl_random random = bl_random_seed(8, (uint64_t)n);
            double column[BL_AXES][PROBES];
            float points[2][PROBES];
            for (int i = 0; i < PROBES; i++) {
                double at[BL_AXES];
                for (int a = 0; a < BL_AXES; a++)
                    at[a] = column[a][i] = 3 + 31 * bl_random_unit(&random);
                assert_true(bl_signal_value(plain, at) == bl_signal_value(repeated, at));
            }
            for (int k = 0; k < 2; k++)
                bl_signal_points(k ? repeated : plain, BL_COLUMNS(column), PROBES, points[k]);
            assert_memory_equal(points[0], points[1], sizeof points[0]);
            bl_signal_free(plain);
            bl_signal_free(repeated);
        }
}

// Floats are those of the reference, for every period, near and far; as in t-registry, 32 * 2^-24.
static void test_floats_agree_with_the_double_reference(void **state) {
    (void)state;
    static const char *const lattices[] = {"hash", "perm256"};
    static const double scales[] = {5, 1e5, 1e9, 1e13};
    bl_random random = bl_random_seed(9, 0);
    for (int n = 0; n < NOISES; n++)
        for (int p = 0; p < PERIODS; p++) {
            char period[16];
            snprintf(period, sizeof period, "%u", periods[p]);
            bl_signal *signal = open_with(noises[n], lattices[p & 1], period);
            double tolerance = 32 * 0x1p-24 * fmax(1, signal->facts.upper);
            for (int line = 0; line < 20; line++) {
                double start[BL_AXES], step[BL_AXES], at[BL_AXES];
                float row[ROW];
                for (int a = 0; a < BL_AXES; a++) {
                    start[a] = scales[line & 3] * (2 * bl_random_unit(&random) - 1);
                    step[a] = line % 5 == 4 || line % 5 == a ? 0.3 : 0;
                }
                bl_signal_row(signal, start, step, ROW, row);
                for (int i = 0; i < ROW; i += 3) {
                    for (int a = 0; a < BL_AXES; a++)
                        at[a] = start[a] + i * step[a];
                    double value = bl_signal_value(signal, at);
                    if (!(fabs((double)row[i] - value) <= tolerance))
                        fail_msg("%s at (%.17g, %.17g, %.17g, %.17g): %.9g, reference %.9g",
                                 signal->text, at[0], at[1], at[2], at[3], (double)row[i], value);
                }
            }
            bl_signal_free(signal);
        }
}

// Below the seam the noise comes as near to its value on the seam as below any other plane: the
// slopes of these noises are below 32.
static void test_there_is_no_seam(void **state) {
    (void)state;
    bl_random random = bl_random_seed(10, 0);
    for (int n = 0; n < NOISES; n++) {
        bl_signal *signal = open_with(noises[n], "hash", "5");
        for (int trial = 0; trial < 60; trial++) {
            double on[BL_AXES], below[BL_AXES];
            unsigned axis = (unsigned)trial % signal->dimensions;
            for (int a = 0; a < BL_AXES; a++)
                on[a] = below[a] = 10 * bl_random_unit(&random) - 5;
            on[axis] = below[axis] = trial % 3 * 5.0 - 5;
            below[axis] -= 0x1p-20;
            assert_near(bl_signal_value(signal, below), bl_signal_value(signal, on), 32 * 0x1p-20);
        }
        bl_signal_free(signal);
    }
}

// A permutation of 256 repeats after 256: a period that is a multiple of it adds nothing, and
// another one is the period of the cells, of which 256 are then not one.
static void test_a_permutation_has_the_smaller_period(void **state) {
    (void)state;
    static const struct {
        const char *period;
        double stated;
    } cases[] = {{"0", 256}, {"256", 256}, {"512", 256}, {"128", 128}, {"384", 384}, {"7", 7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_with("gnoise", "perm256", cases[i].period);
        static probe here, there;
        assert_near(signal->facts.period[0], cases[i].stated, 0);
        take_probe(signal, 0, 0, 0, &here);
        take_probe(signal, 0, 0, cases[i].stated, &there);
        assert_memory_equal(&here, &there, sizeof here);
        bl_signal_free(signal);
    }
}

// Cells that share a number correlate: the closed forms are of a lattice where none do.
static void test_a_periodic_noise_claims_no_closed_form(void **state) {
    (void)state;
    for (int n = 0; n < NOISES; n++) {
        bl_signal *signal = open_with(noises[n], "hash", "0,0,0,9");
        assert_false(bl_signal_has_closed_form(signal));
        assert_true(isnan(signal->facts.covariance_reach));
        assert_false(signal->facts.stationary);
        assert_true(signal->facts.period[3] == 9);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_period_moves_no_bit),
        cmocka_unit_test(test_a_far_period_moves_no_bit),
        cmocka_unit_test(test_no_smaller_shift_repeats),
        cmocka_unit_test(test_the_inside_is_that_of_the_noise_without_a_period),
        cmocka_unit_test(test_floats_agree_with_the_double_reference),
        cmocka_unit_test(test_there_is_no_seam),
        cmocka_unit_test(test_a_permutation_has_the_smaller_period),
        cmocka_unit_test(test_a_periodic_noise_claims_no_closed_form),
    };
    return bl_run_tests(tests);
}
