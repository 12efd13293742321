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
#include "score/bench.h"

typedef struct bench_settings {
    int check;
} bench_settings;

static void read_processor(char *name, size_t size) {
    char line[256];
    snprintf(name, size, "unknown");
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info && fgets(line, sizeof line, info)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon)
            continue;
        colon[strcspn(colon, "\n")] = '\0';
        snprintf(name, size, "%s", colon + 1 + (colon[1] == ' '));
        break;
    }
    if (info)
        fclose(info);
}

static json_t *row_json(const bl_bench_row *row) {
    json_t *object = json_object();
    bl_json_set_text(object, "signal", row->signal);
    bl_json_set_text(object, "path", row->path);
    bl_json_set_text(object, "axis", row->axis);
    bl_json_set_text(object, "isa", row->isa);
    json_object_set_new(object, "peer", json_boolean(row->peer));
    bl_json_set_number(object, "samples_per_cell", row->samples_per_cell);
    bl_json_set_number(object, "samples", row->samples);
    bl_json_set_number(object, "ns_per_sample", row->candidate.minimum);
    bl_json_set_number(object, "ns_per_sample_median", row->candidate.median);
    int transform = bl_bench_is_transform(row);
    int textbook = row->against && strcmp(row->against, "textbook") == 0;
    bl_json_set_text(object, "yardstick", row->against);
    bl_json_set_number(object, "yardstick_ns_per_sample", row->yardstick.minimum);
    bl_json_set_number(object, "yardstick_ns_per_sample_median", row->yardstick.median);
    bl_json_set_number(object, "ratio", transform ? NAN : row->ratio);
    bl_json_set_number(object, "ratio_textbook", textbook ? row->ratio : NAN);
    if (transform)
        bl_json_set_number(object, "cost_in_transforms", 1 / row->ratio);
    bl_json_set_number(object, "max_error", row->max_error);
    if (transform)
        bl_json_set_number(object, "ceiling", 1 / row->floor);
    else
        bl_json_set_number(object, "floor", row->floor);
    json_object_set_new(object, "floor_met",
                        isnan(row->floor) ? json_null() : json_boolean(bl_bench_is_met(row)));
    return object;
}

// Without --check the floors are shown and not judged.
static void report_json(json_t *object, const bl_bench *bench, int checked, bl_verdict verdict) {
    char processor[128];
    read_processor(processor, sizeof processor);
    bl_json_set_text(object, "processor", processor);
    bl_json_set_text(object, "compiler", __VERSION__);
    bl_json_set_count(object, "threads", 1);
    bl_json_set_count(object, "threads_of_psd", (uint64_t)bench->threads);
    bl_json_set_count(object, "rounds", (uint64_t)bench->rounds);
    bl_json_set_text(object, "clock", "CLOCK_MONOTONIC; pieces by turns; the least of the rounds");
    json_t *rows = json_array();
    for (size_t i = 0; i < bench->count; i++)
        json_array_append_new(rows, row_json(&bench->rows[i]));
    json_object_set_new(object, "rows", rows);
    bl_json_set_count(object, "floors_missed", bl_bench_missed(bench));
    bl_json_set_text(object, "verdict", checked ? bl_verdict_word(verdict) : "not judged");
    bl_json_set_count(object, "exit_status", (uint64_t)bl_verdict_status(verdict));
}

static void print_number(FILE *out, const char *format, int width, double number) {
    if (isfinite(number))
        fprintf(out, format, width, number);
    else
        fprintf(out, "%*s", width, "-");
}

static void print_row(bl_call *call, const bl_bench_row *row) {
    FILE *out = call->out;
    fprintf(out, "%-22s %-9s %-2s %-9s", row->signal, row->path, row->axis ? row->axis : "-",
            row->isa);
    print_number(out, "%*.4g", 9, row->samples_per_cell);
    print_number(out, "%*.3f", 9, row->candidate.minimum);
    print_number(out, "%*.3f", 9, row->candidate.median);
    print_number(out, "%*.3f", 10, row->yardstick.minimum);
    fprintf(out, " %-9s", row->against ? row->against : "-");
    print_number(out, "%*.2f", 8, bl_bench_is_transform(row) ? 1 / row->ratio : row->ratio);
    print_number(out, "%*.1e", 10, row->max_error);
    if (!isnan(row->floor))
        fprintf(out, "  %s %.3g %s", bl_bench_is_transform(row) ? "<=" : ">=",
                bl_bench_is_transform(row) ? 1 / row->floor : row->floor,
                bl_call_verdict(call, bl_bench_is_met(row) ? BL_VERDICT_PASS : BL_VERDICT_FAIL));
    fputc('\n', out);
}

