// SPDX-License-Identifier: MIT
//
// The convolution noises, vcnoise and scnoise: their kernel, their impulses, and their float rows
// and points against the double reference, which is itself held against brute force.
//
// Error rate: a statistic below passes for truly random impulses with probability above 1 - 1e-9
// for all its comparisons together.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "noises/impulses/convolution_row.h"
#include "noises/noise.h"
#include "noises/lattice/radial_kernel.h"
#include "noises/impulses/sparse_impulses.h"
#include "noises/textbook.h"
#include "tests/texts.h"

static const char *const names[] = {"vcnoise",
                                    "scnoise",
                                    "scnoise:impulses=1",
                                    "scnoise:impulses=64,seed=18446744073709551615",
                                    "vcnoise:lattice=perm256",
                                    "scnoise:lattice=perm256",
                                    "scnoise:count=poisson",
                                    "scnoise:count=poisson,impulses=1,kernel=gaussian",
                                    "scnoise:count=poisson,impulses=9,kernel=cosine",
                                    "scnoise:count=poisson,lattice=perm256",
                                    "scnoise:kernel=cosine"};
enum { NAMES = sizeof names / sizeof *names };

static bl_signal *open(const char *text) {
    return bl_test_open(text, BL_ISA_BEST);
}

// --- the kernel ---------------------------------------------------------------------------------

static void test_the_kernel_and_its_slope_are_continuous(void **state) {
    (void)state;
    for (double knot = 1; knot <= 2; knot++) {
        double h = 1e-7;
        assert_near(radial_kernel(knot - h), radial_kernel(knot + h), 3e-7);
        assert_near(radial_kernel_slope(knot - h), radial_kernel_slope(knot + h), 2e-6);
        assert_near(radial_kernel(knot), 0, 1e-15);
    }
    assert_near(radial_kernel(0), 1, 0);
    for (double r = 0.01; r < 2.2; r += 0.0137) {
        double h = 1e-6, slope = (radial_kernel(r + h) - radial_kernel(r - h)) / (2 * h);
        assert_near(radial_kernel_slope(r) * r, slope, 1e-5);
    }
}

static void test_the_float_kernel_is_the_kernel(void **state) {
    (void)state;
    for (float r = 0; r < 3; r += 0x1p-12f) {
        assert_near((double)radial_twice(r), 2 * radial_kernel((double)r), 6e-7);
        if (r >= 1)
            assert_true(radial_twice(r) == radial_twice_outer(r));
    }
}

static void test_the_far_polynomial_is_the_kernel(void **state) {
    (void)state;
    for (double w = -1; w <= 2; w += 0x1p-12) {
        double expected = w > 0 ? 2 * radial_kernel(sqrt(4 - w)) : 0;
        assert_near((double)radial_far((float)w, RADIAL_FAR_SCALE), expected, 4.5e-7);
    }
    assert_true(radial_far(0, 1) == 0 && radial_far(-3, 1) == 0);
}

// The text fills a table of K(sqrt(i/100)), i = 0..400, and rounds d*100 to the nearest i.
static void test_the_table_kernel_is_the_table_of_the_text(void **state) {
    (void)state;
    const bl_textbook *tables = bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE));
    bl_random random = bl_random_seed(1, 0);
    for (int i = 0; i < 100000; i++) {
        double d = 4.5 * bl_random_unit(&random);
        int entry = (int)floor(d * 100 + 0.5);
        double expected = d >= 4 || entry > 400 ? 0 : (double)tables->kernel[entry];
        assert_near(radial_kernel_table(d, 100), expected, 1e-7);
    }
    assert_near(radial_kernel_table(0, 1), 1, 0);
    assert_near(radial_kernel_table(4, 1000000), 0, 0);
}

