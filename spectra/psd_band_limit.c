// SPDX-License-Identifier: MIT
//
// The verdict on a band limit.
#include <math.h>
#include <stdlib.h>

#include "spectra/psd_parts.h"

static double decibel(double share_of_variance) {
    return share_of_variance > 0 ? 10 * log10(share_of_variance) : -INFINITY;
}

double bl_psd_smear(const bl_psd *psd) {
    double lobe = bl_window_half_lobe(psd->settings.window);
    return (sqrt((double)psd->settings.dims) * lobe + 0.5) * psd->width[0];
}

int bl_psd_has_outside(const bl_psd *psd, const bl_band_limit *limit) {
    for (size_t i = 1; i < psd->count; i++)
        if (psd->frequency[i] + psd->width[i] / 2 <= limit->from - limit->guard ||
            psd->frequency[i] - psd->width[i] / 2 >= limit->to + limit->guard)
            return 1;
    return 0;
}

// The leak outside of a band that is wider by `by` at both edges; a band from 0 has one edge. All
// of the variance where nothing is left of the band. A limit that misses on its one side is the end
// of an interval that misses on both.
static bl_estimate leak_beyond(const bl_psd *psd, const bl_band_limit *limit, double by,
                               const double *less, double missed) {
    double from = limit->from > 0 ? limit->from - by : -1, to = limit->to + by;
    if (!(psd->variance.value > 0))
        return (bl_estimate){0, 0, 0, 1 - missed, (double)psd->settings.averages};
    if (to > fmax(from, 0))
        return bl_psd_band_share(psd, from, to, 1, less, fmin(2 * missed, 1 - 1e-9));
    return (bl_estimate){1, 1, 1, 1 - missed, (double)psd->settings.averages};
}

// What does not fit the shape of a line on an edge grows by twice its distance in bins: below this
// share a line is nearer than a two-thousandth of a bin, and counts as on the edge.
static const double ON_EDGE = 1e-3;

// How much of an average's power near an edge is that of a line on the edge, less what does not
// fit.
static double line_on_edge(const bl_psd *psd, size_t average, double edge) {
    const bl_window window = psd->settings.window;
    const double *power = psd->profiles + average * (psd->count + 1);
    const double place = edge / psd->width[0], reach = bl_window_half_lobe(window) + 2;
    double product = 0, square = 0, unlike = 0;
    if (psd->settings.dims != 1 || !(place > 2 * reach && place < (double)psd->count - 1 - reach))
        return 0;
    const size_t first = (size_t)ceil(place - reach), last = (size_t)(place + reach);
    for (size_t bin = first; bin <= last; bin++) {
        double kernel = bl_window_kernel(window, (double)bin - place);
        product += kernel * power[bin];
        square += kernel * kernel;
    }
    const double line = product / square;
    for (size_t bin = first; bin <= last; bin++)
        unlike += fabs(power[bin] - line * bl_window_kernel(window, (double)bin - place));
    return unlike < ON_EDGE * line ? line - unlike : 0;
}

// Of each average, the lines on both edges; NULL out of memory, which leaves the limits wide.
static double *lines_on_edges(const bl_psd *psd, const bl_band_limit *limit) {
    const double from = limit->from - limit->guard, to = limit->to + limit->guard;
    double *lines = calloc(psd->settings.averages, sizeof *lines);
    for (size_t k = 0; lines && k < psd->settings.averages; k++)
        lines[k] = line_on_edge(psd, k, to) + (limit->from > 0 ? line_on_edge(psd, k, from) : 0);
    return lines;
}

// Averages narrow the interval with their root; it must not reach the limit. As a size, or 0.
static size_t needed(double now, double factor) {
    double wanted = fmax(ceil(now * factor), now + 1);
    return wanted < 1e15 ? (size_t)wanted : (size_t)1e15; // NaN too
}

typedef struct leak {
    bl_estimate near, at, far; // beyond the edge less the smear, the edge, and the edge and smear
} leak;

// Whether the smear of the edges leaves open more than chance does.
static int is_smeared(const leak *found) {
    return found->near.value - found->far.value > 0.25 * (found->at.upper - found->at.lower);
}

static leak find_leak(const bl_psd *psd, const bl_band_limit *limit, double missed) {
    const double smear = bl_psd_smear(psd), guard = limit->guard;
    double *lines = lines_on_edges(psd, limit);
    leak found = {leak_beyond(psd, limit, guard - smear, lines, missed),
                  leak_beyond(psd, limit, guard, NULL, missed),
                  leak_beyond(psd, limit, guard + smear, NULL, missed)};
    free(lines);
    return found;
}

// What would settle a verdict that is open: longer lines, for the smear shrinks with them, or more
// averages.
static void advise(const bl_psd *psd, const leak *found, double allowed, bl_band_limit *limit) {
    double smeared = found->near.value - found->far.value;
    double chance = found->at.upper - found->at.lower;
    double apart = fabs(found->at.value - allowed), left = apart - 0.5 * smeared;
    if (smeared > chance || left <= 0) {
        double size = (double)needed((double)psd->settings.size, 2 * smeared / fmax(apart, 1e-300));
        limit->needed_size = (size_t)exp2(ceil(log2(size)));
    } else if (!(psd->alike > 0)) { // more of the same tells no more
        double reach = found->at.value > allowed ? found->at.value - found->at.lower
                                                 : found->at.upper - found->at.value;
        limit->needed_averages =
            needed((double)psd->settings.averages, reach / left * (reach / left));
    }
}

