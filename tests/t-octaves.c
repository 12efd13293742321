// SPDX-License-Identifier: MIT
//
// Sums of octaves: which octaves there are and what a width keeps of them, sums against plain loops
// over the basis in double, means and covariances, rotations, errors in the basis.
//
// Statistical tests fail for a right program with a probability of 1e-6 each; seeds are fixed.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "noises/octaves/octaves.h"
#include "tests/jumps.h"
#include "tests/texts.h"

#define LIMIT 4.9 // standard errors, two-sided 1e-6

enum { SAMPLES = 300, LONG = 5000, LINE = 4097 };

static bl_signal *open_signal(const char *text) {
    return bl_test_open(text, BL_ISA_BEST);
}

static const bl_octaves *octaves_of(const bl_signal *signal) {
    assert_true(bl_octaves_is_sum(signal));
    return ((const bl_octaves_settings *)signal->parameters)->octaves;
}

static void random_place(bl_random *random, double size, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        at[a] = size * (2 * bl_random_unit(random) - 1);
}

// Rows along each axis and obliquely, and points, of two texts: the same bits.
static void assert_same_bits(const char *one, const char *other) {
    bl_signal *a = open_signal(one), *b = open_signal(other);
    bl_random random = bl_random_seed(1, 0);
    for (int line = 0; line < 8; line++) {
        double start[BL_AXES], step[BL_AXES] = {0};
        float row[2][SAMPLES];
        random_place(&random, 50, start);
        for (int axis = 0; axis < 3; axis++)
            step[axis] = line % 4 == axis || line % 4 == 3 ? 0.07 : 0;
        bl_signal_row(a, start, step, SAMPLES, row[0]);
        bl_signal_row(b, start, step, SAMPLES, row[1]);
        if (memcmp(row[0], row[1], sizeof row[0]) != 0)
            fail_msg("rows of %s and %s differ", one, other);
        bl_signal_points(a, (const double *const[]){start, start, step, step}, 1, &row[0][0]);
        bl_signal_points(b, (const double *const[]){start, start, step, step}, 1, &row[1][0]);
        assert_memory_equal(&row[0][0], &row[1][0], sizeof(float));
    }
    bl_signal_free(a);
    bl_signal_free(b);
}

// --- the plan -----------------------------------------------------------------------------------

static void test_frequencies_double_below_the_maximum(void **state) {
    (void)state;
    bl_octaves_plan plan = bl_octaves_plan_between(3, 12.5);
    assert_int_equal(plan.count, 3);
    for (unsigned i = 0; i < 3; i++) {
        assert_near(plan.frequency[i], 3 << i, 0);
        assert_near(plan.amplitude[i] * plan.frequency[i], 1, 1e-15);
    }
    assert_int_equal(bl_octaves_plan_between(1, 16).count, 4); // 16 is not below 16
    assert_int_equal(bl_octaves_plan_between(4, 4).count, 0);
    assert_int_equal(bl_octaves_plan_between(5, 1).count, 0);
    plan = bl_octaves_plan_count(5, 2.17, 0.25);
    assert_int_equal(plan.count, 5);
    assert_near(plan.frequency[4], pow(2.17, 4), 1e-12);
    assert_near(plan.amplitude[4], pow(0.25, 4), 0);
    assert_int_equal(bl_octaves_plan_count(5, 2, 0).count, 1);
}

