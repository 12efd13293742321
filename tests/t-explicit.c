// SPDX-License-Identifier: MIT
//
// The noises that are made as a tile: their spectra, harmonic by harmonic, and their variances
// against derivations by another route.
//
// Each statistical test here fails a right program with probability 1e-6 at most; seeds are fixed.
#include "tests/test.h"

#include <complex.h>
#include <unistd.h>

#include "core/fft.h"
#include "core/quadrature.h"
#include "core/random.h"
#include "core/statistics.h"
#include "noises/tiles/displacement.h"
#include "noises/lattice/kernel.h"
#include "noises/noise.h"
#include "noises/tiles/synthesis.h"
#include "noises/tiles/wavelet_tile.h"
#include "tests/temporary.h"
#include "tests/texts.h"

#define ERROR_RATE 1e-6

static bl_signal *open_signal(const char *text) {
    return bl_test_open(text, BL_ISA_BEST);
}

// --- powers at the harmonics --------------------------------------------------------------------

// One period along each axis of a line or of a slice at z, as a transform.
typedef struct harmonics {
    size_t width, height; // samples
    double *spectrum;     // height rows of width/2 + 1 complex numbers
} harmonics;

static harmonics sample_period(const bl_signal *signal, double per_unit, double z) {
    const double *period = signal->facts.period;
    harmonics h = {.width = (size_t)(period[0] * per_unit), .height = 1};
    if (signal->dimensions > 1)
        h.height = (size_t)(period[1] * per_unit);
    bl_fft_shape shape = {
        .kind = BL_FFT_REAL, .precision = BL_FFT_DOUBLE, .dims = 2, .size = {h.height, h.width}};
    const bl_fft *plan;
    assert_int_equal(bl_fft_plan(&shape, &plan, NULL), BL_OK);
    h.spectrum = bl_fft_buffer(bl_fft_bytes(&shape));
    float *row = malloc(h.width * sizeof *row);
    for (size_t y = 0; y < h.height; y++) {
        const double start[BL_AXES] = {0, (double)y / per_unit, z}, step[BL_AXES] = {1 / per_unit};
        bl_signal_row(signal, start, step, h.width, row);
        for (size_t x = 0; x < h.width; x++)
            h.spectrum[y * 2 * (h.width / 2 + 1) + x] = row[x];
    }
    bl_fft_run(plan, h.spectrum);
    free(row);
    return h;
}

// The power of the pair k, -k; kx >= 0.
static double pair_power(const harmonics *h, int kx, int ky) {
    size_t row = (size_t)(ky < 0 ? ky + (int)h->height : ky);
    const double *c = h->spectrum + 2 * (row * (h->width / 2 + 1) + (size_t)kx);
    double count = (double)(h->width * h->height);
    return 2 * (c[0] * c[0] + c[1] * c[1]) / (count * count);
}

// --- fourier ------------------------------------------------------------------------------------

// The target, independently of the code: by the text of the setting.
typedef double target(double f);

static double octave(double f) {
    return f >= 0.5 && f <= 1;
}
static double inverse_square(double f) {
    return f <= 2 ? 1 / (f * f) : 0;
}
static double inverse_cube(double f) {
    return f <= 2 ? 1 / (f * f * f) : 0;
}

// Fixed amplitudes: every harmonic has its power, on both sides of the axes, and there is no other.
// Sampled at 8 times the tile's rate, images fold in from beyond 7.5 of the tile's rates, on two
// sides: for the cubic B-spline, at most (1/15)^4 + (1/17)^4 in amplitude an axis, 1.3e-4 in power
// for two axes; the floats add 1e-6.
static void check_fixed(const char *text, target *density, double total_of_table) {
    bl_signal *signal = open_signal(text);
    harmonics h = sample_period(signal, 8 / signal->facts.cell, 0);
    unsigned dims = signal->dimensions;
    int half[2] = {(int)h.width / 16, dims > 1 ? (int)h.height / 16 : 1};
    double total = 0, seen = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int ky = 1 - half[1]; ky < half[1]; ky++)
            for (int kx = 0; kx < half[0]; kx++) {
                if (kx == 0 && ky <= 0)
                    continue;
                double fx = kx / signal->facts.period[0];
                double fy = dims > 1 ? ky / signal->facts.period[1] : 0;
                double wanted = density(hypot(fx, fy));
                if (pass == 0) {
                    total += wanted;
                    seen += pair_power(&h, kx, ky);
                    continue;
                }
                wanted *= (total_of_table > 0 ? total_of_table : 1) / total;
                double power = pair_power(&h, kx, ky);
                if (!(fabs(power - wanted) <= 2e-4 * wanted + 1e-10))
                    fail_msg("%s: power %g at (%g, %g), target %g", text, power, fx, fy, wanted);
            }
    assert_near(seen, total_of_table > 0 ? total_of_table : 1, 2e-4);
    free(h.spectrum);
    bl_signal_free(signal);
}

