// SPDX-License-Identifier: MIT
//
// How much each bin differs between the averages, found from the averages themselves.
//
// One average of a bin of a Gaussian signal has nu = cells / broadening degrees of freedom (see
// psd_bins.c), a relative variance of 2/nu. Lattice noises have more: the bins of one average share
// the variance of its place in the cell; bins that differ by a whole cycle hold the same lattice
// numbers; the power of a ring may stand in a few of its cells; a bin at half a cycle is its own
// mirror. All of these change with the frequency, so each bin asks its neighbours only.
//
// For K values of a gamma law of relative variance v, mean m and sample variance V,
// E[V/m^2] = v / (1 + v/K)  exactly. R, the sum of V/m^2 over the neighbours times the bin's share
// in what it would be for a Gaussian signal, gives v. Neighbours are taken until there are 96
// values on each side, but no further than a quarter of the bin's number, because the lowest rings
// change fastest. A bin that stands out (V/m^2 has a relative variance of 2 (1 + v)/K) has no less
// than its own V/m^2 one and a half standard deviations down. No bin has less than a Gaussian
// signal's 2/nu.
//
// The part of v beyond 2/nu is an estimate. Neighbours may be no help, if what they share is the
// same, so it has (K - 1)/(1 + v) degrees of freedom; the part 2/nu is known. Both together have,
// by Satterthwaite (1946), (K - 1)/(1 + v) v^2 / (v - 2/nu)^2.
//
// The averages of a grid are neighbours, and may be alike, in two ways. If those that follow one
// another are alike, the variance of means over m successive averages falls more slowly than 1/m:
// the largest excess, over m = 2, 4, ... while there are 8 means or more, multiplies the variance
// of the mean; or the one that white noise has for the overlap of its windows, where that is
// larger. If all of them have a part in common, they spread less than a Gaussian signal would: R is
// 1 - rho of what it should be, and the variance of the mean is 1 + (K - 1) rho times that of
// independent averages; equal averages are one. This is judged over 64 bins, and taken only where R
// is too small by four standard deviations. A deterministic grid spreads less for another reason;
// then its limits are too wide, never too narrow.
#include <math.h>
#include <stdlib.h>

#include "spectra/psd_parts.h"

enum {
    VALUES = 96, // of the neighbours on one side
    WIDE = 32    // bins on one side that judge together whether averages are alike
};

// Of the mean density over all cells: below it stands the rounding of float samples and of the
// float transforms, which is no part of the signal. (2^-24)^2, and 16 for the sums.
static const double ROUNDING = 16 * 0x1p-48;

typedef struct bin_spread {
    double gauss;    // relative variance of one average of a Gaussian signal
    double expected; // V/m^2 of it
    double measured; // V/m^2
    int strong;      // above the rounding
} bin_spread;

static double expected_of(double relative, double averages) {
    return relative / (1 + relative / averages);
}

// The inverse. All power in one of K averages is V/m^2 = K, no gamma law's.
static double relative_of(double expected, double averages) {
    expected = fmin(expected, averages - 1);
    return expected / (1 - expected / averages);
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
        square += (mean / centre - 1) * (mean / centre - 1);
    }
    return square / (double)(groups - 1) * (double)span;
}

static void measure_bins(bl_psd *psd, const bl_bins *bins, bin_spread *spread) {
    double power = 0, cells = 0, averages = (double)psd->settings.averages;
    double measured = 0, expected = 0;
    for (size_t bin = 0; bin < psd->count; bin++) {
        power += psd->psd[bin] * psd->measure[bin];
        cells += psd->measure[bin];
    }
    for (size_t bin = 0; bin < psd->count; bin++) {
        bin_spread *s = &spread[bin];
        s->gauss = 2 * bins->broadening[bin] / bins->cells[bin];
        s->expected = expected_of(s->gauss, averages);
        s->strong = averages > 1 && psd->psd[bin] > ROUNDING * power / cells;
        if (!s->strong)
            continue;
        s->measured = relative_variance(psd, bin, 1);
        // The mean that was removed takes a part of the lowest bins away.
        if (bin >= (size_t)bl_window_half_lobe(psd->settings.window)) {
            measured += s->measured;
            expected += s->expected;
        }
    }
    psd->inflation = expected > 0 ? fmax(1, measured / expected) : 1;
}

// --- one bin ---