static void test_a_width_decides_which_octaves_are_evaluated(void **state) {
    (void)state;
    static const struct {
        double top, width;
        bl_octave_clamp clamp;
        unsigned evaluated;
    } cases[] = {
        {1, 0, BL_CLAMP_HARD, 4},        {1, 0, BL_CLAMP_FADE, 4},
        {1, 1e-30, BL_CLAMP_FADE, 4},    {1, 1.0 / 16, BL_CLAMP_HARD, 3}, // the limit is 8
        {1, 0.0624, BL_CLAMP_HARD, 4},   {1, 1.0 / 16, BL_CLAMP_FADE, 3},
        {1, 0.06, BL_CLAMP_FADE, 4},     {2, 1.0 / 16, BL_CLAMP_HARD, 2},
        {1, 0.5, BL_CLAMP_HARD, 0},      {1, 0.4999, BL_CLAMP_FADE, 1},
        {1, 1e30, BL_CLAMP_FADE, 0},     {1, INFINITY, BL_CLAMP_HARD, 0},
        {1, INFINITY, BL_CLAMP_FADE, 0}, {1, NAN, BL_CLAMP_HARD, 0},
        {1, NAN, BL_CLAMP_FADE, 0},      {1, INFINITY, BL_CLAMP_NONE, 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_octaves_plan plan = bl_octaves_plan_between(1, 16);
        bl_octaves_plan_clamp(&plan, cases[i].top, cases[i].clamp, cases[i].width);
        if (plan.evaluated != cases[i].evaluated)
            fail_msg("case %zu: %u octaves evaluated, expected %u", i, plan.evaluated,
                     cases[i].evaluated);
    }
}

// Monotone, and with the slope of the text's fade: |dk/dw| <= 4 t.
static void test_the_fade_is_continuous_and_monotone(void **state) {
    (void)state;
    double last = 1;
    for (double width = 0, step = 1e-5; width < 0.1; width += step) {
        double kept = bl_octave_kept(8, BL_CLAMP_FADE, width);
        assert_true(kept <= last && last - kept <= 4 * 8 * step + 1e-12);
        // The text: clamp(2 (cutoff - f)/cutoff, 0, 1), cutoff = 1/(2 width).
        double cutoff = 0.5 / width;
        assert_near(kept, fmin(1, fmax(0, width > 0 ? 2 * (cutoff - 8) / cutoff : 1)), 1e-12);
        last = kept;
    }
    assert_true(last == 0);
}

// --- clamped sums -------------------------------------------------------------------------------

static void test_a_clamped_sum_is_the_sum_of_fewer_octaves(void **state) {
    (void)state;
    assert_same_bits("fractalsum:clamp=hard,width=1/16", "fractalsum:max=8");
    assert_same_bits("fractalsum:clamp=fade,width=1/16", "fractalsum:max=8");
    assert_same_bits("fractalsum:clamp=hard,width=0.24", "fractalsum:max=4");
    assert_same_bits("turbulence:clamp=fade,width=1/8,lost=zero", "turbulence:max=4");
    assert_same_bits("fbm:clamp=hard,width=1/8", "fbm:octaves=2");
    // Half the limit and below: nothing is lost.
    assert_same_bits("fractalsum:clamp=fade,width=1/32", "fractalsum");
    assert_same_bits("fractalsum:width=1e-30", "fractalsum");
    assert_same_bits("turbulence:width=1e-30", "turbulence");
    assert_same_bits("ridged:width=1e-30", "ridged");
    assert_same_bits("ridged:width=1e30,clamp=none", "ridged");
    assert_same_bits("gardner:width=1e-30", "gardner");
    assert_same_bits("gardner:width=inf,clamp=none", "gardner");
    assert_same_bits("ridged:width=inf,clamp=none", "ridged");
}

static void test_a_width_of_its_own_is_that_of_the_sum(void **state) {
    (void)state;
    static const char *const names[] = {"fractalsum", "turbulence", "fbm:lacunarity=2.17",
                                        "ridged"};
    bl_random random = bl_random_seed(2, 0);
    for (size_t n = 0; n < 4; n++) {
        bl_signal *plain = open_signal(names[n]);
        for (double width = 0.01; width < 1; width *= 1.7) {
            char text[96];
            snprintf(text, sizeof text, "%s%cwidth=%.17g", names[n],
                     strchr(names[n], ':') ? ',' : ':', width);
            bl_signal *clamped = open_signal(text);
            for (int i = 0; i < 20; i++) {
                double at[BL_AXES];
                random_place(&random, 30, at);
                double value = bl_octaves_value_for_width(plain, at, width);
                assert_near(value, bl_signal_value(clamped, at), 0);
                // Continuous in the width: no octave's part changes faster than its fade.
                double near = bl_octaves_value_for_width(plain, at, width * (1 + 1e-9));
                assert_near(near, value, 1e-7);
            }
            bl_signal_free(clamped);
        }
        const double at[BL_AXES] = {0.3, 0.4, 0.5, 0}, bad[BL_AXES] = {0.3, NAN, 0.5, 0};
        assert_near(bl_octaves_value_for_width(plain, at, 0), bl_signal_value(plain, at), 0);
        assert_true(isnan(bl_octaves_value_for_width(plain, at, NAN)));
        assert_true(isnan(bl_octaves_value_for_width(plain, at, -1)));
        assert_true(isnan(bl_octaves_value_for_width(plain, bad, INFINITY)));
        // Filtered for a view: the widest of the axes that the sum has, or the width of its key.
        const double wide[BL_AXES] = {0.1, 0.3, 0.2, 9}, lost[BL_AXES] = {NAN, 0.3, 0.2, 0};
        const double none[BL_AXES] = {0};
        assert_near(bl_signal_filtered(plain, at, wide), bl_octaves_value_for_width(plain, at, 0.3),
                    0);
        assert_near(bl_signal_filtered(plain, at, none), bl_signal_value(plain, at), 0);
        assert_true(isnan(bl_signal_filtered(plain, at, lost)));
        bl_signal_free(plain);
    }
    bl_signal *clamped = open_signal("fractalsum:width=0.4");
    const double at[BL_AXES] = {0.3, 0.4, 0.5, 0}, narrow[BL_AXES] = {0.1, 0.1, 0.1, 0.1};
    assert_near(bl_signal_filtered(clamped, at, narrow), bl_signal_value(clamped, at), 0);
    bl_signal_free(clamped);
    bl_signal *other = open_signal("gnoise");
    assert_true(isnan(bl_octaves_value_for_width(other, (const double[BL_AXES]){0}, 1)));
    bl_signal_free(other);
}

static void test_a_huge_width_leaves_the_mean(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double least, most; // of E|gnoise| times 15/8, and so on: roughly
    } cases[] = {{"fractalsum:width=1e30", 0, 0},
                 {"fbm:width=1e30", 0, 0},
                 {"fbm:width=inf", 0, 0},
                 {"turbulence:width=inf,clamp=hard", 0.25, 0.31},
                 {"ridged:width=infinity", 1, 1.5},
                 {"fractalsum:width=1", 0, 0},
                 {"turbulence:width=1e30", 0.25, 0.31},
                 {"turbulence:width=1e30,lost=zero", 0, 0},
                 {"ridged:width=1e30", 1, 1.5},
                 {"fractalsum:min=4,max=4", 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i].text);
        const double start[BL_AXES] = {0.3, 7, -2e9, 0}, step[BL_AXES] = {0x1p57, 0, 0, 0};
        float row[64];
        bl_signal_row(signal, start, step, 64, row);
        for (int k = 0; k < 64; k++)
            if (k < 32)
                assert_near((double)row[k], bl_signal_value(signal, start), 0);
            else
                assert_true(isnan(row[k]));
        assert_true((double)row[0] >= cases[i].least && (double)row[0] <= cases[i].most);
        assert_near(octaves_of(signal)->plan.evaluated, 0, 0);
        bl_signal_free(signal);
    }
    // A limit that no octave passes is the same for a width of its own.
    bl_signal *turbulence = open_signal("turbulence"), *gone = open_signal("turbulence:width=1e30");
    const double at[BL_AXES] = {1.5, 2.5, 3.5, 0};
    assert_near(bl_octaves_value_for_width(turbulence, at, INFINITY), bl_signal_value(gone, at), 0);
    bl_signal_free(turbulence);
    bl_signal_free(gone);
    // A quarter of the squares of 0.3 0.707^i.
    bl_signal *gardner = open_signal("gardner:width=inf");
    double ratio = 0.707 * 0.707, mean = 0.09 / 4 * (1 - pow(ratio, 5)) / (1 - ratio);
    assert_near(bl_signal_value(gardner, at), mean, 0x1p-26);
    assert_near(gardner->facts.mean, mean, 0x1p-26);
    assert_string_equal(gardner->text, "gardner:width=inf");
    bl_signal_free(gardner);
}