static void test_fixed_amplitudes_have_the_target_spectrum(void **state) {
    (void)state;
    check_fixed("fourier", octave, 0);
    check_fixed("fourier:dims=1,seed=3", octave, 0);
    check_fixed("fourier:interp=catmull-rom,samples=8,seed=4", octave, 0);
    check_fixed("fourier:size=32,64,seed=5,from=1,to=0.5", octave, 0);
    check_fixed("fourier:spectrum=power", inverse_square, 0);
    check_fixed("fourier:spectrum=power,beta=3,dims=1", inverse_cube, 0);
}

// The mean square over the whole tile, which Gauss's rule integrates exactly cell by cell, is the
// variance stated, images and all, to the rounding of floats.
static void test_fixed_amplitudes_have_the_variance_exactly(void **state) {
    (void)state;
    for (const char *const *interp = bl_tile_interps; *interp; interp++)
        for (int dims = 1; dims <= 2; dims++) {
            char text[96];
            snprintf(text, sizeof text, "fourier:dims=%d,size=16,interp=%s,seed=9", dims, *interp);
            bl_signal *signal = open_signal(text);
            double cell = signal->facts.cell / 2, sum = 0, mean = 0; // the box's edges are halves
            int cells = 32, nodes = BL_QUADRATURE_NODES;
            for (int y = 0; y < (dims > 1 ? cells * nodes : 1); y++)
                for (int x = 0; x < cells * nodes; x++) {
                    int i = x % nodes, j = y % nodes;
                    double at[BL_AXES] = {cell * (x / nodes + 0.5 + bl_quadrature_node[i] / 2)};
                    at[1] = cell * (y / nodes + 0.5 + bl_quadrature_node[j] / 2);
                    double weight = bl_quadrature_weight[i] / 2 / cells;
                    weight *= dims > 1 ? bl_quadrature_weight[j] / 2 / cells : 1;
                    double value = bl_signal_value(signal, at);
                    sum += weight * value * value;
                    mean += weight * value;
                }
            assert_near(sum, signal->facts.variance, 1e-6 * signal->facts.variance);
            assert_near(mean, 0, 1e-6);
            bl_signal_free(signal);
        }
}

// Gaussian amplitudes: the sum of a harmonic's power over K seeds, in units of half its target, is
// chi-square with 2K degrees of freedom; the smallest of all p-values, two-sided, Bonferroni.
static void check_gaussian(const char *text, target *density) {
    enum { SEEDS = 60 };
    bl_signal *signal = open_signal(text);
    bl_tile *tile = signal->parameters; // for its size alone
    int half[2] = {(int)tile->size[0] / 2, signal->dimensions > 1 ? (int)tile->size[1] / 2 : 1};
    size_t columns = (size_t)half[0], rows = 2 * (size_t)half[1];
    double *sums = calloc(columns * rows, sizeof *sums), total = 0, all = 0, pairs = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        bl_signal *fresh = bl_signal_reseed(signal, 100 + seed);
        harmonics h = sample_period(fresh, 4 / signal->facts.cell, 0);
        for (int ky = 1 - half[1]; ky < half[1]; ky++)
            for (int kx = 0; kx < half[0]; kx++)
                sums[(size_t)(ky + half[1]) * columns + (size_t)kx] += pair_power(&h, kx, ky);
        free(h.spectrum);
        bl_signal_free(fresh);
    }
    double smallest = 1;
    for (int pass = 0; pass < 2; pass++)
        for (int ky = 1 - half[1]; ky < half[1]; ky++)
            for (int kx = 0; kx < half[0]; kx++) {
                if (kx == 0 && ky <= 0)
                    continue;
                double fy = signal->dimensions > 1 ? ky / signal->facts.period[1] : 0;
                double wanted = density(hypot(kx / signal->facts.period[0], fy));
                if (pass == 0) {
                    total += wanted;
                    pairs += wanted > 0;
                }
                if (pass == 0 || wanted == 0)
                    continue;
                double x = sums[(size_t)(ky + half[1]) * columns + (size_t)kx] * total / wanted;
                double p = bl_chi_square_cdf(2 * x, 2 * SEEDS);
                smallest = fmin(smallest, 2 * fmin(p, 1 - p));
                all += x;
            }
    double p = bl_chi_square_cdf(2 * all, 2 * SEEDS * pairs);
    printf("# %s: %g harmonics, smallest p %.2g, all together %.2g\n", text, pairs,
           smallest * pairs, 2 * fmin(p, 1 - p));
    assert_true(smallest * pairs > ERROR_RATE / 3);
    assert_true(2 * fmin(p, 1 - p) > ERROR_RATE / 3);
    free(sums);
    bl_signal_free(signal);
}