static void fit_bin(const bin_spread *spread, size_t count, size_t bin, double averages,
                    bl_spread *fit) {
    const bin_spread *own = &spread[bin];
    size_t reach = (size_t)(VALUES / averages), most = bin / 4 > 2 ? bin / 4 : 2;
    reach = reach < most ? reach : most;
    size_t from = bin > reach ? bin - reach : 0;
    size_t to = bin + reach < count ? bin + reach : count - 1;
    double measured = 0, expected = 0;
    for (size_t i = from; i <= to; i++)
        if (spread[i].strong) {
            measured += spread[i].measured;
            expected += spread[i].expected;
        }
    fit->relative = own->gauss;
    if (expected > 0)
        fit->relative = relative_of(measured / expected * own->expected, averages);
    if (own->strong) {
        double noise = sqrt(2 * (1 + fit->relative) / averages);
        double alone = relative_of(own->measured, averages) / (1 + 1.5 * noise);
        fit->relative = fmax(fit->relative, alone);
    }
    fit->freedom = INFINITY;
    if (fit->relative > own->gauss) {
        double excess = 1 - own->gauss / fit->relative;
        fit->freedom = (averages - 1) / ((1 + fit->relative) * excess * excess);
    } else {
        fit->relative = own->gauss;
    }
}

// --- averages that are alike ---

// The growth of the variance of means over m averages beyond 1/m, over all strong bins.
static double successive_correlation(const bl_psd *psd, const bin_spread *spread) {
    size_t first = (size_t)bl_window_half_lobe(psd->settings.window);
    double alone = 0, most = 1;
    for (size_t bin = first; bin < psd->count; bin++)
        alone += spread[bin].strong ? spread[bin].measured : 0;
    for (size_t span = 2; psd->settings.averages / span >= 8 && alone > 0; span *= 2) {
        double joined = 0;
        for (size_t bin = first; bin < psd->count; bin++)
            joined += spread[bin].strong ? relative_variance(psd, bin, span) : 0;
        most = fmax(most, joined / alone);
    }
    return most;
}

// The part rho that all averages have in common, around a bin. Overlap alone takes (overlap - 1) /
// (K - 1) off the spread; K/base averages are independent.
static double common_part(const bl_psd *psd, const bin_spread *spread, size_t bin, double overlap,
                          double base) {
    size_t first = (size_t)bl_window_half_lobe(psd->settings.window);
    size_t from = bin > WIDE + first ? bin - WIDE : first;
    size_t to = bin + WIDE < psd->count ? bin + WIDE : psd->count - 1;
    double measured = 0, expected = 0, gauss = 0, strong = 0;
    for (size_t i = from; i <= to; i++)
        if (spread[i].strong) {
            measured += spread[i].measured;
            expected += spread[i].expected;
            gauss += spread[i].gauss;
            strong++;
        }
    if (strong == 0)
        return 0;
    double averages = (double)psd->settings.averages;
    double ratio = measured / expected / (1 - (overlap - 1) / (averages - 1));
    // Half as many bins as there are stand far enough apart to be independent.
    double noise = sqrt(2 * (1 + gauss / strong) / (averages / base * fmax(1, strong / 2)));
    return ratio < exp(-4 * noise) ? 1 - ratio : 0;
}

static void find_alike(bl_psd *psd, const bin_spread *spread, double overlap, bl_spread *fits) {
    double averages = (double)psd->settings.averages, common = 0, power = 0;
    double base = fmax(overlap, successive_correlation(psd, spread));
    for (size_t bin = 0; bin < psd->count; bin++) {
        double rho = common_part(psd, spread, bin, overlap, base);
        fits[bin].correlation = fmax(base, 1 + (averages - 1) * rho);
        common += rho * psd->psd[bin] * psd->measure[bin];
        power += psd->psd[bin] * psd->measure[bin];
    }
    psd->alike = power > 0 ? common / power : 0;
    psd->correlation = fmax(base, 1 + (averages - 1) * psd->alike);
}

bl_status bl_psd_find_spread(bl_psd *psd, const bl_bins *bins, double overlap, int on_grid,
                             bl_spread *fits, bl_message *message) {
    bin_spread *spread = calloc(psd->count, sizeof *spread);
    if (!spread)
        return bl_report(message, BL_DEVICE, "out of memory for %zu bins", psd->count);
    measure_bins(psd, bins, spread);
    for (size_t bin = 0; bin < psd->count; bin++) {
        fit_bin(spread, psd->count, bin, (double)psd->settings.averages, &fits[bin]);
        fits[bin].correlation = overlap;
    }
    psd->correlation = overlap;
    psd->alike = 0;
    if (on_grid && psd->settings.averages > 1)
        find_alike(psd, spread, overlap, fits);
    free(spread);
    return BL_OK;
}
