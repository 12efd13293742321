// SPDX-License-Identifier: MIT
//
// Cosine-sum windows: w[n] = sum_j (-1)^j a_j cos(2 pi j n / size).
#include "spectra/window.h"

#include <math.h>
#include <string.h>

#include "core/grammar.h"

enum { TERMS = 4 };

typedef struct window_entry {
    const char *name;
    double a[TERMS];
    double half_lobe; // bins from the centre of the main lobe to its first zero
} window_entry;

// Coefficients: Harris 1978, table 1 (minimum 4-sample Blackman-Harris) and the definition of Hann.
static const window_entry windows[BL_WINDOW_COUNT] = {
    [BL_WINDOW_BLACKMAN_HARRIS] = {"blackman-harris", {0.35875, 0.48829, 0.14128, 0.01168}, 4},
    [BL_WINDOW_HANN] = {"hann", {0.5, 0.5, 0, 0}, 2},
    [BL_WINDOW_RECTANGLE] = {"rectangle", {1, 0, 0, 0}, 1},
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
    const char *candidates[BL_WINDOW_COUNT + 1] = {0};
    for (unsigned i = 0; i < BL_WINDOW_COUNT; i++)
        candidates[i] = windows[i].name;
    const char *nearest = bl_nearest(word, candidates);
    return bl_report(message, BL_USAGE,
                     "unknown window '%s'%s%s%s; there are blackman-harris, hann and rectangle",
                     word, nearest ? ", did you mean '" : "", nearest ? nearest : "",
                     nearest ? "'?" : "");
}

void bl_window_fill(bl_window window, size_t size, double *out) {
    const double *a = windows[window].a;
    for (size_t n = 0; n < size; n++) {
        // The symmetric half is taken from the smaller angle, so that w[n] == w[size - n] exactly.
        size_t m = n <= size - n ? n : size - n;
        double phase = 2 * M_PI * (double)m / (double)size;
        out[n] = a[0] - a[1] * cos(phase) + a[2] * cos(2 * phase) - a[3] * cos(3 * phase);
    }
}

double bl_window_half_lobe(bl_window window) {
    return windows[window].half_lobe;
}

double bl_window_correlation(bl_window window, size_t size, size_t offset) {
    // w^2 is a cosine sum of twice the terms: its transform has at most 2*TERMS - 1 harmonics, and
    // the sum over n is exact.
    double sum = 0, cosine = 0;
    const double *a = windows[window].a;
    for (size_t n = 0; n < size; n++) {
        double phase = 2 * M_PI * (double)n / (double)size;
        double w = a[0] - a[1] * cos(phase) + a[2] * cos(2 * phase) - a[3] * cos(3 * phase);
        sum += w * w;
        cosine += w * w * cos(phase * (double)(offset % size));
    }
    return cosine / sum * (cosine / sum);
}

double bl_window_overlap(bl_window window, size_t size, size_t shift) {
    const double *a = windows[window].a;
    double sum = 0, product = 0, power[2];
    for (size_t n = 0; n < size; n++) {
        for (size_t k = 0; k < 2; k++) {
            double phase = 2 * M_PI * (double)(n + k * shift) / (double)size;
            power[k] = a[0] - a[1] * cos(phase) + a[2] * cos(2 * phase) - a[3] * cos(3 * phase);
        }
        sum += power[0] * power[0];
        if (n + shift < size)
            product += power[0] * power[1];
    }
    return product / sum * (product / sum);
}
