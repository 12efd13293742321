// SPDX-License-Identifier: MIT
//
// The verb `spectrum`: the power spectrum of a signal, its confidence limits, its closed form, and
// the shares of the variance in bands.
#include <math.h>
#include <stdlib.h>

#include "cli/json.h"
#include "cli/spectral.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "spectra/autocorrelation.h"

typedef struct spectrum_settings {
    bl_spectral spectral;
    bl_words bands;
    double reach; // of the autocorrelation, units; 0: none wanted
} spectrum_settings;

static const char *const usual_bands[] = {"0:0.5", "0.3:0.7", "0.5:1", "1:inf"};
enum { USUAL_BANDS = sizeof usual_bands / sizeof *usual_bands };

// Reads the bands asked for, or the usual ones; the caller frees them.
static bl_status read_bands(bl_call *call, bl_band **bands, size_t *count) {
    const spectrum_settings *settings = call->settings;
    const char *const *words = settings->bands.count ? settings->bands.words : usual_bands;
    *count = settings->bands.count ? settings->bands.count : USUAL_BANDS;
    *bands = calloc(*count, sizeof **bands);
    if (!*bands)
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    for (size_t i = 0; i < *count; i++) {
        bl_band *band = &(*bands)[i];
        bl_status status =
            bl_read_range("band", words[i], 1, &band->from, &band->to, &call->message);
        if (status == BL_OK && band->from < 0)
            status =
                bl_report(&call->message, BL_USAGE, "--band %s: frequencies start at 0", words[i]);
        if (status != BL_OK)
            return status;
    }
    return BL_OK;
}

static json_t *bands_json(const bl_band *bands, size_t count) {
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        json_t *object = json_object();
        bl_json_set_number(object, "from", bands[i].from);
        bl_json_set_number(object, "to", bands[i].to);
        bl_json_set_number(object, "fraction", bands[i].fraction.value);
        bl_json_set_number(object, "lower", bands[i].fraction.lower);
        bl_json_set_number(object, "upper", bands[i].fraction.upper);
        bl_json_set_number(object, "theory", bands[i].theory);
        json_array_append_new(list, object);
    }
    return list;
}

static void print_bands(FILE *out, const bl_psd *psd, const bl_band *bands, size_t count) {
    // The corners of a slice or volume reach beyond Nyquist.
    double highest = 0.5 * psd->settings.rate * sqrt((double)psd->settings.dims);
    fprintf(out,
            "\nband, cycles per unit   share of the variance   %4.3g %% interval        theory\n",
            100 * psd->settings.level);
    for (size_t i = 0; i < count; i++) {
        char range[48];
        snprintf(range, sizeof range, "%g : %g", bands[i].from, bands[i].to);
        fprintf(out, "%-23s ", range);
        if (bands[i].from >= highest) {
            fputs("beyond what was measured\n", out);
            continue;
        }
        fprintf(out, "%-23.5g %-10.5g %-12.5g ", bands[i].fraction.value, bands[i].fraction.lower,
                bands[i].fraction.upper);
        if (isfinite(bands[i].theory))
            fprintf(out, "%.5g\n", bands[i].theory + 0.0);
        else
            fputs("-\n", out);
    }
}

static json_t *autocorrelation_json(const bl_autocorrelation *a) {
    json_t *object = json_object(), *covariance = json_array(), *lower = json_array(),
           *upper = json_array();
    for (size_t i = 0; i < a->count; i++) {
        json_array_append_new(covariance, bl_json_number(a->covariance[i].value));
        json_array_append_new(lower, bl_json_number(a->covariance[i].lower));
        json_array_append_new(upper, bl_json_number(a->covariance[i].upper));
    }
    bl_json_set_numbers(object, "lag", a->lag, a->count);
    json_object_set_new(object, "covariance", covariance);
    json_object_set_new(object, "lower", lower);
    json_object_set_new(object, "upper", upper);
    bl_json_set_numbers(object, "theory", a->theory, a->count);
    return object;
}

// At most 17 lags, evenly spaced from 0 on.
static void print_autocorrelation(FILE *out, const bl_autocorrelation *a) {
    size_t step = (a->count + 15) / 16;
    fprintf(out,
            "\nlag, units              autocovariance          %4.3g %% interval          theory\n",
            100 * a->settings.level);
    for (size_t i = 0; i < a->count; i += step) {
        const bl_estimate *e = &a->covariance[i];
        fprintf(out, "%-23.5g %-23.5g %-11.4g %-12.4g ", a->lag[i], e->value, e->lower, e->upper);
        if (a->theory)
            fprintf(out, "%.5g\n", a->theory[i] + 0.0);
        else
            fputs("-\n", out);
    }
    if (step > 1)
        fprintf(out, "every %zu%s of the %zu lags; --json gives all\n", step,
                step == 2   ? "nd"
                : step == 3 ? "rd"
                            : "th",
                a->count);
}

