// SPDX-License-Identifier: MIT
#include "reports/trade_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/csv.h"
#include "core/version.h"
#include "reports/output.h"

static double log_error(const bl_alternative *alternative) {
    return alternative->error.value > 0 ? log10(alternative->error.value) : NAN;
}

void bl_trade_plot_describe(const bl_trade *trade, const bl_alternatives *alternatives,
                            const char *name, bl_trade_plot *plot) {
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    int without = 0; // errors
    for (size_t i = 0; i < alternatives->count; i++) {
        const bl_alternative *a = &alternatives->list[i];
        const double drawn[2] = {a->ns, log_error(a)};
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

static void find_log_error(const bl_table *table, size_t row, bl_cell *cell) {
    cell->value = log_error((const bl_alternative *)table->rows + row);
}

#define AT(member) .offset = offsetof(bl_alternative, member)
static const bl_field fields[] = {
    {"front", "", BL_CELL_FLAG, AT(front), .forms = BL_IN_TEXT},
    {"alternative", "alternative", BL_CELL_WORD, AT(name)},
    {"error", "error", BL_CELL_ESTIMATE, AT(error), .digits = 3, .limits = ""},
    {"largest_error", "largest", BL_CELL_REAL, AT(largest), .digits = 3},
    {"ns_per_sample", "ns", BL_CELL_ESTIMATE, AT(ns), .limits = "half of the turns"},
    {"log10_error", NULL, BL_CELL_REAL, .find = find_log_error, .forms = BL_IN_CSV},
    {"front", NULL, BL_CELL_FLAG, AT(front), .forms = BL_IN_CSV | BL_IN_JSON},
    {0}};
#undef AT

bl_table bl_trade_table(const bl_alternatives *alternatives) {
    bl_table table = BL_TABLE(fields, alternatives->list, alternatives->count);
    table.level = 0.95;
    return table;
}

bl_table bl_trade_front(const bl_alternatives *alternatives, bl_alternative *rows) {
    const bl_alternative *list = alternatives->list;
    bl_table table = bl_trade_table(alternatives);
    table.rows = rows;
    table.count = 0;
    for (size_t i = 0; i < alternatives->count; i++) {
        size_t k = table.count;
        if (!list[i].front)
            continue;
        for (; k > 0 && rows[k - 1].ns > list[i].ns; k--)
            rows[k] = rows[k - 1];
        rows[k] = list[i];
        table.count++;
    }
    return table;
}

static bl_status write_table(const bl_trade *trade, const char *subject, const char *folder,
                             const char *name, const bl_table *table, bl_message *message) {
    bl_file file;
    char text[256];
    bl_status status = bl_output_create(folder, name, "csv", &file, message);
    if (status != BL_OK)
        return status;
    bl_csv_comment(file.stream, "version", BL_VERSION);
    bl_csv_comment(file.stream, "trade", trade->name);
    bl_csv_comment(file.stream, "subject", subject);
    snprintf(text, sizeof text, "%s, %s; time: nanoseconds for %s, the median and the quarters",
             trade->error_name, trade->error_unit, trade->sample);
    bl_csv_comment(file.stream, "error", text);
    bl_table_csv(table, file.stream);
    return bl_file_commit(&file, message);
}

static bl_status write_front(const bl_trade *trade, const char *subject, const char *folder,
                             const bl_alternatives *alternatives, bl_message *message) {
    char name[96];
    bl_alternative *rows = malloc((alternatives->count + 1) * sizeof *rows);
    if (!rows)
        return bl_report(message, BL_DEVICE, "out of memory for '%s'", folder);
    const bl_table table = bl_trade_front(alternatives, rows);
    snprintf(name, sizeof name, "%s-front", trade->name);
    bl_status status = write_table(trade, subject, folder, name, &table, message);
    free(rows);
    return status;
}

bl_status bl_trade_files_write(const bl_trade *trade, const char *subject,
                               const bl_alternatives *alternatives, const char *folder,
                               bl_message *message) {
    bl_trade_plot plot;
    const bl_table table = bl_trade_table(alternatives);
    bl_status status = bl_make_folder(folder, message);
    if (status == BL_OK)
        status = write_table(trade, subject, folder, trade->name, &table, message);
    if (status == BL_OK)
        status = write_front(trade, subject, folder, alternatives, message);
    bl_trade_plot_describe(trade, alternatives, trade->name, &plot);
    if (status == BL_OK)
        status = bl_plot_write(&plot.plot, folder, trade->name, 0, message);
    return status == BL_OK ? bl_plot_run(folder, trade->name, 0, message) : status;
}