static double missed_of(const bl_psd *psd, const bl_band_limit *limit) {
    return limit->missed > 0 ? limit->missed : 1 - psd->settings.level;
}

static void judge(const bl_psd *psd, const leak *found, bl_band_limit *limit) {
    const double kept = pow(1 - bl_window_side_lobes(psd->settings.window), psd->settings.dims);
    const double allowed = pow(10, limit->limit_db / 10);
    // Of the power inside the part 1 - kept may be seen anywhere, and so of the power outside.
    double lower = fmax(0, found->far.lower - (1 - kept)) / kept;
    double upper = fmax(lower, fmin(1, found->near.upper / kept));
    limit->leak_db = decibel(fmin(fmax(found->at.value, lower), upper));
    limit->lower_db = decibel(lower);
    limit->upper_db = decibel(upper);
    limit->edge_db = decibel(fmax(0, found->near.value - found->far.value));
    limit->needed_averages = limit->needed_size = 0;
    limit->verdict = upper <= allowed  ? BL_VERDICT_PASS
                     : lower > allowed ? BL_VERDICT_FAIL
                                       : BL_VERDICT_INCONCLUSIVE;
    if (limit->verdict == BL_VERDICT_INCONCLUSIVE)
        advise(psd, found, allowed, limit);
}

void bl_psd_band_limit(const bl_psd *psd, bl_band_limit *limit) {
    const leak found = find_leak(psd, limit, missed_of(psd, limit));
    judge(psd, &found, limit);
}

// A first look that the smear leaves open is a verdict only where it is clear: it has a tenth of
// the error, and the second look the rest. How long the second look's lines are, or 0 for no second
// look, depends on the smear alone.
static size_t size_of_second_look(const bl_psd *psd, const bl_band_limit *limit, double missed,
                                  const leak *found) {
    if (!is_smeared(found))
        return 0;
    bl_band_limit clear = *limit;
    clear.missed = missed / 10;
    bl_psd_band_limit(psd, &clear);
    if (clear.verdict != BL_VERDICT_INCONCLUSIVE)
        return 0;
    double chance = 0.125 * (found->at.upper - found->at.lower);
    double factor = (found->near.value - found->far.value) / fmax(chance, 1e-300);
    double most = pow(BL_PSD_LONGER, 1.0 / (double)psd->settings.dims), power = 2;
    while (power < factor && 2 * power <= most)
        power *= 2;
    return power * (double)psd->settings.size <= 0x1p24 ? (size_t)power * psd->settings.size : 0;
}

bl_status bl_psd_judge_band(const bl_signal *signal, const bl_psd_settings *settings, int is_fixed,
                            bl_psd *psd, bl_band_limit *limit, bl_message *message) {
    bl_status status = bl_psd_measure(signal, settings, psd, message);
    if (status != BL_OK)
        return status;
    status = bl_psd_check_limit(psd, limit, message);
    if (status != BL_OK) {
        bl_psd_free(psd);
        return status;
    }
    const double missed = missed_of(psd, limit);
    const leak found = find_leak(psd, limit, missed);
    bl_psd_settings longer = psd->settings;
    longer.size = is_fixed ? 0 : size_of_second_look(psd, limit, missed, &found);
    if (!longer.size) {
        judge(psd, &found, limit);
        return BL_OK;
    }
    bl_psd_free(psd);
    status = bl_psd_measure(signal, &longer, psd, message);
    limit->missed = 0.9 * missed;
    if (status == BL_OK)
        bl_psd_band_limit(psd, limit);
    return status;
}

// A verdict needs a variance, and frequencies on both sides: in the band and outside of it.
bl_status bl_psd_check_limit(const bl_psd *psd, const bl_band_limit *limit, bl_message *message) {
    static const char remedy[] = "sample more finely (--rate; of an image spacing=)";
    double nyquist = 0.5 * psd->settings.rate;
    if (!(psd->variance.value > 0))
        return bl_report(message, BL_MISMATCH,
                         "the signal is constant: there is no variance to judge");
    if (limit->from >= nyquist)
        return bl_report(message, BL_MISMATCH,
                         "the band %g : %g begins beyond the highest frequency measured, %g cycles "
                         "per unit; %s, or move --band",
                         limit->from, limit->to, nyquist, remedy);
    if (!bl_psd_has_outside(psd, limit))
        return bl_report(message, BL_MISMATCH,
                         "nothing is left to judge outside of the band %g : %g with a guard of "
                         "%.3g: frequencies were measured up to %g cycles per unit; %s, or narrow "
                         "--band or --guard",
                         limit->from, limit->to, limit->guard, nyquist,
                         isfinite(limit->to) ? remedy : "give the band an end");
    return BL_OK;
}
