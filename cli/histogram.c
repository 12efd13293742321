// SPDX-License-Identifier: MIT
//
// The verb `histogram`: the distribution of a signal's values.
#include <math.h>
#include <string.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "spectra/histogram.h"

typedef struct histogram_options {
    uint64_t samples, bins;
    const char *range;
    double level;
} histogram_options;

static void report_json(json_t *object, const bl_signal *signal, const bl_histogram *h) {
    bl_json_set_text(object, "signal", signal->text);
    bl_json_set_count(object, "samples", h->count);
    bl_json_set_count(object, "seed", h->settings.seed);
    bl_json_set_number(object, "level", h->settings.level);
    bl_json_set_estimate(object, "mean", &h->mean);
    bl_json_set_estimate(object, "variance", &h->variance);
    bl_json_set_number(object, "mean_theory", signal->facts.mean);
    bl_json_set_number(object, "variance_theory", signal->facts.variance);
    bl_json_set_number(object, "skewness", bl_moments_skewness(&h->moments));
    bl_json_set_number(object, "kurtosis", bl_moments_kurtosis(&h->moments));
    bl_json_set_text(object, "kurtosis_note", "3 for a normal distribution");
    bl_json_set_number(object, "min", h->minimum);
    bl_json_set_number(object, "max", h->maximum);
    bl_json_set_numbers(object, "min_at", h->minimum_at, signal->dimensions);
    bl_json_set_numbers(object, "max_at", h->maximum_at, signal->dimensions);
    double bound[2] = {signal->facts.lower, signal->facts.upper};
    bl_json_set_numbers(object, "bound", isfinite(bound[0]) && isfinite(bound[1]) ? bound : NULL,
                        2);
    bl_json_set_numbers(object, "bins", h->edges, h->settings.bins + 1);
    bl_json_set_text(object, "bins_note", "edges: one more than the counts");
    json_t *counts = json_array(), *quantiles = json_array();
    for (size_t i = 0; i < h->settings.bins; i++)
        json_array_append_new(counts, json_integer((json_int_t)h->counts[i]));
    json_object_set_new(object, "counts", counts);
    bl_json_set_count(object, "outside", h->outside);
    for (size_t i = 0; i < BL_QUANTILES; i++) {
        json_t *entry = json_object();
        bl_json_set_number(entry, "p", h->quantile_p[i]);
        bl_json_set_estimate(entry, "value", &h->quantile[i]);
        json_array_append_new(quantiles, entry);
    }
    json_object_set_new(object, "quantiles", quantiles);
}

// At most 32 rows: neighbouring bins are joined, which the last line says.
static void print_bars(FILE *out, const bl_histogram *h) {
    enum { WIDTH = 50 };
    size_t join = (h->settings.bins + 31) / 32, most = 1;
    fputs("     value, from : to      share\n", out);
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < h->settings.bins; i += join) {
            size_t end = i + join < h->settings.bins ? i + join : h->settings.bins, sum = 0;
            for (size_t k = i; k < end; k++)
                sum += h->counts[k];
            if (pass == 0 && sum > most)
                most = sum;
            if (pass == 0)
                continue;
            int length = (int)((double)sum / (double)most * WIDTH + 0.5);
            fprintf(out, "%10.4g : %-10.4g %9.5f%s%.*s\n", h->edges[i], h->edges[end],
                    (double)sum / (double)h->count, length ? "  " : "", length,
                    "##################################################");
        }
    if (join > 1)
        fprintf(out, "a row joins %zu of the %zu bins; --json and -o give each\n", join,
                h->settings.bins);
}

static void report_text(FILE *out, const bl_signal *signal, const bl_histogram *h) {
    bl_plain_text(out, signal->text);
    fprintf(out, ": %zu sample%s\n\nmean      ", h->count, bl_plural(h->count));
    bl_plain_estimate(out, &h->mean, h->settings.level, 6);
    fputs("\nvariance  ", out);
    bl_plain_estimate(out, &h->variance, h->settings.level, 6);
    if (isfinite(signal->facts.variance))
        fprintf(out, "   theory %.6g", signal->facts.variance);
    fputs("\nskewness  ", out);
    bl_plain_number(out, bl_moments_skewness(&h->moments), 4);
    fputs("\nkurtosis  ", out);
    bl_plain_number(out, bl_moments_kurtosis(&h->moments), 4);
    fprintf(out, " (3 for a normal distribution)\nrange     %.6g to %.6g", h->minimum + 0.0,
            h->maximum + 0.0);
    if (isfinite(signal->facts.lower) && isfinite(signal->facts.upper))
        fprintf(out, ", bound %.6g to %.6g", signal->facts.lower + 0.0, signal->facts.upper + 0.0);
    fputs("\nquantiles", out);
    for (size_t i = 0; i < BL_QUANTILES; i++)
        fprintf(out, " %g: %.4g%s", h->quantile_p[i], h->quantile[i].value + 0.0,
                i + 1 < BL_QUANTILES ? "," : "\n\n");
    print_bars(out, h);
    if (h->outside)
        fprintf(out, "%zu sample%s outside of these bins\n", h->outside,
                h->outside == 1 ? " lies" : "s lie");
}

