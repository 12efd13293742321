// SPDX-License-Identifier: MIT
//
// The verb `compare`: the comparison figures of the papers for any signals, side by side.
#include "cli/figures.h"
#include "reports/compare.h"
#include "spectra/histogram.h"

typedef struct compare_options {
    const char *format;
} compare_options;

enum { PROBES = 1 << 14 };

// Whether it has values, and all are finite: an hour later is too late to learn of it.
static bl_status check_values(bl_call *call, const bl_signal *signal) {
    bl_histogram_settings settings = bl_histogram_default_settings();
    bl_histogram histogram;
    settings.samples = PROBES;
    settings.threads = bl_call_threads(call);
    settings.seed = call->common.seed;
    bl_status status = bl_histogram_measure(signal, &settings, &histogram, &call->message);
    if (status == BL_OK)
        bl_histogram_free(&histogram);
    return status;
}

// Every signal is opened once before anything is made: a typing error must not leave a folder.
static bl_status check_signals(bl_call *call) {
    bl_status status = BL_OK;
    for (size_t i = 0; i < call->operands.count && status == BL_OK; i++) {
        bl_signal *signal;
        status = bl_call_open(call, call->operands.words[i], &signal);
        if (status != BL_OK)
            break;
        status = check_values(call, signal);
        bl_signal_free(signal);
    }
    return status;
}

static bl_status run_compare(bl_call *call) {
    const compare_options *options = call->settings;
    bl_reproduce_settings settings = bl_reproduce_default_settings();
    settings.folder = "compare";
    settings.format = options->format;
    settings.figures = bl_comparisons;
    settings.figure_count = BL_COMPARISONS;
    settings.signals = call->operands.words;
    settings.signal_count = call->operands.count;
    bl_status status = check_signals(call);
    return status == BL_OK ? bl_figures_run(call, NULL, 0, &settings) : status;
}

static const char *const formats[] = {"svg", "pdf", NULL};

static const bl_option options[] = {{"format", BL_OPTION_CHOICE, offsetof(compare_options, format),
                                     "FORMAT", .fallback = "svg", .choices = formats,
                                     .help = "the plots as SVG alone, or with a PDF beside each"},
                                    {0}};

const bl_verb bl_verb_compare = {
    .name = "compare",
    .operands = "SIGNAL...",
    .summary = "the papers' comparison figures for these signals",
    .text =
        "The figures by which peachey2003 compares noises, for any signals: graphs along a line, "
        "slices, and power spectra with their closed forms; and the distribution of the values. "
        "Each figure gets a folder of its own with its data, its plots and the scripts that drew "
        "them; index.html shows all. A signal that lacks a dimension is left out of the figures "
        "that need it, and the page says so.",
    .least = 1,
    .most = 52,
    .output = BL_OUTPUT_FOLDER,
    .output_help = "the folder to write into (default: compare)",
    .options = options,
    .settings_size = sizeof(compare_options),
    .run = run_compare,
};
