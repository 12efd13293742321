// SPDX-License-Identifier: MIT
//
// Tables and records for a terminal.
#include <math.h>
#include <string.h>

#include "core/plain.h"
#include "core/table.h"

enum { COLUMNS = 64, WIDTH = 100, LEAST_ROOM = 30 };

// A column: the values of a field, or their intervals.
typedef struct text_column {
    const bl_field *field;
    char heading[64];
    int is_limits, is_right; // numbers stand at the right
    size_t width;
} text_column;

static const char *entry(const bl_table *table, const text_column *column, size_t row,
                         bl_cell *cell) {
    bl_cell_find(table, column->field, row, cell);
    return column->is_limits ? bl_cell_limits_text(column->field, cell)
                             : bl_cell_text(column->field, cell);
}

static void add_column(const bl_table *table, const bl_field *field, const char *heading,
                       int is_limits, text_column *column) {
    *column = (text_column){.field = field, .is_limits = is_limits};
    column->is_right = !is_limits && field->kind <= BL_CELL_UNSIGNED;
    snprintf(column->heading, sizeof column->heading, "%s", heading);
    column->width = bl_plain_width(column->heading);
    for (size_t row = 0; row < table->count; row++) {
        bl_cell cell;
        size_t width = bl_plain_width(entry(table, column, row, &cell));
        column->width = width > column->width ? width : column->width;
    }
}

static size_t lay_out(const bl_table *table, text_column columns[COLUMNS]) {
    size_t count = 0;
    for (const bl_field *field = table->fields; field->key && count + 2 <= COLUMNS; field++) {
        char text[64];
        if (!bl_field_is_told(table, field, BL_IN_TEXT) || field->kind == BL_CELL_LIST)
            continue;
        add_column(table, field, field->heading, 0, &columns[count++]);
        const char *heading = bl_field_limits_heading(table, field, text);
        if (heading)
            add_column(table, field, heading, 1, &columns[count++]);
    }
    return count;
}

// Puts `blanks` and the text; returns the blanks that are owed then, as none end a line.
static size_t put(FILE *out, const text_column *column, const char *text, size_t blanks) {
    size_t rest = column->width - bl_plain_width(text);
    if (!*text)
        return blanks + column->width + 2;
    fprintf(out, "%*s", (int)(blanks + (column->is_right ? rest : 0)), "");
    bl_plain_text(out, text);
    return 2 + (column->is_right ? 0 : rest);
}

// A verdict in its colour.
static void put_coloured(FILE *out, const bl_table *table, const bl_cell *cell,
                         const text_column *column, const char *text, size_t *blanks) {
    int coloured = table->coloured && cell->kind == BL_CELL_VERDICT;
    fputs(bl_plain_colour(cell->verdict, coloured), out);
    *blanks = put(out, column, text, *blanks);
    fputs(bl_plain_end(coloured), out);
}

static void put_row(FILE *out, const bl_table *table, const text_column *columns, size_t count,
                    size_t row) {
    size_t blanks = 0, before = 0;
    for (size_t i = 0; i < count; before += columns[i++].width + 2) {
        bl_cell cell;
        const char *text = entry(table, &columns[i], row, &cell);
        int wraps = i + 1 == count && !columns[i].is_right && before + LEAST_ROOM <= WIDTH;
        if (wraps && bl_plain_width(text) > WIDTH - before) {
            fprintf(out, "%*s", (int)blanks, "");
            bl_plain_wrap(out, text, before, before, WIDTH);
        } else {
            put_coloured(out, table, &cell, &columns[i], text, &blanks);
        }
    }
    fputc('\n', out);
}

void bl_table_print(const bl_table *table, FILE *out) {
    text_column columns[COLUMNS];
    size_t count = lay_out(table, columns), blanks = 0;
    for (size_t i = 0; i < count; i++)
        blanks = put(out, &columns[i], columns[i].heading, blanks);
    fputc('\n', out);
    for (size_t row = 0; row < table->count; row++)
        put_row(out, table, columns, count, row);
}

static void put_value(FILE *out, const bl_table *record, const bl_field *field) {
    char heading[64];
    bl_cell cell;
    bl_cell_find(record, field, 0, &cell);
    int coloured = record->coloured && cell.kind == BL_CELL_VERDICT;
    fputs(bl_plain_colour(cell.verdict, coloured), out);
    bl_plain_text(out, bl_cell_is_missing(&cell) ? "not known" : bl_cell_text(field, &cell));
    fputs(bl_plain_end(coloured), out);
    if (field->unit)
        fprintf(out, " %s", field->unit);
    const char *limits = bl_field_limits_heading(record, field, heading);
    if (limits && isfinite(cell.lower) && isfinite(cell.upper))
        fprintf(out, "   %s %s", limits, bl_cell_limits_text(field, &cell));
    fputc('\n', out);
}

static int is_told(const bl_table *record, const bl_field *field) {
    return field->heading && (!field->forms || field->forms & BL_IN_TEXT) &&
           (!field->optional || bl_field_is_told(record, field, BL_IN_TEXT));
}

void bl_record_print(const bl_table *record, FILE *out) {
    text_column names = {0};
    for (const bl_field *field = record->fields; field->key; field++)
        if (is_told(record, field) && strlen(field->heading) > names.width)
            names.width = strlen(field->heading);
    for (const bl_field *field = record->fields; field->key; field++) {
        if (!is_told(record, field))
            continue;
        fprintf(out, "%*s", (int)put(out, &names, field->heading, 0), "");
        put_value(out, record, field);
    }
}
