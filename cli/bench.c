// SPDX-License-Identifier: MIT
//
// The verb `bench`: what a sample costs, against the textbook's loop and other libraries, in one
// run.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "cli/verb.h"
#include "core/clock.h"
#include "score/bench.h"

typedef struct bench_settings {
    int check;
} bench_settings;

// --- the report ---------------------------------------------------------------------------------

static int is_transform(const void *row) {
    return bl_bench_is_transform(row);
}

static int is_loop(const void *row) {
    return !bl_bench_is_transform(row);
}

static int is_textbook(const void *row) {
    const char *against = ((const bl_bench_row *)row)->against;
    return against && strcmp(against, "textbook") == 0;
}

static int has_floor(const void *row) {
    return !isnan(((const bl_bench_row *)row)->floor);
}

// A spectrum is told in bare transforms: fewer are better.
static void find_ratio_text(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_bench_row *is = (const bl_bench_row *)table->rows + row;
    cell->value = is_transform(is) ? is->transforms : is->ratio;
}

static void find_floor_text(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_bench_row *is = (const bl_bench_row *)table->rows + row;
    snprintf(cell->text, sizeof cell->text, is_transform(is) ? "<= %.3g" : ">= %.3g",
             is_transform(is) ? is->ceiling : is->floor);
    cell->word = cell->text;
}

// clang-format off
#define AT(member) .offset = offsetof(bl_bench_row, member)
static const bl_field fields[] = {
    {"signal", "signal", BL_CELL_LETTERS, AT(signal)},
    {"path", "path", BL_CELL_WORD, AT(path)},
    {"axis", "ax", BL_CELL_WORD, AT(axis)},
    {"isa", "isa", BL_CELL_WORD, AT(isa)},
    {"peer", NULL, BL_CELL_FLAG, AT(peer), .forms = BL_IN_JSON},
    {"samples_per_cell", "per cell", BL_CELL_REAL, AT(samples_per_cell), .digits = 3},
    {"samples", NULL, BL_CELL_REAL, AT(samples), .forms = BL_IN_JSON},
    {"ns_per_sample", "ns", BL_CELL_REAL, AT(candidate.minimum), .decimals = 3},
    {"ns_per_sample_median", NULL, BL_CELL_REAL, AT(candidate.median)},
    {"yardstick", "against", BL_CELL_WORD, AT(against)},
    {"yardstick_ns_per_sample", NULL, BL_CELL_REAL, AT(yardstick.minimum)},
    {"yardstick_ns_per_sample_median", NULL, BL_CELL_REAL, AT(yardstick.median), .forms = BL_IN_JSON},
    {"ratio", NULL, BL_CELL_REAL, AT(ratio), .forms = BL_IN_CSV},
    {"ratio", NULL, BL_CELL_REAL, AT(ratio), .when = is_loop, .forms = BL_IN_JSON},
    {"ratio", "ratio", BL_CELL_REAL, .find = find_ratio_text, .decimals = 2, .forms = BL_IN_TEXT},
    {"ratio_textbook", NULL, BL_CELL_REAL, AT(ratio), .when = is_textbook, .forms = BL_IN_JSON},
    {"cost_in_transforms", NULL, BL_CELL_REAL, AT(transforms), .when = is_transform, .absent = 1,
     .forms = BL_IN_JSON},
    {"max_error", "error", BL_CELL_REAL, AT(max_error), .digits = 2},
    {"floor", NULL, BL_CELL_REAL, AT(floor), .forms = BL_IN_CSV},
    {"floor", NULL, BL_CELL_REAL, AT(floor), .when = is_loop, .absent = 1, .forms = BL_IN_JSON},
    {"floor", "floor", BL_CELL_WORD, .when = has_floor, .find = find_floor_text, .forms = BL_IN_TEXT},
    {"ceiling", NULL, BL_CELL_REAL, AT(ceiling), .when = is_transform, .absent = 1,
     .forms = BL_IN_JSON},
    {"floor_met", NULL, BL_CELL_FLAG, AT(met), .when = has_floor, .forms = BL_IN_JSON},
    {"verdict", "verdict", BL_CELL_VERDICT, AT(verdict), .when = has_floor, .forms = BL_IN_TEXT},
    {0}};
#undef AT
// clang-format on

static bl_table rows_of(const bl_bench *bench) {
    return BL_TABLE(fields, bench->rows, bench->count);
}

typedef struct bench_head {
    char processor[128];
    const char *compiler;
    unsigned threads, threads_of_psd, rounds;
    const char *clock;
} bench_head;

#define AT(member) .offset = offsetof(bench_head, member)
static const bl_field head_fields[] = {
    {"processor", "processor", BL_CELL_LETTERS, AT(processor)},
    {"compiler", "compiler", BL_CELL_WORD, AT(compiler)},
    {"threads", "threads", BL_CELL_UNSIGNED, AT(threads)},
    {"threads_of_psd", "of psd", BL_CELL_UNSIGNED, AT(threads_of_psd)},
    {"rounds", "rounds", BL_CELL_UNSIGNED, AT(rounds)},
    {"clock", "clock", BL_CELL_WORD, AT(clock)},
    {0}};
#undef AT

