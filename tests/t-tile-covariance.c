// SPDX-License-Identifier: MIT
//
// The covariance of tiles by routes that know neither transforms nor classes of numbers: each
// random number alone through the code that makes the tile, read back, and averaged over places by
// quadrature; the cosines of spectral synthesis with their images, summed. Then that it is as
// periodic as the tile, and what stands where there is none.
#include "tests/test.h"

#include "core/quadrature.h"
#include "core/random.h"
#include "noises/tiles/displacement.h"
#include "noises/tiles/synthesis.h"
#include "noises/tiles/wavelet_tile.h"
#include "spectra/theory.h"
#include "tests/texts.h"

// Panels of half a number, which hold the knots of every kernel; lags are whole panels.
enum { SIZE = 8, PANELS = 2 * SIZE, NODES = BL_QUADRATURE_NODES, PLACES = PANELS * NODES };

static double covariance(const bl_signal *signal, const double lag[BL_AXES]) {
    return signal->functions->covariance(signal->parameters, lag);
}

typedef struct read_back {
    double value[PLACES][PLACES]; // [y][x]; one row in one dimension
    unsigned rows;
} read_back;

// The numbers as the tile of `like` would read them.
static void read_numbers(const bl_tile *like, double *numbers, read_back *out) {
    bl_tile tile = *like;
    assert_int_equal(bl_tile_make(&tile, numbers, 1, NULL), BL_OK);
    out->rows = tile.dimensions > 1 ? PLACES : 1;
    for (unsigned j = 0; j < out->rows; j++)
        for (unsigned i = 0; i < PLACES; i++) {
            const unsigned place[2] = {i, j};
            double at[BL_AXES] = {0};
            for (int a = 0; a < 2; a++)
                at[a] = (place[a] / NODES + (1 + bl_quadrature_node[place[a] % NODES]) / 2) / 2 /
                        tile.rate;
            out->value[j][i] = bl_tile_value(&tile, at, NULL);
        }
    free(tile.number);
}

// The mean over places of the product with what lies `x` and `y` panels further.
static double product_mean(const read_back *in, unsigned x, unsigned y) {
    double sum = 0;
    for (unsigned j = 0; j < in->rows; j++) {
        const double *row = in->value[j], *there = in->value[(j + y * NODES) % in->rows];
        double weight = in->rows > 1 ? bl_quadrature_weight[j % NODES] / (2.0 * PANELS) : 1;
        for (unsigned i = 0; i < PLACES; i++)
            sum += weight * bl_quadrature_weight[i % NODES] / (2.0 * PANELS) * row[i] *
                   there[(i + x * NODES) % PLACES];
    }
    return sum;
}

// Lags in panels.
static const unsigned lags[][2] = {{0, 0}, {1, 0}, {2, 0}, {3, 0},  {5, 0}, {8, 0},  {13, 0},
                                   {0, 1}, {0, 3}, {0, 8}, {1, 1},  {2, 7}, {7, 2},  {3, 13},
                                   {8, 8}, {4, 6}, {6, 4}, {15, 1}, {9, 5}, {11, 14}};
enum { LAGS = sizeof lags / sizeof *lags };

// Fills a grid from random numbers, of which `which` is 1 and all others are 0; 0 past the last.
typedef int one_function(const bl_signal *signal, size_t which, double *grid);

// Numbers are floats, to 2^-24 of the largest.
static void check_by_single_numbers(const char *text, one_function *one) {
    static read_back read;
    bl_signal *signal = bl_test_open(text, BL_ISA_BEST);
    const bl_tile *tile = signal->parameters;
    double expected[LAGS] = {0}, grid[SIZE * SIZE], all = 0;
    for (size_t which = 0; one(signal, which, grid); which++) {
        read_numbers(tile, grid, &read);
        for (int i = 0; i < LAGS; i++)
            expected[i] += product_mean(&read, lags[i][0], lags[i][1]);
    }
    all = expected[0]; // the noise is scaled to the variance 1
    for (int i = 0; i < LAGS; i++) {
        const double lag[BL_AXES] = {lags[i][0] / 2.0 / tile->rate, lags[i][1] / 2.0 / tile->rate};
        if (tile->dimensions > 1 || lags[i][1] == 0)
            if (!(fabs(covariance(signal, lag) - expected[i] / all) < 2e-6))
                fail_msg("%s: covariance %.9g at (%g, %g), of single numbers %.9g", text,
                         covariance(signal, lag), lag[0], lag[1], expected[i] / all);
    }
    bl_signal_free(signal);
}

