// SPDX-License-Identifier: MIT
#include "reports/filter_plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "core/file.h"
#include "reports/output.h"
#include "reports/plot.h"

enum { PER_UNIT = 128, REACH = 4 };
static const char name[] = "filter";

static const char *ending_of(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".svg") == 0   ? "svg"
           : dot && strcasecmp(dot, ".png") == 0 ? "png"
                                                 : NULL;
}

static bl_status write_data(const bl_filter *filter, const char *folder, bl_message *message) {
    bl_file file;
    bl_status status = bl_output_create(folder, name, "csv", &file, message);
    if (status != BL_OK)
        return status;
    fputs("place,kernel,step,response\n", file.stream);
    for (int i = -REACH * PER_UNIT; i <= REACH * PER_UNIT; i++) {
        double x = (double)i / PER_UNIT;
        fprintf(file.stream, "%.9g,%.9g,%.9g,%.9g\n", x, filter->kernel(x), filter->step(x),
                filter->response(x));
    }
    return bl_file_commit(&file, message);
}

static bl_status draw(const bl_filter *filter, const char *folder, bl_message *message) {
    static const char csv[] = "filter.csv";
    const bl_series place[] = {
        {BL_STROKE_LINE, BL_INK_MEASURED, csv, "place", "kernel", NULL, "kernel", 0},
        {BL_STROKE_LINE, BL_INK_THEORY, csv, "place", "step", NULL, "step", 0},
        {BL_STROKE_LINE, BL_INK_SECOND, csv, "place", "response", NULL, "response", 1 << 20}};
    const bl_series frequency[] = {
        {BL_STROKE_LINE, BL_INK_SECOND, csv, "place", "response", NULL, "response", 0}};
    const bl_panel panels[] = {{"kernel and step, over the distance", place, 3, NULL},
                               {"response, over the frequency", frequency, 1, NULL}};
    const bl_limit limits[] = {{1, -0.5, NULL}, {1, 0.5, "1/2"}};
    char title[128];
    snprintf(title, sizeof title, "What does the filter %s do?", filter->name);
    const bl_plot plot = {
        .title = title,
        .x = {.label = "(a) widths of a sample; (b) cycles per width, Nyquist frequency 1/2",
              .from = -REACH,
              .to = REACH,
              .tick = 1},
        .y = {.label = "value", .from = -0.4, .to = 1.6, .tick = 0.2},
        .panels = panels,
        .panel_count = 2,
        .columns = 2,
        .aspect = 0.8,
        .limits = limits,
        .limit_count = 2};
    bl_status status = write_data(filter, folder, message);
    if (status == BL_OK)
        status = bl_plot_write(&plot, folder, name, 0, message);
    return status == BL_OK ? bl_plot_run(folder, name, 0, message) : status;
}

static bl_status copy(const char *from, const char *to, bl_message *message) {
    char buffer[4096];
    bl_file file;
    FILE *source = fopen(from, "rb");
    if (!source)
        return bl_report(message, BL_DEVICE, "cannot read the picture '%s' that gnuplot made",
                         from);
    bl_status status = bl_file_create(to, &file, message);
    if (status == BL_OK) {
        for (size_t got; (got = fread(buffer, 1, sizeof buffer, source)) > 0;)
            fwrite(buffer, 1, got, file.stream);
        status = bl_file_commit(&file, message); // which checks the writes
    }
    fclose(source);
    return status;
}

static void remove_folder(const char *folder) {
    static const char *const endings[] = {"csv", "gp", "svg", "png"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char *path = bl_output_path(folder, name, endings[i]);
        if (path)
            unlink(path);
        free(path);
    }
    rmdir(folder);
}

bl_status bl_filter_plot(const bl_filter *filter, const char *path, bl_message *message) {
    const char *ending = ending_of(path), *parent = getenv("TMPDIR");
    char *folder = NULL, *picture = NULL;
    if (!ending)
        return bl_report(message, BL_USAGE,
                         "the plot '%s': the ending names the format; use .svg or .png", path);
    if (asprintf(&folder, "%s/bandlimit-XXXXXX", parent && *parent ? parent : "/tmp") < 0)
        return bl_report(message, BL_DEVICE, "out of memory");
    if (!mkdtemp(folder)) {
        bl_status status = bl_report(message, BL_DEVICE,
                                     "cannot make the folder '%s' for the plot; TMPDIR names "
                                     "another place",
                                     folder);
        free(folder);
        return status;
    }
    bl_status status = draw(filter, folder, message);
    if (status == BL_OK) {
        picture = bl_output_path(folder, name, ending);
        status =
            picture ? copy(picture, path, message) : bl_report(message, BL_DEVICE, "out of memory");
    }
    remove_folder(folder);
    free(picture);
    free(folder);
    return status;
}
