// SPDX-License-Identifier: MIT
//
// Chapter 5: spectra, distributions, and the verdict on a band.
#include <math.h>

#include "api/api.h"

#include <stdlib.h>

#include "spectra/autocorrelation.h"
#include "spectra/histogram.h"

// The settings of the caller, with the usual where he says nothing.
static bl_status settle(const bandlimit_signal *signal, const bandlimit_spectrum_settings *given,
                        bl_psd_settings *settings, bandlimit_message *message) {
    static const bl_window windows[] = {[BANDLIMIT_BLACKMAN_HARRIS] = BL_WINDOW_BLACKMAN_HARRIS,
                                        [BANDLIMIT_HANN] = BL_WINDOW_HANN,
                                        [BANDLIMIT_RECTANGLE] = BL_WINDOW_RECTANGLE};
    bandlimit_spectrum_settings own;
    bl_status status = BL_API_TAKE(given, &own, bandlimit_spectrum_settings, message);
    if (status != BL_OK)
        return status;
    if ((size_t)own.window >= sizeof windows / sizeof *windows)
        return bl_report(bl_api_message(message), BL_USAGE, "%d is no window", (int)own.window);
    const unsigned dims = own.dims ? own.dims : 1;
    *settings = bl_psd_default_settings(dims);
    settings->rate = own.rate;
    settings->size = own.size;
    settings->averages =
        own.averages ? own.averages
                     : bl_psd_usual_averages(bl_api_signal(signal), dims, bl_api_size(own.effort));
    settings->window = windows[own.window];
    settings->place = own.on_lattice ? BL_PLACE_LATTICE : BL_PLACE_RANDOM;
    settings->seed = BL_API_SEED(own);
    settings->level = BL_API_LEVEL(own);
    settings->threads = own.threads;
    if (own.axis[0] != 0 || own.axis[1] != 0 || own.axis[2] != 0)
        memcpy(settings->axis, own.axis, sizeof settings->axis);
    return BL_OK;
}

