// SPDX-License-Identifier: MIT
#include "sources/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/interrupt.h"
#include "sources/spawn.h"

enum { TAIL = 1024, QUOTED = 480, GRACE_MS = 250, STANDARD = 3 };

struct bl_child {
    pid_t pid;
    int in, out, err;    // our ends; -1 when closed
    unsigned char *tail; // the last bytes of its standard error
    size_t tail_used;
};

// --- starting ---

// A pipe whose ends are none of the standard streams and are not inherited.
static int open_pipe(int ends[2]) {
    if (pipe2(ends, O_CLOEXEC) != 0)
        return 0;
    for (int i = 0; i < 2; i++) {
        if (ends[i] >= STANDARD)
            continue;
        int moved = fcntl(ends[i], F_DUPFD_CLOEXEC, STANDARD), reason = errno;
        close(ends[i]);
        ends[i] = moved;
        if (moved < 0) {
            close(ends[1 - i]);
            errno = reason;
            return 0;
        }
    }
    return 1;
}

static void close_end(int *end) {
    if (*end >= 0)
        close(*end);
    *end = -1;
}

// The three pipes; ends[i] is the child's end of stream i, the other one ours.
static int open_pipes(bl_child *child, int theirs[STANDARD]) {
    int *const ours[STANDARD] = {&child->in, &child->out, &child->err};
    for (int i = 0; i < STANDARD; i++) {
        int ends[2];
        if (!open_pipe(ends))
            return 0;
        int write_end = i == 0; // we write to its standard input and read the others
        *ours[i] = ends[write_end];
        theirs[i] = ends[!write_end];
        if (fcntl(*ours[i], F_SETFL, O_NONBLOCK) != 0)
            return 0;
    }
    return 1;
}

