// SPDX-License-Identifier: MIT
//
// Whoever takes an entry out of a list owns it: the one who noted it, or a handler. One that finds
// its entry gone waits for the end of the program, so that no number is killed after another
// process got it, and no path is read after its memory was freed.
#include "core/interrupt.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>
#include <unistd.h>

// What does not fit is not noted. A program signal has 64 children at most, and few are alive.
enum { ROOM = 512, LONGEST_WAIT_MS = 2000 };

static _Atomic(intptr_t) groups[ROOM], files[ROOM]; // 0: free
static atomic_int starting;                         // children that are not noted yet
static atomic_int ending;                           // a handler runs

static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNALS = sizeof signals / sizeof *signals };

static void note(_Atomic(intptr_t) *list, intptr_t entry) {
    for (int i = 0; i < ROOM; i++) {
        intptr_t none = 0;
        if (atomic_compare_exchange_strong(&list[i], &none, entry))
            return;
    }
}

// While a handler runs in another thread, nothing may be given back that it may hold.
static void forget(_Atomic(intptr_t) *list, intptr_t entry) {
    for (int i = 0; i < ROOM; i++) {
        intptr_t found = entry;
        if (atomic_compare_exchange_strong(&list[i], &found, 0))
            return;
    }
    while (atomic_load(&ending))
        pause();
}

void bl_interrupt_end_all(void) {
    const struct timespec moment = {0, 1000000};
    int reason = errno;
    atomic_store(&ending, 1);
    // A thread that starts a child holds these signals off, so it is not the one that waits here.
    for (int i = 0; i < LONGEST_WAIT_MS && atomic_load(&starting); i++)
        nanosleep(&moment, NULL);
    for (int i = 0; i < ROOM; i++) {
        intptr_t group = atomic_exchange(&groups[i], 0);
        if (group)
            kill((pid_t)-group, SIGKILL);
    }
    for (int i = 0; i < ROOM; i++) {
        intptr_t file = atomic_exchange(&files[i], 0);
        if (file)
            unlink((const char *)file);
    }
    errno = reason;
}

// The default action is back by SA_RESETHAND; the signal is delivered when the handler returns.
static void end_by(int number) {
    bl_interrupt_end_all();
    raise(number);
}

void bl_interrupt_install(void) {
    struct sigaction action = {.sa_handler = end_by, .sa_flags = SA_RESETHAND}, before;
    for (int i = 0; i < SIGNALS; i++)
        sigaddset(&action.sa_mask, signals[i]);
    for (int i = 0; i < SIGNALS; i++)
        if (sigaction(signals[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(signals[i], &action, NULL);
}

void bl_interrupt_child_starts(sigset_t *before) {
    sigset_t held;
    sigemptyset(&held);
    for (int i = 0; i < SIGNALS; i++)
        sigaddset(&held, signals[i]);
    pthread_sigmask(SIG_BLOCK, &held, before);
    atomic_fetch_add(&starting, 1);
    if (atomic_load(&ending)) {
        atomic_fetch_sub(&starting, 1);
        while (atomic_load(&ending))
            pause();
    }
}

void bl_interrupt_child_started(const sigset_t *before, pid_t group) {
    if (group)
        note(groups, group);
    atomic_fetch_sub(&starting, 1);
    pthread_sigmask(SIG_SETMASK, before, NULL);
}

void bl_interrupt_forget_group(pid_t group) {
    forget(groups, group);
}

void bl_interrupt_note_file(const char *path) {
    note(files, (intptr_t)path);
}

void bl_interrupt_forget_file(const char *path) {
    forget(files, (intptr_t)path);
}