static void test_gaussian_amplitudes_have_the_target_in_the_mean(void **state) {
    (void)state;
    check_gaussian("fourier:amplitudes=gaussian,dims=1", octave);
    check_gaussian("fourier:amplitudes=gaussian,size=32", octave);
    check_gaussian("fourier:amplitudes=gaussian,spectrum=power,size=32", inverse_square);
}

// One harmonic at a quarter of the rate: numbers a quarter of a wave apart are its cosine and sine,
// whose squares add up to its power. With fixed amplitudes that is one number; with gaussian ones
// it is exponential about the same number. Kolmogorov's statistic of K powers is beyond d / sqrt K
// with 2 exp(-2 d^2) at most.
static void test_gaussian_amplitudes_have_exponential_powers(void **state) {
    (void)state;
    enum { SEEDS = 1000 };
    const double start[BL_AXES] = {0}, step[BL_AXES] = {0.25};
    static double powers[SEEDS];
    bl_signal *fixed = open_signal("fourier:dims=1,from=1,to=1"),
              *gaussian = open_signal("fourier:dims=1,from=1,to=1,amplitudes=gaussian");
    float pair[2];
    bl_signal_row(fixed, start, step, 2, pair);
    double one = (double)pair[0] * (double)pair[0] + (double)pair[1] * (double)pair[1];
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        bl_signal *fresh = bl_signal_reseed(gaussian, 500 + seed);
        bl_signal_row(fresh, start, step, 2, pair);
        powers[seed] =
            ((double)pair[0] * (double)pair[0] + (double)pair[1] * (double)pair[1]) / one;
        bl_signal_free(fresh);
    }
    double largest = 0;
    for (int i = 0; i < SEEDS; i++) {
        double below = 0, here = 1 - exp(-powers[i]);
        for (int j = 0; j < SEEDS; j++)
            below += powers[j] < powers[i];
        largest = fmax(largest, fmax(here - below / SEEDS, (below + 1) / SEEDS - here));
    }
    assert_less(largest, sqrt(log(2 / ERROR_RATE) / 2 / SEEDS));
    bl_signal_free(fixed);
    bl_signal_free(gaussian);
}

// --- a user's table -----------------------------------------------------------------------------

static void write_table(const char *path, const char *text) {
    bl_temporary_write(path, text, strlen(text));
}

static double hat_of_table(double f) {
    return f >= 0.25 && f <= 0.75 ? 8 * f - 2 : f > 0.75 && f <= 1 ? 4 * (4 - 4 * f) : 0;
}

static void test_a_table_is_the_spectrum(void **state) {
    (void)state;
    const char *path = bl_temporary_path("spectrum.csv");
    write_table(path, "# made by hand\nfrequency,density,more\n0.25,0,1\n0.75, 4\n\n1,0\n");
    char text[600];
    snprintf(text, sizeof text, "fourier:dims=1,csv=%s", path);
    // One-sided in one dimension: the variance is the area, 1/2 * 3/4 * 4, up to the trapezoids.
    double area = 0;
    for (int k = 1; k < 128; k++)
        area += hat_of_table(k / 64.0) / 64;
    assert_near(area, 1.5, 1e-9);
    check_fixed(text, hat_of_table, area);
    // The settings of a reseeded signal outlive the file and the first signal.
    bl_signal *first = open_signal(text);
    unlink(path);
    bl_signal *second = bl_signal_reseed(first, 7);
    assert_non_null(second);
    bl_signal_free(first);
    bl_signal *third = bl_signal_reseed(second, 8);
    assert_non_null(third);
    bl_signal_free(second);
    assert_near(third->facts.variance, area, 1e-3);
    bl_signal_free(third);
}

static void test_a_bad_table_is_refused_by_its_line(void **state) {
    (void)state;
    static const struct {
        const char *content, *word;
    } bad[] = {{"0,1\n1,2\n1,3\n", "line 3: frequencies must rise"},
               {"f,d\n0,1\nx,2\n", "line 3: expected a frequency"},
               {"f,d\ng,e\n", "line 2: expected a frequency"},
               {"0,1\n1\n", "line 2: expected a density"},
               {"0,1\n1,2x\n", "line 2: expected a density"},
               {"0,1\n# here\n1,-2\n", "line 3: expected a density from 0"},
               {"0,1\n1,nan\n", "line 2: expected a density from 0"},
               {"-1,1\n", "line 1: expected a frequency from 0"},
               {"inf,1\n", "line 1: expected a frequency from 0"},
               {"1,2\n", "line 1: the table ends"},
               {"", "the file is empty"},
               {"1,0\n2,0\n", "no harmonic"}};
    const char *path = bl_temporary_path("bad.csv");
    char text[600];
    snprintf(text, sizeof text, "fourier:csv=%s", path);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        bl_signal *signal = NULL;
        bl_message message = {""};
        write_table(path, bad[i].content);
        bl_status status = bl_noise_open(text, BL_ISA_BEST, &signal, &message);
        if (status != BL_USAGE || !strstr(message.text, bad[i].word) || signal)
            fail_msg("'%s': status %d, '%s'", bad[i].content, status, message.text);
    }
    bl_signal *signal = NULL;
    bl_message message = {""};
    unlink(path);
    assert_int_equal(bl_noise_open(text, BL_ISA_BEST, &signal, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, path));
    snprintf(text, sizeof text, "fourier:csv=%s", bl_temporary_folder());
    assert_int_equal(bl_noise_open(text, BL_ISA_BEST, &signal, &message), BL_DEVICE);
}

