// SPDX-License-Identifier: MIT
#include "tests/sources.h"

#include "sources/source.h"
#include "tests/temporary.h"
#include "tests/test.h"

bl_signal *bl_test_open_source(const char *text) {
    bl_signal *signal = NULL;
    bl_message message = {""};
    if (bl_source_open(text, BL_ISA_BEST, &signal, &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    return signal;
}

void bl_test_refuse_source(const char *text, bl_status expected, const char *word) {
    bl_signal *signal = NULL;
    bl_message message = {""};
    bl_status status = bl_source_open(text, BL_ISA_BEST, &signal, &message);
    if (status != expected || !strstr(message.text, word))
        fail_msg("%s: status %d, expected %d; '%s' should say '%s'", text, status, expected,
                 message.text, word);
    assert_null(signal);
}

const char *bl_test_file_text(const char *name, const char *settings) {
    static char text[1024];
    snprintf(text, sizeof text, "%s%s", bl_temporary_path(name), settings);
    return text;
}

bl_signal *bl_test_open_file(const char *name, const char *settings) {
    return bl_test_open_source(bl_test_file_text(name, settings));
}

void bl_test_refuse_file(const char *name, const char *settings, bl_status expected,
                         const char *word) {
    bl_test_refuse_source(bl_test_file_text(name, settings), expected, word);
}

bl_view bl_test_open_view(const char *text, size_t size) {
    bl_view view;
    bl_message message;
    if (bl_view_open(text, size, size, &view, &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    return view;
}