// The mean over seeds and places, of the sum with and without a width, at the same places.
static void mean_difference(const char *one, const char *other, bl_moments *difference) {
    enum { BATCH = 256 };
    bl_signal *a = open_signal(one), *b = open_signal(other);
    bl_random random = bl_random_seed(3, 0);
    *difference = (bl_moments){.n = 0};
    for (size_t batch = 0; batch < bl_test_scaled(512, 256); batch++) {
        uint64_t seed = bl_random_bits(&random);
        bl_signal *fresh[2] = {bl_signal_reseed(a, seed), bl_signal_reseed(b, seed)};
        double at[BL_AXES][BATCH], mean = 0;
        float out[2][BATCH];
        for (int i = 0; i < BATCH; i++)
            for (int k = 0; k < BL_AXES; k++)
                at[k][i] = 1e6 * bl_random_unit(&random);
        for (int s = 0; s < 2; s++) {
            bl_signal_points(fresh[s], BL_COLUMNS(at), BATCH, out[s]);
            bl_signal_free(fresh[s]);
        }
        for (int i = 0; i < BATCH; i++)
            mean += ((double)out[1][i] - (double)out[0][i]) / BATCH;
        bl_moments_add(difference, mean);
    }
    bl_signal_free(a);
    bl_signal_free(b);
}

// The mean that was measured on opening has an error too: that of 32 x 4096 values of a deviation
// of at most `deviation` for all octaves together.
static void assert_mean_kept(const char *plain, const char *clamped, double deviation) {
    bl_moments difference;
    mean_difference(plain, clamped, &difference);
    double own = deviation / sqrt(32 * 4096);
    double error = sqrt(bl_moments_variance(&difference) / difference.n + own * own);
    if (!(fabs(difference.mean) < LIMIT * error))
        fail_msg("%s: the mean moves by %g +- %g", clamped, difference.mean, error);
}

static void test_turbulence_keeps_its_mean_at_every_width(void **state) {
    (void)state;
    // |gnoise| deviates by about 0.11, times 15/8.
    static const char *const widths[] = {"0.05", "0.1", "0.3", "1e30"};
    for (int w = 0; w < 4; w++) {
        char text[64];
        snprintf(text, sizeof text, "turbulence:width=%s", widths[w]);
        assert_mean_kept("turbulence", text, 0.21);
    }
    // The text's, which loses octaves to zero, does not: half of the sum is gone at 0.3.
    bl_moments difference;
    mean_difference("turbulence", "turbulence:width=0.3,lost=zero", &difference);
    assert_less(difference.mean, -0.1);
    // One octave, the last, of a ridged sum: its mean height has the weight of the one before.
    assert_mean_kept("ridged", "ridged:width=1/16", 0.3);
}

// --- against plain loops ------------------------------------------------------------------------

static double scaled_value(const bl_signal *basis, const double at[BL_AXES], double f) {
    return bl_signal_value(basis, (const double[BL_AXES]){at[0] * f, at[1] * f, at[2] * f, at[3]});
}

static double naive(int which, const bl_signal *basis, const double at[BL_AXES]) {
    double sum = 0, weight = 1, amplitude = 1, f = 1;
    for (int i = 0; i < 4; i++) {
        double noise = scaled_value(basis, at, f);
        double ridge = (1 - fabs(noise)) * (1 - fabs(noise)) * weight;
        weight = fmin(1, 2 * ridge);
        sum += which == 0   ? noise / f
               : which == 1 ? fabs(noise) / f
               : which == 2 ? ridge / f
                            : amplitude * noise;
        amplitude *= 0.7;
        f *= which == 3 ? 2.17 : 2;
    }
    return sum;
}

static void test_sums_are_those_of_plain_loops(void **state) {
    (void)state;
    static const char *const texts[] = {"fractalsum:seed=9", "turbulence:seed=9", "ridged:seed=9",
                                        "fbm:seed=9,lacunarity=2.17,gain=0.7,seeds=same"};
    bl_signal *basis = open_signal("gnoise:seed=9");
    bl_random random = bl_random_seed(4, 0);
    for (int t = 0; t < 4; t++) {
        bl_signal *sum = open_signal(texts[t]);
        for (int i = 0; i < 200; i++) {
            double at[BL_AXES];
            random_place(&random, i % 2 ? 10 : 1e6, at);
            assert_near(bl_signal_value(sum, at), naive(t, basis, at), 4e-15);
        }
        bl_signal_free(sum);
    }
    bl_signal_free(basis);
}

