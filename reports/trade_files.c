// SPDX-License-Identifier: MIT
#include "reports/trade_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/version.h"
#include "reports/output.h"

size_t bl_trade_front(const bl_alternatives *alternatives, size_t *order) {
    const bl_alternative *list = alternatives->list;
    size_t count = 0;
    for (size_t i = 0; i < alternatives->count; i++) {
        size_t k = count;
        if (!list[i].front)
            continue;
        for (; k > 0 && list[order[k - 1]].ns > list[i].ns; k--)
            order[k] = order[k - 1];
        order[k] = i;
        count++;
    }
    return count;
}

double bl_trade_log_error(const bl_alternative *alternative) {
    return alternative->error.value > 0 ? log10(alternative->error.value) : NAN;
}

void bl_trade_plot_describe(const bl_trade *trade, const bl_alternatives *alternatives,
                            const char *name, bl_trade_plot *plot) {
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    int without = 0; // errors
    for (size_t i = 0; i < alternatives->count; i++) {
        const bl_alternative *a = &alternatives->list[i];
        const double drawn[2] = {a->ns, bl_trade_log_error(a)};
        without |= a->error.value <= 0;
        for (int k = 0; k < 2 && a->ns > 0 && isfinite(drawn[1]); k++) {
            least[k] = fmin(least[k], drawn[k]);
            most[k] = fmax(most[k], drawn[k]);
        }
    }
    // Room on both sides, and for the words at the right.
    bl_axis x = {.label = plot->x_label, .logarithmic = 1}, y = {.label = plot->y_label};
    if (least[0] <= most[0]) {
        x.from = least[0] / 1.6, x.to = most[0] * 2.5;
        y.from = floor(least[1]) - 0.2, y.to = ceil(most[1]) + 0.2;
    }
    snprintf(plot->table, sizeof plot->table, "%s.csv", name);
    snprintf(plot->front, sizeof plot->front, "%s-front.csv", name);
    snprintf(plot->x_label, sizeof plot->x_label, "nanoseconds for %s", trade->sample);
    snprintf(plot->y_label, sizeof plot->y_label, "log10 of the %s, %s%s", trade->error_name,
             trade->error_unit, without ? " (0 is not drawn)" : "");
    plot->series[0] = (bl_series){.stroke = BL_STROKE_DASHED,
                                  .ink = BL_INK_THEORY,
                                  .file = plot->front,
                                  .x = "ns_per_sample",
                                  .y = "log10_error",
                                  .label = "nothing is both cheaper and better"};
    plot->series[1] = (bl_series){.stroke = BL_STROKE_POINTS,
                                  .ink = BL_INK_MEASURED,
                                  .file = plot->table,
                                  .x = "ns_per_sample",
                                  .y = "log10_error",
                                  .label = "measured"};
    plot->series[2] = (bl_series){.stroke = BL_STROKE_WORDS,
                                  .ink = BL_INK_PLAIN,
                                  .file = plot->table,
                                  .x = "ns_per_sample",
                                  .y = "log10_error",
                                  .upper = "alternative"};
    plot->panel = (bl_panel){.title = trade->title, .series = plot->series, .series_count = 3};
    plot->plot = (bl_plot){
        .title = trade->question, .x = x, .y = y, .panels = &plot->panel, .panel_count = 1};
}

// Numbers that are not known are empty fields.
static void put_number(FILE *out, double number, char end) {
    if (isfinite(number))
        fprintf(out, "%.9g", number);
    fputc(end, out);
}

static void put_row(FILE *out, const bl_alternative *a) {
    fprintf(out, "\"%s\",", a->name);
    put_number(out, a->error.value, ',');
    put_number(out, a->error.lower, ',');
    put_number(out, a->error.upper, ',');
    put_number(out, a->largest, ',');
    put_number(out, a->ns, ',');
    put_number(out, a->ns_lowest, ',');
    put_number(out, a->ns_highest, ',');
    put_number(out, bl_trade_log_error(a), ',');
    fprintf(out, "%d\n", a->front);
}

static bl_status write_table(const bl_trade *trade, const char *subject, const char *folder,
                             const char *name, const bl_alternatives *alternatives,
                             const size_t *order, size_t count, bl_message *message) {
    bl_file file;
    bl_status status = bl_output_create(folder, name, "csv", &file, message);
    if (status != BL_OK)
        return status;
    fprintf(file.stream, "# version: %s\n# trade: %s\n# subject: ", BL_VERSION, trade->name);
    for (const char *c = subject; *c; c++)
        fputc((unsigned char)*c < ' ' ? ' ' : *c, file.stream);
    fprintf(file.stream,
            "\n# error: %s, %s; time: nanoseconds for %s, the median and the quarters\n"
            "alternative,error,error_lower,error_upper,largest_error,ns_per_sample,"
            "ns_per_sample_lower,ns_per_sample_upper,log10_error,front\n",
            trade->error_name, trade->error_unit, trade->sample);
    for (size_t i = 0; i < count; i++)
        put_row(file.stream, &alternatives->list[order ? order[i] : i]);
    return bl_file_commit(&file, message);
}

bl_status bl_trade_files_write(const bl_trade *trade, const char *subject,
                               const bl_alternatives *alternatives, const char *folder,
                               bl_message *message) {
    char front[96];
    bl_trade_plot plot;
    size_t *order = malloc((alternatives->count + 1) * sizeof *order);
    bl_status status = order ? bl_make_folder(folder, message)
                             : bl_report(message, BL_DEVICE, "out of memory for '%s'", folder);
    snprintf(front, sizeof front, "%s-front", trade->name);
    if (status == BL_OK)
        status = write_table(trade, subject, folder, trade->name, alternatives, NULL,
                             alternatives->count, message);
    if (status == BL_OK)
        status = write_table(trade, subject, folder, front, alternatives, order,
                             bl_trade_front(alternatives, order), message);
    free(order);
    bl_trade_plot_describe(trade, alternatives, trade->name, &plot);
    if (status == BL_OK)
        status = bl_plot_write(&plot.plot, folder, trade->name, 0, message);
    return status == BL_OK ? bl_plot_run(folder, trade->name, 0, message) : status;
}
