// SPDX-License-Identifier: MIT
//
// The handler calls only what is async-signal-safe, and reads no memory but the line and its
// length, which were settled before the call. It has a stack of its own in each thread, for a
// function that calls itself without end has used up the other.
#include "sources/crash.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/interrupt.h"

enum { STACK = 64 << 10 };

// A model that needs no allocation when a handler reads it first.
#define IN_THREAD static _Thread_local __attribute__((tls_model("initial-exec")))
IN_THREAD const char *volatile marked;
IN_THREAD volatile size_t marked_length;
IN_THREAD int prepared;

static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_key_t stacks;
static int have_key;

// The default action is back by SA_RESETHAND; a fault would come again by itself, abort not.
static void end_by(int number) {
    int reason = errno;
    if (marked) {
        ssize_t ignored = write(STDERR_FILENO, marked, marked_length);
        (void)ignored;
    }
    bl_interrupt_end_all();
    errno = reason;
    raise(number);
}

static void drop_stack(void *stack) {
    const stack_t none = {.ss_flags = SS_DISABLE};
    sigaltstack(&none, NULL);
    munmap(stack, STACK);
}

static void install(void) {
    static const int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    struct sigaction action = {.sa_handler = end_by, .sa_flags = SA_RESETHAND | SA_ONSTACK}, before;
    have_key = pthread_key_create(&stacks, drop_stack) == 0;
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        if (sigaction(signals[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(signals[i], &action, NULL);
}

void bl_crash_watch(void) {
    pthread_once(&once, install);
}

// A thread that has a stack for signals keeps it. Without one the handler still serves, except for
// a stack that is full.
static void prepare_thread(void) {
    stack_t stack = {0};
    prepared = 1;
    if (!have_key || sigaltstack(NULL, &stack) != 0 || !(stack.ss_flags & SS_DISABLE))
        return;
    void *room = mmap(NULL, STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED)
        return;
    stack = (stack_t){.ss_sp = room, .ss_size = STACK};
    if (pthread_setspecific(stacks, room) != 0 || sigaltstack(&stack, NULL) != 0) {
        pthread_setspecific(stacks, NULL);
        munmap(room, STACK);
    }
}

void bl_crash_enter(const char *line, size_t length) {
    if (!prepared)
        prepare_thread();
    marked_length = length;
    marked = line;
}

void bl_crash_leave(void) {
    marked = NULL;
}
