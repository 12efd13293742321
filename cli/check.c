// SPDX-License-Identifier: MIT
//
// The verb `check`: does a signal keep to its band, or is all true that it states? The exit status
// is the verdict.
#include <math.h>
#include <string.h>

#include "cli/claims.h"
#include "cli/json.h"
#include "cli/spectral.h"
#include "cli/verb.h"
#include "cli/words.h"

typedef struct check_settings {
    bl_spectral spectral;
    const char *band;
    double leak_db, guard, alpha;
    int claims;
} check_settings;

static void find_band(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    const bl_band_limit *limit = table->rows;
    int used =
        snprintf(cell->text, sizeof cell->text, "%g : %g cycles per unit", limit->from, limit->to);
    if (limit->guard > 0)
        snprintf(cell->text + used, sizeof cell->text - (size_t)used, ", guard %.3g", limit->guard);
    cell->word = cell->text;
}

// How far the window spreads power over the edges, and how much power is there.
static void find_edges(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    const bl_band_limit *limit = table->rows;
    snprintf(cell->text, sizeof cell->text,
             "%.2f dB of the variance within %.3g cycles per unit, inside or outside",
             limit->edge_db, bl_psd_smear(table->context));
    cell->word = cell->text;
}

static void find_smear(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    cell->value = bl_psd_smear(table->context);
}

// clang-format off
#define AT(member) .offset = offsetof(bl_band_limit, member)
#define DB BL_CELL_REAL, .decimals = 2, .unit = "dB of the variance"
static const bl_field limit_fields[] = {
    {"band", "band", BL_CELL_WORD, .find = find_band, .forms = BL_IN_TEXT},
    {"band", NULL, BL_CELL_LIST, AT(from), .length = 2}, // from and to
    {"guard_cycles_per_unit", NULL, BL_CELL_REAL, AT(guard)},
    {"smear_cycles_per_unit", NULL, BL_CELL_REAL, .find = find_smear},
    {"edge_db", NULL, DB, AT(edge_db)},
    {"leak_db", "leak", DB, AT(leak_db)},
    {"lower_db", "lower limit", DB, AT(lower_db)},
    {"upper_db", "upper limit", DB, AT(upper_db)},
    {"edges", "at its edges", BL_CELL_WORD, .find = find_edges, .forms = BL_IN_TEXT},
    {"limit_db", "allowed", DB, AT(limit_db)},
    {"verdict", "verdict", BL_CELL_VERDICT, AT(verdict), .forms = BL_IN_TEXT},
    {"needed_averages", NULL, BL_CELL_COUNT, AT(needed_averages)},
    {"needed_size", NULL, BL_CELL_COUNT, AT(needed_size)},
    {0}};
#undef DB
#undef AT
// clang-format on

static void report_json(json_t *object, const bl_signal *signal, const bl_psd *psd,
                        const bl_band_limit *limit) {
    bl_json_set_text(object, "verdict", bl_verdict_word(limit->verdict));
    bl_json_set_count(object, "exit_status", (uint64_t)bl_verdict_status(limit->verdict));
    bl_table record = BL_RECORD(limit_fields, limit);
    record.context = psd;
    bl_record_json(object, &record, 0);
    bl_json_set_text(object, "db_reference",
                     "total variance; null stands for -inf (no leak at all)");
    bl_spectral_json(object, signal, psd);
}

static void report_text(bl_call *call, const bl_signal *signal, const bl_psd *psd,
                        const bl_band_limit *limit) {
    FILE *out = call->out;
    const check_settings *settings = call->settings;
    bl_spectral_print(out, &settings->spectral, signal, psd);
    bl_table record = BL_RECORD(limit_fields, limit);
    record.context = psd;
    record.coloured = bl_call_coloured(call);
    fputc('\n', out);
    bl_record_print(&record, out);
    if (limit->needed_size && !signal->extent.size[0])
        fprintf(
            out, "%s of about %zu samples would tell the edge from what is beyond: --size %zu\n",
            psd->settings.dims == 1 ? "lines" : "sides", limit->needed_size, limit->needed_size);
    else if (limit->needed_size)
        fprintf(out, "the samples are too few to tell the edge from what is beyond\n");
    else if (limit->needed_averages)
        fprintf(out, "about %zu averages would settle it: --average %zu\n", limit->needed_averages,
                limit->needed_averages);
}

// Gives the verdict to the user.
static bl_status report(bl_call *call, const bl_signal *signal, const bl_psd *psd,
                        const bl_band_limit *limit) {
    if (bl_json_start(call))
        report_json(call->json, signal, psd, limit);
    else if (!call->common.quiet)
        report_text(call, signal, psd, limit);
    return call->path ? bl_spectral_csv(call, signal, psd) : BL_OK;
}