static void test_a_fine_table_is_the_exact_kernel(void **state) {
    (void)state;
    for (int n = 0; n < 2; n++) {
        bl_signal *exact = open(n ? "scnoise" : "vcnoise");
        bl_signal *table =
            open(n ? "scnoise:kernel=table:1000000" : "vcnoise:kernel=table:1000000");
        bl_signal *coarse = open(n ? "scnoise:kernel=table:100" : "vcnoise:kernel=table:100");
        bl_random random = bl_random_seed(2, 0);
        double coarse_error = 0;
        for (int i = 0; i < 200; i++) {
            double at[BL_AXES] = {20 * bl_random_unit(&random), -20 * bl_random_unit(&random),
                                  20 * bl_random_unit(&random), 0};
            double value = bl_signal_value(exact, at);
            assert_near(bl_signal_value(table, at), value, 2e-5);
            coarse_error = fmax(coarse_error, fabs(bl_signal_value(coarse, at) - value));
        }
        assert_true(coarse_error > 1e-3 && coarse_error < 0.1);
        bl_signal_free(exact);
        bl_signal_free(table);
        bl_signal_free(coarse);
    }
}

// --- the impulses -------------------------------------------------------------------------------

enum { CELLS_ACROSS = 24, BINS = 16 };

typedef struct impulse_moments {
    double count, mean[4], square[4], between[4]; // x, y, z, amplitude; products of two impulses
    double bins[4][BINS];
} impulse_moments;

static void add_cell(const bl_lattice *lattice, const impulse_factors *factors,
                     const uint64_t cell[3], uint32_t impulses, impulse_moments *sums) {
    double last[4] = {0};
    for (uint32_t n = 0; n < impulses; n++) {
        impulse one = impulse_of(factors, cell_words_at(lattice, cell), n);
        double centred[4] = {2 * one.place[0] - 1, 2 * one.place[1] - 1, 2 * one.place[2] - 1,
                             one.amplitude};
        for (int f = 0; f < 4; f++) {
            assert_true(fabs(centred[f]) <= 1);
            sums->mean[f] += centred[f];
            sums->square[f] += centred[f] * centred[f];
            sums->between[f] += centred[f] * last[f];
            int bin = (int)((centred[f] + 1) / 2 * BINS);
            sums->bins[f][bin < BINS ? bin : BINS - 1]++;
            last[f] = centred[f];
        }
        sums->count++;
    }
}

static void test_impulses_are_uniform_and_independent(void **state) {
    (void)state;
    enum { IMPULSES = 5 };
    double limit = -bl_normal_quantile(1e-9 / (3 * 4 * (3 + BINS)) / 2);
    for (uint64_t seed = 0; seed < 3; seed++) {
        bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_HASH);
        impulse_factors factors;
        impulse_factors_open(&factors, IMPULSES);
        impulse_moments sums = {.count = 0};
        for (uint64_t i = 0; i < CELLS_ACROSS * CELLS_ACROSS * CELLS_ACROSS; i++) {
            uint64_t cell[3] = {i % CELLS_ACROSS - 12, i / CELLS_ACROSS % CELLS_ACROSS,
                                i / CELLS_ACROSS / CELLS_ACROSS};
            add_cell(&lattice, &factors, cell, IMPULSES, &sums);
        }
        double n = sums.count, pairs = n * (IMPULSES - 1) / IMPULSES;
        for (int f = 0; f < 4; f++) {
            assert_less(fabs(sums.mean[f]) / sqrt(n / 3), limit);
            assert_less(fabs(sums.square[f] - n / 3) / sqrt(n * (1.0 / 5 - 1.0 / 9)), limit);
            assert_less(fabs(sums.between[f]) / sqrt(pairs / 9), limit);
            for (int b = 0; b < BINS; b++)
                assert_less(fabs(sums.bins[f][b] - n / BINS) / sqrt(n / BINS), limit);
        }
    }
}

// --- the reference ------------------------------------------------------------------------------

// All cells up to 3 away, one more than reach: tells that two are enough.
static double brute_scnoise(uint64_t seed, uint32_t impulses, const double at[3]) {
    bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_HASH);
    impulse_factors factors;
    impulse_factors_open(&factors, impulses);
    double sum = 0;
    for (int i = -3; i <= 3; i++)
        for (int j = -3; j <= 3; j++)
            for (int k = -3; k <= 3; k++) {
                double corner[3] = {floor(at[0]) + i, floor(at[1]) + j, floor(at[2]) + k};
                uint64_t cell[3];
                for (int a = 0; a < 3; a++)
                    cell[a] = (uint64_t)(int64_t)corner[a];
                cell_words words = cell_words_at(&lattice, cell);
                for (uint32_t n = 0; n < impulses; n++) {
                    impulse one = impulse_of(&factors, words, n);
                    double dx = at[0] - corner[0] - one.place[0],
                           dy = at[1] - corner[1] - one.place[1],
                           dz = at[2] - corner[2] - one.place[2];
                    sum += one.amplitude * radial_kernel(sqrt(dx * dx + dy * dy + dz * dz));
                }
            }
    return sum / impulses;
}

