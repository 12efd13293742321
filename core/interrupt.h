// SPDX-License-Identifier: MIT
//
// What a program must not leave behind when a signal ends it: process groups of its children, and
// files that are half written. Both are noted here while they exist; a handler that is installed
// for the signals that end a program kills and removes them.
//
// All functions may be called from several threads. Without bl_interrupt_install nothing is ended,
// but noting is still right: the program that a library is part of decides about signals.
#ifndef BL_CORE_INTERRUPT_H
#define BL_CORE_INTERRUPT_H

#include <signal.h>
#include <sys/types.h>

// Handles SIGINT, SIGTERM and SIGHUP where they would end the program: what is noted is ended, and
// then the program is, by the same signal. One that is ignored (nohup) or handled stays so.
void bl_interrupt_install(void);

// Ends what is noted; for handlers of other signals. Async-signal-safe.
void bl_interrupt_end_all(void);

// Holds the signals off while a child is started, so that none is born between a signal and the
// note of it. `before` is kept for bl_interrupt_child_started, which is told the process group, or
// 0 if none was started.
void bl_interrupt_child_starts(sigset_t *before);
void bl_interrupt_child_started(const sigset_t *before, pid_t group);
// To be called before the leader of the group is waited for: the number may be another's after it.
void bl_interrupt_forget_group(pid_t group);

// Notes a file to be removed, by a path that stays where it is until it is forgotten.
void bl_interrupt_note_file(const char *path);
void bl_interrupt_forget_file(const char *path);

#endif
