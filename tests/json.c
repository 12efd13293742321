// SPDX-License-Identifier: MIT
#include "tests/json.h"

#include "tests/program.h"
#include "tests/test.h"

json_t *bl_run_json(int status, const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    if (ran.status != status)
        fail_msg("%s %s: status %d, expected %d: %s", words[0], words[1], ran.status, status,
                 ran.err);
    json_error_t error;
    json_t *object = json_loads(ran.out, 0, &error);
    if (!object)
        fail_msg("%s: not JSON: %s at line %d", words[0], error.text, error.line);
    bl_ran_free(&ran);
    return object;
}

double bl_number_of(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

const char *bl_text_of(const json_t *object, const char *key) {
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}
