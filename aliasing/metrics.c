// SPDX-License-Identifier: MIT
#include "aliasing/metrics.h"

#include <math.h>

enum { WINDOW = 11 }; // pixels a side

bl_image_error bl_image_compare(const double *image, const double *reference, size_t count) {
    bl_image_error error = {0, 0};
    for (size_t i = 0; i < count; i++) {
        double difference = fabs(image[i] - reference[i]);
        error.mse += difference * difference;
        if (isnan(difference) || difference > error.largest)
            error.largest = isnan(error.largest) ? error.largest : difference;
    }
    error.mse /= (double)count;
    return error;
}

double bl_psnr_db(double mse) {
    return -10 * log10(mse);
}

static void fill_window(double weight[WINDOW]) {
    double sum = 0;
    for (int i = 0; i < WINDOW; i++) {
        double t = (double)(i - WINDOW / 2) / 1.5;
        weight[i] = exp(-0.5 * t * t);
        sum += weight[i];
    }
    for (int i = 0; i < WINDOW; i++)
        weight[i] /= sum;
}

// The similarity in the window whose upper left pixel the pointers show.
static double similarity(const double *image, const double *reference, size_t width,
                         const double weight[WINDOW]) {
    const double luminance = 0.01 * 0.01, contrast = 0.03 * 0.03;
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (size_t j = 0; j < WINDOW; j++)
        for (size_t i = 0; i < WINDOW; i++) {
            double w = weight[i] * weight[j], x = image[j * width + i],
                   y = reference[j * width + i];
            a += w * x;
            b += w * y;
            aa += w * x * x;
            bb += w * y * y;
            ab += w * x * y;
        }
    return (2 * a * b + luminance) * (2 * (ab - a * b) + contrast) /
           ((a * a + b * b + luminance) * (aa - a * a + bb - b * b + contrast));
}

bl_estimate bl_ssim(const double *image, const double *reference, size_t width, size_t height,
                    double level) {
    double weight[WINDOW];
    bl_moments moments = {0};
    if (width < WINDOW || height < WINDOW)
        return (bl_estimate){NAN, NAN, NAN, level, 0};
    fill_window(weight);
    for (size_t j = 0; j + WINDOW <= height; j++)
        for (size_t i = 0; i + WINDOW <= width; i++) {
            size_t corner = j * width + i;
            bl_moments_add(&moments, similarity(image + corner, reference + corner, width, weight));
        }
    double places = fmax(2, floor(moments.n / (WINDOW * WINDOW)));
    double half = bl_student_quantile(0.5 + 0.5 * level, places - 1) *
                  sqrt(bl_moments_variance(&moments) / places);
    if (moments.n < 2)
        half = NAN;
    return (bl_estimate){moments.mean, moments.mean - half, fmin(1, moments.mean + half), level,
                         places};
}
