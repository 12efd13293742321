// SPDX-License-Identifier: MIT
//
// Confidence limits of the bins: dof P / chi2(1 - a/2, dof) .. dof P / chi2(a/2, dof).
//
// One average of a bin of a Gaussian signal has nu = cells / broadening degrees of freedom (see
// psd_bins.c), a relative variance of 2/nu. Lattice noises are cyclostationary: the bins of one
// average share the variance of its place in the cell, a factor s with E s = 1 and Var s = c, and
// the relative variance is
//
//   v(c) = (2/nu) (1 + c) + c
//
// which for a line (nu = 2) inflates by 1 + 2c, and for a ring of many cells by far more. We find c
// from the averages themselves. For K values of a gamma law of relative variance v, mean m and
// sample variance V,  E[V/m^2] = v / (1 + v/K)  exactly; c is where the mean of that over 64
// neighbouring bins meets the measured one, clamped at 0. For K = 1 it is 0. The mean of K
// averages has 2 K / v degrees of freedom.
//
// The averages of a grid are neighbours, and may be alike. If so, the variance of means over m
// successive averages falls more slowly than 1/m: the largest excess, over m = 2, 4, ... while
// there are 8 means or more, divides the degrees of freedom, or the one that white noise has for
// the overlap of its windows where that is larger.
#include <math.h>
#include <stdlib.h>

#include "spectra/psd_parts.h"

enum { GROUP = 64 }; // bins that are judged together

static const double WEAK = 1e-6; // of the strongest bin: weaker ones are not asked for c

// Above 200 degrees of freedom the cube root of chi-square is normal (Wilson and Hilferty 1931) to
// within 1e-5 of the quantile at the levels in use, and costs nothing.
double bl_chi_square_ratio(double p, double dof) {
    if (dof < 200)
        return bl_chi_square_quantile(p, dof) / dof;
    double spread = 2 / (9 * dof), root = 1 - spread + bl_normal_quantile(p) * sqrt(spread);
    return root > 0 ? root * root * root : 0;
}

// V/m^2 of one bin over means of `span` successive averages, times span.
static double relative_variance(const bl_psd *psd, size_t bin, size_t span) {
    size_t groups = psd->settings.averages / span, stride = psd->count + 1;
    double sum = 0, square = 0;
    for (size_t g = 0; g < groups; g++) {
        double mean = 0;
        for (size_t k = g * span; k < (g + 1) * span; k++)
            mean += psd->profiles[k * stride + bin];
        sum += mean;
    }
    double centre = sum / (double)groups;
    for (size_t g = 0; g < groups; g++) {
        double mean = 0;
        for (size_t k = g * span; k < (g + 1) * span; k++)
            mean += psd->profiles[k * stride + bin];
        square += (mean - centre) * (mean - centre);
    }
    return square / (double)(groups - 1) / (centre * centre) * (double)span;
}

typedef struct bin_spread {
    double nu;       // degrees of freedom of one average of a Gaussian signal
    double relative; // measured V/m^2
    int strong;
} bin_spread;

static double expected(double nu, double shared, double averages) {
    double v = 2 / nu * (1 + shared) + shared;
    return v / (1 + v / averages);
}

// Solves mean expected(c) = mean measured by halving; the left side grows with c.
static double find_shared(const bin_spread *bins, size_t count, double averages) {
    double measured = 0, strong = 0, low = 0, high = averages;
    for (size_t i = 0; i < count; i++)
        if (bins[i].strong) {
            measured += bins[i].relative;
            strong++;
        }
    if (strong == 0 || averages < 2)
        return 0;
    for (int step = 0; step < 60; step++) {
        double middle = step == 0 ? 0 : 0.5 * (low + high), sum = 0;
        for (size_t i = 0; i < count; i++)
            if (bins[i].strong)
                sum += expected(bins[i].nu, middle, averages);
        if (sum < measured)
            low = middle;
        else
            high = middle;
        if (high == 0)
            break;
    }
    return low;
}

// The growth of the variance of means over m averages beyond 1/m, over all strong bins.
static double find_correlation(const bl_psd *psd, const bin_spread *spread) {
    double alone = 0, most = 1;
    for (size_t bin = 1; bin < psd->count; bin++)
        alone += spread[bin].strong ? spread[bin].relative : 0;
    for (size_t span = 2; psd->settings.averages / span >= 8 && alone > 0; span *= 2) {
        double joined = 0;
        for (size_t bin = 1; bin < psd->count; bin++)
            joined += spread[bin].strong ? relative_variance(psd, bin, span) : 0;
        most = fmax(most, joined / alone);
    }
    return most;
}

