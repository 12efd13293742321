// SPDX-License-Identifier: MIT
//
// The JSON that the program prints.
#ifndef BL_TESTS_JSON_H
#define BL_TESTS_JSON_H

#include <jansson.h>

// Runs the program with these words, ended by NULL, expects the status, and returns the object that
// it prints; the caller drops it.
json_t *bl_run_json(int status, const char *const *words);

// The number, NAN if it is none, and the text, "" if it is none, at a key.
double bl_number_of(const json_t *object, const char *key);
const char *bl_text_of(const json_t *object, const char *key);

#endif