static void test_a_sum_of_one_octave_is_its_basis(void **state) {
    (void)state;
    static const char *const sums[] = {
        "fbm:octaves=1,seeds=same,seed=5,shift=random,rotate=random", "fractalsum:max=2,seed=5",
        "fractalsum:basis=fbm,basis.octaves=1,basis.seeds=same,max=2,seed=5"};
    bl_signal *basis = open_signal("gnoise:seed=5");
    for (int s = 0; s < 3; s++) {
        bl_signal *sum = open_signal(sums[s]);
        float a[SAMPLES], b[SAMPLES];
        const double start[BL_AXES] = {-3.3, 0.7, 2.2, 0}, step[BL_AXES] = {0.11, 0, 0, 0};
        bl_signal_row(sum, start, step, SAMPLES, a);
        bl_signal_row(basis, start, step, SAMPLES, b);
        for (int i = 0; i < SAMPLES; i++)
            assert_near((double)a[i], (double)b[i], 0);
        assert_near(sum->facts.variance, basis->facts.variance, 0);
        assert_near(sum->facts.leak_db, basis->facts.leak_db, 0);
        bl_signal_free(sum);
    }
    bl_signal_free(basis);
}

// Longer than what fits on the stack, through rows and through points of the basis.
static void test_a_long_row_is_its_samples(void **state) {
    (void)state;
    static const char *const texts[] = {"fractalsum:min=1/4", "fbm:lacunarity=2.17", "ridged",
                                        "turbulence:basis=scnoise,width=0.1",
                                        "fbm:shift=random,rotate=random"};
    static float row[LONG];
    for (int t = 0; t < 5; t++) {
        bl_signal *signal = open_signal(texts[t]);
        const double start[BL_AXES] = {0.1, -5.3, 8.7, 0}, step[BL_AXES] = {0.013, 0, 0.001, 0};
        bl_signal_row(signal, start, step, LONG, row);
        for (int i = 0; i < LONG; i += 331) {
            double at[BL_AXES];
            float alone;
            for (int a = 0; a < BL_AXES; a++)
                at[a] = start[a] + i * step[a];
            bl_signal_row(signal, at, step, 1, &alone);
            assert_memory_equal(&alone, &row[i], sizeof alone);
            assert_near((double)alone, bl_signal_value(signal, at), 1e-5);
        }
        bl_signal_free(signal);
    }
}

// The listing of the text, in radians and with its own names.
static void test_gardner_is_the_text_s_loop(void **state) {
    (void)state;
    bl_signal *signal = open_signal("gardner");
    bl_random random = bl_random_seed(5, 0);
    for (int n = 0; n < 300; n++) {
        double at[BL_AXES], f = 0, amplitude = 0.3, xphase = 0.9, yphase = 0.7;
        double xfreq = 2 * M_PI * 0.023, yfreq = 2 * M_PI * 0.021;
        random_place(&random, 1000, at);
        double x = at[0] + 13, y = at[1] + 96;
        for (int i = 0; i < 5; i++) {
            double fx = amplitude * (0.5 + cos(xfreq * (x + xphase)));
            double fy = amplitude * (0.5 + cos(yfreq * (y + yphase)));
            f += fx * fy;
            xphase = M_PI / 2 * 0.9 * cos(yfreq * y);
            yphase = M_PI / 2 * 1.1 * cos(xfreq * x);
            xfreq *= 1.9 + i * 0.1;
            yfreq *= 2.2 - i * 0.08;
            amplitude *= 0.707;
        }
        float out;
        const double *const columns[] = {&at[0], &at[1], &at[2], &at[3]};
        bl_signal_points(signal, columns, 1, &out);
        assert_near(bl_signal_value(signal, at), f, 1e-12);
        assert_near((double)out, f, 3e-8);
    }
    bl_signal_free(signal);
    // Its exact period along x, to rounding.
    signal = open_signal("gardner");
    double value = bl_signal_value(signal, (const double[BL_AXES]){1.25, 2.5});
    double later = bl_signal_value(signal, (const double[BL_AXES]){1.25 + 250000.0 / 23, 2.5});
    assert_near(later, value, 1e-11);
    bl_signal_free(signal);
}

// --- statistics ---------------------------------------------------------------------------------

// The mean of n(p) n(p + lag) over seeds and places against the covariance stated.
static void check_covariance(const char *text, const double lag[BL_AXES]) {
    enum { BATCH = 256 };
    bl_signal *signal = open_signal(text);
    bl_random random = bl_random_seed(6, 0);
    bl_moments products = {.n = 0};
    assert_true(bl_signal_has_closed_form(signal));
    for (size_t batch = 0; batch < bl_test_scaled(1024, 512); batch++) {
        bl_signal *fresh = bl_signal_reseed(signal, bl_random_bits(&random));
        double at[2][BL_AXES][BATCH], mean = 0;
        float out[2][BATCH];
        for (int i = 0; i < BATCH; i++)
            for (int a = 0; a < BL_AXES; a++) {
                at[0][a][i] = 1e6 * bl_random_unit(&random);
                at[1][a][i] = at[0][a][i] + lag[a];
            }
        for (int s = 0; s < 2; s++)
            bl_signal_points(fresh, (const double *const[]){at[s][0], at[s][1], at[s][2], at[s][3]},
                             BATCH, out[s]);
        for (int i = 0; i < BATCH; i++)
            mean += (double)out[0][i] * (double)out[1][i] / BATCH;
        bl_moments_add(&products, mean);
        bl_signal_free(fresh);
    }
    double expected = signal->functions->covariance(signal->parameters, lag);
    double error = sqrt(bl_moments_variance(&products) / products.n);
    if (!(fabs(products.mean - expected) < LIMIT * error))
        fail_msg("%s: covariance %g +- %g, stated %g", text, products.mean, error, expected);
    bl_signal_free(signal);
}

