// SPDX-License-Identifier: MIT
//
// Lattice noises in one, two and four dimensions: against sums written here, against their slices,
// their gradients against uniform directions, their closed forms against products. The measured
// spectra are compared with the closed forms in t-spectrum-theory.
//
// Error rates: the tests of random numbers have fixed seeds and fail a right program with a
// probability below 1e-6 each (5.2 standard errors and more, two-sided).
#include "tests/test.h"

#include "core/hash.h"
#include "core/random.h"
#include "noises/closed_forms.h"
#include "noises/lattice/lattice_dimensions.h"
#include "spectra/theory.h"
#include "tests/program.h"
#include "tests/temporary.h"
#include "tests/texts.h"

enum { COUNT = 203 };

static const char *const texts[] = {"vnoise",
                                    "vnoise:interp=linear",
                                    "vnoise:interp=smooth",
                                    "vnoise:interp=bspline2",
                                    "vnoise:interp=bspline3",
                                    "vnoise:lattice=perm256",
                                    "vnoise:interp=linear,lattice=perm256",
                                    "gnoise",
                                    "gnoise:fade=quintic",
                                    "gnoise:fade=linear,gradients=edges",
                                    "gnoise:gradients=rejection",
                                    "gnoise:lattice=perm256",
                                    "gnoise:gradients=edges,lattice=perm256"};
enum { TEXTS = sizeof texts / sizeof *texts };
static const unsigned all_dimensions[] = {1, 2, 4};

static bl_signal *open_in(const char *text, unsigned dimensions, bl_isa isa) {
    char whole[192];
    snprintf(whole, sizeof whole, "%s%cdims=%u", text, strchr(text, ':') ? ',' : ':', dimensions);
    return bl_test_open(whole, isa);
}

static void random_place(bl_random *random, double scale, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        at[a] = scale * (2 * bl_random_unit(random) - 1);
}

// --- the sums -----------------------------------------------------------------------------------

// The word of a cell, from the formula at the head of lattice.h.
static uint32_t naive_word(const bl_lattice *lattice, unsigned dimensions, const double cell[],
                           unsigned component) {
    uint32_t p = lattice->add[component], q = lattice->exclusive[component];
    for (unsigned a = 0; a < 3 || a < dimensions; a++) {
        int64_t number = a < dimensions ? (int64_t)cell[a] : 0;
        bl_lattice_key key = bl_lattice_key_of(lattice, a, (uint64_t)number);
        p += key.add;
        q ^= key.exclusive;
    }
    return p * q;
}

// All cells within 2, whose weights are the kernel's, outside of its support 0.
static double naive_sum(const bl_lattice *lattice, unsigned dimensions, bl_kernel kernel,
                        int gradients, const double at[BL_AXES]) {
    double sum = 0;
    for (int n = 0; n >> 2 * dimensions == 0; n++) {
        double cell[BL_AXES], weight = 1, value;
        for (unsigned a = 0; a < dimensions; a++) {
            cell[a] = floor(at[a]) + (n >> 2 * a & 3) - 1;
            weight *= bl_kernel_value(kernel, at[a] - cell[a]);
        }
        uint32_t word = naive_word(lattice, dimensions, cell, 0);
        if (gradients < 0) {
            value = bl_lattice_value(word) * BL_LATTICE_UNIT;
        } else {
            bl_direction g = bl_direction_of((bl_gradients)gradients, dimensions, word,
                                             naive_word(lattice, dimensions, cell, 1));
            const double of[BL_AXES] = {g.x, g.y, g.z, g.w};
            value = 0;
            for (unsigned a = 0; a < dimensions; a++)
                value += of[a] * (at[a] - cell[a]);
        }
        sum += weight * value;
    }
    return sum;
}

