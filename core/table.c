// SPDX-License-Identifier: MIT
#include "core/table.h"

#include <math.h>
#include <string.h>

#include "core/statistics.h"

// Where the value stands: in its row, or in its column; NULL: the column is not there.
static const char *place_of(const bl_table *table, const bl_field *field, size_t row) {
    static const size_t sizes[] = {
        [BL_CELL_REAL] = sizeof(double),       [BL_CELL_ESTIMATE] = sizeof(bl_estimate),
        [BL_CELL_COUNT] = sizeof(size_t),      [BL_CELL_UNSIGNED] = sizeof(unsigned),
        [BL_CELL_FLAG] = sizeof(int),          [BL_CELL_WORD] = sizeof(char *),
        [BL_CELL_VERDICT] = sizeof(bl_verdict)};
    const char *start = (const char *)table->rows + table->stride * row + field->offset;
    const char *const *column = (const char *const *)(const void *)start;
    if (table->stride)
        return start;
    return *column ? *column + row * sizes[field->kind] : NULL;
}

static void read_place(const bl_field *field, const char *place, bl_cell *cell) {
    unsigned number = 0;
    switch (field->kind) {
    case BL_CELL_NONE:
        break;
    case BL_CELL_REAL:
        memcpy(&cell->value, place, sizeof cell->value);
        break;
    case BL_CELL_ESTIMATE:
        memcpy(&cell->value, place, sizeof cell->value);
        memcpy(&cell->lower, place + sizeof(double), sizeof cell->lower);
        memcpy(&cell->upper, place + 2 * sizeof(double), sizeof cell->upper);
        break;
    case BL_CELL_COUNT:
        memcpy(&cell->count, place, sizeof cell->count);
        break;
    case BL_CELL_UNSIGNED:
    case BL_CELL_FLAG:
        memcpy(&number, place, sizeof number);
        cell->count = number;
        break;
    case BL_CELL_WORD:
        memcpy(&cell->word, place, sizeof cell->word);
        break;
    case BL_CELL_LETTERS:
        cell->word = place;
        break;
    case BL_CELL_VERDICT:
        memcpy(&cell->verdict, place, sizeof cell->verdict);
        break;
    case BL_CELL_LIST:
        cell->list = (const double *)(const void *)place;
        break;
    }
}

void bl_cell_find(const bl_table *table, const bl_field *field, size_t row, bl_cell *cell) {
    *cell = (bl_cell){.kind = field->kind == BL_CELL_UNSIGNED  ? BL_CELL_COUNT
                              : field->kind == BL_CELL_LETTERS ? BL_CELL_WORD
                                                               : field->kind,
                      .value = NAN,
                      .lower = NAN,
                      .upper = NAN,
                      .count = field->length};
    row *= table->every ? table->every : 1;
    const char *place = field->find ? NULL : place_of(table, field, row);
    if (field->when && !field->when((const char *)table->rows + table->stride * row))
        cell->kind = BL_CELL_NONE;
    else if (field->find)
        field->find(table, row, cell);
    else if (place)
        read_place(field, place, cell);
    else
        cell->kind = BL_CELL_NONE;
}

int bl_cell_is_missing(const bl_cell *cell) {
    int is_number = cell->kind == BL_CELL_REAL || cell->kind == BL_CELL_ESTIMATE;
    return cell->kind == BL_CELL_NONE || (is_number && isnan(cell->value)) ||
           (cell->kind == BL_CELL_WORD && !cell->word) ||
           (cell->kind == BL_CELL_LIST && !cell->list);
}

int bl_field_is_told(const bl_table *table, const bl_field *field, int form) {
    if ((field->forms && !(field->forms & form)) || (form == BL_IN_TEXT && !field->heading))
        return 0;
    int told = table->count == 0 || !(field->optional || form == BL_IN_TEXT);
    for (size_t row = 0; row < table->count && !told; row++) {
        bl_cell cell;
        bl_cell_find(table, field, row, &cell);
        told = form == BL_IN_TEXT ? !bl_cell_is_missing(&cell) : cell.kind != BL_CELL_NONE;
    }
    return told;
}

bl_limit_key bl_field_limit_key(const bl_field *field, const char *which) {
    bl_limit_key key;
    snprintf(key.text, sizeof key.text, "%s%s%s", field->bare_limits ? "" : field->key,
             field->bare_limits ? "" : "_", which);
    return key;
}

// --- in words -----------------------------------------------------------------------------------

// A number at the end of a text; -0 is 0. From 1e9 on all decimals would be noise.
static void add_number(char *text, size_t size, const bl_field *field, double number) {
    size_t used = strlen(text);
    int fixed = field->decimals && fabs(number) < 1e9;
    if (fixed && fabs(number) < 0.5 * pow(10, -field->decimals)) // no -0.00
        number = 0;
    int digits = fixed ? field->decimals : field->digits ? field->digits : 4;
    snprintf(text + used, size - used, fixed ? "%.*f" : "%.*g", digits, number + 0.0);
}

static const char *list_text(const bl_field *field, bl_cell *cell) {
    for (size_t i = 0; i < cell->count; i++) {
        strncat(cell->text, i ? ", " : "(", sizeof cell->text - strlen(cell->text) - 1);
        add_number(cell->text, sizeof cell->text, field, cell->list[i]);
    }
    strncat(cell->text, ")", sizeof cell->text - strlen(cell->text) - 1);
    return cell->text;
}

const char *bl_cell_text(const bl_field *field, bl_cell *cell) {
    if (bl_cell_is_missing(cell))
        return "-";
    if (cell->kind == BL_CELL_WORD)
        return cell->word;
    if (cell->kind == BL_CELL_ESTIMATE && field->is_power && cell->value <= 0 && cell->upper > 0) {
        snprintf(cell->text, sizeof cell->text, "<");
        add_number(cell->text, sizeof cell->text, field, cell->upper);
        return cell->text;
    }
    if (cell->kind == BL_CELL_VERDICT)
        return bl_verdict_word(cell->verdict);
    if (cell->kind == BL_CELL_FLAG)
        return cell->count ? "*" : "";
    cell->text[0] = '\0';
    if (cell->kind == BL_CELL_LIST)
        return list_text(field, cell);
    if (cell->kind == BL_CELL_COUNT)
        snprintf(cell->text, sizeof cell->text, "%zu", cell->count);
    else
        add_number(cell->text, sizeof cell->text, field, cell->value);
    return cell->text;
}

const char *bl_cell_limits_text(const bl_field *field, bl_cell *cell) {
    if (!isfinite(cell->lower) || !isfinite(cell->upper))
        return "-";
    cell->text[0] = '\0';
    add_number(cell->text, sizeof cell->text, field, cell->lower);
    strcat(cell->text, " to ");
    add_number(cell->text, sizeof cell->text, field, cell->upper);
    return cell->text;
}

const char *bl_field_limits_heading(const bl_table *table, const bl_field *field, char text[64]) {
    if (field->kind != BL_CELL_ESTIMATE || !field->limits)
        return NULL;
    snprintf(text, 64, "%g %% interval", 100 * table->level);
    return *field->limits ? field->limits : text;
}