static void test_octaves_of_one_seed_are_uncorrelated_at_a_random_place(void **state) {
    (void)state;
    static const char *const texts[] = {"fractalsum", "fractalsum:basis=vnoise,width=0.1",
                                        "fbm:seeds=same,lacunarity=1.5,gain=0.9", "fbm:gain=0.9",
                                        "fbm:basis=fractalsum,octaves=2"};
    static const double lags[][BL_AXES] = {{0}, {0.2, 0, 0, 0}, {0.1, -0.05, 0.3, 0}};
    for (int t = 0; t < 5; t++)
        for (int l = 0; l < 3; l++)
            check_covariance(texts[t], lags[l]);
}

// Around the origin the octaves of one seed do meet: at 0 they have one value, and so the square of
// the sum is (sum of weights)^2, not the sum of their squares, times that of the basis.
static void test_octaves_of_one_seed_meet_at_the_origin(void **state) {
    (void)state;
    bl_signal *same = open_signal("fractalsum:basis=vnoise,seed=3"),
              *basis = open_signal("vnoise:seed=3");
    const double origin[BL_AXES] = {0};
    assert_near(bl_signal_value(same, origin), 1.875 * bl_signal_value(basis, origin), 1e-15);
    bl_signal_free(same);
    bl_signal_free(basis);
}

static void test_closed_forms_are_stated_only_where_they_hold(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int form, variance;
    } cases[] = {{"fractalsum", 1, 1},
                 {"fractalsum:basis=fractalsum", 0, 0}, // their octaves meet
                 {"fractalsum:basis=gnoise,basis.lattice=perm256", 0, 0},
                 {"fbm:basis=fractalsum", 1, 1},
                 {"fbm:rotate=random", 0, 1}, // the mean over rotations is not stated ...
                 {"fbm:rotate=random,basis=simplex", 1, 1}, // ... but where it changes nothing
                 {"fbm:rotate=random,basis=simplex,basis.lattice=perm256", 0, 0},
                 {"fbm:lacunarity=1", 1, 1},
                 {"fbm:lacunarity=1,seeds=same", 0, 0},
                 {"fbm:lacunarity=1.5,seeds=same", 1, 1},
                 {"fbm:lacunarity=1.49,seeds=same", 0, 0}, // too near to be sure of
                 {"turbulence", 0, 0},
                 {"ridged", 0, 0},
                 {"fractalsum:width=1e30", 0, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i].text);
        if (bl_signal_has_closed_form(signal) != cases[i].form ||
            isfinite(signal->facts.variance) != cases[i].variance)
            fail_msg("%s: closed form %d, variance %g", cases[i].text, signal->closed_form,
                     signal->facts.variance);
        bl_signal_free(signal);
    }
}

// --- facts of the sum from those of the basis ---------------------------------------------------

// Over a basis whose mean is 1/2 all the octaves count, those that are removed too; every second
// number is the mean of a row of independent cells, with a seed of its own.
static void test_the_mean_of_the_basis_is_kept(void **state) {
    (void)state;
    static const char *const texts[] = {
        "fractalsum:basis=rayshade", "fractalsum:basis=rayshade,width=0.1",
        "fractalsum:basis=rayshade,width=0.1,clamp=hard", "fractalsum:basis=rayshade,width=1e30"};
    enum { ROW = 256, SEEDS = 400 };
    for (size_t n = 0; n < sizeof texts / sizeof *texts; n++) {
        bl_signal *signal = open_signal(texts[n]);
        bl_random random = bl_random_seed(9, n);
        bl_moments means = {.n = 0};
        assert_near(signal->facts.mean, 0.5 * (1 + 0.5 + 0.25 + 0.125), 1e-7);
        for (int s = 0; s < SEEDS; s++) {
            float row[ROW];
            double start[BL_AXES], mean = 0;
            bl_signal *fresh = bl_signal_reseed(signal, bl_random_bits(&random));
            random_place(&random, 1e6, start);
            bl_signal_row(fresh, start, (const double[BL_AXES]){2.37}, ROW, row);
            for (int i = 0; i < ROW; i++)
                mean += (double)row[i] / ROW;
            bl_moments_add(&means, mean);
            bl_signal_free(fresh);
        }
        double error = sqrt(bl_moments_variance(&means) / means.n) + 1e-7;
        assert_near(means.mean, signal->facts.mean, LIMIT * error);
        bl_signal_free(signal);
    }
}

