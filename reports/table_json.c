// SPDX-License-Identifier: MIT
#include "reports/table_json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

json_t *bl_json_text(const char *text) {
    if (!text)
        return json_null();
    json_t *plain = json_string(text);
    if (plain)
        return plain;
    // Not UTF-8 (a file name may be any bytes): every byte above ASCII becomes U+FFFD.
    char *safe = malloc(3 * strlen(text) + 1), *at = safe;
    if (!safe)
        return NULL;
    for (; *text; text++) {
        if ((unsigned char)*text < 0x80) {
            *at++ = *text;
        } else {
            memcpy(at, "\xEF\xBF\xBD", 3);
            at += 3;
        }
    }
    *at = '\0';
    json_t *replaced = json_string(safe);
    free(safe);
    return replaced;
}

json_t *bl_json_texts(const char *const *texts, size_t most) {
    json_t *list = json_array();
    for (size_t i = 0; i < most && texts[i]; i++)
        json_array_append_new(list, bl_json_text(texts[i]));
    return list;
}

json_t *bl_json_number(double number) {
    return isfinite(number) ? json_real(number + 0.0) : json_null();
}

json_t *bl_json_numbers(const double *numbers, size_t count) {
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, bl_json_number(numbers[i]));
    return array;
}

void bl_json_set_text(json_t *object, const char *key, const char *text) {
    json_object_set_new(object, key, bl_json_text(text));
}

void bl_json_set_number(json_t *object, const char *key, double number) {
    json_object_set_new(object, key, bl_json_number(number));
}

json_t *bl_json_count(uint64_t count) {
    char digits[24];
    snprintf(digits, sizeof digits, "%llu", (unsigned long long)count);
    return count <= INT64_MAX ? json_integer((json_int_t)count) : json_string(digits);
}

void bl_json_set_count(json_t *object, const char *key, uint64_t count) {
    json_object_set_new(object, key, bl_json_count(count));
}

void bl_json_set_numbers(json_t *object, const char *key, const double *numbers, size_t count) {
    json_object_set_new(object, key, numbers ? bl_json_numbers(numbers, count) : json_null());
}

// --- tables -------------------------------------------------------------------------------------

static json_t *cell_json(const bl_cell *cell) {
    switch (cell->kind) {
    case BL_CELL_NONE:
        return json_null();
    case BL_CELL_WORD:
        return bl_json_text(cell->word);
    case BL_CELL_VERDICT:
        return bl_json_text(bl_verdict_word(cell->verdict));
    case BL_CELL_FLAG:
        return json_boolean(cell->count);
    case BL_CELL_LIST:
        return cell->list ? bl_json_numbers(cell->list, cell->count) : json_null();
    case BL_CELL_COUNT:
        return bl_json_count(cell->count);
    default:
        return bl_json_number(cell->value);
    }
}

void bl_record_json(json_t *object, const bl_table *table, size_t row) {
    for (const bl_field *field = table->fields; field->key; field++) {
        bl_cell cell;
        bl_cell_find(table, field, row, &cell);
        if ((cell.kind == BL_CELL_NONE && field->absent) ||
            !bl_field_is_told(table, field, BL_IN_JSON))
            continue;
        json_object_set_new(object, field->key, cell_json(&cell));
        if (cell.kind != BL_CELL_ESTIMATE)
            continue;
        bl_json_set_number(object, bl_field_limit_key(field, "lower").text, cell.lower);
        bl_json_set_number(object, bl_field_limit_key(field, "upper").text, cell.upper);
    }
}

json_t *bl_table_json(const bl_table *table) {
    json_t *rows = json_array();
    for (size_t row = 0; row < table->count; row++) {
        json_t *object = json_object();
        bl_record_json(object, table, row);
        json_array_append_new(rows, object);
    }
    return rows;
}

// The values of one column; null where no row has any.
static json_t *column_json(const bl_table *table, const bl_field *field, int limit) {
    json_t *values = json_array();
    int any = 0;
    for (size_t row = 0; row < table->count; row++) {
        bl_cell cell;
        bl_cell_find(table, field, row, &cell);
        any |= cell.kind != BL_CELL_NONE;
        json_array_append_new(values, limit == 0  ? cell_json(&cell)
                                      : limit < 0 ? bl_json_number(cell.lower)
                                                  : bl_json_number(cell.upper));
    }
    if (any || table->count == 0)
        return values;
    json_decref(values);
    return json_null();
}

void bl_table_json_columns(json_t *object, const bl_table *table) {
    for (const bl_field *field = table->fields; field->key; field++) {
        if (!bl_field_is_told(table, field, BL_IN_JSON))
            continue;
        json_object_set_new(object, field->key, column_json(table, field, 0));
        if (field->kind != BL_CELL_ESTIMATE)
            continue;
        json_object_set_new(object, bl_field_limit_key(field, "lower").text,
                            column_json(table, field, -1));
        json_object_set_new(object, bl_field_limit_key(field, "upper").text,
                            column_json(table, field, 1));
    }
}