static int one_displacement(const bl_signal *signal, size_t which, double *grid) {
    const bl_tile *tile = signal->parameters;
    const char *hurst = strstr(signal->text, "hurst="),
               *ratio = strstr(signal->text, "lacunarity=");
    bl_displacement settings = {.tile = {.size = {SIZE, SIZE}, .dimensions = tile->dimensions},
                                .hurst = hurst ? atof(hurst + 6) : 0.5,
                                .all = signal->text[0] == 'a',
                                .lacunarity = ratio ? (uint32_t)atoi(ratio + 11) : 2};
    size_t count = bl_displacement_count(&settings);
    double numbers[2 * SIZE * SIZE] = {0};
    if (which >= count)
        return 0;
    numbers[which] = 1;
    bl_displacement_fill(&settings, numbers, grid);
    bl_tile_prefilter(grid, tile->size, (bl_tile_kernel)tile->kernel[0]);
    return 1;
}

static void test_displacements_have_the_covariance_of_their_numbers(void **state) {
    (void)state;
    static const char *const texts[] = {"midpoint:dims=1,size=8",
                                        "midpoint:hurst=0.25,dims=1,size=8,interp=bspline",
                                        "midpoint:dims=1,size=8,interp=nearest",
                                        "midpoint:size=8",
                                        "midpoint:hurst=0.9,size=8,interp=linear",
                                        "midpoint:size=8,interp=bspline",
                                        "additions:dims=1,size=8",
                                        "additions:size=8",
                                        "additions:hurst=0.2,lacunarity=4,size=8,interp=linear"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_by_single_numbers(texts[i], one_displacement);
}

static int one_wavelet(const bl_signal *signal, size_t which, double *grid) {
    const bl_tile *tile = signal->parameters;
    if (which >= bl_tile_count(tile->size))
        return 0;
    memset(grid, 0, SIZE * SIZE * sizeof *grid);
    grid[which] = 1;
    assert_int_equal(bl_wavelet_remove_coarse(grid, tile->size, NULL), BL_OK);
    return 1;
}

static void test_wavelet_noise_has_the_covariance_of_its_numbers(void **state) {
    (void)state;
    check_by_single_numbers("wavelet:dims=2,size=8", one_wavelet);
}

// --- spectral synthesis -------------------------------------------------------------------------

// Each pair of harmonics is sum over images m of p_k |k^(v+m)/k^(v)|^2 cos(2 pi (v+m) . r lag),
// with the images within 40 of each axis: the squares of cubic splines fall as m^-8.
static double sum_of_lines(const bl_signal *signal, const bl_synthesis *settings,
                           const double lag[BL_AXES]) {
    const bl_tile *tile = signal->parameters;
    double sum = 0;
    int half = (int)tile->size[0] / 2;
    for (int y = tile->dimensions > 1 ? 1 - half : 0; y < (tile->dimensions > 1 ? half : 1); y++)
        for (int x = 1 - half; x < half; x++) {
            const int k[3] = {x, y, 0};
            double power = x || y ? bl_synthesis_pair_power(settings, tile, k) / 2 : 0;
            double real = 1, imaginary = 0; // of the product over the axes
            for (uint32_t a = 0; a < tile->dimensions && power > 0; a++) {
                double v = (double)k[a] / tile->size[a], c = 0, s = 0;
                double own = bl_tile_transform((bl_tile_kernel)tile->kernel[a], v);
                for (int m = -40; m <= 40; m++) {
                    double image = bl_tile_transform((bl_tile_kernel)tile->kernel[a], v + m) / own;
                    double angle = 2 * M_PI * (v + m) * tile->rate * lag[a];
                    c += image * image * cos(angle);
                    s += image * image * sin(angle);
                }
                double next = real * c - imaginary * s;
                imaginary = real * s + imaginary * c;
                real = next;
            }
            sum += power * real;
        }
    return sum;
}

static void test_synthesis_has_the_covariance_of_its_lines(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bl_synthesis settings;
    } cases[] = {
        {"fourier:dims=1,size=32", {.tile = {.dimensions = 1}, .from = 0.5, .to = 1, .rate = 4}},
        {"fourier:dims=2,size=16,from=0.25,to=1.5,amplitudes=gaussian,samples=4",
         {.tile = {.dimensions = 2}, .from = 0.25, .to = 1.5, .rate = 4}},
        {"fourier:dims=1,size=16,spectrum=power,beta=1.5,interp=catmull-rom",
         {.tile = {.dimensions = 1}, .spectrum = BL_SYNTHESIS_POWER, .beta = 1.5, .rate = 4}}};
    bl_random random = bl_random_seed(31, 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open(cases[i].text, BL_ISA_BEST);
        for (int trial = 0; trial < 30; trial++) {
            double lag[BL_AXES] = {0};
            for (int a = 0; a < 2; a++)
                lag[a] = trial ? 20 * bl_random_unit(&random) - 10 : 0;
            assert_near(covariance(signal, lag), sum_of_lines(signal, &cases[i].settings, lag),
                        i == 2 ? 1e-6 : 1e-9);
        }
        bl_signal_free(signal);
    }
}