// The ranges of sums, from that of the basis by hand.
static void test_ranges_follow_from_the_basis(void **state) {
    (void)state;
    const double all = 1 + 0.5 + 0.25 + 0.125, origin[BL_AXES] = {0};
    bl_signal *gradients = open_signal("gnoise"), *sum = open_signal("fractalsum");
    assert_near(sum->facts.upper, all * gradients->facts.upper, 1e-15);
    assert_near(sum->facts.lower, -all * gradients->facts.upper, 1e-15);
    bl_signal_free(sum);
    sum = open_signal("turbulence");
    assert_near(sum->facts.lower, 0, 0);
    assert_near(sum->facts.upper, all * gradients->facts.upper, 1e-15);
    bl_signal_free(sum);
    // All octaves are 0 at the origin, where the ridges reach their bound.
    sum = open_signal("ridged");
    assert_near(bl_signal_value(sum, origin), sum->facts.upper, 1e-15);
    assert_near(sum->facts.lower, 0, 0);
    bl_signal_free(sum);
    // A basis that is larger than twice the offset is farther from it than 0 is.
    sum = open_signal("ridged:basis=hermite,offset=1/2");
    assert_near(sum->facts.upper, all * (1.75 - 0.5) * (1.75 - 0.5), 1e-15);
    bl_signal_free(sum);
    // A basis that is never near 0 has a least size: what its removed octave leaves.
    bl_signal *high = open_signal("turbulence:width=0.06");
    sum = open_signal("turbulence:basis=turbulence,basis.width=0.06");
    assert_true(high->facts.lower > 0.01);
    assert_near(sum->facts.lower, all * high->facts.lower, 1e-12);
    assert_near(sum->facts.upper, all * high->facts.upper, 1e-12);
    bl_signal_free(high), bl_signal_free(sum);
    bl_signal_free(gradients);
}

// A size has a kink where the noise crosses 0, if it does and if it is smooth there.
static void test_sizes_have_kinks_where_the_basis_crosses_zero(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int continuity;
    } cases[] = {{"turbulence", 0},
                 {"turbulence:basis=rayshade", 1},
                 {"turbulence:basis=rayshade,basis.weights=linear", 0},
                 {"turbulence:basis=white", -1},
                 {"ridged:basis=simplex", 0},
                 {"fractalsum:basis=simplex", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i].text);
        if (signal->facts.continuity != cases[i].continuity)
            fail_msg("%s: states class %d", cases[i].text, signal->facts.continuity);
        bl_signal_free(signal);
    }
}

// From the place on that is stated, doubles stand at least as far apart as the cells of the finest
// octave, and before it nearer.
static void test_the_finest_octave_loses_its_fraction_first(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double finest; // frequency
    } cases[] = {{"fractalsum", 8},
                 {"turbulence:max=64", 32},
                 {"fractalsum:min=1/4,max=1", 0.5},
                 {"fbm:lacunarity=3,octaves=2", 3},
                 {"ridged:lacunarity=2.5,octaves=3", 6.25},
                 {"fractalsum:width=1/8", 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i].text);
        double far = signal->facts.far;
        if (!(nextafter(far, INFINITY) - far >= 1 / cases[i].finest &&
              far - nextafter(far, 0) < 1 / cases[i].finest))
            fail_msg("%s: states 2^%g", cases[i].text, log2(far));
        bl_signal_free(signal);
    }
}

// Of a random rotation no period is left, but the first octave is not turned.
static void test_a_period_is_left_where_nothing_is_turned(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double period;
    } cases[] = {{"fbm:basis=gnoise,basis.period=12", 12},
                 {"fbm:basis=gnoise,basis.period=12,lacunarity=1.5", 96}, // 1.5^3 12 = 40.5
                 {"fbm:basis=gnoise,basis.period=12,rotate=random", 0},
                 {"fbm:basis=gnoise,basis.period=12,rotate=random,octaves=1", 12}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i].text);
        assert_near(signal->facts.period[1], cases[i].period, 0);
        bl_signal_free(signal);
    }
}

// --- continuity ---------------------------------------------------------------------------------

// A line of two of the finest cells along x; later ones are finer. Gardner's waves are long.
static void sample_line(const bl_signal *signal, int attempt, double unit, bl_random *random,
                        size_t count, double *value) {
    double at[BL_AXES], step = unit * (attempt % 3 == 2 ? 0x1p-15 : 0x1p-12), start;
    random_place(random, 20, at);
    start = step * floor(at[0] / step);
    for (size_t i = 0; i < count; i++) {
        at[0] = start + (double)i * step;
        value[i] = bl_signal_value(signal, at);
    }
}

static void check_class(const char *text, double unit, bl_random *random) {
    static double line[LINE];
    bl_signal *signal = open_signal(text);
    int stated = signal->facts.continuity, found = stated < 0 || stated + 1 >= BL_JUMP_ORDERS;
    for (int attempt = 0; attempt < 24 && stated >= 0 && (attempt == 0 || !found); attempt++) {
        sample_line(signal, attempt, unit, random, LINE, line);
        for (int order = 0; order <= stated && order < BL_JUMP_ORDERS; order++)
            if (bl_jumps(line, LINE, (unsigned)order))
                fail_msg("%s: states class %d, and derivative %d jumps", text, stated, order);
        found = found || bl_jumps(line, LINE, (unsigned)stated + 1);
    }
    if (!found)
        fail_msg("%s: states class %d, and derivative %d does not jump", text, stated, stated + 1);
    bl_signal_free(signal);
}