static void test_the_noise_is_the_sum(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bl_kernel kernel;
        int gradients; // -1: values
    } cases[] = {{"vnoise", BL_KERNEL_CATMULL_ROM, -1},
                 {"vnoise:interp=linear", BL_KERNEL_LINEAR, -1},
                 {"vnoise:interp=smooth", BL_KERNEL_SMOOTH, -1},
                 {"vnoise:interp=bspline2", BL_KERNEL_BSPLINE2, -1},
                 {"vnoise:interp=bspline3", BL_KERNEL_BSPLINE3, -1},
                 {"gnoise", BL_KERNEL_SMOOTH, BL_GRADIENTS_SPHERE},
                 {"gnoise:fade=quintic", BL_KERNEL_QUINTIC, BL_GRADIENTS_SPHERE},
                 {"gnoise:fade=linear", BL_KERNEL_LINEAR, BL_GRADIENTS_SPHERE},
                 {"gnoise:gradients=edges", BL_KERNEL_SMOOTH, BL_GRADIENTS_EDGES},
                 {"gnoise:gradients=rejection", BL_KERNEL_SMOOTH, BL_GRADIENTS_REJECTION}};
    bl_random random = bl_random_seed(1, 0);
    const bl_lattice lattice = bl_lattice_of(0, BL_LATTICE_HASH);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (int d = 0; d < 3; d++) {
            unsigned dimensions = all_dimensions[d];
            bl_signal *signal = open_in(cases[c].text, dimensions, BL_ISA_BEST);
            assert_int_equal(signal->dimensions, dimensions);
            for (int trial = 0; trial < 100; trial++) {
                double at[BL_AXES];
                random_place(&random, trial & 1 ? 1e4 : 4, at);
                double expected =
                    naive_sum(&lattice, dimensions, cases[c].kernel, cases[c].gradients, at);
                assert_near(bl_signal_value(signal, at), expected, 1e-12);
            }
            bl_signal_free(signal);
        }
}

// A kernel that interpolates is 1 at its own plane and 0 at the others.
static void test_fewer_dimensions_are_slices_of_space(void **state) {
    (void)state;
    static const char *const interpolating[] = {"vnoise", "vnoise:interp=linear",
                                                "vnoise:interp=smooth,seed=5",
                                                "vnoise:lattice=perm256", "vnoise:component=2"};
    bl_random random = bl_random_seed(2, 0);
    for (size_t t = 0; t < sizeof interpolating / sizeof *interpolating; t++) {
        bl_signal *space = bl_test_open(interpolating[t], BL_ISA_BEST);
        for (unsigned dimensions = 1; dimensions <= 2; dimensions++) {
            bl_signal *slice = open_in(interpolating[t], dimensions, BL_ISA_BEST);
            for (int trial = 0; trial < 100; trial++) {
                double at[BL_AXES], in[BL_AXES] = {0};
                random_place(&random, 300, at);
                memcpy(in, at, dimensions * sizeof *in);
                assert_near(bl_signal_value(slice, at), bl_signal_value(space, in), 1e-14);
            }
            bl_signal_free(slice);
        }
        bl_signal_free(space);
    }
}

// With a period of 1 all values are one number, which the weights must add up to.
static void test_the_weights_of_values_add_up_to_one(void **state) {
    (void)state;
    bl_random random = bl_random_seed(3, 0);
    for (int t = 0; t < 5; t++)
        for (unsigned dimensions = 1; dimensions <= 4; dimensions++) {
            char text[128];
            snprintf(text, sizeof text, "%s%cperiod=1", texts[t],
                     strchr(texts[t], ':') ? ',' : ':');
            bl_signal *signal = open_in(text, dimensions, BL_ISA_BEST);
            double first = bl_signal_value(signal, (const double[BL_AXES]){0});
            for (int trial = 0; trial < 100; trial++) {
                double at[BL_AXES], step[BL_AXES] = {0};
                float sample;
                random_place(&random, 50, at);
                step[trial & 3] = 0.1;
                assert_near(bl_signal_value(signal, at), first, 1e-14);
                bl_signal_row(signal, at, step, 1, &sample);
                assert_near((double)sample, first, 32 * 0x1p-24);
            }
            bl_signal_free(signal);
        }
}

// --- floats -------------------------------------------------------------------------------------

// A line along each axis in turn, or an oblique one, near and far.
static void choose_line(bl_random *random, int line, double start[BL_AXES], double step[BL_AXES]) {
    static const double scales[] = {4, 1e6, 1e9, 1e15}, steps[] = {0.05, 0.5, 1.3, -0.25, 0, 7.3};
    random_place(random, scales[line / 5 % 4], start);
    for (int a = 0; a < BL_AXES; a++)
        step[a] = line % 5 == 4 || line % 5 == a ? steps[line / 20 % 6] : 0;
}