// --- wavelet ------------------------------------------------------------------------------------

static void test_downsampling_undoes_upsampling(void **state) {
    (void)state;
    bl_random random = bl_random_seed(1, 0);
    for (size_t n = 8; n <= 128; n *= 2)
        for (size_t inner = 1; inner <= 3; inner += 2) {
            double coarse[2 * 64 * 3], fine[2 * 128 * 3], back[2 * 64 * 3];
            for (size_t i = 0; i < n * inner; i++)
                coarse[i] = 2 * bl_random_unit(&random) - 1;
            bl_wavelet_up(coarse, 2, n, inner, fine);
            bl_wavelet_down(fine, 2, n, inner, back);
            for (size_t i = 0; i < n * inner; i++)
                assert_near(back[i], coarse[i], 1e-13);
        }
}

// The periodic spline of n numbers.
static double spline(const double *c, size_t n, double x) {
    double sum = 0;
    for (long j = (long)floor(x) - 3; j <= (long)floor(x) + 3; j++)
        sum += c[(size_t)((j + (long)n) % (long)n)] *
               bl_kernel_value(BL_KERNEL_BSPLINE2, x - (double)j);
    return sum;
}

// By integrals over the functions themselves: with every coarse spline, and upsampling keeps the
// function.
static void test_the_residual_is_orthogonal_to_the_coarse_splines(void **state) {
    (void)state;
    enum { N = 16 };
    double fine[N], coarse[N / 2], up[N];
    bl_random random = bl_random_seed(2, 0);
    bl_tile_numbers(&random, fine, N);
    bl_wavelet_down(fine, 1, N, 1, coarse);
    bl_wavelet_up(coarse, 1, N, 1, up);
    assert_int_equal(bl_wavelet_remove_coarse(fine, (const uint32_t[]){N, 1, 1}, NULL), BL_OK);
    for (int m = 0; m < N / 2; m++) {
        double product = 0, size = 0;
        for (int half = 0; half < 12; half++) // from 2m - 5/2 to 2m + 7/2
            for (int i = 0; i < BL_QUADRATURE_NODES; i++) {
                double t = -3 + 0.25 * (2 * half + 1 + bl_quadrature_node[i]);
                double x = 2 * m + 0.5 + t, b = bl_kernel_value(BL_KERNEL_BSPLINE2, t / 2);
                product += bl_quadrature_weight[i] * b * spline(fine, N, x);
                size += bl_quadrature_weight[i] * b * fabs(spline(fine, N, x));
            }
        assert_near(product, 0, 1e-13 * size); // rounding of some 100 terms, 4e-16 each
        assert_true(size > 0.1);
    }
    for (double x = 0.1; x < N; x += 0.37) {
        double sum = 0;
        for (int m = -2; m < N / 2 + 2; m++)
            sum += coarse[(m + N / 2) % (N / 2)] *
                   bl_kernel_value(BL_KERNEL_BSPLINE2, (x - 2 * m - 0.5) / 2);
        assert_near(sum, spline(up, N, x), 1e-13);
    }
}

// The expected power at every harmonic, or at each `stride`-th, from what becomes of each single
// number: exact, without the algebra of noises/tiles/wavelet_tile.h.
static void check_wavelet_power(unsigned dims, const uint32_t size[3], size_t stride) {
    size_t count = bl_tile_count(size);
    double *one = malloc(count * sizeof *one), *power = calloc(count, sizeof *power);
    for (size_t j = 0; j < count; j++) {
        memset(one, 0, count * sizeof *one);
        one[j] = 1;
        assert_int_equal(bl_wavelet_remove_coarse(one, size, NULL), BL_OK);
        for (size_t k = 0; k < count; k += stride) {
            double complex sum = 0;
            for (size_t i = 0; i < count; i++) {
                double phase = 0;
                for (size_t a = 0, pi = i, pk = k; a < dims; a++) {
                    phase += (double)(pi % size[a] * (pk % size[a])) / size[a];
                    pi /= size[a];
                    pk /= size[a];
                }
                sum += one[i] * cexp(-2 * M_PI * I * phase);
            }
            power[k] += (creal(sum) * creal(sum) + cimag(sum) * cimag(sum)) / (double)count;
        }
    }
    for (size_t k = 0; k < count; k += stride) {
        double v[3] = {0};
        for (size_t a = 0, rest = k; a < dims; a++) {
            v[a] = (double)(rest % size[a]) / size[a];
            rest /= size[a];
        }
        assert_near(bl_wavelet_power(dims, v), power[k], 1e-12);
    }
    assert_near(power[0], 0, 1e-12);
    free(one);
    free(power);
}

