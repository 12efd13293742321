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

// The corners of a slice or volume reach beyond Nyquist.
static int is_beyond(const bl_table *table, size_t row) {
    const bl_psd *psd = table->context;
    const bl_band *band = (const bl_band *)table->rows + row;
    return band->from >= 0.5 * psd->settings.rate * sqrt((double)psd->settings.dims);
}

static void find_range(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_band *band = (const bl_band *)table->rows + row;
    snprintf(cell->text, sizeof cell->text, "%g : %g", band->from, band->to);
    cell->word = cell->text;
}

static void find_share(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_estimate *share = &((const bl_band *)table->rows)[row].fraction;
    if (is_beyond(table, row))
        return;
    cell->value = share->value;
    cell->lower = share->lower;
    cell->upper = share->upper;
}

static void find_remark(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_band *band = (const bl_band *)table->rows + row;
    cell->word = is_beyond(table, row)                        ? "beyond what was measured"
                 : isnan(band->exact) && !isnan(band->theory) ? "no exact share is known"
                                                              : "";
}

// clang-format off
#define AT(member) .offset = offsetof(bl_band, member)
static const bl_field band_fields[] = {
    {"range", "band, cycles per unit", BL_CELL_WORD, .find = find_range, .forms = BL_IN_TEXT},
    {"from", NULL, BL_CELL_REAL, AT(from)},
    {"to", NULL, BL_CELL_REAL, AT(to)},
    {"fraction", NULL, BL_CELL_ESTIMATE, AT(fraction), .bare_limits = 1, .forms = BL_IN_JSON},
    {"share", "share of the variance", BL_CELL_ESTIMATE, .find = find_share, .digits = 5,
     .limits = "", .forms = BL_IN_TEXT},
    {"theory", "theory, windowed", BL_CELL_REAL, AT(theory), .digits = 5},
    {"theory_exact", "theory, exact", BL_CELL_REAL, AT(exact), .digits = 5},
    {"remark", "", BL_CELL_WORD, .find = find_remark, .forms = BL_IN_TEXT},
    {0}};
#undef AT

#define AT(member) .offset = offsetof(bl_autocorrelation, member)
static const bl_field lag_fields[] = {
    {"lag", "lag, units", BL_CELL_REAL, AT(lag), .digits = 5},
    {"covariance", "autocovariance", BL_CELL_ESTIMATE, AT(covariance), .digits = 5, .limits = "",
     .bare_limits = 1},
    {"theory", "theory", BL_CELL_REAL, AT(theory), .digits = 5},
    {0}};
#undef AT
// clang-format on

static bl_table bands_of(const bl_psd *psd, const bl_band *bands, size_t count) {
    bl_table table = BL_TABLE(band_fields, bands, count);
    table.context = psd;
    table.level = psd->settings.level;
    return table;
}

static bl_table lags_of(const bl_autocorrelation *a) {
    return (bl_table){
        .fields = lag_fields, .rows = a, .count = a->count, .level = a->settings.level};
}

// At most 17 lags, evenly spaced from 0 on.
static void print_autocorrelation(FILE *out, const bl_autocorrelation *a) {
    bl_table lags = lags_of(a);
    lags.every = (a->count + 15) / 16;
    lags.count = (a->count + lags.every - 1) / lags.every;
    fputc('\n', out);
    bl_table_print(&lags, out);
    if (lags.every > 1)
        fprintf(out, "every %zu%s of the %zu lags; --json gives all\n", lags.every,
                lags.every == 2   ? "nd"
                : lags.every == 3 ? "rd"
                                  : "th",
                a->count);
}

static json_t *autocorrelation_json(const bl_autocorrelation *a) {
    const bl_table lags = lags_of(a);
    json_t *object = json_object();
    bl_table_json_columns(object, &lags);
    return object;
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
    for (size_t i = 0; i < count; i++) {
        bl_psd_band(psd, &bands[i]);
        bands[i].exact = bl_psd_exact_share(signal, &psd->settings, bands[i].from, bands[i].to);
    }
    const bl_table table = bands_of(psd, bands, count);
    json_t *object = bl_json_start(call);
    if (object) {
        bl_spectral_json(object, signal, psd);
        json_object_set_new(object, "bands", bl_table_json(&table));
    } else if (!call->common.quiet) {
        bl_spectral_print(call->out, &settings->spectral, signal, psd);
        fputc('\n', call->out);
        bl_table_print(&table, call->out);
        if (psd->theory)
            fputs(
                "shares are measured through the window, so their intervals are about the "
                "windowed theory\n",
                call->out);
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
        bl_spectral_warn(call, signal, &psd, BL_RESOLUTION_SPECTRUM);
        status = report(call, signal, &psd, bands, count);
        bl_psd_free(&psd);
    }
    bl_signal_free(signal);
    free(bands);
    return status;
}

static const bl_option options[] = {
    BL_SPECTRAL_OPTIONS(spectrum_settings),
    {"band", BL_OPTION_WORDS, offsetof(spectrum_settings, bands), "A:B",
     .help = "a band whose share of the variance to report, cycles per unit, B may be inf; may be "
             "repeated (default: 0:0.5 0.3:0.7 0.5:1 1:inf)"},
    {"autocorrelation", BL_OPTION_REAL, offsetof(spectrum_settings, reach), "REACH",
     .minimum = 1e-9, .maximum = 1e12,
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
        "window. Shares of the variance in bands have their exact theory beside the windowed one, "
        "which their intervals are about. An image is measured on its own samples: along its rows "
        "or columns, or in "
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
