// SPDX-License-Identifier: MIT
//
// Confidence limits of the bins and of the variance.
//
// A mean of K averages, each of relative variance v (psd_spread.c), whose variance is `correlation`
// times that of independent ones, has dof = 2 K / (v correlation) degrees of freedom; its limits
// are dof P / chi2(1 - a/2, dof) .. dof P / chi2(a/2, dof). Where v is itself an estimate of f
// degrees of freedom, the tail a/2 is that of the normal law beyond Student's quantile of f, which
// for many degrees of freedom are Student's limits and for a known v those of chi-square. Where
// that tail is below 1e-12 the limits are Student's on a scale of logarithms.
#include <math.h>
#include <stdlib.h>

#include "spectra/psd_parts.h"

// Above 200 degrees of freedom the cube root of chi-square is normal (Wilson and Hilferty 1931) to
// within 1e-5 of the quantile at the levels in use, and costs nothing.
double bl_chi_square_ratio(double p, double dof) {
    if (dof < 200)
        return bl_chi_square_quantile(p, dof) / dof;
    double spread = 2 / (9 * dof), root = 1 - spread + bl_normal_quantile(p) * sqrt(spread);
    return root > 0 ? root * root * root : 0;
}

// Student's quantile of a tail; from 30 degrees of freedom on by its expansion around the normal
// one (Abramowitz and Stegun 26.7.5), good to 1e-5 there up to 4 standard deviations.
static double student_quantile(double p, double freedom) {
    if (freedom < 30)
        return bl_student_quantile(p, freedom);
    double z = bl_normal_quantile(p), s = z * z, f = 1 / freedom;
    double first = (s + 1) / 4, second = ((5 * s + 16) * s + 3) / 96;
    double third = (((3 * s + 19) * s + 17) * s - 15) / 384;
    return z * (1 + f * (first + f * (second + f * third)));
}

void bl_psd_limits_of(double value, double dof, double freedom, double level, double *lower,
                      double *upper) {
    double tail = 0.5 * (1 - level), reach = 0;
    if (!isinf(freedom)) {
        reach = -student_quantile(tail, freedom);
        tail = bl_normal_cdf(-reach);
    }
    *lower = 0;
    *upper = INFINITY;
    if (dof > 0 && tail > 1e-12) {
        *lower = value / bl_chi_square_ratio(1 - tail, dof);
        *upper = value / bl_chi_square_ratio(tail, dof);
    } else if (dof > 0) { // from 2 or 3 averages; 1 - tail has no digits left
        double factor = exp(reach * sqrt(2 / dof));
        *lower = value / factor;
        *upper = value * factor;
    }
    if (dof > 0 && value == 0)
        *upper = 0; // 0/0 where the quantile underflows
}

// The relative variance of the power of one average of a Gaussian signal with the measured
// spectrum, var = broadening sum over bins of 2 P^2 / cells; and E power^2 of a mean over K
// averages is P^2 (1 + 2/(cells K)).
static double gaussian_variance(const bl_psd *psd, const bl_bins *bins) {
    size_t stride = psd->count + 1;
    double total = 0, square = 0, averages = (double)psd->settings.averages;
    for (size_t bin = 0; bin < stride; bin++) {
        double power = 0;
        for (size_t k = 0; k < psd->settings.averages; k++)
            power += psd->profiles[k * stride + bin] / averages;
        total += power;
        if (bins->cells[bin] > 0)
            square += power * power / (bins->cells[bin] + 2 / averages) * 2 * bins->broad;
    }
    return total > 0 ? square / (total * total) : 0;
}

void bl_psd_fill_variance_limits(bl_psd *psd, const bl_bins *bins, const double *values) {
    double averages = (double)psd->settings.averages, level = psd->settings.level, square = 0;
    double mean = psd->variance.value, gauss = gaussian_variance(psd, bins);
    psd->variance.level = level;
    psd->variance.samples = averages;
    psd->variance.lower = psd->variance.upper = mean;
    if (!(mean > 0))
        return;
    double relative = gauss, freedom = INFINITY;
    if (averages > 1) {
        for (size_t k = 0; k < psd->settings.averages; k++)
            square += (values[k] / mean - 1) * (values[k] / mean - 1);
        double measured = fmin(square / (averages - 1), averages - 1);
        relative = measured / (1 - measured / averages);
        freedom = averages - 1;
        if (psd->alike > 0 && relative < gauss) { // they spread too little to tell
            relative = gauss;
            freedom = INFINITY;
        }
    }
    if (relative > 0)
        bl_psd_limits_of(mean, 2 * averages / (relative * psd->correlation), freedom, level,
                         &psd->variance.lower, &psd->variance.upper);
}

bl_status bl_psd_fill_limits(bl_psd *psd, const bl_bins *bins, double overlap, int on_grid,
                             bl_message *message) {
    size_t stride = psd->count + 1, averages = psd->settings.averages;
    bl_spread *spread = calloc(psd->count, sizeof *spread);
    if (!spread)
        return bl_report(message, BL_DEVICE, "out of memory for %zu bins", psd->count);
    for (size_t bin = 0; bin < psd->count; bin++) {
        double sum = 0;
        for (size_t k = 0; k < averages; k++)
            sum += psd->profiles[k * stride + bin];
        psd->psd[bin] = sum / (double)averages / psd->measure[bin];
    }
    psd->broadening = bins->broad;
    bl_status status = bl_psd_find_spread(psd, bins, overlap, on_grid, spread, message);
    for (size_t bin = 0; status == BL_OK && bin < psd->count; bin++) {
        // DC has lost the grand mean, and with it one of its values.
        double values = (double)(bin == 0 ? averages - 1 : averages);
        double dof = 2 * values / (spread[bin].relative * spread[bin].correlation);
        psd->dof[bin] = dof;
        bl_psd_limits_of(psd->psd[bin], dof, spread[bin].freedom, psd->settings.level,
                         &psd->lower[bin], &psd->upper[bin]);
    }
    free(spread);
    return status;
}
