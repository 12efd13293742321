// SPDX-License-Identifier: MIT
//
// Walks the registry of noises: every entry is complete, every setting of every key opens, the
// same bits come out of every instruction set, batch and thread, and what a descriptor states
// is kept.
#include "tests/test.h"

#include "core/random.h"
#include "tests/float_error.h"
#include "tests/texts.h"

enum { COUNT = 301 };

static void test_every_descriptor_is_complete(void **state) {
    (void)state;
    assert_true(bl_noise_count() >= 6);
    for (size_t i = 0; i < bl_noise_count(); i++) {
        const bl_noise *noise = bl_noise_at(i, BL_ISA_BASELINE);
        assert_true(noise->name && noise->title && noise->summary && noise->formula);
        assert_non_null(noise->paper);
        assert_true(noise->dimensions >= 1 && noise->dimensions <= 4);
        assert_true(noise->describe && noise->functions.value);
        // A closed form is optional, and so is its other side, where the covariance has no end.
        assert_true(noise->functions.covariance || !noise->functions.density);
        assert_ptr_equal(bl_noise_find(noise->name, BL_ISA_BASELINE), noise);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(noise->name, bl_noise_at(j, BL_ISA_BASELINE)->name);
        for (const bl_parameter *p = noise->parameters; p->key; p++)
            assert_true(p->fallback && p->help && p->unit);
    }
    assert_null(bl_noise_at(bl_noise_count(), BL_ISA_BASELINE));
    assert_null(bl_noise_find("no such noise", BL_ISA_BASELINE));
}

static void test_every_setting_states_its_facts(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        const bl_facts *facts = &signal->facts;
        // A mean may be unknown; a signal of variance 0 says that it is a constant.
        if (!(facts->lower <= facts->upper && (facts->lower < facts->upper || !facts->variance) &&
              facts->bound_proof && !isinf(facts->mean) && facts->continuity >= -1 &&
              facts->period[0] >= 0 && facts->far > 0x1p31))
            fail_msg("%s: incomplete facts", list->text[i]);
        if (signal->closed_form && !(facts->variance >= 0 && facts->covariance_reach > 0 &&
                                     (facts->band_to > 0 || isinf(facts->covariance_reach))))
            fail_msg("%s: a closed form without variance, reach or band", list->text[i]);
        if (bl_signal_has_density(signal) && !signal->functions->density)
            fail_msg("%s: its covariance ends, and it states no density", list->text[i]);
        bl_signal_free(signal);
    }
}

// A place near the origin, far from it, and on cell boundaries, in turn.
static void choose_line(bl_random *random, size_t index, double start[BL_AXES],
                        double step[BL_AXES]) {
    static const double scales[] = {4, 1e6, 1e9, 1e15};
    static const double steps[] = {0.05, 0.5, 1, 7.3, 1e-9, -0.25, 0, 1e6};
    for (int a = 0; a < BL_AXES; a++) {
        start[a] = scales[index % 4] * (2 * bl_random_unit(random) - 1);
        if (index % 5 == 0)
            start[a] = floor(start[a]);
        step[a] = (index % 4 == 3 || index % 4 == (size_t)a) ? steps[index / 4 % 8] : 0;
    }
}

static void fill_by(const bl_signal *signal, const double start[], const double step[],
                    int as_points, float *out) {
    static double at[BL_AXES][COUNT];
    if (!as_points) {
        bl_signal_row(signal, start, step, COUNT, out);
        return;
    }
    const double *const columns[BL_AXES] = {at[0], at[1], at[2], at[3]};
    for (int a = 0; a < BL_AXES; a++)
        for (size_t i = 0; i < COUNT; i++)
            at[a][i] = start[a] + (double)i * step[a];
    bl_signal_points(signal, columns, COUNT, out);
}