static bl_status add_autocorrelation(bl_call *call, const bl_signal *signal) {
    const spectrum_settings *settings = call->settings;
    bl_psd_settings line;
    bl_autocorrelation a;
    bl_status status = bl_spectral_settings(call, &settings->spectral, signal, &line);
    if (status == BL_OK)
        status = bl_autocorrelation_measure(signal, &line, settings->reach, &a, &call->message);
    if (status != BL_OK)
        return status;
    if (call->json)
        json_object_set_new(call->json, "autocorrelation", autocorrelation_json(&a));
    else if (!call->common.quiet)
        print_autocorrelation(call->out, &a);
    bl_autocorrelation_free(&a);
    return BL_OK;
}

// Fills the bands and gives all of it to the user.
static bl_status report(bl_call *call, const bl_signal *signal, const bl_psd *psd, bl_band *bands,
                        size_t count) {
    const spectrum_settings *settings = call->settings;
    bl_status status = BL_OK;
    for (size_t i = 0; i < count; i++)
        bl_psd_band(psd, &bands[i]);
    json_t *object = bl_json_start(call);
    if (object) {
        bl_spectral_json(object, signal, psd);
        json_object_set_new(object, "bands", bands_json(bands, count));
    } else if (!call->common.quiet) {
        bl_spectral_print(call->out, &settings->spectral, signal, psd);
        print_bands(call->out, psd, bands, count);
    }
    if (settings->reach > 0)
        status = add_autocorrelation(call, signal);
    return status == BL_OK && call->path ? bl_spectral_csv(call, signal, psd) : status;
}

static bl_status run_spectrum(bl_call *call) {
    const spectrum_settings *settings = call->settings;
    bl_band *bands = NULL;
    size_t count;
    bl_signal *signal = NULL;
    bl_psd psd;
    bl_status status = read_bands(call, &bands, &count);
    if (status == BL_OK && settings->reach > 0 && settings->spectral.dims != 1)
        status = bl_report(&call->message, BL_USAGE,
                           "--autocorrelation is taken along a line: leave --dims out");
    if (status == BL_OK)
        status = bl_call_open(call, call->operands.words[0], &signal);
    if (status == BL_OK)
        status = bl_spectral_measure(call, &settings->spectral, signal, &psd);
    if (status == BL_OK) {
        status = report(call, signal, &psd, bands, count);
        bl_psd_free(&psd);
    }
    bl_signal_free(signal);
    free(bands);
    return status;
}

static const bl_option options[] = {
    BL_SPECTRAL_OPTIONS(spectrum_settings),
    {.name = "band",
     .kind = BL_OPTION_WORDS,
     .offset = offsetof(spectrum_settings, bands),
     .value = "A:B",
     .help = "a band whose share of the variance to report, cycles per unit, B may be inf; may be "
             "repeated (default: 0:0.5 0.3:0.7 0.5:1 1:inf)"},
    {.name = "autocorrelation",
     .kind = BL_OPTION_REAL,
     .offset = offsetof(spectrum_settings, reach),
     .value = "REACH",
     .minimum = 1e-9,
     .maximum = 1e12,
     .help = "also the autocovariance along the line, for lags up to REACH units and at most half "
             "the line"},
    {0}};

const bl_verb bl_verb_spectrum = {
    .name = "spectrum",
    .operands = "SIGNAL",
    .summary = "power spectrum, with confidence band and theory",
    .text =
        "Averages windowed periodograms over independent random places and fresh seeds, and "
        "compares them with the closed form where the signal states one, seen through the same "
        "window. An image is measured on its own samples: along its rows or columns, or in "
        "patches. "
        "Frequencies are in cycles per unit, which is a lattice cell for a noise.",
    .least = 1,
    .most = 1,
    .output = BL_OUTPUT_DATA,
    .output_help = "write the spectrum as CSV to PATH (as the JSON object, if PATH ends in .json)",
    .options = options,
    .settings_size = sizeof(spectrum_settings),
    .run = run_spectrum,
};