static double brute_vcnoise(uint64_t seed, const double at[3]) {
    bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_HASH);
    double sum = 0;
    for (int i = -3; i <= 3; i++)
        for (int j = -3; j <= 3; j++)
            for (int k = -3; k <= 3; k++) {
                double point[3] = {floor(at[0]) + i, floor(at[1]) + j, floor(at[2]) + k};
                uint64_t cell[3];
                double square = 0;
                for (int a = 0; a < 3; a++) {
                    cell[a] = (uint64_t)(int64_t)point[a];
                    square += (at[a] - point[a]) * (at[a] - point[a]);
                }
                sum += (double)bl_lattice_value(bl_lattice_word(&lattice, cell, 0)) *
                       BL_LATTICE_UNIT * radial_kernel(sqrt(square));
            }
    return sum;
}

static void test_the_reference_sums_all_cells_in_reach(void **state) {
    (void)state;
    bl_signal *sparse = open("scnoise:seed=9,impulses=4"), *lattice = open("vcnoise:seed=9");
    bl_random random = bl_random_seed(3, 0);
    for (size_t i = 0; i < bl_test_scaled(100, 10); i++) {
        double at[BL_AXES] = {0};
        for (int a = 0; a < 3; a++)
            at[a] = i % 8 >> a & 1 ? floor(40 * bl_random_unit(&random)) - 20
                                   : 40 * bl_random_unit(&random) - 20;
        assert_near(bl_signal_value(sparse, at), brute_scnoise(9, 4, at), 1e-13);
        assert_near(bl_signal_value(lattice, at), brute_vcnoise(9, at), 1e-13);
    }
    bl_signal_free(sparse);
    bl_signal_free(lattice);
}

static void test_the_gradient_is_the_slope_of_the_value(void **state) {
    (void)state;
    for (int n = 0; n < NAMES; n++) {
        bl_signal *signal = open(names[n]);
        bl_random random = bl_random_seed(4, 0);
        for (int i = 0; i < 20; i++) {
            double at[BL_AXES] = {0}, slope[BL_AXES], h = 1e-5;
            for (int a = 0; a < 3; a++)
                at[a] = 40 * bl_random_unit(&random) - 20;
            signal->functions->gradient(signal->parameters, at, slope);
            for (int a = 0; a < 3; a++) {
                double before[BL_AXES] = {at[0], at[1], at[2]},
                       after[BL_AXES] = {at[0], at[1], at[2]};
                before[a] -= h;
                after[a] += h;
                double expected = bl_signal_value(signal, after) - bl_signal_value(signal, before);
                assert_near(slope[a], expected / (2 * h), 2e-4); // the slope is not smooth
            }
        }
        bl_signal_free(signal);
    }
}

static void test_the_text_tables_have_period_256(void **state) {
    (void)state;
    for (int n = 4; n < 6; n++) {
        bl_signal *signal = open(names[n]);
        double at[BL_AXES] = {3.25, -7.5, 11.125, 0},
               moved[BL_AXES] = {259.25, -263.5, 1035.125, 0};
        assert_near(bl_signal_value(signal, at), bl_signal_value(signal, moved), 0);
        assert_true(signal->facts.period[0] == 256);
        bl_signal_free(signal);
    }
}

// --- floats -------------------------------------------------------------------------------------

// The largest error of a row against the reference.
static double row_error(const bl_signal *signal, const double start[BL_AXES],
                        const double step[BL_AXES], size_t count) {
    float *out = malloc(count * sizeof *out);
    double worst = 0;
    bl_signal_row(signal, start, step, count, out);
    size_t stride = count / 60 + 1;
    for (size_t i = 0; i < count;
         i += i + stride < count || i + 1 == count ? stride : count - 1 - i) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        worst = fmax(worst, fabs((double)out[i] - bl_signal_value(signal, at)));
    }
    free(out);
    return worst;
}