static void test_every_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    bl_random random = bl_random_seed(1, 0);
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *reference = bl_test_open(list->text[i], BL_ISA_BASELINE);
        for (int isa = BL_ISA_V3; isa < BL_ISA_COUNT; isa++) {
            if (!bl_isa_runs_here((bl_isa)isa))
                continue;
            bl_signal *other = bl_test_open(list->text[i], (bl_isa)isa);
            for (size_t line = 0; line < 32; line++) {
                float a[COUNT], b[COUNT];
                double start[BL_AXES], step[BL_AXES];
                choose_line(&random, line, start, step);
                fill_by(reference, start, step, line & 1, a);
                fill_by(other, start, step, line & 1, b);
                if (memcmp(a, b, sizeof a) != 0)
                    fail_msg("%s: %s differs from baseline", list->text[i],
                             bl_isa_name((bl_isa)isa));
            }
            bl_signal_free(other);
        }
        bl_signal_free(reference);
    }
}

static void test_floats_agree_with_the_double_reference(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    bl_random random = bl_random_seed(2, 0);
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        double tolerance = bl_test_float_error(signal), largest = 0;
        size_t lines = bl_test_scaled(64, 16); // by rows, then by points
        for (size_t line = 0; line < lines; line++) {
            float out[COUNT];
            double start[BL_AXES], step[BL_AXES];
            choose_line(&random, line, start, step);
            fill_by(signal, start, step, line >= lines / 2, out);
            for (size_t k = 0; k < COUNT; k += 3) {
                double at[BL_AXES];
                for (int a = 0; a < BL_AXES; a++)
                    at[a] = start[a] + (double)k * step[a];
                double expected = bl_signal_value(signal, at);
                largest = fmax(largest, fabs(out[k] - expected));
                if (!(fabs(out[k] - expected) <= tolerance))
                    fail_msg("%s at (%.17g, %.17g, %.17g): %.9g, reference %.9g", list->text[i],
                             at[0], at[1], at[2], (double)out[k], expected);
            }
        }
        if (getenv("BL_TEST_VERBOSE"))
            printf("%s: %.3g of the error allowed\n", list->text[i], largest / tolerance);
        bl_signal_free(signal);
    }
}

static void test_the_bound_is_kept(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    size_t count = bl_test_scaled(1 << 14, 1 << 12);
    double *columns[BL_AXES];
    float *out = malloc(count * sizeof *out);
    bl_random random = bl_random_seed(3, 0);
    for (int a = 0; a < BL_AXES; a++) {
        columns[a] = malloc(count * sizeof(double));
        for (size_t k = 0; k < count; k++)
            columns[a][k] = 1e5 * (bl_random_unit(&random) - 0.5);
    }
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        bl_signal_points(signal, (const double *const *)columns, count, out);
        for (size_t k = 0; k < count; k++)
            if (!(out[k] >= signal->facts.lower && out[k] <= signal->facts.upper))
                fail_msg("%s: %g is outside [%g, %g]", list->text[i], (double)out[k],
                         signal->facts.lower, signal->facts.upper);
        bl_signal_free(signal);
    }
    for (int a = 0; a < BL_AXES; a++)
        free(columns[a]);
    free(out);
}

static void test_bad_coordinates_give_nan(void **state) {
    (void)state;
    static const double bad[] = {NAN, INFINITY, -INFINITY, 0x1p62, -1e300};
    const bl_texts *list = bl_test_texts();
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        for (size_t b = 0; b < sizeof bad / sizeof *bad; b++)
            for (unsigned axis = 0; axis < signal->dimensions; axis++) {
                double start[BL_AXES] = {0.3, 0.4, 0.6, 0.7}, step[BL_AXES] = {0},
                       gradient[BL_AXES];
                float row[40], points[40];
                start[axis] = bad[b];
                step[(axis + 1) % 3] = 0.125;
                bl_signal_row(signal, start, step, 40, row);
                double at[BL_AXES][40];
                for (int a = 0; a < BL_AXES; a++)
                    for (int k = 0; k < 40; k++)
                        at[a][k] = start[a];
                bl_signal_points(signal, BL_COLUMNS(at), 40, points);
                for (int k = 0; k < 40; k++)
                    if (!isnan(row[k]) || !isnan(points[k]))
                        fail_msg("%s: coordinate %g gave a value", list->text[i], bad[b]);
                assert_true(isnan(bl_signal_value(signal, start)));
                if (!signal->functions->gradient)
                    continue;
                signal->functions->gradient(signal->parameters, start, gradient);
                assert_true(isnan(gradient[0]));
            }
        bl_signal_free(signal);
    }
}