static int spawn(bl_child *child, char *const *words, const int theirs[STANDARD]) {
    posix_spawn_file_actions_t actions;
    sigset_t all;
    sigfillset(&all);
    if (posix_spawn_file_actions_init(&actions) != 0)
        return ENOMEM;
    int failed = 0;
    for (int i = 0; i < STANDARD && !failed; i++)
        failed = posix_spawn_file_actions_adddup2(&actions, theirs[i], i);
#if __GLIBC_PREREQ(2, 34)
    if (!failed) // what others opened without O_CLOEXEC
        failed = posix_spawn_file_actions_addclosefrom_np(&actions, STANDARD);
#endif
    if (!failed)
        failed = bl_spawn(&child->pid, words, &actions, &all);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

static void discard(bl_child *child) {
    close_end(&child->in);
    close_end(&child->out);
    close_end(&child->err);
    free(child->tail);
    free(child);
}

static const char *remedy(int reason, const char *program) {
    if (reason == ENOENT && !strchr(program, '/') && access(program, X_OK) == 0)
        return "; it is not in PATH, but in this folder: write ./ before it";
    if (reason == ENOENT)
        return strchr(program, '/') ? "; check its path, and its first line if it is a script"
                                    : "; it is not in PATH";
    if (reason == ENOEXEC)
        return "; a script needs a first line such as #!/usr/bin/env python3";
    return reason == EACCES ? "; make it executable" : "";
}

bl_status bl_child_start(char *const *words, bl_child **out, bl_message *message) {
    bl_child *child = calloc(1, sizeof *child);
    int theirs[STANDARD] = {-1, -1, -1}, reason = 0;
    if (!child || !(child->tail = malloc(TAIL))) {
        free(child);
        return bl_report(message, BL_DEVICE, "out of memory");
    }
    child->in = child->out = child->err = -1;
    reason = open_pipes(child, theirs) ? spawn(child, words, theirs) : errno;
    for (int i = 0; i < STANDARD; i++)
        close_end(&theirs[i]);
    if (reason != 0) {
        discard(child);
        return bl_report(message, BL_DEVICE, "cannot start '%.200s': %s%s", words[0],
                         strerror(reason), remedy(reason, words[0]));
    }
    *out = child;
    return BL_OK;
}

// --- what the child says on standard error ---

static void keep_tail(bl_child *child, const unsigned char *bytes, size_t count) {
    if (count > TAIL) {
        bytes += count - TAIL;
        count = TAIL;
    }
    size_t kept = child->tail_used + count > TAIL ? TAIL - count : child->tail_used;
    memmove(child->tail, child->tail + child->tail_used - kept, kept);
    memcpy(child->tail + kept, bytes, count);
    child->tail_used = kept + count;
}

// Takes what is there. A child that never stops talking is left after 64 reads.
static void drain_errors(bl_child *child) {
    unsigned char buffer[4096];
    for (int i = 0; i < 64 && child->err >= 0; i++) {
        ssize_t got = read(child->err, buffer, sizeof buffer);
        if (got > 0)
            keep_tail(child, buffer, (size_t)got);
        else if (got == 0 || (errno != EAGAIN && errno != EINTR))
            close_end(&child->err);
        else if (errno == EAGAIN)
            return;
    }
}

void bl_child_errors(bl_child *child, char *out, size_t size) {
    size_t used = 0, start = 0, end;
    drain_errors(child);
    end = child->tail_used;
    while (end > 0 && (child->tail[end - 1] == '\n' || child->tail[end - 1] == '\r'))
        end--;
    if (end > QUOTED)
        start = end - QUOTED;
    while (start < end && start > 0 && (child->tail[start] & 0xC0) == 0x80)
        start++; // in the middle of a letter of UTF-8
    out[0] = '\0';
    for (size_t i = start; i < end && used + 5 < size; i++) {
        unsigned char c = child->tail[i];
        if (c == '\n')
            used += (size_t)snprintf(out + used, size - used, "\\n");
        else if (c < 0x20 || c == 0x7F)
            used += (size_t)snprintf(out + used, size - used, "\\x%02x", c);
        else
            used += (size_t)snprintf(out + used, size - used, "%c", c);
    }
}

// A message with what the child said last.
static bl_status report(bl_child *child, bl_message *message, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static bl_status report(bl_child *child, bl_message *message, const char *format, ...) {
    char what[256], errors[640];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    bl_child_errors(child, errors, sizeof errors);
    return bl_report(message, BL_DEVICE, "%s%s%s", what,
                     errors[0] ? "; its standard error ends with: " : "", errors);
}

// --- ending ---

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// Waits until the child has ended, without reaping it; false if it has not within the grace.
static int has_ended(const bl_child *child) {
    const struct timespec pause = {0, 1000000};
    for (double until = now() + 1e-3 * GRACE_MS;;) {
        siginfo_t info = {0};
        int got = waitid(P_PID, (id_t)child->pid, &info, WEXITED | WNOHANG | WNOWAIT);
        if ((got == 0 && info.si_pid == child->pid) || (got != 0 && errno == ECHILD))
            return 1;
        if (now() > until)
            return 0;
        nanosleep(&pause, NULL);
    }
}

// Ends the child and its process group, whose number is the child's until that is reaped. False if
// somebody else reaped it (a program that ignores SIGCHLD).
static int reap(bl_child *child, int *status) {
    kill(-child->pid, SIGKILL);
    bl_interrupt_forget_group(child->pid);
    pid_t got;
    do
        got = waitpid(child->pid, status, 0);
    while (got < 0 && errno == EINTR);
    return got == child->pid;
}

static void describe_end(bl_child *child, char *out, size_t size) {
    int ended = has_ended(child), status;
    drain_errors(child);
    int known = reap(child, &status);
    child->pid = 0;
    if (!ended)
        snprintf(out, size, "closed its standard output");
    else if (known && WIFSIGNALED(status))
        snprintf(out, size, "was killed by signal %d (%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
    else if (known)
        snprintf(out, size, "ended with exit status %d", WEXITSTATUS(status));
    else
        snprintf(out, size, "ended");
}

bl_status bl_child_end(bl_child *child, int idle, bl_message *message) {
    bl_status status = BL_OK;
    int unused;
    close_end(&child->in);
    double until = now() + 1e-3 * GRACE_MS;
    while (child->pid && idle) {
        struct pollfd files[2] = {{child->out, POLLIN, 0}, {child->err, POLLIN, 0}};
        int left = (int)(1e3 * (until - now()));
        unsigned char byte;
        if (left <= 0 || (poll(files, 2, left) < 0 && errno != EINTR))
            break;
        if (files[1].revents)
            drain_errors(child);
        if (!files[0].revents)
            continue;
        if (read(child->out, &byte, 1) > 0)
            status = report(child, message,
                            "wrote more than it was asked for: an answer is one double a point");
        break;
    }
    if (child->pid && idle && status == BL_OK)
        (void)has_ended(child);
    if (child->pid)
        (void)reap(child, &unused);
    discard(child);
    return status;
}

// --- asking ---

typedef struct exchange {
    const unsigned char *request;
    unsigned char *answer;
    size_t request_size, answer_size, sent, received;
    int ended; // the child's standard output is closed
} exchange;

// Whether an answer was meant for people: a frequent mistake.
static int looks_like_text(const exchange *talk) {
    size_t i = 0;
    while (i < talk->received && ((talk->answer[i] >= 0x20 && talk->answer[i] < 0x7F) ||
                                  strchr("\t\r\n", talk->answer[i] ? talk->answer[i] : 1)))
        i++;
    return i > 0 && i == talk->received;
}

static const char *text_hint(const exchange *talk) {
    return looks_like_text(talk)
               ? "; the answer looks like text: it must be bare doubles of 8 bytes each"
               : "";
}

// A pipe without a reader: the signal for it is ours alone, for the program we are part of may
// neither have asked for it nor expect it.
static ssize_t write_quietly(int file, const void *bytes, size_t count) {
    sigset_t pipe_signal, before, pending;
    const struct timespec at_once = {0, 0};
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    sigpending(&pending);
    pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
    ssize_t done = write(file, bytes, count);
    int reason = errno;
    if (done < 0 && reason == EPIPE && !sigismember(&pending, SIGPIPE))
        while (sigtimedwait(&pipe_signal, NULL, &at_once) < 0 && errno == EINTR)
            continue;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return done;
}

// True if a byte was moved. A child that closes its input may still answer.
static int send_more(bl_child *child, exchange *talk) {
    ssize_t done =
        write_quietly(child->in, talk->request + talk->sent, talk->request_size - talk->sent);
    if (done > 0)
        talk->sent += (size_t)done;
    else if (done < 0 && errno != EAGAIN && errno != EINTR)
        close_end(&child->in);
    return done > 0;
}

static int receive_more(bl_child *child, exchange *talk) {
    size_t room = talk->answer_size + BL_CHILD_SLACK - talk->received;
    ssize_t got = read(child->out, talk->answer + talk->received, room);
    if (got > 0)
        talk->received += (size_t)got;
    else if (got == 0 || (errno != EAGAIN && errno != EINTR))
        talk->ended = 1;
    return got > 0;
}

// Serves all three pipes until the answer is there. False if nothing moved in time.
static int converse(bl_child *child, exchange *talk, double timeout) {
    double until = now() + timeout;
    while (!talk->ended && talk->received <= talk->answer_size &&
           (talk->received < talk->answer_size ||
            (talk->sent < talk->request_size && child->in >= 0))) {
        int in = talk->sent < talk->request_size ? child->in : -1; // poll skips -1
        struct pollfd files[STANDARD] = {
            {in, POLLOUT, 0}, {child->out, POLLIN, 0}, {child->err, POLLIN, 0}};
        double left = until - now();
        if (left <= 0)
            return 0;
        int ready = poll(files, STANDARD, left > 1e6 ? 1000000000 : (int)(1e3 * left) + 1);
        if (ready < 0 && errno != EINTR)
            return 0;
        if (ready <= 0)
            continue;
        int moved = 0;
        if (files[0].revents)
            moved |= send_more(child, talk);
        if (files[1].revents)
            moved |= receive_more(child, talk);
        if (files[2].revents)
            drain_errors(child);
        if (moved)
            until = now() + timeout;
    }
    return 1;
}

// Whether bytes wait that belong to no question.
static int has_more(const bl_child *child) {
    struct pollfd file = {child->out, POLLIN, 0};
    return poll(&file, 1, 0) > 0 && (file.revents & POLLIN);
}

bl_status bl_child_ask(bl_child *child, const void *request, size_t request_size, void *answer,
                       size_t answer_size, double timeout, bl_message *message) {
    exchange talk = {.request = request,
                     .answer = answer,
                     .request_size = request_size,
                     .answer_size = answer_size};
    char end[128];
    int more = has_more(child);
    int moved = more || converse(child, &talk, timeout);
    if (more || talk.received > answer_size)
        return report(child, message,
                      "wrote more than it was asked for: an answer is one double a point%s",
                      text_hint(&talk));
    if (!moved)
        return report(child, message,
                      "moved no byte for %g s, with %zu of %zu bytes taken and %zu of %zu "
                      "answered%s; timeout=SECONDS waits longer",
                      timeout, talk.sent, request_size, talk.received, answer_size,
                      text_hint(&talk));
    if (talk.received == answer_size)
        return BL_OK;
    describe_end(child, end, sizeof end);
    return report(child, message, "%s after %zu of %zu bytes of an answer%s", end, talk.received,
                  answer_size, text_hint(&talk));
}