static const double bases[] = {0, -3, 1e6, -1e6, 1e9, -1e9};
enum { BASES = sizeof bases / sizeof *bases };

static void test_rows_along_an_axis_equal_the_reference(void **state) {
    (void)state;
    const double steps[] = {1.0 / 20, 1.0 / 2, 1.0 / 5, 1.0 / 6, 1.0 / 333, 1, 1.3, 7, 1e-7, 1e-12};
    const size_t counts[] = {1, 2, 15, 17, 200, 5000};
    bl_random random = bl_random_seed(5, 0);
    for (int n = 0; n < NAMES; n++) {
        bl_signal *signal = open(names[n]);
        for (size_t s = 0; s < 10; s++)
            for (size_t c = 0; c < 6; c++) {
                int axis = (int)(bl_random_bits(&random) % 3);
                double start[BL_AXES] = {0}, step[BL_AXES] = {0};
                for (int a = 0; a < 3; a++)
                    start[a] = bases[(s + c) % BASES] + 9 * bl_random_unit(&random);
                step[axis] = c % 2 ? -steps[s] : steps[s];
                assert_less(row_error(signal, start, step, counts[c]), 1e-6);
            }
        bl_signal_free(signal);
    }
}

// Steps that are multiples of 2^-9, so that a start in the middle has exactly the same coordinates;
// pieces of all sizes from 1 up, in both directions, of splats and of gathers.
static void test_a_row_in_pieces_has_the_bits_of_the_whole(void **state) {
    (void)state;
    enum { COUNT = 5000 };
    static float whole[COUNT], piece[COUNT];
    const double steps[] = {0.05078125, 0.5, 0x1p-9, -0.19921875, -1.25, 0.5};
    for (int n = 0; n < NAMES; n++) {
        bl_signal *signal = open(names[n]);
        for (int s = 0; s < 6; s++) {
            double start[BL_AXES] = {bases[s] + 0.25, -7.7, 1e6 + 0.3, 0}, step[BL_AXES] = {0};
            if (s == 5) // on its way it leaves the limit of rows, and goes on by points
                start[0] = AXIS_ROW_LIMIT - 100;
            size_t total = n == 3 ? 400 : COUNT; // 64 impulses take their time
            step[0] = steps[s];
            bl_signal_row(signal, start, step, total, whole);
            for (size_t from = 0, size = 1; from < total; from += size, size = size * 3 / 2 + 1) {
                double at[BL_AXES] = {start[0] + (double)from * step[0], start[1], start[2], 0};
                size_t count = from + size <= total ? size : total - from;
                bl_signal_row(signal, at, step, count, piece);
                assert_memory_equal(piece, whole + from, count * sizeof *piece);
            }
        }
        bl_signal_free(signal);
    }
}

static void test_other_rows_equal_the_reference(void **state) {
    (void)state;
    const double steps[][BL_AXES] = {{0.05, 0.03, 0}, {0.1, -0.2, 0.3}, {0, 0, 0},
                                     {0, 1e-300, 0},  {1e5, 0, 0},      {0.4, 0.4, 0.4, 0.4}};
    for (int n = 0; n < NAMES; n++) {
        bl_signal *signal = open(names[n]);
        for (int s = 0; s < 6; s++) {
            double start[BL_AXES] = {bases[s] + 0.3, bases[s] - 0.6, bases[s] + 0.1, 5};
            assert_less(row_error(signal, start, steps[s], 300), 1e-6);
        }
        float untouched = 7;
        bl_signal_row(signal, steps[0], steps[1], 0, &untouched);
        assert_true(untouched == 7);
        bl_signal_free(signal);
    }
}

static void test_points_equal_the_reference(void **state) {
    (void)state;
    enum { COUNT = 1500 };
    static double x[COUNT], y[COUNT], z[COUNT];
    static float out[COUNT], one_by_one;
    const double *at[BL_AXES] = {x, y, z, z};
    bl_random random = bl_random_seed(6, 0);
    for (int n = 0; n < NAMES; n++) {
        bl_signal *signal = open(names[n]);
        for (int i = 0; i < COUNT; i++) {
            x[i] = bases[i % BASES] + 1000 * bl_random_unit(&random) - 500;
            y[i] = bases[i % BASES] + (i % 5 ? 1000 * bl_random_unit(&random) - 500 : 0.5);
            z[i] = i % 7 ? 1000 * bl_random_unit(&random) - 500 : floor(x[i]);
        }
        bl_signal_points(signal, at, COUNT, out);
        for (int i = 0; i < COUNT; i += 11) {
            double place[BL_AXES] = {x[i], y[i], z[i], 0};
            assert_near((double)out[i], bl_signal_value(signal, place), 1e-6);
            const double *alone[BL_AXES] = {x + i, y + i, z + i, z + i};
            bl_signal_points(signal, alone, 1, &one_by_one);
            assert_true(out[i] == one_by_one); // whatever the company
        }
        bl_signal_free(signal);
    }
}

