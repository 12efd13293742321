// SPDX-License-Identifier: MIT
//
// How far from an edge the density crosses the threshold by chance: of each bin the ratio of its
// smoothed density to that of the peak bin has an interval, from the spread of both over the
// averages. The outermost bin whose upper limit reaches the threshold is as far out as the edge may
// be, the outermost one whose lower limit does, as far in. The peak bin itself has the ratio 1
// without an error, so that there always is one.
//
// The averages of a grid depend on each other: the intervals of the ratios are wider by the root of
// psd->correlation.
#include "score/properties/band_edges.h"

#include <math.h>
#include <stdlib.h>

static const double SMOOTHING = 0.05; // cycles per unit each way

// Of each bin: the ratio to the peak, with its limits.
typedef struct ratio {
    double value, lower, upper;
} ratio;

// The bins around a bin; frequency 0, from which the mean was taken, is left out.
typedef struct span {
    size_t from, to; // [from, to)
} span;

static span span_of(const bl_psd *psd, size_t bin) {
    size_t reach = (size_t)(SMOOTHING / psd->width[0] + 0.5);
    span s = {bin > reach ? bin - reach : 1, bin + reach + 1};
    s.to = s.to < psd->count ? s.to : psd->count;
    return s;
}

// The smoothed density of one average, or, without any, of their mean.
static double smooth_density(const bl_psd *psd, const double *profile, size_t bin) {
    span s = span_of(psd, bin);
    double sum = 0;
    for (size_t i = s.from; i < s.to; i++)
        sum += profile ? profile[i] / psd->measure[i] : psd->psd[i];
    return s.to > s.from ? sum / (double)(s.to - s.from) : 0;
}

static size_t peak_of(const bl_psd *psd) {
    size_t peak = 1;
    double most = 0;
    for (size_t i = 1; i < psd->count; i++) {
        double here = smooth_density(psd, NULL, i);
        if (here > most) {
            most = here;
            peak = i;
        }
    }
    return most > 0 ? peak : 0;
}

// `room` holds the densities of the bin and of the peak in each average.
static ratio ratio_of(const bl_psd *psd, size_t bin, double *room, double level) {
    size_t averages = psd->settings.averages;
    for (size_t k = 0; k < averages; k++)
        room[k] = smooth_density(psd, psd->profiles + k * (psd->count + 1), bin);
    bl_estimate e = bl_ratio_estimate(room, room + averages, averages, level);
    double widen = sqrt(psd->correlation);
    return (ratio){e.value, e.value - widen * (e.value - e.lower),
                   e.value + widen * (e.upper - e.value)};
}

// NaN limits, of one average, reach nothing.
static bl_band_edges edges_at(const bl_psd *psd, const ratio *ratios, double least, double level) {
    size_t first[3] = {0}, last[3] = {0}; // by the upper limits, the values, the lower limits
    for (size_t i = 1; i < psd->count; i++) {
        const double reaches[3] = {ratios[i].upper, ratios[i].value, ratios[i].lower};
        for (int way = 0; way < 3; way++)
            if (reaches[way] >= least) {
                first[way] = first[way] ? first[way] : i;
                last[way] = i;
            }
    }
    const double *f = psd->frequency, averages = (double)psd->settings.averages;
    if (!first[0] || !first[2])
        return (bl_band_edges){{f[first[1]], f[first[1]], f[first[1]], 0, averages},
                               {f[last[1]], f[last[1]], f[last[1]], 0, averages}};
    return (bl_band_edges){{f[first[1]], f[first[0]], f[first[2]], level, averages},
                           {f[last[1]], f[last[2]], f[last[0]], level, averages}};
}

bl_status bl_find_band_edges(const bl_psd *psd, const double *below_db, size_t count, double level,
                             bl_band_edges *edges, bl_message *message) {
    size_t averages = psd->settings.averages, peak = peak_of(psd);
    const bl_estimate none = {NAN, NAN, NAN, 0, (double)averages};
    ratio *ratios = calloc(psd->count, sizeof *ratios);
    double *room = calloc(2 * averages, sizeof *room);
    if (!ratios || !room) {
        free(ratios);
        free(room);
        return bl_report(message, BL_DEVICE, "out of memory for the edges of %zu bins", psd->count);
    }
    for (size_t k = 0; peak && k < averages; k++)
        room[averages + k] = smooth_density(psd, psd->profiles + k * (psd->count + 1), peak);
    for (size_t i = 1; peak && i < psd->count; i++)
        ratios[i] = ratio_of(psd, i, room, level);
    for (size_t d = 0; d < count; d++)
        edges[d] = peak ? edges_at(psd, ratios, pow(10, -below_db[d] / 10), level)
                        : (bl_band_edges){none, none};
    free(ratios);
    free(room);
    return BL_OK;
}
