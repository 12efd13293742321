// SPDX-License-Identifier: MIT
//
// The JSON objects of the verbs. Every object starts with its schema, the version and the arguments
// as typed; a number that is not finite becomes null. Building never fails half-way: without memory
// the object stays incomplete and bl_json_print reports it.
#ifndef BL_CLI_JSON_H
#define BL_CLI_JSON_H

#include "cli/verb.h"
#include "core/statistics.h"

// Makes {"schema": "bandlimit.NAME/1", "version": ..., "arguments": [...]}.
json_t *bl_json_head(const char *name, int argument_count, char *const *arguments);

// Starts call->json for the call's verb and returns it; NULL without --json.
json_t *bl_json_start(bl_call *call);

// Text, with bytes that are not UTF-8 replaced by U+FFFD; null for NULL.
json_t *bl_json_text(const char *text);
// A number, or null if it is not finite.
json_t *bl_json_number(double number);
json_t *bl_json_numbers(const double *numbers, size_t count);

void bl_json_set_text(json_t *object, const char *key, const char *text);
void bl_json_set_number(json_t *object, const char *key, double number);
void bl_json_set_count(json_t *object, const char *key, uint64_t count); // text above 2^63-1
void bl_json_set_numbers(json_t *object, const char *key, const double *numbers, size_t count);
// Sets key, key_lower and key_upper.
void bl_json_set_estimate(json_t *object, const char *key, const bl_estimate *estimate);

// Writes the object and a line feed. False if a write fails or memory is short.
int bl_json_print(const json_t *object, FILE *out);

#endif
