// SPDX-License-Identifier: MIT
//
// What a figure opens and measures, through its run: the run owns it all and releases it when the
// figure has ended. Whatever fails ends the run (reports/run.h), so that all results are good.
//
// Settings begin with the seed and the threads of the run.
#ifndef BL_REPORTS_MEASURE_H
#define BL_REPORTS_MEASURE_H

#include "aliasing/alias.h"
#include "filters/summed_area.h"
#include "reports/run.h"
#include "spectra/histogram.h"
#include "spectra/psd.h"

// A signal by its text, as it stands; and with the seed of the run, where the signal has one and
// the text names none.
bl_signal *bl_run_signal(bl_run *run, const char *text);
bl_signal *bl_run_seeded_signal(bl_run *run, const char *text);
// Several by their texts, as they stand.
void bl_run_signals(bl_run *run, const char *const *texts, size_t count, bl_signal **signals);

// The signal as it filters itself exactly for samples of this width, for pictures that are not to
// show alias; the signal itself where it has no such form, or has a width of its own.
const bl_signal *bl_run_filtered(bl_run *run, const bl_signal *signal, double width);

const bl_view *bl_run_view(bl_run *run, const char *text, size_t width, size_t height);
const bl_method *bl_run_method(bl_run *run, const char *text, const bl_signal *signal);

bl_psd_settings bl_run_psd_settings(const bl_run *run, unsigned dims);
const bl_psd *bl_run_psd(bl_run *run, const bl_signal *signal, const bl_psd_settings *settings);
// NULL, with the reason, for a signal that does not fit the settings.
const bl_psd *bl_run_fitting_psd(bl_run *run, const bl_signal *signal,
                                 const bl_psd_settings *settings, bl_message *why);
// The share of the variance between two frequencies.
bl_estimate bl_psd_share(const bl_psd *psd, double from, double to);
// The same minus that of the closed form: NAN where there is none.
bl_estimate bl_psd_share_off(const bl_psd *psd, double from, double to);

bl_histogram_settings bl_run_histogram_settings(const bl_run *run, size_t samples);
const bl_histogram *bl_run_histogram(bl_run *run, const bl_signal *signal,
                                     const bl_histogram_settings *settings);

// Of the picture alone: no flicker, no times.
bl_alias_settings bl_run_alias_settings(const bl_run *run, double replicates, double most_samples);
const bl_alias_result *bl_run_alias(bl_run *run, const bl_signal *signal, const bl_view *view,
                                    const char *const *methods, size_t count,
                                    const bl_alias_settings *settings);

// The table of a square image, continued by its edges.
const bl_summed_area *bl_run_summed_area(bl_run *run, const float *values, size_t side,
                                         bl_sums sums);

#endif
