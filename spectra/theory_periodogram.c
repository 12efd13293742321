// SPDX-License-Identifier: MIT
//
// The expectation of a windowed periodogram.
//
// With samples n_j at spacing h = 1/rate on a grid of `size` a side and the product window w,
//     E |sum_j w_j n_j e^(-2 pi i f_k j h)|^2 = sum_m R(m h) r(m) e^(-2 pi i k m / size) * sum w^2,
// where m runs over the differences of two samples and r(m) = sum_j w_j w_{j+m} / sum w_j^2 along
// each axis (not circular). Times h^dims / sum w^2 that is the expectation of the estimate, with
// every alias and all of the window's leak in it. No Fourier transform of the grid is needed: R
// reaches over a few lags, so we sum over these axis by axis, at a cost of size * lags a line.
// Lags that differ by `size` have the same exponential and are added first, so lags <= size.
#include "spectra/theory.h"

#include <math.h>
#include <stdlib.h>

enum { AXES = 3 };

typedef struct periodogram {
    unsigned dims;
    size_t size;
    size_t lags[AXES];        // after folding; 1 beyond dims
    long furthest[AXES];      // lags run from -furthest to furthest
    size_t bins[AXES];        // what each axis is transformed to
    double *cosine, *sine;    // of 2 pi k / size
    double *weight[AXES];     // r(m), m = 0..furthest
    double *real, *imaginary; // the array being transformed
    double *next_real, *next_imaginary;
} periodogram;

static void release(periodogram *p) {
    for (int a = 0; a < AXES; a++)
        free(p->weight[a]);
    free(p->cosine);
    free(p->sine);
    free(p->real);
    free(p->imaginary);
    free(p->next_real);
    free(p->next_imaginary);
}

// Any component of lag is at most the reach, so |lag . u| <= reach * sum |u_a|.
static long furthest_lag(const bl_signal *signal, const double u[BL_AXES], double rate,
                         size_t size) {
    double span = 0;
    for (int a = 0; a < BL_AXES; a++)
        span += fabs(u[a]);
    return (long)fmin((double)size - 1, ceil(signal->facts.covariance_reach * span * rate));
}

static int fill_weights(periodogram *p, int axis, const double *window) {
    size_t size = p->size;
    p->weight[axis] = malloc(((size_t)p->furthest[axis] + 1) * sizeof *p->weight[axis]);
    if (!p->weight[axis])
        return 0;
    for (size_t m = 0; m <= (size_t)p->furthest[axis]; m++) {
        double sum = 0;
        for (size_t j = 0; j + m < size; j++)
            sum += window[j] * window[j + m];
        p->weight[axis][m] = sum;
    }
    for (size_t m = (size_t)p->furthest[axis] + 1; m-- > 0;)
        p->weight[axis][m] /= p->weight[axis][0];
    return 1;
}

// Two buffers, each large enough for the array before and after every pass.
static int make_buffers(periodogram *p) {
    size_t most = 0;
    for (unsigned done = 0; done <= p->dims; done++) {
        size_t count = 1;
        for (unsigned a = 0; a < p->dims; a++)
            if (__builtin_mul_overflow(count, a < done ? p->bins[a] : p->lags[a], &count))
                return 0;
        most = count > most ? count : most;
    }
    p->real = calloc(most, sizeof *p->real);
    p->imaginary = calloc(most, sizeof *p->imaginary);
    p->next_real = malloc(most * sizeof *p->next_real);
    p->next_imaginary = malloc(most * sizeof *p->next_imaginary);
    return p->real && p->imaginary && p->next_real && p->next_imaginary;
}

static int prepare(periodogram *p, const bl_signal *signal, const double directions[3][BL_AXES],
                   double rate, bl_window window) {
    p->cosine = malloc(p->size * sizeof *p->cosine);
    p->sine = malloc(p->size * sizeof *p->sine);
    if (!p->cosine || !p->sine)
        return 0;
    bl_window_fill(window, p->size, p->cosine);
    for (int a = 0; a < AXES; a++) {
        int used = (unsigned)a < p->dims;
        p->furthest[a] = used ? furthest_lag(signal, directions[a], rate, p->size) : 0;
        size_t all = 2 * (size_t)p->furthest[a] + 1;
        p->lags[a] = all < p->size ? all : used ? p->size : 1;
        p->bins[a] = (unsigned)a + 1 == p->dims ? p->size / 2 + 1 : p->size;
        if (!fill_weights(p, a, p->cosine))
            return 0;
    }
    for (size_t k = 0; k < p->size; k++) {
        double angle = 2 * M_PI * (double)k / (double)p->size;
        p->cosine[k] = cos(angle);
        p->sine[k] = sin(angle);
    }
    return make_buffers(p);
}

// Where lag m stands in the array: -m from the end.
static size_t slot(const periodogram *p, int axis, long m) {
    long lags = (long)p->lags[axis];
    return (size_t)(m < 0 ? m + lags : m % lags);
}

// The lag of a slot, modulo the size.
static size_t lag_of(const periodogram *p, unsigned axis, size_t index) {
    size_t lags = p->lags[axis];
    return lags == p->size || index <= lags / 2 ? index : index + p->size - lags;
}

