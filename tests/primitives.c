// SPDX-License-Identifier: MIT
#include "tests/primitives.h"

#include "filters/primitive.h"
#include "tests/test.h"

bl_status bl_test_open_primitive(const char *text, bl_signal **signal, bl_message *message) {
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    const bl_primitive *primitive = bl_primitive_find(spec.name);
    status = primitive ? bl_definition_open(primitive, &spec, text, NULL, signal, message)
                       : bl_report(message, BL_USAGE, "no primitive is called '%s'", spec.name);
    bl_spec_free(&spec);
    return status;
}

bl_signal *bl_test_primitive(const char *text) {
    bl_signal *signal = NULL;
    bl_message message = {""};
    if (bl_test_open_primitive(text, &signal, &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    return signal;
}

double bl_test_filtered(const bl_signal *signal, double x, double width) {
    const double at[BL_AXES] = {x}, widths[BL_AXES] = {width};
    return bl_signal_filtered(signal, at, widths);
}