bandlimit_status bandlimit_spectrum_measure(const bandlimit_signal *signal,
                                            const bandlimit_spectrum_settings *settings,
                                            bandlimit_spectrum *spectrum,
                                            bandlimit_message *message) {
    bl_psd_settings own;
    bl_status status = BL_API_CHECK(spectrum, bandlimit_spectrum, message);
    if (status == BL_OK)
        status = settle(signal, settings, &own, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    bl_psd *psd = bl_api_room(sizeof *psd, message);
    status =
        psd ? bl_psd_measure(bl_api_signal(signal), &own, psd, bl_api_message(message)) : BL_DEVICE;
    if (status != BL_OK)
        return bl_api_end(status, signal, psd, message);
    *spectrum = (bandlimit_spectrum){.bytes = sizeof *spectrum,
                                     .dims = psd->settings.dims,
                                     .rate = psd->settings.rate,
                                     .size = psd->settings.size,
                                     .averages = psd->settings.averages,
                                     .count = psd->count,
                                     .frequency = psd->frequency,
                                     .measure = psd->measure,
                                     .psd = psd->psd,
                                     .lower = psd->lower,
                                     .upper = psd->upper,
                                     .theory = psd->theory,
                                     .anisotropy_db = psd->anisotropy_db,
                                     .plane = psd->plane,
                                     .mean = psd->mean,
                                     .variance = bl_api_estimate(&psd->variance),
                                     .variance_theory = psd->variance_theory,
                                     .guard = bl_psd_smear(psd),
                                     .parseval_residual = psd->parseval_residual,
                                     .owned = psd};
    return BANDLIMIT_OK;
}

void bandlimit_spectrum_free(bandlimit_spectrum *spectrum) {
    BL_API_RELEASE(spectrum, bl_psd_free);
}

bandlimit_estimate bandlimit_spectrum_share(const bandlimit_spectrum *spectrum, double from,
                                            double to) {
    bl_band band = {.from = from, .to = to};
    bl_psd_band(spectrum->owned, &band);
    return bl_api_estimate(&band.fraction);
}

bandlimit_status bandlimit_check(const bandlimit_spectrum *spectrum, bandlimit_band_limit *limit,
                                 bandlimit_message *message) {
    bl_status status = BL_API_CHECK(limit, bandlimit_band_limit, message);
    if (status == BL_OK)
        status = BL_API_CHECK(spectrum, bandlimit_spectrum, message);
    if (status == BL_OK && !spectrum->owned)
        status = bl_report(bl_api_message(message), BL_USAGE, "no spectrum was measured yet");
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_psd *psd = spectrum->owned;
    bl_band_limit own = {.from = limit->from,
                         .to = limit->to != 0 ? limit->to : 1,
                         .limit_db = limit->limit_db != 0 ? limit->limit_db : -30,
                         .guard = fmax(0, limit->guard)};
    if (!(own.from >= 0 && own.to > own.from && own.limit_db <= 0))
        return (bandlimit_status)bl_report(
            bl_api_message(message), BL_USAGE,
            "a band goes from 0 or above to something larger, and a leak is at most 0 dB; not "
            "%g : %g and %g dB",
            own.from, own.to, own.limit_db);
    status = bl_psd_check_limit(psd, &own, bl_api_message(message));
    if (status != BL_OK)
        return (bandlimit_status)status;
    bl_psd_band_limit(psd, &own);
    limit->leak_db = own.leak_db;
    limit->lower_db = own.lower_db;
    limit->upper_db = own.upper_db;
    limit->needed_averages = own.needed_averages;
    limit->verdict = (bandlimit_verdict)own.verdict;
    return BANDLIMIT_OK;
}

// --- autocorrelation: its intervals as arrays ---

typedef struct autocorrelation_room {
    bl_autocorrelation measured;
    double *columns; // covariance, lower, upper
} autocorrelation_room;

bandlimit_status bandlimit_autocorrelation_measure(const bandlimit_signal *signal,
                                                   const bandlimit_spectrum_settings *settings,
                                                   double reach,
                                                   bandlimit_autocorrelation *autocorrelation,
                                                   bandlimit_message *message) {
    bl_psd_settings own;
    bl_status status = BL_API_CHECK(autocorrelation, bandlimit_autocorrelation, message);
    if (status == BL_OK)
        status = settle(signal, settings, &own, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    autocorrelation_room *room = bl_api_room(sizeof *room, message);
    status = room ? bl_autocorrelation_measure(bl_api_signal(signal), &own, reach, &room->measured,
                                               bl_api_message(message))
                  : BL_DEVICE;
    if (status != BL_OK)
        return bl_api_end(status, signal, room, message);
    const bl_autocorrelation *measured = &room->measured;
    const size_t count = measured->count;
    room->columns = bl_api_room((3 * count + 1) * sizeof *room->columns, message);
    if (!room->columns) {
        bl_autocorrelation_free(&room->measured);
        return bl_api_end(BL_DEVICE, signal, room, message);
    }
    for (size_t i = 0; i < count; i++) {
        room->columns[i] = measured->covariance[i].value;
        room->columns[count + i] = measured->covariance[i].lower;
        room->columns[2 * count + i] = measured->covariance[i].upper;
    }
    *autocorrelation = (bandlimit_autocorrelation){.bytes = sizeof *autocorrelation,
                                                   .count = count,
                                                   .lag = measured->lag,
                                                   .covariance = room->columns,
                                                   .lower = room->columns + count,
                                                   .upper = room->columns + 2 * count,
                                                   .theory = measured->theory,
                                                   .mean = measured->mean,
                                                   .owned = room};
    return BANDLIMIT_OK;
}

static void free_autocorrelation(autocorrelation_room *room) {
    bl_autocorrelation_free(&room->measured);
    free(room->columns);
}

void bandlimit_autocorrelation_free(bandlimit_autocorrelation *autocorrelation) {
    BL_API_RELEASE(autocorrelation, free_autocorrelation);
}

// --- the histogram ---

typedef struct histogram_room {
    bl_histogram measured;
    bandlimit_estimate quantile[BL_QUANTILES];
} histogram_room;

static void show_histogram(histogram_room *room, bandlimit_histogram *histogram) {
    const bl_histogram *measured = &room->measured;
    for (size_t i = 0; i < BL_QUANTILES; i++)
        room->quantile[i] = bl_api_estimate(&measured->quantile[i]);
    *histogram = (bandlimit_histogram){.bytes = sizeof *histogram,
                                       .samples = measured->count,
                                       .outside = measured->outside,
                                       .mean = bl_api_estimate(&measured->mean),
                                       .variance = bl_api_estimate(&measured->variance),
                                       .skewness = bl_moments_skewness(&measured->moments),
                                       .kurtosis = bl_moments_kurtosis(&measured->moments),
                                       .minimum = measured->minimum,
                                       .maximum = measured->maximum,
                                       .bins = measured->settings.bins,
                                       .edges = measured->edges,
                                       .counts = measured->counts,
                                       .quantiles = BL_QUANTILES,
                                       .quantile_p = measured->quantile_p,
                                       .quantile = room->quantile,
                                       .owned = room};
    memcpy(histogram->minimum_at, measured->minimum_at, sizeof histogram->minimum_at);
    memcpy(histogram->maximum_at, measured->maximum_at, sizeof histogram->maximum_at);
}

bandlimit_status bandlimit_histogram_measure(const bandlimit_signal *signal,
                                             const bandlimit_histogram_settings *settings,
                                             bandlimit_histogram *histogram,
                                             bandlimit_message *message) {
    bandlimit_histogram_settings own;
    bl_status status = BL_API_CHECK(histogram, bandlimit_histogram, message);
    if (status == BL_OK)
        status = BL_API_TAKE(settings, &own, bandlimit_histogram_settings, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_histogram_settings used = {
        .samples = own.samples ? own.samples : bl_histogram_usual_samples(bl_api_size(own.effort)),
        .bins = own.bins ? own.bins : 64,
        .from = own.from,
        .to = own.to,
        .seed = BL_API_SEED(own),
        .level = BL_API_LEVEL(own),
        .threads = own.threads};
    histogram_room *room = bl_api_room(sizeof *room, message);
    status = room ? bl_histogram_measure(bl_api_signal(signal), &used, &room->measured,
                                         bl_api_message(message))
                  : BL_DEVICE;
    if (status == BL_OK)
        show_histogram(room, histogram);
    return bl_api_end(status, signal, room, message);
}

void bandlimit_histogram_free(bandlimit_histogram *histogram) {
    BL_API_RELEASE(histogram, bl_histogram_free); // which the room begins with
}