static void fill_spread(bl_psd *psd, const bl_bins *bins, bin_spread *spread) {
    double peak = 0, averages = (double)psd->settings.averages, measured = 0, exponential = 0;
    for (size_t bin = 1; bin < psd->count; bin++)
        peak = fmax(peak, psd->psd[bin]);
    for (size_t bin = 0; bin < psd->count; bin++) {
        spread[bin].nu = bins->cells[bin] / bins->broadening[bin];
        // The mean that was removed takes a part of the lowest bins away.
        spread[bin].strong = bin >= (size_t)bl_window_half_lobe(psd->settings.window) &&
                             psd->psd[bin] > WEAK * peak && averages > 1;
        if (!spread[bin].strong)
            continue;
        spread[bin].relative = relative_variance(psd, bin, 1);
        measured += spread[bin].relative;
        exponential += expected(spread[bin].nu, 0, averages);
    }
    psd->inflation = exponential > 0 ? fmax(1, measured / exponential) : 1;
}

static void fill_bin(bl_psd *psd, size_t bin, const bin_spread *spread, double shared) {
    double averages = (double)psd->settings.averages, tail = 0.5 * (1 - psd->settings.level);
    double relative = 2 / spread->nu * (1 + shared) + shared;
    // DC has lost the grand mean, and with it one of its values.
    double values = bin == 0 ? averages - 1 : averages;
    double dof = 2 * values / relative / psd->correlation;
    psd->dof[bin] = dof;
    psd->lower[bin] = dof > 0 ? psd->psd[bin] / bl_chi_square_ratio(1 - tail, dof) : 0;
    psd->upper[bin] = dof > 0 ? psd->psd[bin] / bl_chi_square_ratio(tail, dof) : INFINITY;
    if (dof > 0 && psd->psd[bin] == 0)
        psd->upper[bin] = 0; // 0/0 where the quantile underflows
}

// One average has no spread: the interval of its variance is that of a Gaussian signal with the
// measured spectrum, var V = broadening sum over bins of 2 P^2 / cells; and E power^2 of a bin is
// P^2 (1 + 2/cells).
static void fill_lone_variance(bl_psd *psd, const bl_bins *bins) {
    double total = 0, square = 0, tail = 0.5 * (1 - psd->settings.level);
    for (size_t bin = 0; bin <= psd->count; bin++) {
        double power = psd->profiles[bin];
        total += power;
        if (bins->cells[bin] > 0)
            square += power * power / (bins->cells[bin] + 2) * bins->broad;
    }
    bl_estimate *variance = &psd->variance;
    if (!(square > 0))
        return;
    double dof = total * total / square;
    variance->lower = variance->value / bl_chi_square_ratio(1 - tail, dof);
    variance->upper = variance->value / bl_chi_square_ratio(tail, dof);
}

bl_status bl_psd_fill_limits(bl_psd *psd, const bl_bins *bins, double overlap, int on_grid,
                             bl_message *message) {
    bin_spread *spread = calloc(psd->count, sizeof *spread);
    if (!spread)
        return bl_report(message, BL_DEVICE, "out of memory for %zu bins", psd->count);
    size_t stride = psd->count + 1, averages = psd->settings.averages;
    for (size_t bin = 0; bin < psd->count; bin++) {
        double sum = 0;
        for (size_t k = 0; k < averages; k++)
            sum += psd->profiles[k * stride + bin];
        psd->psd[bin] = sum / (double)averages / psd->measure[bin];
    }
    psd->broadening = bins->broad;
    fill_spread(psd, bins, spread);
    psd->correlation = on_grid ? fmax(overlap, find_correlation(psd, spread)) : overlap;
    for (size_t from = 0; from < psd->count; from += GROUP) {
        // The last group takes what is left, so that no group is small where there are more.
        size_t count = psd->count - from < 2 * GROUP ? psd->count - from : GROUP;
        double shared = find_shared(spread + from, count, (double)averages);
        for (size_t bin = from; bin < from + count; bin++)
            fill_bin(psd, bin, &spread[bin], shared);
        if (count != GROUP)
            break;
    }
    free(spread);
    if (averages == 1)
        fill_lone_variance(psd, bins);
    return BL_OK;
}
