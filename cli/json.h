// SPDX-License-Identifier: MIT
//
// The JSON objects of the verbs. Every object starts with its schema, the version and the arguments
// as typed. Building never fails half-way: without memory
// the object stays incomplete and bl_json_print reports it.
#ifndef BL_CLI_JSON_H
#define BL_CLI_JSON_H

#include "cli/verb.h"
#include "reports/table_json.h"

// Makes {"schema": "bandlimit.NAME/1", "version": ..., "arguments": [...]}.
json_t *bl_json_head(const char *name, int argument_count, char *const *arguments);

// Starts call->json for the call's verb and returns it; NULL without --json.
json_t *bl_json_start(bl_call *call);

// Writes the object and a line feed. False if a write fails or memory is short.
int bl_json_print(const json_t *object, FILE *out);

#endif