static void test_the_spectrum_of_the_residual(void **state) {
    (void)state;
    check_wavelet_power(1, (const uint32_t[]){32, 1, 1}, 1);
    check_wavelet_power(2, (const uint32_t[]){16, 8, 1}, 1);
    check_wavelet_power(3, (const uint32_t[]){8, 8, 8}, 17);
}

// The expected share of a slice's variance below `limit`, |f| in the slice, for z normal.
static double expected_share(const bl_signal *signal, double limit) {
    const bl_tile *tile = signal->parameters;
    double below = 0;
    int n = (int)tile->size[0], depth = (int)tile->size[2];
    for (int kx = -n; kx < n; kx++) // all that lies below the limit
        for (int ky = -n; ky < n; ky++)
            for (int kz = 0; kz < depth; kz++) {
                const double v[3] = {(double)kx / n, (double)ky / n, (double)kz / depth};
                double power = bl_wavelet_power(3, v);
                for (int a = 0; a < 2; a++)
                    power *= pow(bl_tile_transform((bl_tile_kernel)tile->kernel[a], v[a]), 2);
                power *= bl_tile_power((bl_tile_kernel)tile->kernel[2], v[2]);
                below += hypot(v[0], v[1]) * tile->rate < limit ? power : 0;
            }
    return below / ((double)n * n * depth) / bl_wavelet_variance(tile);
}

// The largest sum of sizes in a row of the orthogonal projection of n quadratic B-splines onto n/2
// of twice the width, by the normal equations: (U' G U)^-1 U' G of numbers, then U, where U has the
// masks 1 3 3 1 over 4 and G, the products of splines, 1 26 66 26 1 over 120.
static double gain_by_normal_equations(void) {
    enum { N = 16, HALF = N / 2 };
    static const double mask[] = {0.25, 0.75, 0.75, 0.25};
    static const double gram[] = {1 / 120.0, 26 / 120.0, 66 / 120.0, 26 / 120.0, 1 / 120.0};
    double u[N][HALF] = {{0}}, right[HALF][N] = {{0}}, left[HALF][HALF] = {{0}}, largest = 0;
    for (int k = 0; k < HALF; k++)
        for (int t = 0; t < 4; t++)
            u[(2 * k + t) % N][k] += mask[t];
    for (int k = 0; k < HALF; k++)
        for (int i = 0; i < N; i++)
            for (int t = 0; t < 5; t++)
                right[k][i] += u[(i + t + N - 2) % N][k] * gram[t];
    for (int k = 0; k < HALF; k++)
        for (int m = 0; m < HALF; m++)
            for (int i = 0; i < N; i++)
                left[k][m] += right[k][i] * u[i][m];
    for (int k = 0; k < HALF; k++) // Gauss and Jordan, of a positive definite matrix
        for (int m = 0; m < HALF; m++) {
            double factor = m == k ? 0 : left[m][k] / left[k][k];
            for (int c = 0; c < HALF; c++)
                left[m][c] -= factor * left[k][c];
            for (int i = 0; i < N; i++)
                right[m][i] -= factor * right[k][i];
        }
    for (int row = 0; row < N; row++) {
        double sum = 0;
        for (int i = 0; i < N; i++) {
            double entry = 0;
            for (int k = 0; k < HALF; k++)
                entry += u[row][k] * right[k][i] / left[k][k];
            sum += fabs(entry);
        }
        largest = fmax(largest, sum);
    }
    return largest;
}

// Numbers of variance 1 are at most 4 sqrt(3/4) in size; the deviation of what is left of them
// stands in the tile, and t-facts measures it.
static void test_the_bound_of_wavelet_is_that_of_the_projection(void **state) {
    (void)state;
    double gain = gain_by_normal_equations();
    for (int dims = 2; dims <= 3; dims++)
        for (int projected = 0; projected < dims - 1; projected++) { // of a volume alone
            char text[80];
            snprintf(text, sizeof text, "wavelet:dims=%d,size=16%s", dims,
                     projected ? ",slice=projected" : "");
            bl_signal *signal = open_signal(text);
            double deviation = sqrt(bl_wavelet_variance(signal->parameters));
            double wanted =
                (projected ? 2 : 1) * 4 * sqrt(0.75) * (1 + pow(gain, dims)) / deviation;
            assert_near(signal->facts.upper, wanted, 3e-5 * wanted); // 3.4642 for 3.46410
            assert_near(signal->facts.lower, -wanted, 3e-5 * wanted);
            bl_signal_free(signal);
        }
}