// The domain ends at 2^62, or before it for a noise that scales its coordinates up, which then also
// loses its fraction the earlier.
static void test_a_row_that_leaves_the_domain_ends_in_nan(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        float out[64];
        double start[BL_AXES] = {0.5, 0.5, 0.5, 0}, step[BL_AXES] = {0x1p58, 0, 0, 0};
        bl_signal_row(signal, start, step, 64, out);
        double sure = bl_signal_domain(signal);
        for (int k = 0; k < 64; k++) {
            int beyond = k >= 16 || (k > 0 && isnan(out[k - 1]));
            if (beyond || 0.5 + k * 0x1p58 < sure)
                assert_int_equal(isnan(out[k]) != 0, beyond);
        }
        bl_signal_free(signal);
    }
}

// The order and the size of a batch, and the thread, change nothing.
static void test_batches_and_threads_change_nothing(void **state) {
    (void)state;
    enum { LINE = 1000 };
    const bl_texts *list = bl_test_texts();
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        static float whole[LINE], parts[LINE];
        // Multiples of 2^-6, so that a start in the middle has exactly the same coordinates.
        const double start[BL_AXES] = {-3.25, 100.5, 7.015625, 0},
                     step[BL_AXES] = {0.046875, 0, 0, 0};
        bl_signal_row(signal, start, step, LINE, whole);
        for (int threads = 1; threads <= 4; threads++) {
            memset(parts, 0, sizeof parts);
#pragma omp parallel for num_threads(threads) schedule(dynamic)
            for (int from = 0; from < LINE; from += 37) {
                double at[BL_AXES] = {start[0] + from * step[0], start[1], start[2], start[3]};
                size_t count = from + 37 <= LINE ? 37 : (size_t)(LINE - from);
                bl_signal_row(signal, at, step, count, parts + from);
            }
            if (memcmp(parts, whole, sizeof whole) != 0)
                fail_msg("%s: a row in batches differs from the whole", list->text[i]);
        }
        bl_signal_free(signal);
    }
}

static void test_a_point_in_another_batch_has_the_same_bits(void **state) {
    (void)state;
    enum { MANY = 500 };
    const bl_texts *list = bl_test_texts();
    bl_random random = bl_random_seed(4, 0);
    static double at[BL_AXES][MANY];
    for (int a = 0; a < BL_AXES; a++)
        for (int k = 0; k < MANY; k++)
            at[a][k] = 50 * (bl_random_unit(&random) - 0.5);
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        float all[MANY], one;
        bl_signal_points(signal, BL_COLUMNS(at), MANY, all);
        for (int k = 0; k < MANY; k += 7) {
            bl_signal_points(signal,
                             (const double *const[]){at[0] + k, at[1] + k, at[2] + k, at[3] + k}, 1,
                             &one);
            assert_memory_equal(&one, &all[k], sizeof one);
        }
        bl_signal_free(signal);
    }
}

// Of fourth order: the error is h^4/30 times a fifth derivative.
static double central_difference(const bl_signal *signal, const double at[BL_AXES], unsigned axis,
                                 double h) {
    double value[5], place[BL_AXES];
    memcpy(place, at, sizeof place);
    for (int i = 0; i < 5; i++) {
        place[axis] = at[axis] + (i - 2) * h;
        value[i] = bl_signal_value(signal, place);
    }
    return (8 * (value[3] - value[1]) - (value[4] - value[0])) / (12 * h);
}