// --- all ----------------------------------------------------------------------------------------

static void test_it_repeats_and_is_largest_at_zero(void **state) {
    (void)state;
    static const char *const texts[] = {"fourier",  "fourier:dims=3",
                                        "wavelet",  "wavelet:slice=projected,normal=y",
                                        "midpoint", "additions:size=16,64"};
    bl_random random = bl_random_seed(32, 0);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bl_signal *signal = bl_test_open(texts[i], BL_ISA_BEST);
        const bl_facts *facts = &signal->facts;
        assert_true(isinf(facts->covariance_reach) && bl_signal_has_closed_form(signal));
        for (int trial = 0; trial < 50; trial++) {
            double lag[BL_AXES], back[BL_AXES], there[BL_AXES];
            for (unsigned a = 0; a < BL_AXES; a++) {
                lag[a] = round(40 * bl_random_unit(&random) * 256 - 5120) / 256;
                there[a] = lag[a] + (trial % 7 - 3) * facts->period[a];
                back[a] = -lag[a];
            }
            double here = covariance(signal, lag);
            assert_near(covariance(signal, there), here, 1e-14);
            assert_near(covariance(signal, back), here, 1e-14);
            assert_true(fabs(here) <= facts->variance + 1e-12);
        }
        assert_near(covariance(signal, (double[BL_AXES]){0}), facts->variance, 1e-9);
        assert_true(isnan(covariance(signal, (double[BL_AXES]){INFINITY})));
        assert_true(isnan(covariance(signal, (double[BL_AXES]){0, NAN})));
        bl_signal_free(signal);
    }
}

// Seeds share one covariance, which outlives the signal that made it.
static void test_copies_share_it(void **state) {
    (void)state;
    bl_signal *first = bl_test_open("midpoint:size=16", BL_ISA_BEST);
    bl_signal *second = bl_signal_reseed(first, 9), *third = bl_signal_copy(second);
    const double lag[BL_AXES] = {0.6, -1.3};
    double expected = covariance(first, lag);
    assert_ptr_equal(((bl_tile *)first->parameters)->covariance,
                     ((bl_tile *)third->parameters)->covariance);
    bl_signal_free(first);
    bl_signal_free(second);
    assert_near(covariance(third, lag), expected, 0);
    bl_signal_free(third);
}

// A spectrum of lines has no density; of a tile of more than 2^22 numbers nothing is said.
static void test_there_is_no_density_and_none_of_large_tiles(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open("fourier", BL_ISA_BEST);
    double d[3][BL_AXES] = {{1}, {0, 1}}, out[33];
    assert_false(bl_signal_has_density(signal));
    assert_int_equal(bl_theory_periodogram(signal, 1, d, 16, 64, BL_WINDOW_HANN, out, NULL), BL_OK);
    assert_true(isnan(bl_theory_line(signal, d[0], 0.7)));
    assert_true(isnan(bl_theory_slice(signal, d[0], d[1], 0.7, 0)));
    assert_true(isnan(bl_theory_volume(signal, d[0])));
    assert_true(isnan(bl_theory_band(signal, 1, d, 0, 1)));
    bl_signal_free(signal);
    signal = bl_test_open("fourier:dims=1,size=8388608", BL_ISA_BEST);
    assert_false(bl_signal_has_closed_form(signal));
    assert_true(isnan(signal->facts.covariance_reach));
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_displacements_have_the_covariance_of_their_numbers),
        cmocka_unit_test(test_wavelet_noise_has_the_covariance_of_its_numbers),
        cmocka_unit_test(test_synthesis_has_the_covariance_of_its_lines),
        cmocka_unit_test(test_it_repeats_and_is_largest_at_zero),
        cmocka_unit_test(test_copies_share_it),
        cmocka_unit_test(test_there_is_no_density_and_none_of_large_tiles),
    };
    return bl_run_tests(tests);
}
