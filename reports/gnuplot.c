// SPDX-License-Identifier: MIT
//
// Runs gnuplot as a child, without a shell, in the folder of the script. The pictures are made
// under a prefixed name and renamed when all of them are whole.
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file.h"
#include "core/interrupt.h"
#include "reports/plot.h"
#include "sources/spawn.h"

enum { SAID = 600 }; // bytes of what gnuplot says that fit a message

// Reads all that the child says and keeps the first of it, newlines as blanks.
static void listen_to(int from, char said[SAID]) {
    char buffer[1024];
    size_t kept = 0;
    for (;;) {
        ssize_t got = read(from, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        for (ssize_t i = 0; i < got; i++) {
            char c = buffer[i] == '\n' || buffer[i] == '\t' ? ' ' : buffer[i];
            int doubled = c == ' ' && (kept == 0 || said[kept - 1] == ' ');
            if (kept + 1 < SAID && !doubled)
                said[kept++] = c;
        }
    }
    said[kept] = '\0';
}

static int spawn_gnuplot(const char *folder, const char *script, const char *prefix, int to,
                         pid_t *child) {
    char set_prefix[64];
    snprintf(set_prefix, sizeof set_prefix, "prefix='%s'", prefix);
    // -d keeps a user's start-up file out of the figures.
    const char *const arguments[] = {"gnuplot", "-d", "-e", set_prefix, script, NULL};
    posix_spawn_file_actions_t actions;
    sigset_t none;
    sigemptyset(&none);
    if (posix_spawn_file_actions_init(&actions) != 0)
        return ENOMEM;
    int failed = posix_spawn_file_actions_addchdir_np(&actions, folder);
    if (!failed)
        failed = posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    if (!failed)
        failed = posix_spawn_file_actions_adddup2(&actions, to, 1);
    if (!failed)
        failed = posix_spawn_file_actions_adddup2(&actions, to, 2);
    if (!failed) // what it ignores is what we do
        failed = bl_spawn(child, (char *const *)arguments, &actions, &none);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

static bl_status draw(const char *folder, const char *script, const char *prefix,
                      bl_message *message) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return bl_report(message, BL_DEVICE, "cannot start gnuplot: %s", strerror(errno));
    pid_t child;
    int failed = spawn_gnuplot(folder, script, prefix, ends[1], &child);
    close(ends[1]);
    if (failed) {
        close(ends[0]);
        return bl_report(message, BL_DEVICE,
                         "cannot start gnuplot: %s; install it (Debian: gnuplot-nox) and see that "
                         "it is in PATH. The data and the script %s/%s are written",
                         strerror(failed), folder, script);
    }
    char said[SAID];
    listen_to(ends[0], said);
    close(ends[0]);
    int state = 0;
    bl_interrupt_forget_group(child);
    while (waitpid(child, &state, 0) < 0 && errno == EINTR)
        ;
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0)
        return BL_OK;
    return bl_report(message, BL_DEVICE, "gnuplot failed on %s/%s: %s", folder, script,
                     *said ? said : "it said nothing");
}

// gnuplot does not notice a full disk: a picture that was cut short lacks the end of its format.
static int is_whole(const char *path, const char *ending) {
    static const struct {
        const char *ending, *mark;
        size_t length;
    } marks[] = {{"svg", "</svg>", 6}, {"png", "IEND", 4}, {"pdf", "%%EOF", 5}};
    char tail[32] = {0};
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return 0;
    size_t got = 0;
    if (fseek(stream, -(long)sizeof tail, SEEK_END) == 0)
        got = fread(tail, 1, sizeof tail, stream);
    fclose(stream);
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
        if (strcmp(ending, marks[i].ending) == 0)
            return memmem(tail, got, marks[i].mark, marks[i].length) != NULL;
    return 0;
}

static bl_status install(const char *folder, const char *prefix, const char *name,
                         const char *ending, bl_message *message) {
    char *from = NULL, *to = NULL;
    bl_status status = BL_DEVICE;
    if (asprintf(&from, "%s/%s%s.%s", folder, prefix, name, ending) < 0)
        from = NULL;
    if (asprintf(&to, "%s/%s.%s", folder, name, ending) < 0)
        to = NULL;
    if (!from || !to)
        bl_report(message, BL_DEVICE, "out of memory");
    else if (is_whole(from, ending))
        status = bl_file_install(from, to, message);
    else
        bl_report(message, BL_DEVICE,
                  "cannot write '%s': gnuplot left it cut short; is the disk full?", to);
    free(from);
    free(to);
    return status;
}

// Where gnuplot leaves a picture; NULL out of memory. Noted, so that a signal removes it.
static char *note_picture(const char *folder, const char *prefix, const char *name,
                          const char *ending) {
    char *path = NULL;
    if (asprintf(&path, "%s/%s%s.%s", folder, prefix, name, ending) < 0)
        return NULL;
    bl_interrupt_note_file(path);
    return path;
}

bl_status bl_plot_run(const char *folder, const char *name, int with_pdf, bl_message *message) {
    static const char *const endings[] = {"svg", "png", "pdf"};
    int count = with_pdf ? 3 : 2;
    char prefix[40], *script = NULL, *pictures[3];
    snprintf(prefix, sizeof prefix, ".%ld-", (long)getpid());
    if (asprintf(&script, "%s.gp", name) < 0)
        return bl_report(message, BL_DEVICE, "out of memory");
    for (int i = 0; i < count; i++)
        pictures[i] = note_picture(folder, prefix, name, endings[i]);
    bl_status status = draw(folder, script, prefix, message);
    for (int i = 0; i < count; i++) {
        if (status == BL_OK)
            status = install(folder, prefix, name, endings[i], message);
        if (!pictures[i])
            continue;
        if (status != BL_OK)
            unlink(pictures[i]);
        bl_interrupt_forget_file(pictures[i]);
        free(pictures[i]);
    }
    free(script);
    return status;
}
