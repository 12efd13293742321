// SPDX-License-Identifier: MIT
//
// Cosine-sum windows: w[n] = sum_j (-1)^j a_j cos(2 pi j n / size).
#include "spectra/window.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/registry.h"
#include "core/sinc.h"

enum { TERMS = 4 };

typedef struct window_entry {
    const char *name;
    double a[TERMS];
    double half_lobe;  // bins from the centre of the main lobe to its first zero
    double side_lobes; // the share of the power beyond it: 1 - the integral of |W|^2 to the zero
} window_entry;

// Coefficients: Harris 1978, table 1 (minimum 4-sample Blackman-Harris) and the definition of Hann.
static const window_entry windows[BL_WINDOW_COUNT] = {
    [BL_WINDOW_BLACKMAN_HARRIS] = {"blackman-harris",
                                   {0.35875, 0.48829, 0.14128, 0.01168},
                                   4,
                                   1.201e-9},
    [BL_WINDOW_HANN] = {"hann", {0.5, 0.5, 0, 0}, 2, 5.1444e-4},
    [BL_WINDOW_RECTANGLE] = {"rectangle", {1, 0, 0, 0}, 1, 0.0971767},
};

const char *bl_window_name(bl_window window) {
    return (unsigned)window < BL_WINDOW_COUNT ? windows[window].name : "unknown";
}

bl_status bl_window_read(const char *word, bl_window *window, bl_message *message) {
    for (unsigned i = 0; i < BL_WINDOW_COUNT; i++)
        if (strcmp(word, windows[i].name) == 0) {
            *window = (bl_window)i;
            return BL_OK;
        }
    const char *words[BL_WINDOW_COUNT + 1] = {0};
    for (unsigned i = 0; i < BL_WINDOW_COUNT; i++)
        words[i] = windows[i].name;
    return bl_report_unknown(&(bl_unknown){.what = "window", .word = word, .words = words},
                             message);
}

// The window at an angle; cos(2p) and cos(3p) from cos(p), Chebyshev's polynomials.
static double window_at(bl_window window, double phase) {
    const double *a = windows[window].a;
    double c = cos(phase);
    return a[0] - a[1] * c + a[2] * (2 * c * c - 1) - a[3] * ((4 * c * c - 3) * c);
}

void bl_window_fill(bl_window window, size_t size, double *out) {
    // One half, and its mirror: w[n] == w[size - n] exactly.
    for (size_t n = 0; n <= size / 2 && n < size; n++)
        out[n] = window_at(window, 2 * M_PI * (double)n / (double)size);
    for (size_t n = size / 2 + 1; n < size; n++)
        out[n] = out[size - n];
}

double bl_window_half_lobe(bl_window window) {
    return windows[window].half_lobe;
}

double bl_window_kernel(bl_window window, double bins) {
    const double *a = windows[window].a;
    double sum = a[0] * bl_sinc(bins), squares = a[0] * a[0];
    for (int j = 1; j < TERMS; j++) {
        sum += 0.5 * a[j] * (bl_sinc(bins - j) + bl_sinc(bins + j));
        squares += 0.5 * a[j] * a[j];
    }
    return sum * sum / squares;
}

double bl_window_side_lobes(bl_window window) {
    return windows[window].side_lobes;
}

// The coefficient of exp(i j phase) in w.
static double coefficient(bl_window window, long j) {
    long order = labs(j);
    if (order >= TERMS)
        return 0;
    double a = windows[window].a[order] * (order % 2 ? -1 : 1);
    return order ? 0.5 * a : a;
}

// The coefficient of exp(i j phase) in w^2.
static double square_coefficient(bl_window window, long j) {
    double sum = 0;
    for (long i = 1 - TERMS; i < TERMS; i++)
        sum += coefficient(window, i) * coefficient(window, j - i);
    return sum;
}

double bl_window_correlation(bl_window window, size_t size, size_t offset) {
    // The transform of w^2 over the samples: the harmonics that are equal modulo the size, added.
    size_t shift = offset % size, least = shift < size - shift ? shift : size - shift;
    double here = 0, centre = 0;
    long last = 2 * (TERMS - 1);
    if (least > (size_t)last)
        return 0;
    long period = size < 64 ? (long)size : 64; // beyond the harmonics any period is as good
    for (long j = -last; j <= last; j++) {
        if ((j - (long)least) % period == 0)
            here += square_coefficient(window, j);
        if (j % period == 0)
            centre += square_coefficient(window, j);
    }
    return here / centre * (here / centre);
}

double bl_window_overlap(bl_window window, size_t size, size_t shift) {
    double sum = 0, product = 0, step = 2 * M_PI / (double)size;
    for (size_t n = 0; n < size; n++) {
        double w = window_at(window, step * (double)n);
        sum += w * w;
        if (n + shift < size)
            product += w * window_at(window, step * (double)(n + shift));
    }
    return product / sum * (product / sum);
}
