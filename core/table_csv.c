// SPDX-License-Identifier: MIT
//
// Tables as data files, and records as their comments.
#include <math.h>
#include <string.h>

#include "core/csv.h"
#include "core/table.h"

static int is_told(const bl_table *table, const bl_field *field) {
    return field->kind != BL_CELL_LIST && bl_field_is_told(table, field, BL_IN_CSV);
}

static void put_header(FILE *out, const bl_table *table) {
    const char *between = "";
    for (const bl_field *field = table->fields; field->key; field++) {
        if (!is_told(table, field))
            continue;
        fprintf(out, "%s%s", between, field->key);
        if (field->kind == BL_CELL_ESTIMATE)
            fprintf(out, ",%s,%s", bl_field_limit_key(field, "lower").text,
                    bl_field_limit_key(field, "upper").text);
        between = ",";
    }
    fputc('\n', out);
}

static void put_cell(FILE *out, const bl_field *field, const bl_cell *cell) {
    int missing = bl_cell_is_missing(cell);
    if (field->kind == BL_CELL_ESTIMATE) {
        bl_csv_number(out, cell->value);
        fputc(',', out);
        bl_csv_number(out, cell->lower);
        fputc(',', out);
        bl_csv_number(out, cell->upper);
    } else if (cell->kind == BL_CELL_REAL) {
        bl_csv_number(out, cell->value);
    } else if (cell->kind == BL_CELL_WORD && !missing) {
        bl_csv_word(out, cell->word);
    } else if (cell->kind == BL_CELL_VERDICT) {
        bl_csv_word(out, bl_verdict_word(cell->verdict));
    } else if (!missing) {
        fprintf(out, "%zu", cell->count);
    }
}

void bl_table_csv(const bl_table *table, FILE *out) {
    put_header(out, table);
    for (size_t row = 0; row < table->count; row++) {
        const char *between = "";
        for (const bl_field *field = table->fields; field->key; field++) {
            if (!is_told(table, field))
                continue;
            bl_cell cell;
            bl_cell_find(table, field, row, &cell);
            fputs(between, out);
            put_cell(out, field, &cell);
            between = ",";
        }
        fputc('\n', out);
    }
}

// The text of one value, on one line.
static void put_comment(FILE *out, const char *key, const bl_cell *cell) {
    char text[32 * 24] = "";
    if (cell->kind == BL_CELL_WORD || cell->kind == BL_CELL_VERDICT) {
        int is_word = cell->kind == BL_CELL_WORD;
        bl_csv_comment(out, key, is_word ? cell->word : bl_verdict_word(cell->verdict));
        return;
    }
    const double *numbers = cell->kind == BL_CELL_LIST ? cell->list : &cell->value;
    size_t count = cell->kind == BL_CELL_LIST ? cell->count : 1;
    for (size_t i = 0; i < count && strlen(text) + 24 < sizeof text; i++)
        sprintf(text + strlen(text), "%s%.9g", i ? " " : "", numbers[i]);
    if (cell->kind == BL_CELL_COUNT || cell->kind == BL_CELL_FLAG)
        sprintf(text, "%zu", cell->count);
    bl_csv_comment(out, key, text);
}

void bl_record_csv(const bl_table *record, FILE *out) {
    for (const bl_field *field = record->fields; field->key; field++) {
        bl_cell cell;
        bl_cell_find(record, field, 0, &cell);
        if (bl_cell_is_missing(&cell) || !bl_field_is_told(record, field, BL_IN_CSV))
            continue;
        put_comment(out, field->key, &cell);
        bl_cell limit = {.kind = BL_CELL_REAL, .value = cell.lower};
        if (isfinite(cell.lower))
            put_comment(out, bl_field_limit_key(field, "lower").text, &limit);
        limit.value = cell.upper;
        if (isfinite(cell.upper))
            put_comment(out, bl_field_limit_key(field, "upper").text, &limit);
    }
}
