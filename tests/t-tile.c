// SPDX-License-Identifier: MIT
//
// Tiles: reading against the sum of kernels written out, seams, periods, filters, random numbers.
#include "tests/test.h"

#include "core/quadrature.h"
#include "noises/lattice/kernel.h"
#include "noises/noise.h"
#include "noises/tiles/tile.h"

static const char *const words[] = {"bspline3", "catmull-rom", "linear",
                                    "nearest",  "bspline2",    "bspline2 wide"};

// The kernels by their definitions; for `nearest`, the box with its left edge.
static double kernel_value(bl_tile_kernel kernel, double x) {
    switch (kernel) {
    case BL_TILE_BSPLINE3:
        return bl_kernel_value(BL_KERNEL_BSPLINE3, x);
    case BL_TILE_CATMULL_ROM:
        return bl_kernel_value(BL_KERNEL_CATMULL_ROM, x);
    case BL_TILE_LINEAR:
        return bl_kernel_value(BL_KERNEL_LINEAR, x);
    case BL_TILE_NEAREST:
        return x >= -0.5 && x < 0.5;
    case BL_TILE_BSPLINE2:
        return bl_kernel_value(BL_KERNEL_BSPLINE2, x);
    default:
        return bl_kernel_value(BL_KERNEL_BSPLINE2, x / 2);
    }
}

static bl_tile make_tile(unsigned dimensions, const uint32_t kernel[3], bl_random *random) {
    bl_tile tile = {.dimensions = dimensions, .rate = 4, .size = {16, 1, 1}};
    for (unsigned a = 0; a < 3; a++) {
        tile.kernel[a] = kernel[a];
        tile.size[a] = a >= dimensions ? 1 : a == 0 ? 16 : a == 1 ? 8 : 4;
    }
    double numbers[16 * 8 * 4];
    for (size_t i = 0; i < bl_tile_count(tile.size); i++)
        numbers[i] = 2 * bl_random_unit(random) - 1;
    assert_int_equal(bl_tile_make(&tile, numbers, 1, NULL), BL_OK);
    return tile;
}

// All numbers within 4 of the place, without wrapping the place.
static double plain_sum(const bl_tile *tile, const double at[BL_AXES]) {
    double sum = 0;
    long from[3] = {0}, to[3] = {0};
    for (unsigned a = 0; a < tile->dimensions; a++) {
        from[a] = (long)floor(at[a] * tile->rate) - 4;
        to[a] = from[a] + 9;
    }
    for (long k = from[2]; k <= to[2]; k++)
        for (long j = from[1]; j <= to[1]; j++)
            for (long i = from[0]; i <= to[0]; i++) {
                const long place[3] = {i, j, k};
                double weight = 1;
                size_t index = 0;
                for (int a = 2; a >= 0; a--) {
                    long size = tile->size[a];
                    index = index * (size_t)size + (size_t)((place[a] % size + size) % size);
                    if ((unsigned)a < tile->dimensions)
                        weight *= kernel_value((bl_tile_kernel)tile->kernel[a],
                                               at[a] * tile->rate - (double)place[a]);
                }
                sum += weight * (double)tile->number[index];
            }
    return sum;
}

static void test_reading_is_the_sum_of_the_kernels(void **state) {
    (void)state;
    bl_random random = bl_random_seed(1, 0);
    for (unsigned dims = 1; dims <= 3; dims++)
        for (uint32_t n = 0; n < BL_TILE_KERNELS; n++) {
            const uint32_t kernel[3] = {n, (n + 1) % BL_TILE_KERNELS, (n + 4) % BL_TILE_KERNELS};
            bl_tile tile = make_tile(dims, kernel, &random);
            for (int trial = 0; trial < 300; trial++) {
                double at[BL_AXES];
                for (int a = 0; a < BL_AXES; a++) {
                    at[a] = 60 * bl_random_unit(&random) - 30;
                    if (trial % 3 == 0) // on knots and half way between
                        at[a] = round(at[a] * 8) / 8;
                }
                double value = bl_tile_value(&tile, at, NULL), expected = plain_sum(&tile, at);
                if (!(fabs(value - expected) < 1e-13))
                    fail_msg("%s in %u-D: %.17g, plainly %.17g", words[n], dims, value, expected);
            }
            bl_tile_release(&tile);
        }
}

// Shifts by whole periods, near and 2^40 of them, change no bit, of value and of gradient.
static void test_the_period_is_exact(void **state) {
    (void)state;
    bl_random random = bl_random_seed(2, 0);
    for (uint32_t n = 0; n < BL_TILE_KERNELS; n++) {
        bl_tile tile = make_tile(3, (const uint32_t[]){n, n, n}, &random);
        for (int trial = 0; trial < 100; trial++) {
            double at[BL_AXES] = {0}, there[BL_AXES] = {0}, g[2][BL_AXES];
            for (int a = 0; a < 3; a++) {
                at[a] = floor(bl_random_unit(&random) * 8192) / 1024;
                double periods = trial & 1 ? 0x1p36 : floor(9 * bl_random_unit(&random)) - 4;
                there[a] = at[a] + periods * tile.size[a] / tile.rate;
            }
            double here = bl_tile_value(&tile, at, g[0]), far = bl_tile_value(&tile, there, g[1]);
            assert_memory_equal(&here, &far, sizeof here);
            assert_memory_equal(g[0], g[1], sizeof g[0]);
        }
        bl_tile_release(&tile);
    }
}

