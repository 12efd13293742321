// SPDX-License-Identifier: MIT
//
// Statuses and messages: how every function of the library says that something went wrong.
//
// A function that can fail on bad input returns a bl_status and takes a bl_message, a buffer that
// the caller owns; on failure it holds one sentence that says what, where and what to do. The
// library itself never prints and never exits. The numbers are the exit statuses of the program.
#ifndef BL_CORE_STATUS_H
#define BL_CORE_STATUS_H

typedef enum bl_status {
    BL_OK = 0,           // done; of a verb: its verdict is pass
    BL_INCONCLUSIVE = 1, // a verdict (core/verdict.h): the interval straddles the limit
    BL_FAIL = 2,         // measured, and outside the limit
    BL_MISMATCH = 3,     // inputs that do not fit together, or do not fit in memory
    BL_DEVICE = 4,       // a file, a device or the memory allocator refused
    BL_USAGE = 64        // an unknown word, a value out of its range
} bl_status;

typedef struct bl_message {
    char text[1024];
} bl_message;

// Writes the message (cut at the buffer's end, which keeps the first words) and returns `status`,
// so that `return bl_report(message, BL_USAGE, ...)` is one line. `message` may be NULL.
bl_status bl_report(bl_message *message, bl_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// "mismatch", "device error", ...: the word of a status in JSON.
const char *bl_status_word(bl_status status);

#endif
