// SPDX-License-Identifier: MIT
#include "api/api.h"

#include <stdlib.h>

#include "core/version.h"

// Statuses, messages, verdicts and estimates are the same inside and outside.
_Static_assert((int)BANDLIMIT_FAULT == (int)BL_FAIL &&
                   (int)BANDLIMIT_MISMATCH == (int)BL_MISMATCH &&
                   (int)BANDLIMIT_DEVICE == (int)BL_DEVICE && (int)BANDLIMIT_USAGE == (int)BL_USAGE,
               "statuses are cast");
_Static_assert((int)BANDLIMIT_PASS == (int)BL_VERDICT_PASS &&
                   (int)BANDLIMIT_INCONCLUSIVE == (int)BL_VERDICT_INCONCLUSIVE &&
                   (int)BANDLIMIT_FAIL == (int)BL_VERDICT_FAIL &&
                   (int)BANDLIMIT_NOT_RUN == (int)BL_VERDICT_NOT_RUN,
               "verdicts are cast");
_Static_assert(sizeof(bandlimit_message) == sizeof(bl_message), "messages are cast");
_Static_assert(sizeof(bandlimit_estimate) == sizeof(bl_estimate) &&
                   offsetof(bandlimit_estimate, lower) == offsetof(bl_estimate, lower) &&
                   offsetof(bandlimit_estimate, upper) == offsetof(bl_estimate, upper) &&
                   offsetof(bandlimit_estimate, level) == offsetof(bl_estimate, level),
               "estimates are copied");

const char *bandlimit_version(void) {
    return BL_VERSION;
}

bl_size bl_api_size(bandlimit_effort effort) {
    return effort == BANDLIMIT_QUICK ? BL_QUICK : effort == BANDLIMIT_FULL ? BL_FULL : BL_NORMAL;
}

bl_status bl_api_check(const void *object, size_t bytes, const char *type,
                       bandlimit_message *message) {
    size_t given;
    memcpy(&given, object, sizeof given);
    if (given == bytes)
        return BL_OK;
    return bl_report(bl_api_message(message), BL_USAGE,
                     "a %s of %zu bytes, where this library (" BL_VERSION
                     ") has %zu: call BANDLIMIT_INIT on it, and compile the program with the "
                     "bandlimit.h of the library that it runs with",
                     type, given, bytes);
}

bl_status bl_api_take(const void *settings, void *own, size_t bytes, const char *type,
                      bandlimit_message *message) {
    memset(own, 0, bytes);
    bl_status status = settings ? bl_api_check(settings, bytes, type, message) : BL_OK;
    if (settings && status == BL_OK)
        memcpy(own, settings, bytes);
    return status;
}

bl_status bl_api_index(size_t index, size_t count, const char *what, bandlimit_message *message) {
    return index < count ? BL_OK
                         : bl_report(bl_api_message(message), BL_USAGE,
                                     "there is no %s %zu: they count from 0, and there are %zu",
                                     what, index, count);
}

void *bl_api_room(size_t bytes, bandlimit_message *message) {
    void *room = calloc(1, bytes);
    if (!room)
        bl_report(bl_api_message(message), BL_DEVICE, "out of memory");
    return room;
}

bandlimit_status bl_api_end(bl_status status, const bandlimit_signal *signal, void *room,
                            bandlimit_message *message) {
    bl_message complaint;
    if (status == BL_OK)
        return BANDLIMIT_OK;
    free(room);
    if (status == BL_MISMATCH && signal &&
        bl_signal_complaint(bl_api_signal(signal), &complaint) == BL_DEVICE)
        status = bl_report(bl_api_message(message), BL_DEVICE, "%s", complaint.text);
    return (bandlimit_status)status;
}
