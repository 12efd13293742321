// SPDX-License-Identifier: MIT
#include "tests/program.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/test.h"

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

static void redirect(int from, int to) {
    if (from < 0 || dup2(from, to) < 0)
        _exit(127);
}

// In the child: no file beyond the limit (a write fails with EFBIG, as the signal is ignored), and
// no powers. The program was opened before, as its folder may be closed to others.
static void become(const bl_streams *streams, int program, char *const *words, int in, int out,
                   int err) {
    redirect(in, STDIN_FILENO);
    redirect(err, STDERR_FILENO);
    if (streams->close_output)
        close(STDOUT_FILENO);
    else
        redirect(streams->output ? open(streams->output, O_WRONLY) : out, STDOUT_FILENO);
    const struct rlimit most = {streams->most_bytes, streams->most_bytes};
    if (streams->most_bytes &&
        (signal(SIGXFSZ, SIG_IGN) == SIG_ERR || setrlimit(RLIMIT_FSIZE, &most) != 0))
        _exit(127);
    if (streams->as_nobody && geteuid() == 0 && (setgid(BL_NOBODY) != 0 || setuid(BL_NOBODY) != 0))
        _exit(127);
    fexecve(program, words, environ);
    _exit(127);
}

static int wait_for(pid_t child) {
    int status;
    while (waitpid(child, &status, 0) < 0)
        continue;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int bl_can_be_nobody(void) {
    if (geteuid() != 0)
        return 1;
    pid_t child = fork();
    if (child == 0)
        _exit(setgid(BL_NOBODY) != 0 || setuid(BL_NOBODY) != 0);
    return child > 0 && wait_for(child) == 0;
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
    char **all = with_program(words);
    int program = open(all[0], O_RDONLY | O_CLOEXEC);
    if (program < 0)
        fail_msg("cannot open %s: %s", all[0], strerror(errno));
    pid_t child = fork();
    if (child == 0)
        become(streams, program, all, fileno(in), fileno(out), fileno(err));
    assert_true(child > 0);
    close(program);
    bl_ran ran = {.status = wait_for(child)};
    if (ran.status == 127)
        fail_msg("cannot start %s", all[0]);
    size_t size;
    ran.out = read_stream(out, &ran.out_size);
    ran.err = read_stream(err, &size);
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