static void test_the_gradient_is_the_derivative(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    bl_random random = bl_random_seed(5, 0);
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        int trials = signal->functions->gradient && signal->facts.continuity >= 0 ? 40 : 0;
        int disagree = 0; // a kink within h of the place is allowed 3 times in 120
        for (int trial = 0; trial < trials; trial++) {
            double at[BL_AXES], gradient[BL_AXES] = {0};
            double cell = signal->facts.cell > 0 ? signal->facts.cell : 1;
            // Away from cell boundaries, where a C0 noise has no derivative.
            for (int a = 0; a < BL_AXES; a++)
                at[a] = cell * (floor(20 * bl_random_unit(&random) / cell) + 0.02 +
                                0.96 * bl_random_unit(&random));
            signal->functions->gradient(signal->parameters, at, gradient);
            for (unsigned a = 0; a < signal->dimensions; a++) {
                // Octaves of high frequency have large derivatives: a finer difference then agrees.
                double limit = 1e-6 * fmax(1, fabs(gradient[a]));
                double slope = central_difference(signal, at, a, 1e-5);
                for (double h = 1e-6; h > 5e-10 && !(fabs(slope - gradient[a]) < limit); h /= 10)
                    slope = central_difference(signal, at, a, h);
                disagree += !(fabs(slope - gradient[a]) < limit);
                if (disagree > (signal->facts.continuity == 0 ? 3 : 0))
                    fail_msg("%s: d/d%c = %.12g, differences %.12g", list->text[i], "xyzw"[a],
                             gradient[a], slope);
            }
        }
        bl_signal_free(signal);
    }
}

static void test_a_reseeded_signal_is_another_and_the_same_as_opened(void **state) {
    (void)state;
    const double start[BL_AXES] = {0.3, 0.4, 0.5, 0}, step[BL_AXES] = {0.21, 0, 0, 0};
    for (size_t i = 0; i < bl_noise_count(); i++) {
        char text[64];
        const char *name = bl_noise_at(i, BL_ISA_BEST)->name;
        snprintf(text, sizeof text, "%s:seed=77", name);
        bl_signal *zero = bl_test_open(name, BL_ISA_BEST),
                  *opened = bl_test_open(text, BL_ISA_BEST);
        bl_signal *reseeded = bl_signal_reseed(zero, 77);
        float a[64], b[64], c[64];
        bl_signal_row(zero, start, step, 64, a);
        bl_signal_row(opened, start, step, 64, b);
        bl_signal_row(reseeded, start, step, 64, c);
        assert_memory_equal(b, c, sizeof b);
        assert_memory_not_equal(a, b, sizeof a);
        bl_signal_free(zero);
        bl_signal_free(opened);
        bl_signal_free(reseeded);
    }
}

static void test_an_unknown_noise_is_named_with_the_nearest(void **state) {
    (void)state;
    bl_signal *signal = NULL;
    bl_message message = {""};
    assert_int_equal(bl_noise_open("gnoice:seed=1", BL_ISA_BEST, &signal, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "'gnoice'"));
    assert_non_null(strstr(message.text, "'gnoise'"));
    assert_null(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_descriptor_is_complete),
        cmocka_unit_test(test_every_setting_states_its_facts),
        cmocka_unit_test(test_every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(test_floats_agree_with_the_double_reference),
        cmocka_unit_test(test_the_bound_is_kept),
        cmocka_unit_test(test_bad_coordinates_give_nan),
        cmocka_unit_test(test_a_row_that_leaves_the_domain_ends_in_nan),
        cmocka_unit_test(test_batches_and_threads_change_nothing),
        cmocka_unit_test(test_a_point_in_another_batch_has_the_same_bits),
        cmocka_unit_test(test_the_gradient_is_the_derivative),
        cmocka_unit_test(test_a_reseeded_signal_is_another_and_the_same_as_opened),
        cmocka_unit_test(test_an_unknown_noise_is_named_with_the_nearest),
    };
    return bl_run_tests(tests);
}
