// SPDX-License-Identifier: MIT
//
// A running figure: what it has written, said and claimed so far.
#include "reports/run.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/version.h"
#include "reports/output.h"

struct bl_run {
    const bl_reproduce_settings *settings;
    size_t done, total;
    bl_figure_result result;
    bl_run_note *notes;
    bl_run_picture *plots;
    size_t note_count, plot_count;
    char **texts; // every string that a service copied
    size_t text_count;
    int starved; // a list could not grow: reported when the figure ends
};

// Makes room for one more element of a list. On failure the list is untouched and the run is
// marked, so that lists of notes and claims need no status of their own.
static int grow(bl_run *run, void *list, size_t count, size_t size) {
    void **where = list;
    if (count & (count - 1)) // room is made at 0 and at the powers of two
        return 1;
    void *larger = realloc(*where, (count ? 2 * count : 1) * size);
    if (!larger) {
        run->starved = 1;
        return 0;
    }
    *where = larger;
    return 1;
}

static const char *keep(bl_run *run, char *text) {
    if (!text || !grow(run, &run->texts, run->text_count, sizeof *run->texts)) {
        free(text);
        run->starved = 1;
        return "";
    }
    return run->texts[run->text_count++] = text;
}

const char *bl_run_vtext(bl_run *run, const char *format, va_list arguments) {
    char *text = NULL;
    return keep(run, vasprintf(&text, format, arguments) < 0 ? NULL : text);
}

const char *bl_run_text(bl_run *run, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const char *text = bl_run_vtext(run, format, arguments);
    va_end(arguments);
    return text;
}

const bl_reproduce_settings *bl_run_settings(const bl_run *run) {
    return run->settings;
}

double bl_run_pick(const bl_run *run, double quick, double normal, double full) {
    return bl_size_pick(run->settings->size, quick, normal, full);
}

void bl_run_step(bl_run *run, const char *step) {
    const bl_reproduce_settings *settings = run->settings;
    if (settings->progress)
        settings->progress(settings->user, run->done, run->total, run->result.figure->name, step);
}

void bl_run_setting(bl_run *run, const char *name, const char *value) {
    if (grow(run, &run->notes, run->note_count, sizeof *run->notes))
        run->notes[run->note_count++] =
            (bl_run_note){keep(run, strdup(name)), keep(run, strdup(value))};
}

static void add_file(bl_run *run, const char *name, const char *ending) {
    bl_figure_result *result = &run->result;
    if (!grow(run, &result->files, result->file_count, sizeof *result->files))
        return;
    char *file = NULL;
    if (asprintf(&file, "%s.%s", name, ending) < 0)
        run->starved = 1;
    else
        result->files[result->file_count++] = file;
}

