// SPDX-License-Identifier: MIT
#include "core/status.h"

#include <stdarg.h>
#include <stdio.h>

bl_status bl_report(bl_message *message, bl_status status, const char *format, ...) {
    if (message) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message->text, sizeof message->text, format, arguments);
        va_end(arguments);
    }
    return status;
}

const char *bl_status_word(bl_status status) {
    switch (status) {
    case BL_OK:
        return "pass";
    case BL_INCONCLUSIVE:
        return "inconclusive";
    case BL_FAIL:
        return "fail";
    case BL_MISMATCH:
        return "mismatch";
    case BL_DEVICE:
        return "device error";
    case BL_USAGE:
        return "bad usage";
    }
    return "unknown";
}