static void test_floats_agree_with_the_double_reference(void **state) {
    (void)state;
    bl_random random = bl_random_seed(4, 0);
    for (int t = 0; t < TEXTS; t++)
        for (int d = 0; d < 3; d++) {
            bl_signal *signal = open_in(texts[t], all_dimensions[d], BL_ISA_BEST);
            double tolerance = 32 * 0x1p-24 * fmax(1, signal->facts.upper);
            for (int line = 0; line < 120; line++) {
                static double column[BL_AXES][COUNT];
                float row[COUNT], points[COUNT];
                double start[BL_AXES], step[BL_AXES];
                choose_line(&random, line, start, step);
                for (int a = 0; a < BL_AXES; a++)
                    for (int i = 0; i < COUNT; i++)
                        column[a][i] = start[a] + i * step[a];
                bl_signal_row(signal, start, step, COUNT, row);
                bl_signal_points(signal, BL_COLUMNS(column), COUNT, points);
                for (int i = 0; i < COUNT; i += 7) {
                    const double at[BL_AXES] = {column[0][i], column[1][i], column[2][i],
                                                column[3][i]};
                    double value = bl_signal_value(signal, at);
                    assert_near((double)row[i], value, tolerance);
                    assert_near((double)points[i], value, tolerance);
                    assert_true(fabs(value) <= signal->facts.upper);
                }
            }
            bl_signal_free(signal);
        }
}

static void test_bits_depend_on_neither_instruction_set_nor_neighbours(void **state) {
    (void)state;
    bl_random random = bl_random_seed(5, 0);
    for (int t = 0; t < TEXTS; t++)
        for (int d = 0; d < 3; d++) {
            bl_signal *first = open_in(texts[t], all_dimensions[d], BL_ISA_BASELINE);
            for (int isa = BL_ISA_BASELINE; isa < BL_ISA_COUNT; isa++) {
                if (!bl_isa_runs_here((bl_isa)isa))
                    continue;
                bl_signal *other = open_in(texts[t], all_dimensions[d], (bl_isa)isa);
                for (int line = 0; line < 40; line++) {
                    float a[COUNT], b[COUNT], alone;
                    double start[BL_AXES], step[BL_AXES], at[BL_AXES];
                    choose_line(&random, 3 * line, start, step);
                    bl_signal_row(first, start, step, COUNT, a);
                    bl_signal_row(other, start, step, COUNT, b);
                    assert_memory_equal(a, b, sizeof a);
                    for (int i = 0; i < COUNT; i += 31) {
                        for (int n = 0; n < BL_AXES; n++)
                            at[n] = start[n] + i * step[n];
                        bl_signal_row(other, at, step, 1, &alone);
                        assert_memory_equal(&alone, &b[i], sizeof alone);
                    }
                }
                bl_signal_free(other);
            }
            bl_signal_free(first);
        }
}

static void test_coordinates_beyond_the_dimensions_are_not_read(void **state) {
    (void)state;
    for (int t = 0; t < TEXTS; t++)
        for (unsigned dimensions = 1; dimensions <= 3; dimensions++) {
            bl_signal *signal = open_in(texts[t], dimensions, BL_ISA_BEST);
            double at[2][BL_AXES] = {{0.3, 0.7, 5.1, 0}, {0.3, 0.7, 5.1, NAN}};
            double step[2][BL_AXES] = {{0.1}, {0.1}};
            float row[2][20], point[2];
            for (unsigned a = dimensions; a < BL_AXES; a++) {
                at[1][a] = a & 1 ? NAN : INFINITY;
                step[1][a] = 3;
            }
            for (int k = 0; k < 2; k++) {
                bl_signal_row(signal, at[k], step[k], 20, row[k]);
                bl_signal_points(
                    signal, (const double *const[]){&at[k][0], &at[k][1], &at[k][2], &at[k][3]}, 1,
                    &point[k]);
            }
            assert_memory_equal(row[0], row[1], sizeof row[0]);
            assert_memory_equal(&point[0], &point[1], sizeof *point);
            assert_true(bl_signal_value(signal, at[0]) == bl_signal_value(signal, at[1]));
            bl_signal_free(signal);
        }
}

// --- words and gradients ------------------------------------------------------------------------

