// SPDX-License-Identifier: MIT
#include "tests/temporary.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder_name[256];

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where) {
    (void)info, (void)kind, (void)where;
    return remove(path);
}

static void remove_folder(void) {
    nftw(folder_name, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

const char *bl_temporary_folder(void) {
    if (!folder_name[0]) {
        const char *base = getenv("TMPDIR");
        snprintf(folder_name, sizeof folder_name, "%s/bandlimit-XXXXXX", base ? base : "/tmp");
        if (!mkdtemp(folder_name))
            abort();
        atexit(remove_folder);
    }
    return folder_name;
}

const char *bl_temporary_path(const char *name) {
    static char paths[10][512];
    static int next;
    char *path = paths[next++ % 10];
    snprintf(path, sizeof paths[0], "%s/%s", bl_temporary_folder(), name);
    return path;
}

char *bl_temporary_read(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    char *text = NULL;
    size_t used = 0, got;
    do {
        text = realloc(text, used + 65537);
        if (!text)
            abort();
        used += got = fread(text + used, 1, 65536, file);
    } while (got > 0);
    fclose(file);
    text[used] = '\0';
    if (size)
        *size = used;
    return text;
}

void bl_temporary_write(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0)
        abort();
}

enum { NOBODY = 65534 };

static int dropped;

// access() asks for the real user, open() for the effective one: both go, the saved one stays.
int bl_temporary_drop_powers(void) {
    if (geteuid() != 0)
        return 1;
    chmod(bl_temporary_folder(), 0755);
    dropped = setresuid(NOBODY, NOBODY, 0) == 0;
    return dropped;
}

void bl_temporary_take_powers(void) {
    if (dropped && setresuid(0, 0, 0) != 0)
        abort();
    dropped = 0;
}

void bl_temporary_limit_files(size_t most_bytes) {
    struct rlimit limit;
    signal(SIGXFSZ, SIG_IGN);
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0)
        abort();
    limit.rlim_cur = most_bytes ? most_bytes : limit.rlim_max;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0)
        abort();
}

size_t bl_temporary_files(void) {
    DIR *directory = opendir(bl_temporary_folder());
    size_t count = 0;
    for (struct dirent *entry; directory && (entry = readdir(directory));)
        count++;
    closedir(directory);
    return count - 2; // "." and ".."
}

int bl_temporary_run(const char *folder, const char *const arguments[]) {
    pid_t child = fork();
    if (child == 0) {
        int null = open("/dev/null", O_RDWR);
        dup2(null, 0);
        dup2(null, 1);
        dup2(null, 2);
        if (folder && chdir(folder) != 0)
            _exit(126);
        execvp(arguments[0], (char *const *)arguments);
        _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child)
        return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int bl_temporary_no_wisdom(void **state) {
    (void)state;
    return setenv("XDG_CACHE_HOME", "/dev/null/none", 1);
}