// On both sides of the tile's edge, by the last double: equal to the slope times a rounding, for
// every kernel but the box.
static void test_there_is_no_seam(void **state) {
    (void)state;
    bl_random random = bl_random_seed(3, 0);
    for (uint32_t n = 0; n < BL_TILE_KERNELS; n++) {
        if (n == BL_TILE_NEAREST)
            continue;
        bl_tile tile = make_tile(2, (const uint32_t[]){n, n, n}, &random);
        for (int trial = 0; trial < 100; trial++) {
            double on[BL_AXES] = {0, bl_random_unit(&random)}, below[BL_AXES], g[2][BL_AXES];
            on[0] = tile.size[0] / tile.rate * (trial % 5 - 2);
            memcpy(below, on, sizeof below);
            below[0] = nextafter(on[0], -INFINITY);
            assert_near(bl_tile_value(&tile, below, g[0]), bl_tile_value(&tile, on, g[1]), 1e-14);
            for (int a = 0; a < 2 && n != BL_TILE_LINEAR; a++)
                assert_near(g[0][a], g[1][a], 1e-12);
        }
        bl_tile_release(&tile);
    }
}

// The sum over images of |k^|^2, and the transform itself, by quadrature of the kernel.
static void test_transforms_and_powers_of_the_kernels(void **state) {
    (void)state;
    for (int n = 0; n < BL_TILE_KERNELS; n++)
        for (double v = -0.5; v <= 0.5; v += 0.0625) {
            bl_tile_kernel kernel = (bl_tile_kernel)n;
            double integral = 0, images = 0;
            for (int panel = -6; panel < 6; panel++) // knots are multiples of 1/2
                for (int i = 0; i < BL_QUADRATURE_NODES; i++) {
                    double x = 0.25 * (2 * panel + 1 + bl_quadrature_node[i]);
                    integral += 0.25 * bl_quadrature_weight[i] * kernel_value(kernel, x) *
                                cos(2 * M_PI * v * x);
                }
            assert_near(bl_tile_transform(kernel, v), integral, 1e-12);
            // The tail beyond M falls as M^-1 for the box, M^-3 for the hat and faster for others.
            for (int m = -3000; m <= 3000; m++)
                images += pow(bl_tile_transform(kernel, v + m), 2);
            double tail = n == BL_TILE_NEAREST ? 2 / (M_PI * M_PI * 2999) : 1e-9;
            assert_near(bl_tile_power(kernel, v), images + tail / 2, tail / 2 + 1e-12);
        }
}

static void test_gains_are_the_largest_sums_of_sizes(void **state) {
    (void)state;
    for (int n = 0; n < BL_TILE_KERNELS; n++) {
        double most = 0;
        for (int i = 0; i < 512; i++) {
            double sum = 0;
            for (int j = -4; j <= 4; j++)
                sum += fabs(kernel_value((bl_tile_kernel)n, i / 512.0 + j));
            most = fmax(most, sum);
        }
        assert_near(bl_tile_gain((bl_tile_kernel)n), most, 1e-14);
    }
    // The inverse of (1, 4, 1)/6: its row's sum of sizes, from a single number.
    double one[256] = {1}, sum = 0;
    bl_tile_prefilter(one, (const uint32_t[]){256, 1, 1}, BL_TILE_BSPLINE3);
    for (int i = 0; i < 256; i++)
        sum += fabs(one[i]);
    assert_near(bl_tile_prefilter_gain(BL_TILE_BSPLINE3), sum, 1e-13);
}

// What bl_tile_solve solves, put back into the filter.
static void test_the_periodic_filter_is_inverted(void **state) {
    (void)state;
    static const double poles[] = {-0.26794919243112270, -0.43, -0.043, 0.6, -0.95};
    bl_random random = bl_random_seed(4, 0);
    for (size_t n = 4; n <= 64; n *= 2)
        for (size_t inner = 1; inner <= 3; inner += 2)
            for (size_t p = 0; p < 5; p++) {
                double s[2 * 64 * 3], d[2 * 64 * 3], z = poles[p];
                for (size_t i = 0; i < 2 * n * inner; i++)
                    d[i] = s[i] = 2 * bl_random_unit(&random) - 1;
                bl_tile_solve(d, 2, n, inner, z);
                for (size_t o = 0; o < 2; o++)
                    for (size_t k = 0; k < n; k++)
                        for (size_t i = 0; i < inner; i++) {
                            const double *line = d + o * n * inner + i;
                            double back = line[(k + 1) % n * inner] +
                                          line[(k + n - 1) % n * inner] -
                                          (z + 1 / z) * line[k * inner];
                            assert_near(back, s[(o * n + k) * inner + i], 1e-12);
                        }
            }
}

