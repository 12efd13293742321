// SPDX-License-Identifier: MIT
#include "reports/measure.h"

#include <stdint.h>
#include <string.h>

#include "aliasing/method.h"
#include "sources/source.h"

// --- signals and views --------------------------------------------------------------------------

static void release_signal(void *signal) {
    bl_signal_free(signal);
}

bl_signal *bl_run_signal(bl_run *run, const char *text) {
    bl_signal *signal = NULL;
    bl_run_must(run, bl_source_open(text, bl_run_settings(run)->isa, &signal, bl_run_message(run)));
    return bl_run_keep(run, signal, release_signal);
}

bl_signal *bl_run_seeded_signal(bl_run *run, const char *text) {
    const bl_reproduce_settings *settings = bl_run_settings(run);
    bl_signal *signal = bl_run_signal(run, text), *seeded = NULL;
    if (signal->seed_offset == SIZE_MAX || strstr(text, "seed="))
        return signal;
    bl_run_release(run, signal);
    bl_run_must(run, bl_source_open_seeded(text, settings->seed, settings->isa, &seeded,
                                           bl_run_message(run)));
    return bl_run_keep(run, seeded, release_signal);
}

void bl_run_signals(bl_run *run, const char *const *texts, size_t count, bl_signal **signals) {
    for (size_t i = 0; i < count; i++)
        signals[i] = bl_run_signal(run, texts[i]);
}

const bl_signal *bl_run_filtered(bl_run *run, const bl_signal *signal, double width) {
    bl_signal *filtered;
    if (bl_signal_own_width(signal) > 0)
        return signal;
    bl_status status = bl_method_open_own(signal, "exact", bl_run_text(run, "%.17g", width),
                                          &filtered, bl_run_message(run));
    if (status == BL_USAGE) // it, or its other settings, have none
        return signal;
    bl_run_must(run, status);
    return bl_run_keep(run, filtered, release_signal);
}

static void release_view(void *view) {
    bl_view_close(view);
}

const bl_view *bl_run_view(bl_run *run, const char *text, size_t width, size_t height) {
    bl_view *view = bl_run_memory(run, 1, sizeof *view);
    bl_run_must(run, bl_view_open(text, width, height, view, bl_run_message(run)));
    return bl_run_keep(run, view, release_view);
}

static void release_method(void *method) {
    bl_method_close(method);
}

const bl_method *bl_run_method(bl_run *run, const char *text, const bl_signal *signal) {
    bl_method *method = bl_run_memory(run, 1, sizeof *method);
    bl_run_must(run, bl_method_open(text, signal, method, bl_run_message(run)));
    return bl_run_keep(run, method, release_method);
}

// --- spectra ------------------------------------------------------------------------------------

bl_psd_settings bl_run_psd_settings(const bl_run *run, unsigned dims) {
    bl_psd_settings settings = bl_psd_default_settings(dims);
    settings.seed = bl_run_settings(run)->seed;
    settings.threads = bl_run_settings(run)->threads;
    return settings;
}

static void release_psd(void *psd) {
    bl_psd_free(psd);
}

const bl_psd *bl_run_fitting_psd(bl_run *run, const bl_signal *signal,
                                 const bl_psd_settings *settings, bl_message *why) {
    bl_psd *psd = bl_run_memory(run, 1, sizeof *psd);
    bl_status status = bl_psd_measure(signal, settings, psd, why);
    if (status == BL_MISMATCH)
        return NULL;
    if (status != BL_OK)
        bl_run_must(run, bl_report(bl_run_message(run), status, "%s", why->text));
    return bl_run_keep(run, psd, release_psd);
}

const bl_psd *bl_run_psd(bl_run *run, const bl_signal *signal, const bl_psd_settings *settings) {
    bl_message why = {""};
    const bl_psd *psd = bl_run_fitting_psd(run, signal, settings, &why);
    if (!psd)
        bl_run_must(run, bl_report(bl_run_message(run), BL_MISMATCH, "%s", why.text));
    return psd;
}

bl_estimate bl_psd_share(const bl_psd *psd, double from, double to) {
    bl_band band = {.from = from, .to = to};
    bl_psd_band(psd, &band);
    return band.fraction;
}

bl_estimate bl_psd_share_off(const bl_psd *psd, double from, double to) {
    bl_band band = {.from = from, .to = to};
    bl_psd_band(psd, &band);
    return (bl_estimate){band.fraction.value - band.theory, band.fraction.lower - band.theory,
                         band.fraction.upper - band.theory, band.fraction.level,
                         band.fraction.samples};
}

// --- histograms ---------------------------------------------------------------------------------

bl_histogram_settings bl_run_histogram_settings(const bl_run *run, size_t samples) {
    bl_histogram_settings settings = bl_histogram_default_settings();
    settings.samples = samples;
    settings.seed = bl_run_settings(run)->seed;
    settings.threads = bl_run_settings(run)->threads;
    return settings;
}

static void release_histogram(void *histogram) {
    bl_histogram_free(histogram);
}

const bl_histogram *bl_run_histogram(bl_run *run, const bl_signal *signal,
                                     const bl_histogram_settings *settings) {
    bl_histogram *histogram = bl_run_memory(run, 1, sizeof *histogram);
    bl_run_must(run, bl_histogram_measure(signal, settings, histogram, bl_run_message(run)));
    return bl_run_keep(run, histogram, release_histogram);
}

// --- aliases and tables -------------------------------------------------------------------------

bl_alias_settings bl_run_alias_settings(const bl_run *run, double replicates, double most_samples) {
    bl_alias_settings settings = bl_alias_default_settings();
    settings.replicates = (unsigned)replicates;
    settings.most_samples = (uint32_t)most_samples;
    settings.frames = 0;
    settings.rounds = 0;
    settings.seed = bl_run_settings(run)->seed;
    settings.threads = bl_run_settings(run)->threads;
    return settings;
}

static void release_alias(void *result) {
    bl_alias_free(result);
}

const bl_alias_result *bl_run_alias(bl_run *run, const bl_signal *signal, const bl_view *view,
                                    const char *const *methods, size_t count,
                                    const bl_alias_settings *settings) {
    bl_alias_result *result = bl_run_memory(run, 1, sizeof *result);
    bl_run_must(
        run, bl_alias_measure(signal, view, methods, count, settings, result, bl_run_message(run)));
    return bl_run_keep(run, result, release_alias);
}

static void release_table(void *table) {
    bl_summed_area_free(table);
}

const bl_summed_area *bl_run_summed_area(bl_run *run, const float *values, size_t side,
                                         bl_sums sums) {
    bl_summed_area *table = NULL;
    bl_run_must(run, bl_summed_area_make(values, side, side, sums, BL_CLAMPED, &table,
                                         bl_run_message(run)));
    return bl_run_keep(run, table, release_table);
}
