// SPDX-License-Identifier: MIT
//
// The expected periodogram against its definition, its sum, and the bare closed form.
#include "tests/test.h"

#include "spectra/theory.h"
#include "tests/term_signals.h"

// From the definition: sum over all pairs of samples of w w' R e^(-2 pi i f (j - j')).
static double by_pairs(const bl_signal *signal, unsigned dims, const double d[3][BL_AXES],
                       double rate, size_t size, const double *w, const size_t bin[3]) {
    size_t count = 1, counts[3] = {1, 1, 1};
    for (unsigned a = 0; a < dims; a++)
        count *= counts[a] = size;
    double sum = 0, norm = 0;
    for (size_t p = 0; p < count; p++)
        for (size_t q = 0; q < count; q++) {
            size_t rest_p = p, rest_q = q;
            double weight = 1, turns = 0, lag[BL_AXES] = {0};
            for (unsigned a = 0; a < dims; a++) {
                size_t i = rest_p % size, j = rest_q % size;
                rest_p /= size;
                rest_q /= size;
                weight *= w[i] * w[j];
                double difference = (double)i - (double)j;
                turns += difference * (double)bin[a] / (double)size;
                for (int c = 0; c < BL_AXES; c++)
                    lag[c] += difference * d[a][c] / rate;
            }
            sum += weight * bl_terms_covariance(signal->parameters, lag) * cos(2 * M_PI * turns);
            norm += p == q ? weight : 0;
        }
    return sum / norm * pow(rate, -(double)dims);
}

static void check_periodogram(const bl_signal *signal, unsigned dims, const double axis[3],
                              double rate, size_t size, bl_window window) {
    double d[3][BL_AXES], w[64];
    bl_directions(dims, axis, d);
    bl_window_fill(window, size, w);
    size_t bins = size / 2 + 1, rows = dims > 1 ? size : 1, planes = dims > 2 ? size : 1;
    double *out = malloc(planes * rows * bins * sizeof *out);
    assert_int_equal(bl_theory_periodogram(signal, dims, d, rate, size, window, out, NULL), BL_OK);
    double peak = 0;
    for (size_t i = 0; i < planes * rows * bins; i++)
        peak = fmax(peak, out[i]);
    for (size_t i = 0; i < planes; i += 3)
        for (size_t j = 0; j < rows; j += 3)
            for (size_t k = 0; k < bins; k += 2) {
                size_t bin[3] = {k, 0, 0};
                if (dims == 2)
                    bin[0] = j, bin[1] = k;
                if (dims == 3)
                    bin[0] = i, bin[1] = j, bin[2] = k;
                assert_near(out[(i * rows + j) * bins + k],
                            by_pairs(signal, dims, d, rate, size, w, bin), 2e-13 * peak);
            }
    free(out);
}

static void test_periodogram_is_its_definition(void **state) {
    (void)state;
    const double z[3] = {0, 0, 1}, x[3] = {1, 0, 0}, oblique[3] = {1, 2, -1.5};
    bl_signal *gradient = make_signal(GRADIENT), *radial = make_signal(RADIAL);
    check_periodogram(gradient, 1, x, 4, 64, BL_WINDOW_BLACKMAN_HARRIS);
    check_periodogram(gradient, 1, oblique, 4, 45, BL_WINDOW_HANN);
    check_periodogram(gradient, 1, x, 16, 32, BL_WINDOW_RECTANGLE); // lags fold
    check_periodogram(radial, 1, oblique, 1, 64, BL_WINDOW_BLACKMAN_HARRIS);
    check_periodogram(gradient, 2, z, 2, 12, BL_WINDOW_BLACKMAN_HARRIS);
    check_periodogram(gradient, 2, oblique, 2, 15, BL_WINDOW_HANN);
    check_periodogram(gradient, 2, oblique, 8, 12, BL_WINDOW_BLACKMAN_HARRIS); // fold
    check_periodogram(gradient, 3, z, 1, 6, BL_WINDOW_HANN);
    check_periodogram(radial, 3, z, 2, 5, BL_WINDOW_BLACKMAN_HARRIS);
    bl_signal_free(gradient);
    bl_signal_free(radial);
}

// Summed over all frequencies it is the variance: r(0) = 1.
static void test_periodogram_sums_to_the_variance(void **state) {
    (void)state;
    const size_t sizes[3] = {2048, 512, 64};
    const double rates[3] = {16, 8, 4};
    bl_signal *signal = make_signal(GRADIENT);
    for (unsigned dims = 1; dims <= 3; dims++) {
        double d[3][BL_AXES];
        bl_directions(dims, (double[]){0, 0, 1}, d);
        size_t size = sizes[dims - 1], bins = size / 2 + 1, rows = 1;
        for (unsigned a = 1; a < dims; a++)
            rows *= size;
        double *out = malloc(rows * bins * sizeof *out), sum = 0;
        assert_int_equal(bl_theory_periodogram(signal, dims, d, rates[dims - 1], size,
                                               BL_WINDOW_BLACKMAN_HARRIS, out, NULL),
                         BL_OK);
        for (size_t i = 0; i < rows; i++)
            for (size_t k = 0; k < bins; k++)
                sum += out[i * bins + k] * (k == 0 || k == size / 2 ? 1 : 2);
        free(out);
        sum *= pow(rates[dims - 1] / (double)size, dims);
        assert_near(sum / variance_of(signal), 1, 1e-12);
    }
    bl_signal_free(signal);
}

// Far from alias and with a window that leaks little it is the bare closed form, smoothed.
static void test_periodogram_tends_to_the_bare_form(void **state) {
    (void)state;
    enum { SIZE = 4096 };
    bl_signal *signal = make_signal(CATMULL_ROM);
    double d[3][BL_AXES] = {{1}}, out[SIZE / 2 + 1];
    assert_int_equal(
        bl_theory_periodogram(signal, 1, d, 16, SIZE, BL_WINDOW_BLACKMAN_HARRIS, out, NULL), BL_OK);
    for (int k = 16; k < SIZE / 20; k += 7)
        assert_near(out[k] / bl_theory_line(signal, d[0], k * 16.0 / SIZE), 1, 1e-2);
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_periodogram_is_its_definition),
        cmocka_unit_test(test_periodogram_sums_to_the_variance),
        cmocka_unit_test(test_periodogram_tends_to_the_bare_form),
    };
    return bl_run_tests(tests);
}