// The power of slices below half a cycle a unit, over seeds and places z, against the formula; and
// the projection has far less of it than the plain slice.
static void test_projected_slices_leak_less_below_half_a_cycle(void **state) {
    (void)state;
    enum { SEEDS = 64 };
    static const char *const texts[] = {"wavelet", "wavelet:slice=projected"};
    double limit = -bl_normal_quantile(ERROR_RATE / 4), expected[2];
    for (int t = 0; t < 2; t++) {
        bl_signal *signal = open_signal(texts[t]);
        bl_random random = bl_random_seed(3, 0);
        bl_moments moments = {.n = 0};
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            bl_signal *fresh = bl_signal_reseed(signal, seed);
            harmonics h = sample_period(fresh, 8, 16 * bl_random_unit(&random));
            double below = 0;
            for (int ky = -8; ky <= 8; ky++)
                for (int kx = 0; kx <= 8; kx++)
                    if ((kx > 0 || ky > 0) && hypot(kx, ky) / 16 < 0.5)
                        below += pair_power(&h, kx, ky);
            below += pair_power(&h, 0, 0) / 2;
            bl_moments_add(&moments, below);
            free(h.spectrum);
            bl_signal_free(fresh);
        }
        expected[t] = expected_share(signal, 0.5);
        double error = sqrt(bl_moments_variance(&moments) / SEEDS);
        printf("# %s: share below 1/2 %.4f +- %.4f, formula %.4f\n", texts[t], moments.mean, error,
               expected[t]);
        assert_near(moments.mean, expected[t], limit * error);
        bl_signal_free(signal);
    }
    assert_less(expected[1], expected[0] / 4);
}

// --- displacements ------------------------------------------------------------------------------

// The covariances of all numbers of a square tile, level by level: a new number that is the mean of
// others has the mean of their covariances, and its own displacement adds to its variance.
enum { MOST = 16 * 16 };
typedef struct covariances {
    int width, height;
    double of[MOST][MOST];
} covariances;

static int place(const covariances *c, int x, int y) {
    return (y + 4 * c->height) % c->height * c->width + (x + 4 * c->width) % c->width;
}

static void set_mean(covariances *c, int i, const int *from, int count, double variance) {
    static double row[MOST];
    double own = 0;
    int all = c->width * c->height;
    for (int j = 0; j < all; j++) {
        row[j] = 0;
        for (int k = 0; k < count; k++)
            row[j] += c->of[from[k]][j] / count;
    }
    for (int k = 0; k < count; k++)
        own += row[from[k]] / count;
    for (int j = 0; j < all; j++)
        c->of[i][j] = c->of[j][i] = row[j];
    c->of[i][i] = own + variance;
}

static void divide(covariances *c, double hurst) {
    for (int h = c->width / 2; h >= 1; h /= 2) {
        double square = pow(2.0 * h / c->width, 2 * hurst);
        for (int y = c->height > 1 ? h : 0; y < c->height; y += 2 * h)
            for (int x = h; x < c->width; x += 2 * h) {
                const int corners[] = {place(c, x - h, y - h), place(c, x + h, y - h),
                                       place(c, x - h, y + h), place(c, x + h, y + h)};
                const int ends[] = {place(c, x - h, y), place(c, x + h, y)};
                set_mean(c, place(c, x, y), c->height > 1 ? corners : ends, c->height > 1 ? 4 : 2,
                         square);
            }
        for (int y = 0; c->height > 1 && y < c->height; y += h)
            for (int x = y / h % 2 ? 0 : h; x < c->width; x += 2 * h) {
                const int around[] = {place(c, x - h, y), place(c, x + h, y), place(c, x, y - h),
                                      place(c, x, y + h)};
                set_mean(c, place(c, x, y), around, 4, square * pow(0.5, hurst));
            }
    }
}

// With linear interpolation the mean over a cell takes 2/3 of the variances and 1/3 of the
// covariances of neighbours, along each axis.
static double mean_variance(const covariances *c, int linear) {
    double sum = 0;
    for (int y = 0; y < c->height; y++)
        for (int x = 0; x < c->width; x++)
            for (int j = linear && c->height > 1 ? -1 : 0; j <= (linear && c->height > 1); j++)
                for (int i = -linear; i <= linear; i++) {
                    double weight = linear ? (i ? 1.0 / 6 : 2.0 / 3) : 1;
                    weight *= linear && c->height > 1 ? (j ? 1.0 / 6 : 2.0 / 3) : 1;
                    sum += weight * c->of[place(c, x, y)][place(c, x + i, y + j)];
                }
    return sum / (c->width * c->height);
}