// RFC 4180: quotes only where they are needed, doubled inside.
static void put_field(FILE *out, const char *text) {
    if (!strpbrk(text, "\",\r\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void put_cell(FILE *out, const bl_column *column, size_t row) {
    if (column->words)
        put_field(out, column->words[row]);
    else if (!isnan(column->values[row]))
        fprintf(out, "%.9g", column->values[row]);
}

static void put_table(FILE *out, const bl_run *run, const char *what, const bl_column *columns,
                      size_t column_count, size_t rows) {
    const bl_figure *figure = run->result.figure;
    fprintf(out, "# %s\n# bandlimit %s, figure %s (%s), size %s, seed %llu\n", what, BL_VERSION,
            figure->name, figure->paper, bl_size_word(run->settings->size),
            (unsigned long long)run->settings->seed);
    for (size_t i = 0; i < run->note_count; i++)
        fprintf(out, "# %s: %s\n", run->notes[i].name, run->notes[i].text);
    for (size_t c = 0; c < column_count; c++) {
        fputs(c ? "," : "", out);
        put_field(out, columns[c].name);
    }
    fputc('\n', out);
    for (size_t row = 0; row < rows; row++)
        for (size_t c = 0; c < column_count; c++) {
            put_cell(out, &columns[c], row);
            fputc(c + 1 < column_count ? ',' : '\n', out);
        }
}

bl_status bl_run_csv(bl_run *run, const char *name, const char *what, const bl_column *columns,
                     size_t column_count, size_t rows, bl_message *message) {
    bl_file file;
    bl_status status = bl_output_create(run->result.folder, name, "csv", &file, message);
    if (status != BL_OK)
        return status;
    put_table(file.stream, run, what, columns, column_count, rows);
    status = bl_file_commit(&file, message);
    if (status == BL_OK)
        add_file(run, name, "csv");
    return status;
}

// What the page tells of a plot: its texts, and its legend.
static void keep_picture(bl_run *run, const char *name, const bl_plot *plot,
                         const char *alternative) {
    if (!grow(run, &run->plots, run->plot_count, sizeof *run->plots))
        return;
    bl_run_picture *kept = &run->plots[run->plot_count++];
    *kept = (bl_run_picture){.name = keep(run, strdup(name)),
                             .text = keep(run, strdup(alternative)),
                             .title = keep(run, strdup(plot->title ? plot->title : ""))};
    const bl_panel *panel = bl_plot_legend(plot);
    for (size_t i = 0; i < panel->series_count && kept->key_count < BL_KEYS; i++)
        if (panel->series[i].label)
            kept->keys[kept->key_count++] =
                (bl_run_key){keep(run, strdup(panel->series[i].label)), panel->series[i].stroke,
                             panel->series[i].ink};
}

bl_status bl_run_plot(bl_run *run, const char *name, const bl_plot *plot, const char *alternative,
                      bl_message *message) {
    int with_pdf = strcmp(run->settings->format, "pdf") == 0;
    const char *folder = run->result.folder;
    bl_run_step(run, "plotting");
    bl_status status = bl_plot_write(plot, folder, name, with_pdf, message);
    if (status == BL_OK) {
        add_file(run, name, "gp");
        status = bl_plot_run(folder, name, with_pdf, message);
    }
    if (status != BL_OK)
        return status;
    add_file(run, name, "svg");
    add_file(run, name, "png");
    if (with_pdf)
        add_file(run, name, "pdf");
    keep_picture(run, name, plot, alternative);
    return BL_OK;
}

// The image's own attributes, then the settings of the run as "bandlimit:NAME".
static bl_attribute *attributes_of(bl_run *run, const bl_image *image, size_t *count) {
    *count = image->attribute_count + run->note_count;
    bl_attribute *attributes = calloc(*count + 1, sizeof *attributes);
    if (!attributes)
        return NULL;
    for (size_t i = 0; i < image->attribute_count; i++)
        attributes[i] = image->attributes[i];
    for (size_t i = 0; i < run->note_count; i++)
        attributes[image->attribute_count + i] = (bl_attribute){
            bl_run_text(run, "bandlimit:%s", run->notes[i].name), run->notes[i].text};
    return attributes;
}

bl_status bl_run_image(bl_run *run, const char *name, const bl_image *image, bl_message *message) {
    static const char *const endings[] = {"exr", "png"};
    bl_image full = *image;
    bl_attribute *attributes = attributes_of(run, image, &full.attribute_count);
    full.attributes = attributes;
    bl_status status = attributes ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    for (int i = 0; i < 2 && status == BL_OK; i++) {
        char *path = bl_output_path(run->result.folder, name, endings[i]);
        status = path ? bl_image_write(path, &full, message)
                      : bl_report(message, BL_DEVICE, "out of memory");
        free(path);
        if (status == BL_OK)
            add_file(run, name, endings[i]);
    }
    free(attributes);
    return status;
}

void bl_run_claim(bl_run *run, const bl_claim *claim) {
    bl_figure_result *result = &run->result;
    if (!grow(run, &result->claims, result->claim_count, sizeof *result->claims))
        return;
    bl_claim *kept = &result->claims[result->claim_count++];
    *kept = *claim;
    bl_claim_judge(kept);
    result->outcomes[bl_claim_outcome(kept)]++;
}

bl_run_view bl_run_look(const bl_run *run) {
    return (bl_run_view){.result = &run->result,
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

static bl_status run_it(bl_run *run, bl_message *message) {
    const bl_figure *figure = run->result.figure;
    if (asprintf(&run->result.folder, "%s/%s", run->settings->folder, figure->name) < 0) {
        run->result.folder = NULL;
        return bl_report(message, BL_DEVICE, "out of memory");
    }
    bl_status status = bl_make_folder(run->result.folder, message);
    bl_run_step(run, "starting");
    if (status == BL_OK)
        status = figure->run(run, message);
    if (status == BL_OK)
        add_file(run, figure->name, "json");
    if (status == BL_OK && run->starved)
        status = bl_report(message, BL_DEVICE, "out of memory in figure %s", figure->name);
    if (status == BL_OK) {
        bl_run_view view = bl_run_look(run);
        status = bl_run_write_json(&view, run->settings, message);
    }
    return status;
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
    double start = now();
    bl_status status = run_it(run, message);
    run->result.seconds = now() - start;
    if (status == BL_OK)
        *out = run;
    else
        bl_run_free(run);
    return status;
}

void bl_run_free(bl_run *run) {
    if (!run)
        return;
    for (size_t i = 0; i < run->result.file_count; i++)
        free(run->result.files[i]);
    for (size_t i = 0; i < run->text_count; i++)
        free(run->texts[i]);
    free(run->result.files);
    free(run->result.claims);
    free(run->result.folder);
    free(run->texts);
    free(run->notes);
    free(run->plots);
    free(run);
}
