// SPDX-License-Identifier: MIT
//
// A running figure: what it has written, said and claimed so far.
#include "reports/run.h"

#include <assert.h>
#include <math.h>
#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/csv.h"
#include "core/version.h"
#include "reports/output.h"
#include "reports/owned.h"
#include "reports/record.h"

struct bl_run {
    const bl_reproduce_settings *settings;
    size_t done, total;
    bl_figure_result result;
    bl_run_note *notes;
    bl_run_picture *plots;
    size_t note_count, plot_count;
    bl_owned texts;  // every string that a service copied; they live as long as the run
    bl_owned opened; // what the figure opened, measured and allocated, until it ends
    jmp_buf end;     // where a failure leads to
    bl_status status;
    bl_message *message; // of the caller
};

// --- failing ------------------------------------------------------------------------------------

bl_message *bl_run_message(bl_run *run) {
    return run->message;
}

void bl_run_must(bl_run *run, bl_status status) {
    assert(!omp_in_parallel());
    if (status == BL_OK)
        return;
    run->status = status;
    longjmp(run->end, 1);
}

static void need(bl_run *run, int have) {
    if (!have)
        bl_run_must(run, bl_report(run->message, BL_DEVICE, "out of memory in figure %s",
                                   run->result.figure->name));
}

// Makes room for one more element of a list.
static void grow(bl_run *run, void *list, size_t count, size_t size) {
    need(run, bl_grow(list, count, size));
}

// --- what is owned ------------------------------------------------------------------------------

void *bl_run_keep(bl_run *run, void *thing, void (*release)(void *thing)) {
    need(run, thing && bl_owned_add(&run->opened, thing, release));
    return thing;
}

void bl_run_release(bl_run *run, const void *thing) {
    bl_owned_release(&run->opened, thing);
}

void *bl_run_memory(bl_run *run, size_t count, size_t size) {
    return bl_run_keep(run, calloc(count ? count : 1, size), free);
}

static const char *keep(bl_run *run, char *text) {
    need(run, text && bl_owned_add(&run->texts, text, free));
    return text;
}

const char *bl_run_text(bl_run *run, const char *format, ...) {
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    return keep(run, length < 0 ? NULL : text);
}

// --- what is said -------------------------------------------------------------------------------

const bl_reproduce_settings *bl_run_settings(const bl_run *run) {
    return run->settings;
}

double bl_run_pick(const bl_run *run, double quick, double normal, double full) {
    return bl_size_pick(run->settings->size, quick, normal, full);
}

size_t bl_run_count(const bl_run *run, double quick, double normal, double full) {
    return (size_t)bl_run_pick(run, quick, normal, full);
}

bl_random bl_run_random(const bl_run *run, uint64_t stream) {
    return bl_random_seed(run->settings->seed, stream);
}

void bl_run_step(bl_run *run, const char *step) {
    const bl_reproduce_settings *settings = run->settings;
    if (settings->progress)
        settings->progress(settings->user, run->done, run->total, run->result.figure->name, step);
}

void bl_run_setting(bl_run *run, const char *name, const char *value) {
    const bl_run_note note = {keep(run, strdup(name)), keep(run, strdup(value))};
    grow(run, &run->notes, run->note_count, sizeof *run->notes);
    run->notes[run->note_count++] = note;
}

static void add_file(bl_run *run, const char *name, const char *ending) {
    bl_figure_result *result = &run->result;
    grow(run, &result->files, result->file_count, sizeof *result->files);
    result->files[result->file_count++] = bl_run_text(run, "%s.%s", name, ending);
}

// A data file begins with what it is, and with the settings that were noted so far.
static bl_file begin_csv(bl_run *run, const char *name, const char *what) {
    const bl_figure *figure = run->result.figure;
    bl_file file;
    bl_run_must(run, bl_output_create(run->result.folder, name, "csv", &file, run->message));
    fprintf(file.stream, "# %s\n# bandlimit %s, figure %s (%s), size %s, seed %llu\n", what,
            BL_VERSION, figure->name, figure->paper, bl_size_word(run->settings->size),
            (unsigned long long)run->settings->seed);
    for (size_t i = 0; i < run->note_count; i++)
        fprintf(file.stream, "# %s: %s\n", run->notes[i].name, run->notes[i].text);
    return file;
}

static void end_csv(bl_run *run, const char *name, bl_file *file) {
    bl_run_must(run, bl_file_commit(file, run->message));
    add_file(run, name, "csv");
}

static void put_cell(FILE *out, const bl_column *column, size_t row) {
    if (column->words)
        bl_csv_word(out, column->words[row]);
    else if (!isnan(column->values[row]))
        fprintf(out, "%.9g", column->values[row]); // infinity too: a band may be open
}

void bl_run_csv(bl_run *run, const char *name, const char *what, const bl_column *columns,
                size_t column_count, size_t rows) {
    bl_file file = begin_csv(run, name, what);
    for (size_t c = 0; c < column_count; c++) {
        fputs(c ? "," : "", file.stream);
        bl_csv_word(file.stream, columns[c].name);
    }
    fputc('\n', file.stream);
    for (size_t row = 0; row < rows; row++)
        for (size_t c = 0; c < column_count; c++) {
            put_cell(file.stream, &columns[c], row);
            fputc(c + 1 < column_count ? ',' : '\n', file.stream);
        }
    end_csv(run, name, &file);
}