// In one dimension a word has the key of one axis alone to live on: the values of neighbours are
// uncorrelated, and fill their range evenly.
static void test_values_on_a_line_are_random(void **state) {
    (void)state;
    enum { CELLS = 1 << 20, LAGS = 16, BINS = 256 };
    for (uint64_t seed = 0; seed < 3; seed++) {
        bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_HASH);
        static double value[CELLS + LAGS];
        double chi_square = 0, expected = (double)CELLS / BINS, count[BINS] = {0};
        for (uint64_t i = 0; i < CELLS + LAGS; i++) {
            uint32_t word = bl_lattice_word_in(&lattice, 1, (const uint64_t[BL_AXES]){i}, 0);
            value[i] = bl_lattice_value(word) * BL_LATTICE_UNIT;
            if (i < CELLS)
                count[word >> 24]++;
        }
        // A product of two independent values has the variance 1/9.
        for (int lag = 1; lag <= LAGS; lag++) {
            double sum = 0;
            for (int i = 0; i < CELLS; i++)
                sum += value[i] * value[i + lag];
            assert_near(sum / CELLS, 0, 5.7 / 3 / sqrt(CELLS));
        }
        for (int b = 0; b < BINS; b++)
            chi_square += (count[b] - expected) * (count[b] - expected) / expected;
        assert_near(chi_square, BINS - 1, 5.7 * sqrt(2 * (BINS - 1)));
    }
}

// E g_a = 0, E g_a g_b = variance if a = b, else 0; for unit vectors also E g_a^4 = 3 / (d (d+2)),
// which tells a sphere from a cube. All moments are means of numbers of size 9/16 * 9 at most.
static void check_moments(bl_gradients gradients, unsigned dimensions, double variance,
                          double fourth) {
    enum { WORDS = 1 << 19 };
    bl_random random = bl_random_seed(6, dimensions);
    double mean[BL_AXES] = {0}, product[BL_AXES][BL_AXES] = {{0}}, power[BL_AXES] = {0};
    for (int i = 0; i < WORDS; i++) {
        uint64_t bits = bl_random_bits(&random);
        bl_direction g =
            bl_direction_of(gradients, dimensions, (uint32_t)bits, (uint32_t)(bits >> 32));
        const double of[BL_AXES] = {g.x, g.y, g.z, g.w};
        double square = 0;
        for (unsigned a = 0; a < BL_AXES; a++) {
            square += of[a] * of[a];
            mean[a] += of[a] / WORDS;
            power[a] += of[a] * of[a] * of[a] * of[a] / WORDS;
            for (unsigned b = 0; b < BL_AXES; b++)
                product[a][b] += of[a] * of[b] / WORDS;
            assert_true(a < dimensions || of[a] == 0);
        }
        if (dimensions > 1 || gradients != BL_GRADIENTS_SPHERE)
            assert_near(square, variance * dimensions, 1e-6 * dimensions);
    }
    // Standard errors: at most the root of E g_a^2 <= 1, of E g_a^4 <= 1, of E g_a^8 <= 1.
    const double error = 5.7 / sqrt(WORDS);
    for (unsigned a = 0; a < dimensions; a++) {
        assert_near(mean[a], 0, error);
        assert_near(power[a], fourth, error);
        for (unsigned b = 0; b < dimensions; b++)
            assert_near(product[a][b], a == b ? variance : 0, error);
    }
}

static void test_gradients_are_uniform(void **state) {
    (void)state;
    check_moments(BL_GRADIENTS_SPHERE, 1, 1.0 / 3, 1.0 / 5);
    check_moments(BL_GRADIENTS_SPHERE, 2, 1.0 / 2, 3.0 / 8);
    check_moments(BL_GRADIENTS_SPHERE, 4, 1.0 / 4, 1.0 / 8);
    check_moments(BL_GRADIENTS_REJECTION, 1, 1, 1);
    check_moments(BL_GRADIENTS_REJECTION, 2, 1.0 / 2, 3.0 / 8);
    check_moments(BL_GRADIENTS_REJECTION, 4, 1.0 / 4, 1.0 / 8);
    check_moments(BL_GRADIENTS_EDGES, 1, 1, 1);
    check_moments(BL_GRADIENTS_EDGES, 2, 1, 1);
    check_moments(BL_GRADIENTS_EDGES, 4, 3.0 / 4, 3.0 / 4);
}

