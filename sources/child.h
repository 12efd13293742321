// SPDX-License-Identifier: MIT
//
// A child process that reads questions from its standard input and answers on its standard output.
#ifndef BL_SOURCES_CHILD_H
#define BL_SOURCES_CHILD_H

#include <stddef.h>

#include "core/status.h"

typedef struct bl_child bl_child;

// Room behind an answer, so that one that is too long shows at once.
enum { BL_CHILD_SLACK = 64 };

// Starts a program by its words, which end with NULL; the first is looked up in PATH. The child has
// the signals of a fresh program, no file of ours but the three pipes, and a process group of its
// own. Errors: BL_DEVICE for a program that cannot be started. The caller ends with bl_child_end.
bl_status bl_child_start(char *const *words, bl_child **child, bl_message *message);

// Sends the request and waits for an answer of exactly that size; `answer` has room for
// BL_CHILD_SLACK bytes more. Both directions are served at once, so neither can block the other.
// Errors: BL_DEVICE for a child that ended, answered more, or moved no byte for `timeout` seconds;
// the message quotes the end of its standard error. After an error it can only be ended.
bl_status bl_child_ask(bl_child *child, const void *request, size_t request_size, void *answer,
                       size_t answer_size, double timeout, bl_message *message);

// Reads what has arrived on standard error and writes its end, in one printable line, into `out`.
void bl_child_errors(bl_child *child, char *out, size_t size);

// Closes the child's input, gives it a moment to end, and ends it with all its own children. `idle`
// says that it owes no answer: BL_DEVICE then if it left bytes that nobody asked for.
bl_status bl_child_end(bl_child *child, int idle, bl_message *message);

#endif
