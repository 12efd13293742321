// SPDX-License-Identifier: MIT
#include "sources/spawn.h"

#include <errno.h>
#include <unistd.h>

#include "core/interrupt.h"

int bl_spawn(pid_t *child, char *const *words, const posix_spawn_file_actions_t *actions,
             const sigset_t *defaults) {
    posix_spawnattr_t attributes;
    sigset_t none, before;
    sigemptyset(&none);
    if (posix_spawnattr_init(&attributes) != 0)
        return ENOMEM;
    posix_spawnattr_setpgroup(&attributes, 0);
    // The mask that is held while it starts is not for it.
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK |
                                              POSIX_SPAWN_SETPGROUP);
    bl_interrupt_child_starts(&before);
    int failed = posix_spawnp(child, words[0], actions, &attributes, words, environ);
    bl_interrupt_child_started(&before, failed ? 0 : *child);
    posix_spawnattr_destroy(&attributes);
    return failed;
}