// With two octaves, whose finer one has the frequency 2; ridges of a gain so small that no weight
// reaches 1, or so large that all do, have the kinks of the basis alone.
static void test_sums_of_any_basis_have_the_class_stated(void **state) {
    (void)state;
    static const char *const sums[] = {"fractalsum:max=4,basis=%s", "turbulence:max=4,basis=%s",
                                       "fbm:octaves=2,basis=%s", "ridged:octaves=2,basis=%s"};
    static const char *const more[] = {
        "ridged:octaves=2,basis=rayshade,gain=0.9", "ridged:octaves=2,basis=rayshade,gain=0",
        "ridged:octaves=2,basis=rayshade,gain=4,offset=1.6",
        "ridged:octaves=2,basis=rayshade,gain=4,offset=1.2", "ridged:octaves=1,basis=rayshade"};
    static const int classes[] = {1, 1, 1, 0, 1};
    bl_random random = bl_random_seed(7, 0);
    for (size_t n = 0; n < bl_noise_count(); n++)
        for (int s = 0; s < 4; s++) {
            const char *name = bl_noise_at(n, BL_ISA_BEST)->name;
            char text[160];
            snprintf(text, sizeof text, sums[s], name);
            check_class(text, strcmp(name, "gardner") == 0 ? 32 : 1, &random);
        }
    for (size_t m = 0; m < sizeof more / sizeof *more; m++) {
        bl_signal *signal = open_signal(more[m]);
        assert_int_equal(signal->facts.continuity, classes[m]);
        bl_signal_free(signal);
        check_class(more[m], 1, &random);
    }
}

// --- rotations, seeds, errors -------------------------------------------------------------------

static void check_rotation(const bl_octave *octave, bl_moments *square) {
    const double(*r)[BL_AXES] = octave->rotation;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += r[i][k] * r[j][k];
            assert_near(sum, i == j, 1e-15);
        }
    double determinant = 0;
    for (int k = 0; k < 3; k++)
        determinant += r[0][k] * (r[1][(k + 1) % 3] * r[2][(k + 2) % 3] -
                                  r[1][(k + 2) % 3] * r[2][(k + 1) % 3]);
    assert_near(determinant, 1, 2e-15);
    bl_moments_add(&square[0], r[0][0] * r[0][0]);
    bl_moments_add(&square[1], r[0][0] + r[1][1] + r[2][2]);
}

// Uniform on the rotations: an entry squared has the mean 1/3, the trace 0.
static void test_rotations_are_orthonormal_and_uniform(void **state) {
    (void)state;
    bl_signal *signal = open_signal("fbm:rotate=random,octaves=4");
    bl_moments moments[2] = {{.n = 0}, {.n = 0}};
    for (uint64_t seed = 0; seed < 1000; seed++) {
        bl_signal *fresh = bl_signal_reseed(signal, seed);
        const bl_octaves *octaves = octaves_of(fresh);
        assert_false(octaves->octave[0].rotated);
        for (int i = 1; i < 4; i++)
            check_rotation(&octaves->octave[i], moments);
        assert_memory_not_equal(octaves->octave[1].rotation, octaves->octave[2].rotation,
                                sizeof octaves->octave[1].rotation);
        bl_signal_free(fresh);
    }
    assert_near(moments[0].mean, 1.0 / 3,
                LIMIT * sqrt(bl_moments_variance(&moments[0]) / moments[0].n));
    assert_near(moments[1].mean, 0, LIMIT * sqrt(bl_moments_variance(&moments[1]) / moments[1].n));
    bl_signal_free(signal);
}

// Uniform within 2^10 cells each way, in multiples of 2^-32: mean 0 and variance 2^20/3, whose
// squares have the variance 2^40 4/45. Both ends are met within a hundredth, but with a probability
// of 2 (1 - 1/200)^4500 = 3e-10.
static void test_offsets_are_uniform(void **state) {
    (void)state;
    bl_moments value = {.n = 0}, square = {.n = 0};
    double low = 0, high = 0;
    for (int seed = 0; seed < 500; seed++) {
        char text[64];
        snprintf(text, sizeof text, "fbm:shift=random,seed=%d", seed);
        bl_signal *signal = open_signal(text);
        const bl_octaves *octaves = octaves_of(signal);
        assert_false(octaves->octave[0].shifted);
        for (unsigned o = 1; o < octaves->plan.count; o++)
            for (unsigned a = 0; a < octaves->dimensions; a++) {
                double offset = octaves->octave[o].offset[a] * 0x1p-10;
                assert_near(offset * 0x1p42, floor(offset * 0x1p42), 0);
                bl_moments_add(&value, offset);
                bl_moments_add(&square, offset * offset);
                low = fmin(low, offset);
                high = fmax(high, offset);
            }
        bl_signal_free(signal);
    }
    assert_near(value.n, 4500, 0);
    assert_near(value.mean, 0, LIMIT * sqrt(1.0 / 3 / value.n));
    assert_near(square.mean, 1.0 / 3, LIMIT * sqrt(4.0 / 45 / square.n));
    assert_true(low >= -1 && high < 1);
    assert_near(low, -1, 0.01);
    assert_near(high, 1, 0.01);
}

// A sum that is seen at low frequencies only ends at 2^62 all the same.
static void test_the_domain_of_slow_octaves_ends_where_it_is_stated_to(void **state) {
    (void)state;
    bl_signal *signal = open_signal("fractalsum:min=1/4,max=1/2");
    for (int axis = 0; axis < 3; axis++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double in[BL_AXES] = {0.5, 0.5, 0.5, 0}, out[BL_AXES] = {0.5, 0.5, 0.5, 0};
            const double step[BL_AXES] = {0};
            float row[2], points[2];
            in[axis] = sign * 0x1p61;
            out[axis] = sign * 0x1p62;
            bl_signal_row(signal, in, step, 1, &row[0]);
            bl_signal_row(signal, out, step, 1, &row[1]);
            bl_signal_points(signal, (const double *const[]){&in[0], &in[1], &in[2], &in[3]}, 1,
                             &points[0]);
            bl_signal_points(signal, (const double *const[]){&out[0], &out[1], &out[2], &out[3]}, 1,
                             &points[1]);
            assert_true(isfinite(row[0]) && isfinite(points[0]));
            assert_true(isnan(row[1]) && isnan(points[1]));
            assert_true(isfinite(bl_signal_value(signal, in)));
            assert_true(isnan(bl_signal_value(signal, out)));
        }
    bl_signal_free(signal);
}