static void test_bad_coordinates_give_nan_and_leave_the_others_alone(void **state) {
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY, 0x1p62, -1e300};
    for (int n = 0; n < NAMES; n++) {
        bl_signal *signal = open(names[n]);
        for (int b = 0; b < 5; b++)
            for (int axis = 0; axis < 3; axis++) {
                double x[3] = {0.2, 0.2, 0.2}, y[3] = {0.4, 0.4, 0.4}, z[3] = {0.7, 0.7, 0.7};
                double *moved[] = {x, y, z};
                moved[axis][1] = bad[b];
                const double *at[BL_AXES] = {x, y, z, z};
                float out[3];
                bl_signal_points(signal, at, 3, out);
                assert_true(isnan(out[1]) && out[0] == out[2] && !isnan(out[0]));
                double place[BL_AXES] = {x[1], y[1], z[1], 0};
                assert_true(isnan(bl_signal_value(signal, place)));
                bl_signal_row(signal, place, (double[BL_AXES]){0.1, 0, 0, 0}, 3, out);
                assert_true(isnan(out[0]) && isnan(out[2]));
            }
        // A row that leaves the valid range on its way.
        float out[8];
        bl_signal_row(signal, (double[BL_AXES]){0.5}, (double[BL_AXES]){0x1p60}, 8, out);
        assert_true(!isnan(out[0]) && !isnan(out[3]) && isnan(out[4]) && isnan(out[7]));
        bl_signal_free(signal);
    }
}

static void test_all_instruction_sets_give_the_same_bits(void **state) {
    (void)state;
    enum { COUNT = 700 };
    static float expected[COUNT], actual[COUNT];
    const double steps[] = {0.05, 0.5, -0.013, 1.1, 2};
    for (int n = 0; n < NAMES; n++)
        for (int s = 0; s < 5; s++)
            for (int i = 0; i < BL_ISA_COUNT; i++) {
                if (!bl_isa_runs_here((bl_isa)i))
                    continue;
                bl_signal *signal = bl_test_open(names[n], (bl_isa)i);
                double start[BL_AXES] = {1e6 + 0.3, -7.7, 0.25, 0}, step[BL_AXES] = {0};
                step[s % 3] = steps[s];
                bl_signal_row(signal, start, step, COUNT, i ? actual : expected);
                if (i)
                    assert_memory_equal(actual, expected, sizeof actual);
                bl_signal_free(signal);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_kernel_and_its_slope_are_continuous),
        cmocka_unit_test(test_the_float_kernel_is_the_kernel),
        cmocka_unit_test(test_the_far_polynomial_is_the_kernel),
        cmocka_unit_test(test_the_table_kernel_is_the_table_of_the_text),
        cmocka_unit_test(test_a_fine_table_is_the_exact_kernel),
        cmocka_unit_test(test_impulses_are_uniform_and_independent),
        cmocka_unit_test(test_the_reference_sums_all_cells_in_reach),
        cmocka_unit_test(test_the_gradient_is_the_slope_of_the_value),
        cmocka_unit_test(test_the_text_tables_have_period_256),
        cmocka_unit_test(test_rows_along_an_axis_equal_the_reference),
        cmocka_unit_test(test_a_row_in_pieces_has_the_bits_of_the_whole),
        cmocka_unit_test(test_other_rows_equal_the_reference),
        cmocka_unit_test(test_points_equal_the_reference),
        cmocka_unit_test(test_bad_coordinates_give_nan_and_leave_the_others_alone),
        cmocka_unit_test(test_all_instruction_sets_give_the_same_bits),
    };
    return bl_run_tests(tests);
}
