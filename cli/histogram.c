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

// --- its values ---------------------------------------------------------------------------------

static const bl_histogram *histogram_of(const bl_table *table) {
    return table->rows;
}

static const bl_facts *facts_of(const bl_table *table) {
    return &((const bl_signal *)table->context)->facts;
}

static void find_theory(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    cell->value = facts_of(table)->variance;
}

static int has_bound(const void *facts) {
    return isfinite(((const bl_facts *)facts)->lower) && isfinite(((const bl_facts *)facts)->upper);
}

static void find_range(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    const bl_histogram *h = histogram_of(table);
    const bl_facts *facts = facts_of(table);
    int length =
        snprintf(cell->text, sizeof cell->text, "%.6g to %.6g", h->minimum + 0.0, h->maximum + 0.0);
    if (has_bound(facts))
        snprintf(cell->text + length, sizeof cell->text - (size_t)length, ", bound %.6g to %.6g",
                 facts->lower + 0.0, facts->upper + 0.0);
    cell->word = cell->text;
}

static void find_upper_edge(const bl_table *table, size_t row, bl_cell *cell) {
    cell->value = histogram_of(table)->edges[row + 1];
}

static void find_density(const bl_table *table, size_t row, bl_cell *cell) {
    cell->value = bl_histogram_density(histogram_of(table), row);
}

static void find_probability(const bl_table *table, size_t row, bl_cell *cell) {
    cell->value = ((const bl_histogram *)table->context)->quantile_p[row];
}

// clang-format off
#define AT(member) .offset = offsetof(bl_histogram, member)
static const bl_field head_fields[] = {
    {"samples", NULL, BL_CELL_COUNT, AT(count)},
    {"seed", NULL, BL_CELL_COUNT, AT(settings.seed)},
    {"level", NULL, BL_CELL_REAL, AT(settings.level)},
    {"mean", "mean", BL_CELL_ESTIMATE, AT(mean), .digits = 6, .limits = ""},
    {"variance", "variance", BL_CELL_ESTIMATE, AT(variance), .digits = 6, .limits = ""},
    {"theory", "theory", BL_CELL_REAL, .find = find_theory, .digits = 6, .forms = BL_IN_TEXT,
     .optional = 1},
    {"skewness", "skewness", BL_CELL_REAL, AT(skewness), .forms = BL_IN_TEXT | BL_IN_JSON},
    {"kurtosis", "kurtosis", BL_CELL_REAL, AT(kurtosis),
     .forms = BL_IN_TEXT | BL_IN_JSON, .unit = "(3 for a normal distribution)"},
    {"range", "range", BL_CELL_WORD, .find = find_range, .forms = BL_IN_TEXT},
    {"min", NULL, BL_CELL_REAL, AT(minimum)},
    {"max", NULL, BL_CELL_REAL, AT(maximum)},
    {"outside", NULL, BL_CELL_COUNT, AT(outside)},
    {0}};

static const bl_field bin_fields[] = {
    {"from", NULL, BL_CELL_REAL, AT(edges), .forms = BL_IN_CSV},
    {"to", NULL, BL_CELL_REAL, .find = find_upper_edge, .forms = BL_IN_CSV},
    {"count", NULL, BL_CELL_COUNT, AT(counts), .forms = BL_IN_CSV},
    {"density", NULL, BL_CELL_REAL, .find = find_density, .forms = BL_IN_CSV},
    {"counts", NULL, BL_CELL_COUNT, AT(counts), .forms = BL_IN_JSON},
    {0}};
#undef AT

#define AT(member) .offset = offsetof(bl_facts, member)
static const bl_field fact_fields[] = {
    {"mean_theory", NULL, BL_CELL_REAL, AT(mean)},
    {"variance_theory", NULL, BL_CELL_REAL, AT(variance)},
    {"bound", NULL, BL_CELL_LIST, AT(lower), .length = 2, .when = has_bound}, // and the upper one
    {0}};
#undef AT

static const bl_field quantile_fields[] = {
    {"p", NULL, BL_CELL_REAL, .find = find_probability},
    {"value", NULL, BL_CELL_ESTIMATE, .offset = 0},
    {0}};
// clang-format on

static bl_table head_of(const bl_signal *signal, const bl_histogram *h) {
    bl_table head = BL_RECORD(head_fields, h);
    head.context = signal;
    head.level = h->settings.level;
    return head;
}

static bl_table bins_of(const bl_histogram *h) {
    return (bl_table){.fields = bin_fields, .rows = h, .count = h->settings.bins};
}