static void test_midpoint_variance_by_covariances(void **state) {
    (void)state;
    static covariances c;
    static const double hursts[] = {0, 0.3, 1};
    for (int dims = 1; dims <= 2; dims++)
        for (int h = 0; h < 3; h++)
            for (int linear = 0; linear < 2; linear++) {
                bl_displacement settings = {.hurst = hursts[h]};
                settings.tile.dimensions = (uint32_t)dims;
                settings.tile.size[0] = settings.tile.size[1] = 16;
                settings.tile.interp = linear ? BL_TILE_LINEAR : BL_TILE_NEAREST;
                memset(&c, 0, sizeof c);
                c.width = 16;
                c.height = dims > 1 ? 16 : 1;
                divide(&c, hursts[h]);
                double variance;
                assert_int_equal(bl_displacement_variance(&settings, &variance, NULL), BL_OK);
                assert_near(variance, mean_variance(&c, linear), 1e-12);
            }
}

// Additions on a line: a sum over the levels of independent hats, whose mean square over the
// numbers s apart is (2 + 1/s^2)/3 of the variance.
static void test_additions_variance_by_hats(void **state) {
    (void)state;
    for (uint32_t ratio = 2; ratio <= 8; ratio *= 2)
        for (double hurst = 0; hurst <= 1; hurst += 0.5) {
            bl_displacement settings = {.hurst = hurst, .all = 1, .lacunarity = ratio};
            settings.tile.dimensions = 1;
            settings.tile.size[0] = 512;
            settings.tile.interp = BL_TILE_NEAREST;
            double variance, expected = 0, coarsest = 1;
            while (coarsest * ratio < 512)
                coarsest *= ratio;
            for (double s = coarsest; s >= 1; s /= ratio)
                expected += pow(s / coarsest, 2 * hurst) * (2 + 1 / (s * s)) / 3;
            assert_int_equal(bl_displacement_variance(&settings, &variance, NULL), BL_OK);
            assert_near(variance, expected, 1e-12);
        }
}

// The slope of log power over log frequency, by octaves from 8 harmonics to 1/8 of the numbers, a
// value a seed.
static bl_estimate measure_slope(const char *text) {
    enum { SEEDS = 100, OCTAVES = 16 };
    bl_signal *signal = open_signal(text);
    double slopes[SEEDS];
    for (int seed = 0; seed < SEEDS; seed++) {
        bl_signal *fresh = bl_signal_reseed(signal, (uint64_t)seed);
        harmonics h = sample_period(fresh, 1 / signal->facts.cell, 0);
        double sx = 0, sy = 0, sxx = 0, sxy = 0, n = 0;
        for (int k = 8; k < (int)h.width / 8; k *= 2, n++) {
            double power = 0;
            for (int i = k; i < 2 * k; i++)
                power += pair_power(&h, i, 0) / k;
            sx += n, sxx += n * n, sy += log2(power), sxy += n * log2(power);
        }
        slopes[seed] = (n * sxy - sx * sy) / (n * sxx - sx * sx);
        free(h.spectrum);
        bl_signal_free(fresh);
    }
    bl_signal_free(signal);
    return bl_mean_estimate(slopes, SEEDS, 1 - ERROR_RATE / 6);
}

// Neither is fractional Brownian motion: their slopes are near -(2H+1), not at it. The kernels of
// the levels are hats, whose images lift or lower the octaves alike but not their ends; 0.2 is what
// the method may miss, and the interval is that of the measurement.
static void test_the_slopes_are_near_those_of_fractional_motion(void **state) {
    (void)state;
    static const char *const names[] = {"midpoint", "additions"};
    for (int n = 0; n < 2; n++)
        for (double hurst = 0.25; hurst < 1; hurst += 0.25) {
            char text[96];
            snprintf(text, sizeof text, "%s:dims=1,size=4096,hurst=%g", names[n], hurst);
            bl_estimate slope = measure_slope(text);
            printf("# %s: slope %.3f in [%.3f, %.3f], 2H+1 = %g\n", text, slope.value, slope.lower,
                   slope.upper, 2 * hurst + 1);
            assert_true(slope.upper > -(2 * hurst + 1) - 0.2);
            assert_true(slope.lower < -(2 * hurst + 1) + 0.2);
        }
}

// The defect stated: the first point of midpoint displacement is 0 for all seeds, others are not.
static void test_midpoint_is_pinned_at_its_first_point(void **state) {
    (void)state;
    bl_signal *signal = open_signal("midpoint");
    for (uint64_t seed = 0; seed < 10; seed++) {
        bl_signal *fresh = bl_signal_reseed(signal, seed);
        assert_near(bl_signal_value(fresh, (const double[BL_AXES]){16, -32}), 0, 0);
        assert_true(fabs(bl_signal_value(fresh, (const double[BL_AXES]){8, 8})) > 0);
        bl_signal_free(fresh);
    }
    bl_signal_free(signal);
}