// The projection of a uniform unit vector in four dimensions on a random direction has the density
// (2/pi) sqrt(1 - t^2), whatever the direction: 32 bins of equal probability, for each of 12.
static void test_the_sphere_in_four_dimensions_has_no_direction(void **state) {
    (void)state;
    enum { WORDS = 1 << 16, BINS = 32, DIRECTIONS = 12 };
    bl_random random = bl_random_seed(7, 0);
    for (int n = 0; n < DIRECTIONS; n++) {
        double u[BL_AXES], length = 0, count[BINS] = {0}, chi_square = 0;
        random_place(&random, 1, u);
        for (int a = 0; a < BL_AXES; a++)
            length += u[a] * u[a];
        for (int i = 0; i < WORDS; i++) {
            uint64_t bits = bl_random_bits(&random);
            bl_direction g =
                bl_direction_of(BL_GRADIENTS_SPHERE, 4, (uint32_t)bits, (uint32_t)(bits >> 32));
            double t = (g.x * u[0] + g.y * u[1] + g.z * u[2] + g.w * u[3]) / sqrt(length);
            t = fmax(-1, fmin(1, t));
            double below = 0.5 + (asin(t) + t * sqrt(1 - t * t)) / M_PI;
            count[(int)fmin(BINS - 1, BINS * below)]++;
        }
        for (int b = 0; b < BINS; b++)
            chi_square += pow(count[b] - WORDS / BINS, 2) / (WORDS / BINS);
        // Chi-square with 31 degrees of freedom is beyond 100 with probability 3e-9.
        assert_less(chi_square, 100);
    }
}

// All 2^20 words that the circle tells apart: 64 sectors with an equal share to 1e-3, no sector of
// 2^10 without one, of unit length.
static void test_the_circle_is_even(void **state) {
    (void)state;
    enum { SECTORS = 64, FINE = 1024 };
    double count[SECTORS] = {0};
    static int fine[FINE];
    double longest = 0;
    for (uint32_t n = 0; n < 1 << 20; n++) {
        bl_direction g = bl_sphere_in(2, n << 12, 0);
        double turn = atan2((double)g.y, (double)g.x) / (2 * M_PI) + 0.5;
        count[(int)(turn * SECTORS) % SECTORS]++;
        fine[(int)(turn * FINE) % FINE] = 1;
        longest = fmax(longest, fabs(hypot((double)g.x, (double)g.y) - 1));
    }
    assert_less(longest, 1e-6);
    for (int s = 0; s < SECTORS; s++)
        assert_near(count[s] * SECTORS / (1 << 20), 1, 1e-3);
    for (int s = 0; s < FINE; s++)
        assert_true(fine[s]);
}

// --- what is stated -----------------------------------------------------------------------------

static void test_value_bounds_are_powers(void **state) {
    (void)state;
    for (unsigned d = 1; d <= 4; d++) {
        assert_near(bl_bound_value_in(BL_KERNEL_CATMULL_ROM, d).value, pow(1.25, d), 1e-15);
        assert_near(bl_bound_value_in(BL_KERNEL_BSPLINE3, d).value, 1, 0);
    }
}

// The sum over the corners of weight times the largest g . d, at random places and in the middle.
static void test_gradient_bounds_hold_and_are_reached(void **state) {
    (void)state;
    static const bl_kernel weights[] = {BL_KERNEL_LINEAR, BL_KERNEL_SMOOTH, BL_KERNEL_QUINTIC};
    bl_random random = bl_random_seed(8, 0);
    for (int trial = 0; trial < 60000; trial++) {
        unsigned d = all_dimensions[trial % 3];
        bl_kernel weight = weights[trial / 3 % 3];
        double unit = 0, edges = 0, at[BL_AXES];
        for (unsigned a = 0; a < d; a++)
            at[a] = trial < 9 ? 0.5 : bl_random_unit(&random);
        for (unsigned corner = 0; corner >> d == 0; corner++) {
            double product = 1, square = 0, sum = 0, least = 1;
            for (unsigned a = 0; a < d; a++) {
                double offset = fabs(at[a] - (corner >> a & 1));
                product *= bl_kernel_value(weight, offset);
                square += offset * offset;
                sum += offset;
                least = fmin(least, offset);
            }
            unit += product * sqrt(square);
            edges += product * (d == 4 ? sum - least : sum);
        }
        assert_less(unit, bl_bound_gradient_in(weight, 0, d).value);
        assert_less(edges, bl_bound_gradient_in(weight, 1, d).value);
        if (trial < 9) {
            assert_near(unit, bl_bound_gradient_in(weight, 0, d).value, 1.1e-5);
            assert_near(edges, d == 4 ? 1.5 : d / 2.0, 1e-12);
        }
    }
}