static void test_prefiltered_numbers_pass_through_the_values(void **state) {
    (void)state;
    bl_random random = bl_random_seed(5, 0);
    for (uint32_t kernel = 0; kernel <= BL_TILE_NEAREST; kernel++) {
        bl_tile tile = {.dimensions = 3, .rate = 2, .size = {8, 16, 4}};
        double values[512], numbers[512];
        for (int i = 0; i < 512; i++)
            values[i] = numbers[i] = 2 * bl_random_unit(&random) - 1;
        for (int a = 0; a < 3; a++)
            tile.kernel[a] = kernel;
        bl_tile_prefilter(numbers, tile.size, (bl_tile_kernel)kernel);
        assert_int_equal(bl_tile_make(&tile, numbers, 1, NULL), BL_OK);
        for (int i = 0; i < 512; i++) {
            const double at[BL_AXES] = {i % 8 / 2.0, i / 8 % 16 / 2.0, i / 128 / 2.0};
            // Floats below 27, rounded by 2^-24 of them, in weights that sum to 1.
            assert_near(bl_tile_value(&tile, at, NULL), values[i], 27 * 0x1p-24);
        }
        bl_tile_release(&tile);
    }
}

// Moments within 5.5 standard errors each: a right generator fails once in 10^7.
static void test_random_numbers_have_their_moments_and_bound(void **state) {
    (void)state;
    enum { COUNT = 1 << 18 };
    double *z = malloc(COUNT * sizeof *z), sums[9] = {0}, neighbours = 0;
    bl_random random = bl_random_seed(6, 0);
    bl_tile_numbers(&random, z, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        assert_true(fabs(z[i]) < BL_TILE_NUMBER);
        for (int power = 1; power <= 8; power++)
            sums[power] += pow(z[i], power) / COUNT;
        neighbours += i ? z[i] * z[i - 1] / COUNT : 0;
    }
    assert_near(sums[1], 0, 5.5 * sqrt(1.0 / COUNT));
    assert_near(sums[2], 1, 5.5 * sqrt((sums[4] - 1) / COUNT));
    assert_near(sums[3], 0, 5.5 * sqrt(sums[6] / COUNT));
    assert_near(sums[4], 2.7, 5.5 * sqrt((sums[8] - 2.7 * 2.7) / COUNT));
    assert_near(neighbours, 0, 5.5 * sqrt(1.0 / COUNT));
    assert_true(BL_TILE_NUMBER > 4 * sqrt(0.75 / (1 - 0x1p-32)) * (1 - 0x1p-16));
    free(z);
}

// 2^26 numbers are the most.
static void test_a_tile_has_a_largest_size(void **state) {
    (void)state;
    static const uint32_t usual[BL_TILE_AXES] = {256, 64, 32};
    const bl_tile_settings most = {.dimensions = 2, .size = {8192, 8192}};
    const bl_tile_settings more = {.dimensions = 2, .size = {8192, 16384}};
    bl_message message = {""};
    assert_int_equal(bl_tile_check(&most, usual, 8, &message), BL_OK);
    assert_int_equal(bl_tile_check(&more, usual, 8, &message), BL_MISMATCH);
    assert_non_null(strstr(message.text, "2^26"));
}

static void test_settings_that_make_no_tile_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *word;
        bl_status status;
    } bad[] = {{"midpoint:size=12", "size=12", BL_USAGE},
               {"midpoint:size=4", "from 8 on", BL_USAGE},
               {"midpoint:size=32,64", "square", BL_USAGE},
               {"midpoint:samples=3", "samples=3", BL_USAGE},
               {"additions:size=16384,16384", "too large", BL_MISMATCH},
               {"wavelet:dims=2,slice=projected", "dims=3", BL_USAGE},
               {"fourier:samples=1", "samples=1", BL_USAGE},
               {"fourier:samples=2,to=2", "samples=2", BL_USAGE},
               {"fourier:from=0.51,to=0.52,size=8", "no harmonic", BL_USAGE}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        bl_signal *signal = NULL;
        bl_message message = {""};
        bl_status status = bl_noise_open(bad[i].text, BL_ISA_BEST, &signal, &message);
        if (status != bad[i].status || !strstr(message.text, bad[i].word) || signal)
            fail_msg("%s: status %d, '%s'", bad[i].text, status, message.text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reading_is_the_sum_of_the_kernels),
        cmocka_unit_test(test_the_period_is_exact),
        cmocka_unit_test(test_there_is_no_seam),
        cmocka_unit_test(test_transforms_and_powers_of_the_kernels),
        cmocka_unit_test(test_gains_are_the_largest_sums_of_sizes),
        cmocka_unit_test(test_the_periodic_filter_is_inverted),
        cmocka_unit_test(test_prefiltered_numbers_pass_through_the_values),
        cmocka_unit_test(test_random_numbers_have_their_moments_and_bound),
        cmocka_unit_test(test_a_tile_has_a_largest_size),
        cmocka_unit_test(test_settings_that_make_no_tile_are_refused),
    };
    return bl_run_tests(tests);
}
