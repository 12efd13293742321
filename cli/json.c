// SPDX-License-Identifier: MIT
#include "cli/json.h"

json_t *bl_json_head(const char *name, int argument_count, char *const *arguments) {
    char schema[64];
    snprintf(schema, sizeof schema, "bandlimit.%s/1", name);
    json_t *object = json_object();
    bl_json_set_text(object, "schema", schema);
    bl_json_set_text(object, "version", BL_VERSION);
    json_object_set_new(object, "arguments",
                        bl_json_texts((const char *const *)arguments, (size_t)argument_count));
    return object;
}

json_t *bl_json_start(bl_call *call) {
    if (!call->common.json)
        return NULL;
    json_decref(call->json);
    call->json = bl_json_head(call->verb->name, call->argument_count, call->arguments);
    return call->json;
}

int bl_json_print(const json_t *object, FILE *out) {
    return object && json_dumpf(object, out, JSON_INDENT(1) | JSON_REAL_PRECISION(16)) == 0 &&
           fputc('\n', out) != EOF;
}