// Line, slice and volume of each noise along the axes, as products of transforms over the axes they
// span and of the correlation at 0 over the others.
static double product_form(const bl_terms *terms, int spanned, const double f[BL_AXES]) {
    double sum = 0;
    for (int i = 0; i < terms->count; i++) {
        double product = terms->term[i].variance;
        for (int a = 0; a < (int)terms->dimensions; a++) {
            double k = bl_kernel_transform(terms->term[i].kernel[a], f[a]);
            product *= a < spanned ? k * k : bl_kernel_correlation(terms->term[i].kernel[a], 0);
        }
        sum += product;
    }
    return sum;
}

static void test_closed_forms_are_products(void **state) {
    (void)state;
    static const double x[BL_AXES] = {1}, y[BL_AXES] = {0, 1}, f[BL_AXES] = {0.3, 0.55, 0.8};
    for (int which = 0; which < 2; which++)
        for (int d = 0; d < 3; d++) {
            unsigned dimensions = all_dimensions[d];
            static const double gradient_variance[] = {0, (1 - 0x1p-40) / 3, 0.5, 0, 0.25};
            bl_signal *signal = open_in(which ? "gnoise" : "vnoise", dimensions, BL_ISA_BEST);
            bl_terms terms = {.dimensions = dimensions};
            if (which)
                bl_terms_add_gradient(&terms, gradient_variance[dimensions], BL_KERNEL_RAMP_SMOOTH,
                                      BL_KERNEL_SMOOTH);
            else
                bl_terms_add_value(&terms, BL_VALUE_VARIANCE(1 << 20), BL_KERNEL_CATMULL_ROM);
            double variance = product_form(&terms, 0, f);
            assert_near(signal->facts.variance, variance, 1e-14);
            assert_near(bl_theory_line(signal, x, f[0]), product_form(&terms, 1, f),
                        1e-12 * variance);
            double plane = bl_theory_slice(signal, x, y, f[0], f[1]);
            double volume = bl_theory_volume(signal, f);
            if (dimensions == 1)
                assert_true(isnan(plane));
            else
                assert_near(plane, product_form(&terms, 2, f), 1e-9 * variance);
            if (dimensions < 4)
                assert_true(isnan(volume));
            else
                assert_near(volume, product_form(&terms, 3, f), 1e-9 * variance);
            double all[3][BL_AXES] = {{1}, {0, 1}, {0, 0, 1}};
            double share = bl_theory_band(signal, 1, all, 1, INFINITY);
            assert_near(share, bl_terms_share_above(&terms, 1), 1e-12);
            assert_true(signal->facts.leak_db >= 10 * log10(share));
            assert_true(isnan(bl_theory_band(signal, 3, all, 0, 1)) == (dimensions < 3));
            bl_signal_free(signal);
        }
}

// --- components ---------------------------------------------------------------------------------

// component=k is the noise of the seed bl_component_seed(seed, k), and the components are
// uncorrelated: the mean of their product over K places of as many seeds is within 5.7 standard
// errors of 0.
static void test_components_are_other_seeds_and_uncorrelated(void **state) {
    (void)state;
    enum { K = 4000, COMPONENTS = 4 };
    static const char *const names[] = {"vnoise",  "gnoise:dims=4",  "vnoise:dims=2",  "hermite",
                                        "scnoise", "simplex:dims=2", "simplex:dims=4", "white"};
    bl_random random = bl_random_seed(9, 0);
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        double sum[COMPONENTS][COMPONENTS] = {{0}}, square[COMPONENTS][COMPONENTS] = {{0}};
        bl_signal *base = bl_test_open(names[n], BL_ISA_BEST);
        for (unsigned k = 0; k < COMPONENTS; k++) {
            char text[64];
            snprintf(text, sizeof text, "%s%cseed=3,component=%u", names[n],
                     strchr(names[n], ':') ? ',' : ':', k);
            bl_signal *own = bl_test_open(text, BL_ISA_BEST);
            bl_signal *seeded = bl_signal_reseed(base, bl_component_seed(3, k));
            const double start[BL_AXES] = {-7.3, 0.2, 9.1, 4.4}, step[BL_AXES] = {0.37};
            float row[2][64];
            bl_signal_row(own, start, step, 64, row[0]);
            bl_signal_row(seeded, start, step, 64, row[1]);
            assert_memory_equal(row[0], row[1], sizeof row[0]);
            bl_signal_free(own);
            bl_signal_free(seeded);
        }
        for (int i = 0; i < K; i++) {
            double value[COMPONENTS], at[BL_AXES];
            random_place(&random, 1000, at);
            for (unsigned k = 0; k < COMPONENTS; k++) {
                bl_signal *one = bl_signal_reseed(base, bl_component_seed((uint64_t)i, k));
                value[k] = bl_signal_value(one, at);
                bl_signal_free(one);
            }
            for (int j = 0; j < COMPONENTS; j++)
                for (int k = 0; k < j; k++) {
                    sum[j][k] += value[j] * value[k];
                    square[j][k] += value[j] * value[j] * value[k] * value[k];
                }
        }
        for (int j = 0; j < COMPONENTS; j++)
            for (int k = 0; k < j; k++)
                assert_near(sum[j][k], 0, 5.7 * sqrt(square[j][k]));
        bl_signal_free(base);
    }
}

