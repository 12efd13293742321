// SPDX-License-Identifier: MIT
//
// Between include/bandlimit.h, the document for programs, and the house: types of the one are
// turned into those of the other here and nowhere else, so that the inside may change.
#ifndef BL_API_API_H
#define BL_API_API_H

#include "core/signal.h"
#include "core/size.h"
#include "core/statistics.h"
#include "core/verdict.h"
#include "include/bandlimit.h"

static inline const bl_signal *bl_api_signal(const bandlimit_signal *signal) {
    return (const bl_signal *)signal;
}

static inline bl_message *bl_api_message(bandlimit_message *message) {
    return (bl_message *)message;
}

static inline bandlimit_estimate bl_api_estimate(const bl_estimate *estimate) {
    bandlimit_estimate same;
    memcpy(&same, estimate, sizeof same);
    return same;
}

bl_size bl_api_size(bandlimit_effort effort);

// Whether an object of the caller's, which begins with its size, is of the size that the library
// knows. Errors: BL_USAGE.
bl_status bl_api_check(const void *object, size_t bytes, const char *type,
                       bandlimit_message *message);
#define BL_API_CHECK(object, type, message) bl_api_check(object, sizeof(type), #type, message)

// Copies settings of the caller's, where there are any, into `own`; else all of it is 0.
bl_status bl_api_take(const void *settings, void *own, size_t bytes, const char *type,
                      bandlimit_message *message);
#define BL_API_TAKE(settings, own, type, message)                                                  \
    bl_api_take(settings, own, sizeof(type), #type, message)

// The numbers where nothing is said, and "past the end".
#define BL_API_SEED(settings) ((settings).seed ? (settings).seed : 1)
#define BL_API_LEVEL(settings) ((settings).level != 0 ? (settings).level : 0.95)
bl_status bl_api_index(size_t index, size_t count, const char *what, bandlimit_message *message);

// Room for a result, and the status of a measurement that went into it: where it failed, the room
// is freed; where the source of the signal did, that is the reason.
void *bl_api_room(size_t bytes, bandlimit_message *message);
bandlimit_status bl_api_end(bl_status status, const bandlimit_signal *signal, void *room,
                            bandlimit_message *message);

// Frees the room of an object, after what `release` does with it, and leaves the object as
// BANDLIMIT_INIT does.
#define BL_API_RELEASE(object, release)                                                            \
    do {                                                                                           \
        if ((object)->owned)                                                                       \
            release((object)->owned);                                                              \
        free((object)->owned);                                                                     \
        BANDLIMIT_INIT(object);                                                                    \
    } while (0)

#endif
