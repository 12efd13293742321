// SPDX-License-Identifier: MIT
//
// Shares of the variance in a band.
//
// A bin that an edge cuts counts in proportion. Four averages and more give the interval of the
// share as a ratio of sums over averages; fewer, as for a single large slice, by the degrees of
// freedom of the bins: with A the power in the band, B the power outside, T = A + B,
//
//   var A = broadening sum over bins of share^2 power^2 2/(cells K),   F = A/T,
//   var F = ((1-F)^2 var A + F^2 var B) / T^2
//
// and the interval is symmetric in log(F/(1-F)), which keeps it inside of 0..1. The averages of a
// grid that are alike tell nothing by their spread: then the wider of both intervals holds.
#include <math.h>
#include <stdlib.h>

#include "spectra/psd_parts.h"
#include "spectra/theory.h"

// The part of a bin that lies in [from, to]. DC reaches from 0, the last bin ends at Nyquist.
static double share_of_bin(const bl_psd *psd, size_t bin, double from, double to) {
    double step = psd->width[bin], nyquist = 0.5 * psd->settings.rate;
    double low = bin ? step * ((double)bin - 0.5) : 0;
    double high = fmin(step * ((double)bin + 0.5), nyquist);
    double inside = fmin(high, to) - fmax(low, from);
    return inside > 0 ? fmin(1, inside / (high - low)) : 0;
}

static double share_of_corners(const bl_psd *psd, double to) {
    return to >= sqrt((double)psd->settings.dims) * 0.5 * psd->settings.rate ? 1 : 0;
}

static double share(const bl_psd *psd, size_t bin, double from, double to) {
    return bin < psd->count ? share_of_bin(psd, bin, from, to) : share_of_corners(psd, to);
}

// Cells of the full spectrum in a bin.
static double cells_of(const bl_psd *psd, size_t bin) {
    if (psd->settings.dims == 1) // a line has no corners
        return bin == 0 || 2 * bin == psd->settings.size ? 1 : bin < psd->count ? 2 : 0;
    double dims = (double)psd->settings.dims, cell = pow(psd->width[0], dims), all = 0;
    if (bin < psd->count)
        return psd->measure[bin] / cell;
    for (size_t b = 0; b < psd->count; b++)
        all += psd->measure[b] / cell;
    return pow((double)psd->settings.size, dims) - all;
}

static double invert_logit(double x) {
    return 1 / (1 + exp(-x));
}

// The interval from the degrees of freedom of the bins, for few averages.
static bl_estimate share_by_freedom(const bl_psd *psd, double from, double to, int outside,
                                    double missed) {
    double averages = (double)psd->settings.averages, in = 0, out = 0, var_in = 0, var_out = 0;
    for (size_t bin = 0; bin <= psd->count; bin++) {
        double power = 0, part = share(psd, bin, from, to), cells = cells_of(psd, bin);
        part = outside ? 1 - part : part;
        for (size_t k = 0; k < psd->settings.averages; k++)
            power += psd->profiles[k * (psd->count + 1) + bin] / averages;
        if (!(cells > 0))
            continue;
        // The square of an estimate of few degrees of freedom is too large by 1 + 2/dof.
        double square = power * power / (1 + 2 / (cells * averages));
        double variance = 2 * square * psd->broadening * psd->correlation / (cells * averages);
        in += part * power;
        out += (1 - part) * power;
        var_in += part * part * variance;
        var_out += (1 - part) * (1 - part) * variance;
    }
    bl_estimate estimate = {0, 0, 0, 1 - missed, averages};
    if (!(in > 0))
        return estimate;
    if (!(out > 0)) {
        estimate.value = estimate.lower = estimate.upper = 1;
        return estimate;
    }
    double f = in / (in + out);
    double spread = sqrt((1 - f) * (1 - f) * var_in + f * f * var_out) / (in + out);
    double logit = log(in / out), reach = -bl_normal_quantile(0.5 * missed) * spread;
    estimate.value = f;
    estimate.lower = invert_logit(logit - reach / (f * (1 - f)));
    estimate.upper = invert_logit(logit + reach / (f * (1 - f)));
    return estimate;
}

bl_estimate bl_psd_band_share(const bl_psd *psd, double from, double to, int outside,
                              const double *less, double missed) {
    size_t averages = psd->settings.averages, stride = psd->count + 1;
    double *pairs = averages >= 4 ? calloc(2 * averages, sizeof *pairs) : NULL;
    if (!pairs) // few averages; or no memory for the better way
        return share_by_freedom(psd, from, to, outside, missed);
    double whole = 0, part_sum = 0;
    for (size_t bin = 0; bin <= psd->count; bin++) {
        double part = share(psd, bin, from, to);
        part = outside ? 1 - part : part;
        for (size_t k = 0; k < averages; k++) {
            double power = psd->profiles[k * stride + bin];
            pairs[k] += part * power;
            pairs[averages + k] += power;
            part_sum += part * power;
            whole += power;
        }
    }
    for (size_t k = 0; less && k < averages; k++) {
        double taken = fmin(less[k], pairs[k]);
        pairs[k] -= taken;
        part_sum -= taken;
    }
    bl_estimate estimate = {0, 0, 0, 1 - missed, (double)averages};
    if (whole > 0 && part_sum > 0) {
        estimate = bl_ratio_estimate_missing(pairs, pairs + averages, averages, missed);
        double widen = sqrt(psd->correlation), value = estimate.value;
        estimate.lower = fmax(0, value - widen * (value - estimate.lower));
        estimate.upper = fmin(1, value + widen * (estimate.upper - value));
        if (psd->alike > 0) {
            bl_estimate freedom = share_by_freedom(psd, from, to, outside, missed);
            estimate.lower = fmin(estimate.lower, freedom.lower);
            estimate.upper = fmax(estimate.upper, freedom.upper);
        }
    }
    free(pairs);
    return estimate;
}

void bl_psd_band(const bl_psd *psd, bl_band *band) {
    band->fraction = bl_psd_band_share(psd, band->from, band->to, 0, NULL, 1 - psd->settings.level);
    band->theory = band->exact = NAN;
    if (!psd->theory)
        return;
    double all = *psd->theory_corners, in = share_of_corners(psd, band->to) * all;
    for (size_t bin = 0; bin < psd->count; bin++) {
        double power = psd->theory[bin] * psd->measure[bin];
        in += share_of_bin(psd, bin, band->from, band->to) * power;
        all += power;
    }
    band->theory = in / all;
}

double bl_psd_exact_share(const bl_signal *signal, const bl_psd_settings *settings, double from,
                          double to) {
    double directions[3][BL_AXES];
    if (settings->place != BL_PLACE_RANDOM || signal->extent.size[0] ||
        !bl_directions(settings->dims, settings->axis, directions))
        return NAN;
    return bl_theory_band(signal, settings->dims, directions, from, to);
}
