// SPDX-License-Identifier: MIT
//
// Starts a program so that it ends with us.
#ifndef BL_SOURCES_SPAWN_H
#define BL_SOURCES_SPAWN_H

#include <signal.h>
#include <spawn.h>
#include <sys/types.h>

// Starts a program by its words, which end with NULL; the first is looked up in PATH. The child
// has a process group of its own, which is noted (core/interrupt.h) until the caller forgets it, no
// signal is blocked in it, and those of `defaults` do what they do in a fresh program. Returns 0,
// or the errno that says why there is no child. Safe from several threads.
int bl_spawn(pid_t *child, char *const *words, const posix_spawn_file_actions_t *actions,
             const sigset_t *defaults);

#endif
