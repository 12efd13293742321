// SPDX-License-Identifier: MIT
//
// Values, tables and records as JSON; a number that is not finite becomes null. Without memory an
// object stays incomplete, and the writer at the end reports it.
#ifndef BL_REPORTS_TABLE_JSON_H
#define BL_REPORTS_TABLE_JSON_H

#include <jansson.h>
#include <stdint.h>

#include "core/table.h"

// An array of objects, one a row.
json_t *bl_table_json(const bl_table *table);
// Sets each column as an array of the object.
void bl_table_json_columns(json_t *object, const bl_table *table);
// Sets the values of one row in the object.
void bl_record_json(json_t *object, const bl_table *table, size_t row);

// Text, with bytes that are not UTF-8 replaced by U+FFFD; null for NULL.
json_t *bl_json_text(const char *text);
// An array of so many texts, or as many as stand before a NULL.
json_t *bl_json_texts(const char *const *texts, size_t most);
// A number, or null if it is not finite.
json_t *bl_json_number(double number);
// An integer, or text above 2^63 - 1.
json_t *bl_json_count(uint64_t count);
json_t *bl_json_numbers(const double *numbers, size_t count);

void bl_json_set_text(json_t *object, const char *key, const char *text);
void bl_json_set_number(json_t *object, const char *key, double number);
void bl_json_set_count(json_t *object, const char *key, uint64_t count);
void bl_json_set_numbers(json_t *object, const char *key, const double *numbers, size_t count);

#endif