static bl_status write_csv(bl_call *call, const bl_signal *signal, const bl_histogram *h) {
    bl_file file;
    bl_status status = bl_csv_open(call, &file);
    if (status != BL_OK)
        return status;
    char text[160];
    bl_csv_comment(file.stream, "bandlimit histogram", BL_VERSION);
    bl_csv_comment(file.stream, "signal", signal->text);
    snprintf(text, sizeof text, "samples %zu, outside %zu, seed %llu, mean %.9g, variance %.9g",
             h->count, h->outside, (unsigned long long)h->settings.seed, h->mean.value,
             h->variance.value);
    bl_csv_comment(file.stream, "settings", text);
    fputs("from,to,count,density\n", file.stream);
    for (size_t i = 0; i < h->settings.bins; i++) {
        double width = h->edges[i + 1] - h->edges[i];
        bl_csv_number(file.stream, h->edges[i]), fputc(',', file.stream);
        bl_csv_number(file.stream, h->edges[i + 1]), fputc(',', file.stream);
        fprintf(file.stream, "%zu,", h->counts[i]);
        bl_csv_number(file.stream, (double)h->counts[i] / (double)h->count / width),
            fputc('\n', file.stream);
    }
    return bl_csv_close(call, &file);
}

static bl_status settle(bl_call *call, bl_histogram_settings *settings) {
    const histogram_options *options = call->settings;
    *settings = bl_histogram_default_settings();
    settings->samples =
        options->samples ? options->samples : bl_histogram_usual_samples(call->size);
    settings->bins = options->bins;
    settings->level = options->level;
    settings->threads = bl_call_threads(call);
    if (call->common.seed_word)
        settings->seed = call->common.seed;
    return options->range ? bl_read_range("range", options->range, 0, &settings->from,
                                          &settings->to, &call->message)
                          : BL_OK;
}

static bl_status run_histogram(bl_call *call) {
    bl_histogram_settings settings;
    bl_signal *signal = NULL;
    bl_histogram histogram;
    bl_status status = settle(call, &settings);
    if (status == BL_OK)
        status = bl_call_open(call, call->operands.words[0], &signal);
    if (status == BL_OK) {
        bl_progress(call, "measuring %s ...", signal->text);
        status = bl_histogram_measure(signal, &settings, &histogram, &call->message);
    }
    if (status == BL_OK) {
        if (bl_json_start(call))
            report_json(call->json, signal, &histogram);
        else if (!call->common.quiet)
            report_text(call->out, signal, &histogram);
        if (call->path)
            status = write_csv(call, signal, &histogram);
        bl_histogram_free(&histogram);
    }
    bl_signal_free(signal);
    return status;
}

static const bl_option options[] = {
    {.name = "samples",
     .kind = BL_OPTION_UNSIGNED,
     .offset = offsetof(histogram_options, samples),
     .value = "N",
     .minimum = 2,
     .maximum = 1e12,
     .help = "samples at random places; an image gives all its own (default: a million or so; "
             "65536 with --quick, 2^26 with --full)"},
    {.name = "bins",
     .kind = BL_OPTION_UNSIGNED,
     .offset = offsetof(histogram_options, bins),
     .value = "N",
     .fallback = "64",
     .minimum = 1,
     .maximum = 1e6,
     .help = "bins of equal width"},
    {.name = "range",
     .kind = BL_OPTION_WORD,
     .offset = offsetof(histogram_options, range),
     .value = "LO:HI",
     .help = "values of the first and last edge (default: the range observed)"},
    {.name = "level",
     .kind = BL_OPTION_REAL,
     .offset = offsetof(histogram_options, level),
     .value = "P",
     .fallback = "0.95",
     .minimum = 0.5,
     .maximum = 0.999999,
     .help = "confidence level of the intervals"},
    {0}};

const bl_verb bl_verb_histogram = {
    .name = "histogram",
    .operands = "SIGNAL",
    .summary = "distribution of values, moments, range",
    .text =
        "Samples the signal at independent random places and seeds. Kurtosis is 3 for a normal "
        "distribution.",
    .least = 1,
    .most = 1,
    .output = BL_OUTPUT_DATA,
    .output_help = "write the bins as CSV to PATH (as the JSON object, if PATH ends in .json)",
    .options = options,
    .settings_size = sizeof(histogram_options),
    .run = run_histogram,
};
