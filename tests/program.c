// SPDX-License-Identifier: MIT
#include "tests/program.h"

#include <dirent.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/test.h"

extern char **environ;

static char folder[64];

const char *bl_test_folder(void) {
    if (!*folder) {
        strcpy(folder, "/tmp/bandlimit-test-XXXXXX");
        assert_non_null(mkdtemp(folder));
    }
    return folder;
}

const char *bl_test_path(const char *name) {
    static char paths[8][256];
    static unsigned next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", bl_test_folder(), name);
    return path;
}

int bl_remove_folder(void **state) {
    (void)state;
    char command[128];
    if (!*folder)
        return 0;
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

size_t bl_test_files(void) {
    DIR *directory = opendir(bl_test_folder());
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return count;
}

static char *read_stream(FILE *stream, size_t *size) {
    rewind(stream);
    size_t room = 1 << 16, used = 0;
    char *text = malloc(room + 1);
    for (size_t got; text && (got = fread(text + used, 1, room - used, stream)) > 0;) {
        used += got;
        if (used == room)
            text = realloc(text, (room *= 2) + 1);
    }
    assert_non_null(text);
    text[used] = '\0';
    *size = used;
    return text;
}

char *bl_test_read(const char *path) {
    FILE *stream = fopen(path, "r");
    size_t size;
    if (!stream)
        return NULL;
    char *text = read_stream(stream, &size);
    fclose(stream);
    return text;
}

void bl_test_write(const char *path, const void *bytes, size_t size) {
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    assert_int_equal(fclose(stream), 0);
}

// The program's words: its path, then those given.
static char **with_program(const char *const *words) {
    size_t count = 0;
    while (words[count])
        count++;
    char **all = calloc(count + 2, sizeof *all);
    const char *program = getenv("BL_PROGRAM");
    assert_non_null(all);
    all[0] = strdup(program && *program ? program : "build/bandlimit");
    for (size_t i = 0; i < count; i++)
        all[i + 1] = strdup(words[i]);
    return all;
}

static int wait_for(pid_t child) {
    int status;
    while (waitpid(child, &status, 0) < 0)
        continue;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

bl_ran bl_run_words(const bl_streams *streams, const char *const *words) {
    static const bl_streams plain;
    if (!streams)
        streams = &plain;
    FILE *in = tmpfile(), *out = tmpfile(), *err = tmpfile();
    assert_true(in && out && err);
    if (streams->input)
        fputs(streams->input, in);
    rewind(in);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in), STDIN_FILENO);
    if (streams->close_output)
        posix_spawn_file_actions_addclose(&actions, STDOUT_FILENO);
    else if (streams->output)
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, streams->output, O_WRONLY, 0);
    else
        posix_spawn_file_actions_adddup2(&actions, fileno(out), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(err), STDERR_FILENO);
    char **all = with_program(words);
    pid_t child;
    int refused = posix_spawn(&child, all[0], &actions, NULL, all, environ);
    if (refused)
        fail_msg("cannot start %s: %s", all[0], strerror(refused));
    bl_ran ran = {.status = wait_for(child)};
    size_t size;
    ran.out = read_stream(out, &ran.out_size);
    ran.err = read_stream(err, &size);
    posix_spawn_file_actions_destroy(&actions);
    for (char **word = all; *word; word++)
        free(*word);
    free(all);
    fclose(in);
    fclose(out);
    fclose(err);
    return ran;
}

void bl_ran_free(bl_ran *ran) {
    free(ran->out);
    free(ran->err);
    *ran = (bl_ran){0};
}