void bl_run_table(bl_run *run, const char *name, const char *what, const bl_table *table) {
    bl_file file = begin_csv(run, name, what);
    bl_table_csv(table, file.stream);
    end_csv(run, name, &file);
}

// What the page tells of a plot: its texts, and its legend.
static void keep_picture(bl_run *run, const char *name, const bl_plot *plot,
                         const char *alternative) {
    grow(run, &run->plots, run->plot_count, sizeof *run->plots);
    bl_run_picture *kept = &run->plots[run->plot_count++];
    *kept = (bl_run_picture){.name = keep(run, strdup(name)),
                             .text = keep(run, strdup(alternative)),
                             .title = keep(run, strdup(plot->title))};
    const bl_panel *panel = bl_plot_legend(plot);
    for (size_t i = 0; i < panel->series_count && kept->key_count < BL_KEYS; i++)
        if (panel->series[i].label)
            kept->keys[kept->key_count++] =
                (bl_run_key){keep(run, strdup(panel->series[i].label)), panel->series[i].stroke,
                             panel->series[i].ink};
}

void bl_run_plot(bl_run *run, const char *name, const bl_plot *wanted, const char *alternative) {
    bl_plot plot = *wanted;
    int with_pdf = strcmp(run->settings->format, "pdf") == 0;
    const char *folder = run->result.folder;
    plot.title = plot.title ? plot.title : run->result.figure->question;
    bl_run_step(run, "plotting");
    bl_run_must(run, bl_plot_write(&plot, folder, name, with_pdf, run->message));
    add_file(run, name, "gp");
    bl_run_must(run, bl_plot_run(folder, name, with_pdf, run->message));
    add_file(run, name, "svg");
    add_file(run, name, "png");
    if (with_pdf)
        add_file(run, name, "pdf");
    keep_picture(run, name, &plot, alternative);
}

// The image's own attributes, then the settings of the run as "bandlimit:NAME".
static const bl_attribute *attributes_of(bl_run *run, const bl_image *image, size_t *count) {
    *count = image->attribute_count + run->note_count;
    bl_attribute *attributes = bl_run_memory(run, *count, sizeof *attributes);
    for (size_t i = 0; i < image->attribute_count; i++)
        attributes[i] = image->attributes[i];
    for (size_t i = 0; i < run->note_count; i++)
        attributes[image->attribute_count + i] = (bl_attribute){
            bl_run_text(run, "bandlimit:%s", run->notes[i].name), run->notes[i].text};
    return attributes;
}

const char *bl_run_image(bl_run *run, const char *name, const bl_image *image) {
    static const char *const endings[] = {"exr", "png"};
    bl_image full = *image;
    full.attributes = attributes_of(run, image, &full.attribute_count);
    for (int i = 0; i < 2; i++) {
        const char *path = bl_run_text(run, "%s/%s.%s", run->result.folder, name, endings[i]);
        bl_run_must(run, bl_image_write(path, &full, run->message));
        add_file(run, name, endings[i]);
    }
    return run->result.files[run->result.file_count - 1];
}

void bl_run_warn(bl_run *run, const char *text) {
    bl_figure_result *result = &run->result;
    const char *kept = bl_run_text(run, "%s", text);
    grow(run, &result->warnings, result->warning_count, sizeof *result->warnings);
    result->warnings[result->warning_count++] = kept;
}

void bl_run_claim(bl_run *run, const bl_claim *claim) {
    bl_figure_result *result = &run->result;
    grow(run, &result->claims, result->claim_count, sizeof *result->claims);
    bl_claim *kept = &result->claims[result->claim_count++];
    *kept = *claim;
    bl_claim_judge(kept);
    result->outcomes[bl_claim_outcome(kept)]++;
}

// --- the harness --------------------------------------------------------------------------------

bl_run_record bl_run_look(const bl_run *run) {
    return (bl_run_record){.result = &run->result,
                           .settings = run->notes,
                           .setting_count = run->note_count,
                           .plots = run->plots,
                           .plot_count = run->plot_count};
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void make_figure(bl_run *run) {
    const bl_figure *figure = run->result.figure;
    run->result.folder = bl_run_text(run, "%s/%s", run->settings->folder, figure->name);
    bl_run_must(run, bl_make_folder(run->result.folder, run->message));
    bl_run_step(run, "starting");
    figure->run(run);
    add_file(run, figure->name, "json");
    const bl_run_record record = bl_run_look(run);
    bl_run_must(run, bl_run_write_json(&record, run->settings, run->message));
}

bl_status bl_run_figure(const bl_figure *figure, const bl_reproduce_settings *settings, size_t done,
                        size_t total, bl_run **out, bl_message *message) {
    bl_run *run = calloc(1, sizeof *run);
    if (!run)
        return bl_report(message, BL_DEVICE, "out of memory");
    run->settings = settings;
    run->done = done;
    run->total = total;
    run->result.figure = figure;
    run->message = message;
    const double start = now();
    if (setjmp(run->end) == 0)
        make_figure(run);
    run->result.seconds = now() - start;
    bl_owned_release_all(&run->opened);
    const bl_status status = run->status;
    if (status == BL_OK)
        *out = run;
    else
        bl_run_free(run);
    return status;
}

void bl_run_free(bl_run *run) {
    if (!run)
        return;
    bl_owned_release_all(&run->texts);
    free(run->result.files);
    free(run->result.claims);
    free(run->result.warnings);
    free(run->notes);
    free(run->plots);
    free(run);
}