// The options of the spectrum say nothing to the scorecard.
static bl_status refuse_of_band(bl_call *call) {
    for (int i = 0; i < call->argument_count; i++) {
        const char *word = call->arguments[i];
        if (strcmp(word, "--") == 0)
            break;
        for (const bl_option *option = call->verb->options; option->name; option++) {
            size_t length = strlen(option->name);
            if (strncmp(word, "--", 2) == 0 && strncmp(word + 2, option->name, length) == 0 &&
                (word[2 + length] == '\0' || word[2 + length] == '=') &&
                strcmp(option->name, "claims") != 0 && strcmp(option->name, "alpha") != 0)
                return bl_report(&call->message, BL_USAGE,
                                 "--%s says nothing to --claims, which takes all from what the "
                                 "signal states; leave one of them out",
                                 option->name);
        }
    }
    return BL_OK;
}

static bl_status run_check(bl_call *call) {
    const check_settings *settings = call->settings;
    bl_band_limit limit = {.limit_db = settings->leak_db, .guard = settings->guard};
    bl_psd_settings wanted;
    bl_signal *signal;
    bl_psd psd;
    bl_status status = settings->claims ? refuse_of_band(call) : BL_OK;
    if (settings->claims)
        return status == BL_OK ? bl_check_claims(call, settings->alpha) : status;
    status = bl_read_range("band", settings->band, 1, &limit.from, &limit.to, &call->message);
    if (status == BL_OK && limit.from < 0)
        status = bl_report(&call->message, BL_USAGE, "--band %s: frequencies start at 0",
                           settings->band);
    if (status == BL_OK)
        status = bl_call_open(call, call->operands.words[0], &signal);
    if (status != BL_OK)
        return status;
    status = bl_spectral_settings(call, &settings->spectral, signal, &wanted);
    if (status == BL_OK) {
        int is_fixed = settings->spectral.size || signal->extent.size[0];
        bl_progress(call, "measuring %s ...", signal->text);
        status = bl_psd_judge_band(signal, &wanted, is_fixed, &psd, &limit, &call->message);
    }
    if (status == BL_OK) {
        // What folds may come to lie in the band, and be missing from the leak. Below -40 dB it is
        // not seen by the measurement of it.
        double leak = fmax(pow(10, 0.1 * settings->leak_db), 1e-4);
        bl_spectral_warn(call, signal, &psd, fmin(leak, BL_RESOLUTION_SPECTRUM));
        status = report(call, signal, &psd, &limit);
        bl_psd_free(&psd);
    }
    bl_signal_free(signal);
    if (status != BL_OK)
        return status;
    call->message.text[0] = '\0';
    return bl_verdict_status(limit.verdict);
}

static const bl_option options[] = {
    {"band", BL_OPTION_WORD, offsetof(check_settings, band), "A:B", .fallback = "0:1",
     .help = "the band, cycles per unit; B may be inf"},
    {"leak", BL_OPTION_REAL, offsetof(check_settings, leak_db), "DB", .fallback = "-30",
     .minimum = -300, .maximum = 0,
     .help = "share of the variance allowed outside of the band, dB of the variance"},
    {"guard", BL_OPTION_REAL, offsetof(check_settings, guard), "G", .fallback = "0", .minimum = 0,
     .maximum = 1e6, .help = "cycles per unit beyond both edges that are not judged"},
    BL_SPECTRAL_OPTIONS(check_settings),
    {"claims", BL_OPTION_FLAG, offsetof(check_settings, claims),
     .help = "judge every fact that the signal states, by the scorecard, in place of one band; "
             "options of a band are then refused"},
    {"alpha", BL_OPTION_REAL, offsetof(check_settings, alpha), "P", .fallback = "1e-6",
     .minimum = 1e-12, .maximum = 0.5,
     .help = "--claims: probability that a signal all of whose facts are true shows a failure "
             "by chance"},
    {0}};

const bl_verb bl_verb_check = {
    .name = "check",
    .operands = "SIGNAL",
    .summary = "band-limit verdict: does the signal keep to its band",
    .text =
        "Measures the share of the variance outside of the band. Pass (exit status 0): its upper "
        "confidence limit is below the leak allowed; fail (2): its lower limit is above; "
        "inconclusive (1): the limits straddle it, and the report says how many averages, or how "
        "long lines, would settle it. The window smears power over an edge of the band: the limits "
        "count what lies within the smear as outside for the upper one, as inside for the lower "
        "one. Where that leaves the verdict open, longer lines are measured, unless --size is "
        "given. It is an error (3) if there is nothing to judge: the signal is constant, or no "
        "measured frequency lies in the band, or none outside of it. --claims "
        "judges every fact that the signal states (its range, mean, variance, band and so on), a "
        "line a claim. A signal that states nothing is an error (3), and so is a program, which "
        "can state nothing.",
    .least = 1,
    .most = 1,
    .output = BL_OUTPUT_DATA,
    .output_help = "write the spectrum as CSV to PATH (as the JSON object, if PATH ends in .json)",
    .options = options,
    .settings_size = sizeof(check_settings),
    .run = run_check,
};