static void report_json(json_t *object, const bl_signal *signal, const bl_histogram *h) {
    const bl_table head = head_of(signal, h), bins = bins_of(h);
    bl_table quantiles = BL_TABLE(quantile_fields, h->quantile, BL_QUANTILES);
    quantiles.context = h;
    bl_json_set_text(object, "signal", signal->text);
    bl_record_json(object, &head, 0);
    bl_record_json(object, &BL_RECORD(fact_fields, &signal->facts), 0);
    bl_json_set_text(object, "kurtosis_note", "3 for a normal distribution");
    bl_json_set_numbers(object, "min_at", h->minimum_at, signal->dimensions);
    bl_json_set_numbers(object, "max_at", h->maximum_at, signal->dimensions);
    bl_json_set_numbers(object, "bins", h->edges, h->settings.bins + 1);
    bl_json_set_text(object, "bins_note", "edges: one more than the counts");
    bl_table_json_columns(object, &bins);
    json_object_set_new(object, "quantiles", bl_table_json(&quantiles));
}

// --- bars ---------------------------------------------------------------------------------------

enum { BARS = 32, BAR = 50 };

typedef struct histogram_bar {
    double from, to, share;
    char bar[BAR + 1];
} histogram_bar;

#define AT(member) .offset = offsetof(histogram_bar, member)
static const bl_field bar_fields[] = {{"from", "from", BL_CELL_REAL, AT(from)},
                                      {"to", "to", BL_CELL_REAL, AT(to)},
                                      {"share", "share", BL_CELL_REAL, AT(share), .decimals = 5},
                                      {"bar", "", BL_CELL_LETTERS, AT(bar)},
                                      {0}};
#undef AT

// At most 32 rows: neighbouring bins are joined, which the last line says.
static void print_bars(FILE *out, const bl_histogram *h) {
    histogram_bar bars[BARS];
    size_t bins = h->settings.bins, join = (bins + BARS - 1) / BARS, count = 0;
    double most = 0;
    for (size_t i = 0; i < bins; i += join, count++) {
        size_t end = i + join < bins ? i + join : bins;
        bars[count] =
            (histogram_bar){h->edges[i], h->edges[end], bl_histogram_share(h, i, end), ""};
        most = fmax(most, bars[count].share);
    }
    for (size_t i = 0; i < count && most > 0; i++)
        memset(bars[i].bar, '#', (size_t)(bars[i].share / most * BAR + 0.5));
    bl_table_print(&BL_TABLE(bar_fields, bars, count), out);
    if (join > 1)
        fprintf(out, "a row joins %zu of the %zu bins; --json and -o give each\n", join, bins);
}

static void print_quantiles(FILE *out, const bl_histogram *h) {
    char text[BL_QUANTILES * 32] = "";
    for (size_t i = 0; i < BL_QUANTILES; i++)
        sprintf(text + strlen(text), "%s%g: %.4g", i ? ", " : "", h->quantile_p[i],
                h->quantile[i].value + 0.0);
    fputs("quantiles ", out);
    bl_plain_wrap(out, text, 10, 10, 100);
    fputs("\n\n", out);
}

static void report_text(FILE *out, const bl_signal *signal, const bl_histogram *h) {
    const bl_table head = head_of(signal, h);
    bl_plain_text(out, signal->text);
    fprintf(out, ": %zu sample%s\n\n", h->count, bl_plural(h->count));
    bl_record_print(&head, out);
    print_quantiles(out, h);
    print_bars(out, h);
    if (h->outside)
        fprintf(out, "%zu sample%s outside of these bins\n", h->outside,
                h->outside == 1 ? " lies" : "s lie");
}

static bl_status write_csv(bl_call *call, const bl_signal *signal, const bl_histogram *h) {
    const bl_table head = head_of(signal, h), bins = bins_of(h);
    return bl_csv_write(call, signal->text, &head, &bins);
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
    {"samples", BL_OPTION_UNSIGNED, offsetof(histogram_options, samples), "N", .minimum = 2,
     .maximum = 1e12,
     .help = "samples at random places; an image gives all its own (default: a million or so; "
             "65536 with --quick, 2^26 with --full)"},
    {"bins", BL_OPTION_UNSIGNED, offsetof(histogram_options, bins), "N", .fallback = "64",
     .minimum = 1, .maximum = 1e6, .help = "bins of equal width"},
    {"range", BL_OPTION_WORD, offsetof(histogram_options, range), "LO:HI",
     .help = "values of the first and last edge (default: the range observed)"},
    BL_LEVEL_OPTION(offsetof(histogram_options, level)),
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
