// SPDX-License-Identifier: MIT
#include "aliasing/predict.h"

#include <math.h>
#include <stdlib.h>

#include "spectra/theory.h"

// The directions of rows and columns of an upright square grid in the signal, and the length of a
// pixel there; 0 if it is none.
static double square_pixel(const bl_view *view, double directions[3][BL_AXES]) {
    bl_sight sight;
    double across = 0, down = 0, product = 0;
    if (!view->kind->affine || view->width != view->height || !bl_view_see(view, 0, 0, &sight))
        return 0;
    for (int a = 0; a < BL_AXES; a++) {
        across += sight.across[a] * sight.across[a];
        down += sight.down[a] * sight.down[a];
        product += sight.across[a] * sight.down[a];
    }
    if (!(across > 0) || fabs(across - down) > 1e-12 * across || fabs(product) > 1e-12 * across)
        return 0;
    for (int a = 0; a < BL_AXES; a++) {
        directions[0][a] = sight.down[a] / sqrt(across); // the axis that changes slowest
        directions[1][a] = sight.across[a] / sqrt(across);
        directions[2][a] = 0;
    }
    return sqrt(across);
}

// The density sums to the variance over frequencies that stand `step` cycles per pixel apart.
static bl_prediction weigh(const double *density, size_t size, size_t width, double unit,
                           const bl_method *method) {
    bl_prediction sum = {0, 0};
    const double step = 1 / (double)width;
    for (size_t j = 0; j < size; j++) {
        double fy = step * (j <= size / 2 ? (double)j : (double)j - (double)size);
        for (size_t i = 0; i <= size / 2; i++) {
            double fx = step * (double)i, h = method->kind->response(method->parameters, fx, fy);
            double power =
                (i == 0 || 2 * i == size ? 1 : 2) * unit * density[j * (size / 2 + 1) + i];
            if (fabs(fx) < 0.5 && fabs(fy) < 0.5)
                sum.blur += (1 - h) * (1 - h) * power;
            else
                sum.alias += h * h * power;
        }
    }
    return sum;
}

bl_status bl_predict_energies(const bl_signal *signal, const bl_view *view, const bl_method *method,
                              size_t oversample, bl_prediction *prediction, int *known,
                              bl_message *message) {
    double directions[3][BL_AXES];
    const double pixel = square_pixel(view, directions);
    const size_t size = view->width * oversample;
    *prediction = (bl_prediction){NAN, NAN};
    *known = 0;
    if (pixel <= 0 || !bl_signal_has_closed_form(signal) || !method->kind->response ||
        isnan(method->kind->response(method->parameters, 0, 0)) ||
        !bl_theory_reaches(signal, 2, (const double(*)[BL_AXES])directions))
        return BL_OK;
    double *density = malloc(size * (size / 2 + 1) * sizeof *density);
    if (!density)
        return bl_report(message, BL_DEVICE, "out of memory for the closed form of a spectrum");
    bl_status status =
        bl_theory_periodogram(signal, 2, (const double(*)[BL_AXES])directions,
                              (double)oversample / pixel, size, BL_WINDOW_HANN, density, message);
    double frequency = 1 / (pixel * (double)view->width); // between neighbours, cycles per unit
    if (status == BL_OK) {
        *prediction = weigh(density, size, view->width, frequency * frequency, method);
        *known = 1;
    }
    free(density);
    return status;
}