static void report_text(bl_call *call, const bl_bench *bench) {
    char processor[128];
    read_processor(processor, sizeof processor);
    fprintf(
        call->out,
        "%s; compiler %s\none thread (psd: %d); least and median of %d rounds by turns; error "
        "against the double\nreference around 0, 1e6 and 1e9; yardstick: the plain loop of the "
        "textbook, or for\nother settings than the default the reference in double, at the same "
        "places; ratio: how much\nfaster (psd: how many bare transforms it costs); per "
        "cell: samples in a lattice cell (points:\n%d over a cube of %d cells a side, hardly two "
        "in one); floor: the ratio asked for, which\nonly --check makes the exit status\n\n",
        processor, __VERSION__, bl_call_threads(call), bench->rounds, BL_SCATTERED,
        BL_SCATTER_CUBE);
    fprintf(call->out, "%-22s %-9s %-2s %-9s%9s%9s%9s%10s %-9s%8s%10s  %s\n", "signal", "path",
            "ax", "isa", "per cell", "ns", "median", "plain ns", "loop", "ratio", "error", "floor");
    for (size_t i = 0; i < bench->count; i++)
        print_row(call, &bench->rows[i]);
}

static bl_status write_csv(bl_call *call, const bl_bench *bench) {
    bl_file file;
    char processor[128];
    bl_status status = bl_csv_open(call, &file);
    if (status != BL_OK)
        return status;
    read_processor(processor, sizeof processor);
    bl_csv_comment(file.stream, "bandlimit bench", BL_VERSION);
    bl_csv_comment(file.stream, "processor", processor);
    bl_csv_comment(file.stream, "compiler", __VERSION__);
    fputs(
        "signal,path,axis,isa,samples_per_cell,ns_per_sample,ns_per_sample_median,"
        "yardstick,yardstick_ns_per_sample,ratio,max_error,floor\n",
        file.stream);
    for (size_t i = 0; i < bench->count; i++) {
        const bl_bench_row *row = &bench->rows[i];
        const double times[] = {row->samples_per_cell, row->candidate.minimum,
                                row->candidate.median};
        const double against[] = {row->yardstick.minimum, row->ratio, row->max_error};
        bl_csv_word(file.stream, row->signal, ',');
        bl_csv_word(file.stream, row->path, ',');
        bl_csv_word(file.stream, row->axis ? row->axis : "", ',');
        bl_csv_word(file.stream, row->isa, ',');
        for (size_t k = 0; k < 3; k++)
            bl_csv_number(file.stream, times[k], ',');
        bl_csv_word(file.stream, row->against ? row->against : "", ',');
        for (size_t k = 0; k < 3; k++)
            bl_csv_number(file.stream, against[k], ',');
        bl_csv_number(file.stream, row->floor, '\n');
    }
    return bl_csv_close(call, &file);
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

static const bl_option options[] = {{.name = "check",
                                     .kind = BL_OPTION_FLAG,
                                     .offset = offsetof(bench_settings, check),
                                     .help = "exit with 2 if a ratio is below its floor"},
                                    {0}};

const bl_verb bl_verb_bench = {
    .name = "bench",
    .operands = "[NOISE...]",
    .summary = "throughput, ns a sample, against what is installed",
    .text =
        "Times rows of samples along each axis (20 and 2 samples a cell) and scattered points, "
        "by turns with a plain loop at the same places (the textbook's, or for other settings than "
        "the default the reference in double), then the other "
        "libraries that are installed (stb_perlin, libnoise), then a radial spectrum of 4096 x "
        "4096 samples against the bare transform. With words, those noises alone and no "
        "spectrum.",
    .most = 4096,
    .output = BL_OUTPUT_DATA,
    .output_help = "write the rows as CSV to PATH (as the JSON object, if PATH ends in .json)",
    .takes_every_isa = 1,
    .options = options,
    .settings_size = sizeof(bench_settings),
    .run = run_bench,
};
