// SPDX-License-Identifier: MIT
//
// Says in whose code the program crashed, when a signal such as SIGSEGV ends it within a function
// of the user's.
#ifndef BL_SOURCES_CRASH_H
#define BL_SOURCES_CRASH_H

#include <stddef.h>

// Handles SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT where nobody else does: between
// bl_crash_enter and bl_crash_leave of the same thread a line is written to standard error; then
// the program ends by the signal in any case. The first call counts.
void bl_crash_watch(void);

// The line, which must stay where it is until bl_crash_leave. Calls cannot be nested.
void bl_crash_enter(const char *line, size_t length);
void bl_crash_leave(void);

#endif
