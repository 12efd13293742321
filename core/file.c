// SPDX-License-Identifier: MIT
#include "core/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/interrupt.h"

char *bl_file_temporary_name(const char *path) {
    // The ending stays last, because image libraries choose the format by it: dir/.name.PID.N.ext
    static unsigned counter; // only makes names differ; atomic, so threads may call this
    unsigned number = __atomic_fetch_add(&counter, 1, __ATOMIC_RELAXED);
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    char *temporary = NULL;
    if (asprintf(&temporary, "%.*s.%s.%ld.%u%s", (int)(name - path), path, name, (long)getpid(),
                 number, dot ? dot : "") < 0)
        return NULL;
    return temporary;
}

// Whether it is the file that standard output or error goes to, as /dev/stdout is.
static int is_standard(const struct stat *info) {
    struct stat standard;
    for (int stream = STDOUT_FILENO; stream <= STDERR_FILENO; stream++)
        if (fstat(stream, &standard) == 0 && standard.st_dev == info->st_dev &&
            standard.st_ino == info->st_ino)
            return 1;
    return 0;
}

// A device such as /dev/full or a pipe cannot be replaced by renaming, nor can a file that is open
// as standard output: they are written in place, the latter at its end.
typedef enum target_kind { TARGET_REPLACED, TARGET_IN_PLACE, TARGET_APPENDED } target_kind;

static target_kind kind_of(const char *path) {
    struct stat info;
    if (stat(path, &info) != 0 || S_ISDIR(info.st_mode))
        return TARGET_REPLACED;
    if (!S_ISREG(info.st_mode))
        return TARGET_IN_PLACE;
    return is_standard(&info) ? TARGET_APPENDED : TARGET_REPLACED;
}

// What a file is known by: the file that a symbolic link points to is replaced, not the link.
static char *resolve(const char *path, target_kind kind) {
    struct stat info;
    if (kind == TARGET_REPLACED && lstat(path, &info) == 0 && S_ISLNK(info.st_mode))
        return realpath(path, NULL);
    return strdup(path);
}

static void release(bl_file *file) {
    if (file->temporary)
        bl_interrupt_forget_file(file->temporary);
    free(file->path);
    free(file->temporary);
    *file = (bl_file){0};
}

bl_status bl_file_create(const char *path, bl_file *file, bl_message *message) {
    struct stat info;
    *file = (bl_file){0};
    if (!*path)
        return bl_report(message, BL_USAGE, "an empty name is no file to write to");
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return bl_report(message, BL_DEVICE, "cannot write '%s': it is a folder; name a file",
                         path);
    // A pipe opened for reading too would not wait for its reader.
    static const char *const modes[] = {"w+", "w", "a"};
    target_kind kind = kind_of(path);
    file->path = resolve(path, kind);
    if (file->path)
        file->temporary =
            kind == TARGET_REPLACED ? bl_file_temporary_name(file->path) : strdup(file->path);
    if (file->path && file->temporary && kind == TARGET_REPLACED)
        bl_interrupt_note_file(file->temporary);
    if (file->path && file->temporary)
        file->stream = fopen(file->temporary, modes[kind]);
    if (!file->stream) {
        bl_report(message, BL_DEVICE, "cannot write '%s': %s; check the folder and its permissions",
                  path, strerror(errno));
        release(file);
        return BL_DEVICE;
    }
    return BL_OK;
}

// An earlier write failed and its errno is lost; one more byte, in a file that will be removed,
// fails for the same reason.
static int ask_again(int descriptor, int special) {
    return !special && lseek(descriptor, 0, SEEK_END) >= 0 && write(descriptor, "", 1) < 0 ? errno
                                                                                           : EIO;
}

bl_status bl_file_commit(bl_file *file, bl_message *message) {
    int special = strcmp(file->path, file->temporary) == 0;
    int failed = fflush(file->stream) != 0;
    int reason = errno;
    if (!failed && ferror(file->stream)) {
        failed = 1;
        reason = ask_again(fileno(file->stream), special);
    }
    // fsync makes a full disk or a failing device speak up before the old file is replaced; pipes
    // and devices do not know it.
    if (!failed && !special && fsync(fileno(file->stream)) != 0) {
        failed = 1;
        reason = errno;
    }
    if (fclose(file->stream) != 0 && !failed) {
        failed = 1;
        reason = errno;
    }
    bl_status status = BL_OK;
    if (failed) {
        if (!special)
            unlink(file->temporary);
        status = bl_report(message, BL_DEVICE, "cannot write '%s': %s; nothing was changed there",
                           file->path, strerror(reason));
    } else if (!special) {
        status = bl_file_install(file->temporary, file->path, message);
    }
    release(file);
    return status;
}

void bl_file_discard(bl_file *file) {
    if (!file->stream)
        return;
    fclose(file->stream);
    if (strcmp(file->path, file->temporary) != 0)
        unlink(file->temporary);
    release(file);
}

bl_status bl_file_install(const char *temporary, const char *path, bl_message *message) {
    if (rename(temporary, path) == 0)
        return BL_OK;
    int reason = errno;
    unlink(temporary);
    return bl_report(message, BL_DEVICE, "cannot write '%s': %s", path, strerror(reason));
}

bl_status bl_make_folder(const char *path, bl_message *message) {
    char *copy = strdup(path);
    if (!copy)
        return bl_report(message, BL_DEVICE, "out of memory making the folder '%s'", path);
    bl_status status = BL_OK;
    for (char *at = copy + 1; status == BL_OK; at++) {
        char here = *at;
        if (here != '/' && here != '\0')
            continue;
        *at = '\0';
        struct stat info;
        if (mkdir(copy, 0777) != 0 && errno != EEXIST)
            status = bl_report(message, BL_DEVICE, "cannot make the folder '%s': %s", copy,
                               strerror(errno));
        else if (stat(copy, &info) != 0 || !S_ISDIR(info.st_mode))
            status =
                bl_report(message, BL_DEVICE,
                          "cannot make the folder '%s': a file of that name is in the way", copy);
        *at = here;
        if (here == '\0')
            break;
    }
    free(copy);
    return status;
}