static bench_head head_of(const bl_bench *bench) {
    bench_head head = {.compiler = __VERSION__,
                       .threads = 1,
                       .threads_of_psd = (unsigned)bench->threads,
                       .rounds = (unsigned)bench->rounds,
                       .clock = "CLOCK_MONOTONIC; pieces by turns; the least of the rounds"};
    bl_processor_name(head.processor, sizeof head.processor);
    return head;
}

// Without --check the floors are shown and not judged.
static void report_json(json_t *object, const bl_bench *bench, int checked, bl_verdict verdict) {
    const bench_head head = head_of(bench);
    const bl_table record = BL_RECORD(head_fields, &head), rows = rows_of(bench);
    bl_record_json(object, &record, 0);
    json_object_set_new(object, "rows", bl_table_json(&rows));
    bl_json_set_count(object, "floors_missed", bl_bench_missed(bench));
    bl_json_set_text(object, "verdict", checked ? bl_verdict_word(verdict) : "not judged");
    bl_json_set_count(object, "exit_status", (uint64_t)bl_verdict_status(verdict));
}

static void report_text(bl_call *call, const bl_bench *bench) {
    const bench_head head = head_of(bench);
    const bl_table record = BL_RECORD(head_fields, &head);
    bl_table rows = rows_of(bench);
    rows.coloured = bl_call_coloured(call);
    bl_record_print(&record, call->out);
    fprintf(
        call->out,
        "\nper cell: samples in a lattice cell (points: %d over a cube of %d cells a side, hardly "
        "two in one)\n"
        "ns: of a sample, the least of the rounds\n"
        "against: the plain loop of the textbook, or for other settings than the default the "
        "reference in\n  double, at the same places\n"
        "ratio: how much faster than that (psd: how many bare transforms it costs)\n"
        "error: against the double reference around 0, 1e6 and 1e9\n"
        "floor: the ratio asked for, which only --check makes the exit status\n\n",
        BL_SCATTERED, BL_SCATTER_CUBE);
    bl_table_print(&rows, call->out);
}

static bl_status write_csv(bl_call *call, const bl_bench *bench) {
    const bench_head head = head_of(bench);
    const bl_table record = BL_RECORD(head_fields, &head), rows = rows_of(bench);
    return bl_csv_write(call, NULL, &record, &rows);
}

// The signals named, or the whole registry, with the instruction sets asked for.
static bl_status time_noises(bl_call *call, bl_bench *bench) {
    size_t named = call->operands.count;
    bl_status status = BL_OK;
    for (size_t i = 0; i < (named ? named : bl_noise_count()); i++)
        for (int isa = 0; isa < BL_ISA_COUNT && status == BL_OK; isa++) {
            bl_isa only = call->isa == BL_ISA_BEST ? bl_isa_best() : call->isa;
            if (call->every_isa ? !bl_isa_runs_here((bl_isa)isa) : isa != (int)only)
                continue;
            const char *text =
                named ? call->operands.words[i] : bl_noise_at(i, BL_ISA_BASELINE)->name;
            status = bl_bench_noise(bench, text, (bl_isa)isa, &call->message);
        }
    return status;
}

static void show_progress(void *user, const char *what) {
    bl_progress(user, "timing %s ...", what);
}

static bl_status run_bench(bl_call *call) {
    const bench_settings *settings = call->settings;
    bl_bench bench = {.isa = call->isa,
                      .threads = bl_call_threads(call),
                      .rounds = (int)bl_size_pick(call->size, 3, 9, 31),
                      .turn_seconds = bl_size_pick(call->size, 2e-4, 2e-3, 5e-3),
                      .progress = show_progress,
                      .user = call};
    bl_status status = time_noises(call, &bench);
    bl_verdict verdict = BL_VERDICT_PASS;
    if (status == BL_OK)
        status = bl_bench_peers(&bench, &call->message);
    if (status == BL_OK && call->operands.count == 0)
        status = bl_bench_psd(&bench, &call->message);
    bl_progress(call, NULL);
    if (settings->check && bl_bench_missed(&bench) > 0)
        verdict = BL_VERDICT_FAIL;
    if (status == BL_OK && bl_json_start(call))
        report_json(call->json, &bench, settings->check, verdict);
    else if (status == BL_OK && !call->common.quiet)
        report_text(call, &bench);
    if (status == BL_OK && call->path)
        status = write_csv(call, &bench);
    free(bench.rows);
    return status == BL_OK ? bl_verdict_status(verdict) : status;
}

static const bl_option options[] = {{"check", BL_OPTION_FLAG, offsetof(bench_settings, check),
                                     .help = "exit with 2 if a ratio is below its floor"},
                                    {0}};

const bl_verb bl_verb_bench = {
    .name = "bench",
    .operands = "[NOISE...]",
    .summary = "throughput, ns a sample, against what is installed",
    .text =
        "Times rows of samples along each axis (20 and 2 samples a cell) and scattered points. "
        "Each takes turns with a plain loop at the same places: the textbook's or, for settings "
        "other than the default, the reference in double. Then come the other libraries that are "
        "installed (stb_perlin, libnoise), and a radial spectrum of 4096 x 4096 samples against "
        "the bare transform. With words, those noises alone and no spectrum.",
    .most = 4096,
    .output = BL_OUTPUT_DATA,
    .output_help = "write the rows as CSV to PATH (as the JSON object, if PATH ends in .json)",
    .takes_every_isa = 1,
    .options = options,
    .settings_size = sizeof(bench_settings),
    .run = run_bench,
};