static void test_reseeding_is_opening_with_that_seed(void **state) {
    (void)state;
    static const char *const texts[] = {"fractalsum:basis=vnoise,basis.interp=linear",
                                        "turbulence:width=0.1",
                                        "turbulence:width=1e30",
                                        "fbm:shift=random,rotate=random,lacunarity=1.9",
                                        "ridged:basis=fbm,basis.octaves=2,octaves=2,width=0.3",
                                        "gardner:terms=3"};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        char text[160];
        snprintf(text, sizeof text, "%s,seed=77", texts[t]);
        bl_signal *zero = open_signal(texts[t]), *opened = open_signal(text);
        bl_signal *reseeded = bl_signal_reseed(zero, 77);
        float a[SAMPLES], b[SAMPLES];
        const double start[BL_AXES] = {0.3, 0.4, 0.5, 0}, step[BL_AXES] = {0.21, 0, 0, 0};
        bl_signal_free(zero); // nothing of it is shared
        bl_signal_row(opened, start, step, SAMPLES, a);
        bl_signal_row(reseeded, start, step, SAMPLES, b);
        assert_memory_equal(a, b, sizeof a);
        bl_signal_free(opened);
        bl_signal_free(reseeded);
    }
}

static void test_errors_name_the_basis(void **state) {
    (void)state;
    static const struct {
        const char *text, *words[3];
    } cases[] = {
        {"fractalsum:basis=gnoice", {"in the basis 'gnoice'", "did you mean 'gnoise'"}},
        {"fbm:basis.fad=cubic", {"'basis.fad' at column 5 of 'fbm:basis.fad=cubic'", "'fade'"}},
        {"ridged:basis=vnoise,basis.interp=cubic",
         {"'basis.interp=cubic' at column 34 of 'ridged:", "linear"}},
        {"fbm:basis=fbm,octaves=2,basis.basis.fdae=cubic",
         {"'basis.basis.fdae' at column 25 of 'fbm:basis=fbm"}},
        {"fbm:basis=./my.so:mine", {"list noises"}},
        {"turbulence:basis.seed=3", {"in the basis 'gnoise:seed=3'", "give seed="}},
        {"fbm:basis=fbm,basis.basis.seed=3", {"in the basis 'fbm:basis.seed=3'", "in the basis"}},
        {"fbm:basis.basis.basis.basis.basis=fbm", {"in the basis", "more than four"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = NULL;
        bl_message message = {""};
        assert_int_equal(bl_noise_open(cases[i].text, BL_ISA_BEST, &signal, &message), BL_USAGE);
        assert_null(signal);
        for (int w = 0; w < 3 && cases[i].words[w]; w++)
            if (!strstr(message.text, cases[i].words[w]))
                fail_msg("%s: '%s' has no '%s'", cases[i].text, message.text, cases[i].words[w]);
    }
    bl_signal *deep = open_signal(
        "fbm:octaves=1,basis=fbm,basis.octaves=1,basis.basis=fbm,"
        "basis.basis.octaves=1,basis.basis.basis=fbm,"
        "basis.basis.basis.octaves=1,basis.basis.basis.basis=vnoise");
    bl_signal_free(deep);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frequencies_double_below_the_maximum),
        cmocka_unit_test(test_a_width_decides_which_octaves_are_evaluated),
        cmocka_unit_test(test_the_fade_is_continuous_and_monotone),
        cmocka_unit_test(test_a_clamped_sum_is_the_sum_of_fewer_octaves),
        cmocka_unit_test(test_a_width_of_its_own_is_that_of_the_sum),
        cmocka_unit_test(test_a_huge_width_leaves_the_mean),
        cmocka_unit_test(test_turbulence_keeps_its_mean_at_every_width),
        cmocka_unit_test(test_sums_are_those_of_plain_loops),
        cmocka_unit_test(test_a_sum_of_one_octave_is_its_basis),
        cmocka_unit_test(test_a_long_row_is_its_samples),
        cmocka_unit_test(test_gardner_is_the_text_s_loop),
        cmocka_unit_test(test_octaves_of_one_seed_are_uncorrelated_at_a_random_place),
        cmocka_unit_test(test_octaves_of_one_seed_meet_at_the_origin),
        cmocka_unit_test(test_closed_forms_are_stated_only_where_they_hold),
        cmocka_unit_test(test_the_mean_of_the_basis_is_kept),
        cmocka_unit_test(test_ranges_follow_from_the_basis),
        cmocka_unit_test(test_sizes_have_kinks_where_the_basis_crosses_zero),
        cmocka_unit_test(test_the_finest_octave_loses_its_fraction_first),
        cmocka_unit_test(test_a_period_is_left_where_nothing_is_turned),
        cmocka_unit_test(test_sums_of_any_basis_have_the_class_stated),
        cmocka_unit_test(test_rotations_are_orthonormal_and_uniform),
        cmocka_unit_test(test_offsets_are_uniform),
        cmocka_unit_test(test_the_domain_of_slow_octaves_ends_where_it_is_stated_to),
        cmocka_unit_test(test_reseeding_is_opening_with_that_seed),
        cmocka_unit_test(test_errors_name_the_basis),
    };
    return bl_run_tests(tests);
}