// --- facts --------------------------------------------------------------------------------------

// One harmonic at a quarter of the rate, read by the cubic B-spline: its image at v + k has the
// power (v/(v + k))^8 of it. The band ends at the harmonic, and the leak is what the images have.
static void test_one_harmonic_states_its_images(void **state) {
    (void)state;
    bl_signal *signal = open_signal("fourier:dims=1,from=1,to=1");
    double all = 0, v = 0.25;
    for (int k = -1000; k <= 1000; k++)
        all += pow(v / (v + k), 8);
    double leak = 10 * log10(1 - 1 / all);
    assert_near(signal->facts.variance, all, 1e-12);
    assert_near(signal->facts.band_from, 0, 0);
    assert_near(signal->facts.band_to, 1, 0);
    assert_true(leak <= signal->facts.leak_db && signal->facts.leak_db < leak + 0.0101);
    assert_near(signal->facts.period[0], 64, 0); // 256 numbers, 4 a unit
    assert_near(signal->facts.cell, 0.25, 0);
    assert_near(signal->facts.far, 0x1p50, 0); // where doubles are multiples of 1/4
    bl_signal_free(signal);
    signal = open_signal("fourier:from=1/2,to=3/4,size=32");
    // Multiples of 1/8 in the plane: the largest length up to 3/4 is that of (6, 0).
    assert_near(signal->facts.band_to, 0.75, 0);
    bl_signal_free(signal);
}

// In one dimension the deviations of the levels are a geometric series; a value is at most their
// sum times 4 sqrt(3/4), over the deviation of the whole, times what reading can add: 5/4 for the
// spline of Catmull and Rom, 3 for numbers that were filtered for the B-spline.
static void test_displacements_state_their_range_and_variance(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bl_displacement of;
        double gain;
        int levels;
    } cases[] = {
        {"midpoint:dims=1,size=8",
         {.hurst = 0.5, .lacunarity = 2, .tile = {.size = {8}, .interp = BL_TILE_CATMULL_ROM}},
         1.25,
         3},
        {"midpoint:dims=1,size=16,hurst=1,interp=linear",
         {.hurst = 1, .lacunarity = 2, .tile = {.size = {16}, .interp = BL_TILE_LINEAR}},
         1,
         4},
        {"midpoint:dims=1,size=16,hurst=0.25,interp=bspline",
         {.hurst = 0.25, .lacunarity = 2, .tile = {.size = {16}, .interp = BL_TILE_BSPLINE3}},
         3,
         4},
        {"additions:dims=1,size=16,hurst=0.25,interp=nearest",
         {.hurst = 0.25,
          .all = 1,
          .lacunarity = 2,
          .tile = {.size = {16}, .interp = BL_TILE_NEAREST}},
         1,
         4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_displacement of = cases[i].of;
        bl_message message = {""};
        double variance, total = 0;
        of.tile.dimensions = 1;
        assert_int_equal(bl_displacement_variance(&of, &variance, &message), BL_OK);
        for (int level = 0; level < cases[i].levels; level++)
            total += pow(0.5, of.hurst * level);
        double bound = total * 4 * sqrt(0.75) / sqrt(variance) * cases[i].gain;
        bl_signal *signal = open_signal(cases[i].text);
        assert_near(signal->facts.upper, bound, 1e-4 * bound); // 3.4642 for 3.46410
        assert_near(signal->facts.lower, -bound, 1e-4 * bound);
        assert_near(signal->facts.variance, 1, 0);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fixed_amplitudes_have_the_target_spectrum),
        cmocka_unit_test(test_fixed_amplitudes_have_the_variance_exactly),
        cmocka_unit_test(test_gaussian_amplitudes_have_the_target_in_the_mean),
        cmocka_unit_test(test_gaussian_amplitudes_have_exponential_powers),
        cmocka_unit_test(test_a_table_is_the_spectrum),
        cmocka_unit_test(test_a_bad_table_is_refused_by_its_line),
        cmocka_unit_test(test_downsampling_undoes_upsampling),
        cmocka_unit_test(test_the_residual_is_orthogonal_to_the_coarse_splines),
        cmocka_unit_test(test_the_spectrum_of_the_residual),
        cmocka_unit_test(test_the_bound_of_wavelet_is_that_of_the_projection),
        cmocka_unit_test(test_projected_slices_leak_less_below_half_a_cycle),
        cmocka_unit_test(test_midpoint_variance_by_covariances),
        cmocka_unit_test(test_additions_variance_by_hats),
        cmocka_unit_test(test_the_slopes_are_near_those_of_fractional_motion),
        cmocka_unit_test(test_midpoint_is_pinned_at_its_first_point),
        cmocka_unit_test(test_one_harmonic_states_its_images),
        cmocka_unit_test(test_displacements_state_their_range_and_variance),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, bl_temporary_no_wisdom, NULL);
}