static void test_the_program_prints_and_renders_components(void **state) {
    (void)state;
    char expected[128] = "";
    for (int k = 0; k < 3; k++) {
        char text[64];
        snprintf(text, sizeof text, "gnoise:dims=4,seed=9,component=%d", k);
        bl_ran one = bl_run_program("eval", text, "0.3", "1.7", "2.2", "5.5");
        assert_int_equal(one.status, 0);
        one.out[strcspn(one.out, "\n")] = k < 2 ? ' ' : '\n';
        strncat(expected, one.out, sizeof expected - strlen(expected) - 1);
        bl_ran_free(&one);
    }
    bl_ran all = bl_run_program("eval", "gnoise:dims=4,seed=9", "0.3", "1.7", "2.2", "5.5",
                                "--components", "3");
    assert_string_equal(all.out, expected);
    bl_ran_free(&all);
    const char *png = bl_temporary_path("two.png"), *exr = bl_temporary_path("three.exr");
    bl_ran two = bl_run_program("render", "gnoise", "-o", png, "--components", "2");
    assert_int_equal(two.status, BL_USAGE);
    bl_ran_free(&two);
    // The middle pixel of 3 x 3 pixels a unit apart is the place of --at; channels are R, G, B.
    bl_ran three = bl_run_program("render", "gnoise:dims=4,seed=9", "-o", exr, "--components", "3",
                                  "--width", "3", "--scale", "3", "--at", "0.3,1.7,2.2,5.5");
    assert_int_equal(three.status, 0);
    bl_ran_free(&three);
    char *rest = expected;
    for (int k = 0; k < 3; k++) {
        char text[256];
        snprintf(text, sizeof text, "%s:channel=%c", exr, "RGB"[k]);
        bl_ran pixel = bl_run_program("eval", text, "1", "1");
        assert_int_equal(pixel.status, 0);
        assert_near(strtod(pixel.out, NULL), strtod(rest, &rest), 1e-6);
        bl_ran_free(&pixel);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_noise_is_the_sum),
        cmocka_unit_test(test_fewer_dimensions_are_slices_of_space),
        cmocka_unit_test(test_the_weights_of_values_add_up_to_one),
        cmocka_unit_test(test_floats_agree_with_the_double_reference),
        cmocka_unit_test(test_bits_depend_on_neither_instruction_set_nor_neighbours),
        cmocka_unit_test(test_coordinates_beyond_the_dimensions_are_not_read),
        cmocka_unit_test(test_values_on_a_line_are_random),
        cmocka_unit_test(test_gradients_are_uniform),
        cmocka_unit_test(test_the_sphere_in_four_dimensions_has_no_direction),
        cmocka_unit_test(test_the_circle_is_even),
        cmocka_unit_test(test_value_bounds_are_powers),
        cmocka_unit_test(test_gradient_bounds_hold_and_are_reached),
        cmocka_unit_test(test_closed_forms_are_products),
        cmocka_unit_test(test_components_are_other_seeds_and_uncorrelated),
        cmocka_unit_test(test_the_program_prints_and_renders_components),
    };
    return bl_run_tests(tests);
}
