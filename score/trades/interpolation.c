// SPDX-License-Identifier: MIT
//
// interpolation: the kernel between the lattice points, for the noises with the key interp.
//
// Error: the share of the variance above 1 cycle a cell along a line at a random place, which an
// ideal noise of this lattice would not have. It is measured, over fresh places and seeds, whether
// or not the noise has a closed form.
//
// Source: peachey2003, pp. 70-72.
#include "core/setting.h"
#include "score/trade_signals.h"
#include "spectra/psd.h"

#include <math.h>

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && bl_signal_choices(subject, "interp") && subject->facts.cell > 0;
}

static bl_status measure_leak(const bl_signal *signal, const bl_trade_settings *settings,
                              bl_estimate *leak, bl_message *message) {
    static const size_t averages[] = {32, 128, 1024};
    bl_psd_settings psd_settings = bl_psd_default_settings(1);
    bl_psd psd;
    psd_settings.averages = averages[settings->size];
    psd_settings.seed = settings->seed;
    psd_settings.threads = settings->threads;
    psd_settings.rate = 16 / signal->facts.cell;
    bl_status status = bl_psd_measure(signal, &psd_settings, &psd, message);
    if (status != BL_OK)
        return status;
    bl_band above = {.from = 1 / signal->facts.cell, .to = INFINITY};
    bl_psd_band(&psd, &above);
    *leak = above.fraction;
    bl_psd_free(&psd);
    return BL_OK;
}

static bl_status add(const bl_signal *subject, const char *word, const bl_trade_settings *settings,
                     bl_alternatives *alternatives, bl_message *message) {
    bl_signal *signal;
    bl_estimate leak;
    bl_status status = bl_signal_with_setting(subject, "interp", word, &signal, message);
    if (status == BL_OK)
        status = bl_trade_add_signal(alternatives, word, signal, NULL, message);
    if (status == BL_OK)
        status = measure_leak(signal, settings, &leak, message);
    if (status == BL_OK)
        alternatives->list[alternatives->count - 1].error = leak;
    return status;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    const char *const *word = bl_signal_choices(subject, "interp");
    bl_status status = bl_trade_places_make(subject, -64, 64, settings, alternatives, message);
    for (; *word && status == BL_OK; word++)
        status = add(subject, *word, settings, alternatives, message);
    return status;
}

BL_TRADE_DESCRIPTOR(interpolation) = {
    .name = "interpolation",
    .title = "interpolation of the lattice",
    .question = "Which kernel keeps a lattice noise below 1 cycle a cell, and at what cost?",
    .paper = "peachey2003, pp. 70-72",
    .error_name = "power above 1 cycle per cell",
    .error_unit = "of the variance",
    .sample = "a value at a scattered point",
    .subject = "vnoise",
    .applies = applies,
    .open = open,
    .close = bl_trade_close_signals};