static void fill_covariance(periodogram *p, const bl_signal *signal,
                            const double directions[3][BL_AXES], double rate) {
    for (long i = -p->furthest[0]; i <= p->furthest[0]; i++)
        for (long j = -p->furthest[1]; j <= p->furthest[1]; j++)
            for (long k = -p->furthest[2]; k <= p->furthest[2]; k++) {
                double lag[BL_AXES];
                for (int a = 0; a < BL_AXES; a++)
                    lag[a] = ((double)i * directions[0][a] + (double)j * directions[1][a] +
                              (double)k * directions[2][a]) /
                             rate;
                size_t at =
                    (slot(p, 0, i) * p->lags[1] + slot(p, 1, j)) * p->lags[2] + slot(p, 2, k);
                p->real[at] += signal->functions->covariance(signal->parameters, lag) *
                               p->weight[0][labs(i)] * p->weight[1][labs(j)] *
                               p->weight[2][labs(k)];
            }
}

// [lags][inner] -> [bins][inner] for each of `outer` blocks.
static void transform_axis(const periodogram *p, unsigned axis, size_t outer, size_t inner) {
    size_t lags = p->lags[axis], bins = p->bins[axis];
    for (size_t o = 0; o < outer; o++)
        for (size_t k = 0; k < bins; k++) {
            double *real = p->next_real + (o * bins + k) * inner;
            double *imaginary = p->next_imaginary + (o * bins + k) * inner;
            for (size_t i = 0; i < inner; i++)
                real[i] = imaginary[i] = 0;
            for (size_t m = 0; m < lags; m++) {
                size_t turn = k * lag_of(p, axis, m) % p->size;
                double c = p->cosine[turn], s = -p->sine[turn];
                const double *from = p->real + (o * lags + m) * inner;
                const double *from_imaginary = p->imaginary + (o * lags + m) * inner;
                for (size_t i = 0; i < inner; i++) {
                    real[i] += c * from[i] - s * from_imaginary[i];
                    imaginary[i] += s * from[i] + c * from_imaginary[i];
                }
            }
        }
}

// The last axis; only the real part is needed: R(-lag) = R(lag) makes the whole real. The rows of
// cosines are made once a lag and used for every block.
static void transform_last(periodogram *p, size_t outer, double *out) {
    unsigned axis = p->dims - 1;
    size_t lags = p->lags[axis], bins = p->bins[axis];
    double *cosine = p->next_real, *sine = p->next_imaginary; // bins <= what the buffers hold
    for (size_t i = 0; i < outer * bins; i++)
        out[i] = 0;
    for (size_t m = 0; m < lags; m++) {
        size_t lag = lag_of(p, axis, m), turn = 0;
        for (size_t k = 0; k < bins; k++) {
            cosine[k] = p->cosine[turn];
            sine[k] = p->sine[turn];
            turn += lag;
            turn -= turn >= p->size ? p->size : 0;
        }
        for (size_t o = 0; o < outer; o++) {
            double real = p->real[o * lags + m], imaginary = p->imaginary[o * lags + m];
            for (size_t k = 0; k < bins; k++)
                out[o * bins + k] += real * cosine[k] + imaginary * sine[k];
        }
    }
}

static void swap(double **a, double **b) {
    double *keep = *a;
    *a = *b;
    *b = keep;
}

static void transform(periodogram *p, double *out) {
    size_t outer = 1, inner = 1;
    for (unsigned a = 1; a < p->dims; a++)
        inner *= p->lags[a];
    for (unsigned a = 0; a + 1 < p->dims; a++) {
        transform_axis(p, a, outer, inner);
        swap(&p->real, &p->next_real);
        swap(&p->imaginary, &p->next_imaginary);
        outer *= p->bins[a];
        inner /= p->lags[a + 1];
    }
    transform_last(p, outer, out);
}

bl_status bl_theory_periodogram(const bl_signal *signal, unsigned dims,
                                const double directions[3][BL_AXES], double rate, size_t size,
                                bl_window window, double *out, bl_message *message) {
    if (!bl_signal_has_closed_form(signal))
        return bl_report(message, BL_MISMATCH,
                         "%s: no closed form of its spectrum for these settings; measure without "
                         "the theory",
                         signal->text);
    if (!bl_theory_reaches(signal, dims, directions))
        return bl_report(message, BL_MISMATCH, "%s has %u dimension%s, and a direction leaves them",
                         signal->text, signal->dimensions, signal->dimensions == 1 ? "" : "s");
    // The axes not used have direction 0, one lag and weight 1.
    double used[3][BL_AXES] = {{0}};
    for (unsigned d = 0; d < dims; d++)
        for (int a = 0; a < BL_AXES; a++)
            used[d][a] = directions[d][a];
    periodogram p = {.dims = dims, .size = size};
    if (!prepare(&p, signal, used, rate, window)) {
        release(&p);
        return bl_report(message, BL_DEVICE, "out of memory for a spectrum of size %zu in %u axes",
                         size, dims);
    }
    fill_covariance(&p, signal, used, rate);
    transform(&p, out);
    size_t count = 1;
    for (unsigned a = 0; a < dims; a++)
        count *= p.bins[a];
    double scale = pow(rate, -(double)dims);
    for (size_t i = 0; i < count; i++)
        out[i] = fmax(0, scale * out[i]); // never negative but for rounding
    release(&p);
    return BL_OK;
}
