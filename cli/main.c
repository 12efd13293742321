// SPDX-License-Identifier: MIT
//
// bandlimit: a laboratory for procedural noise. This file reads the command line, runs one verb,
// and sees to it that what was printed arrived and that the exit status says what happened.
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/json.h"
#include "core/plain.h"
#include "cli/registries.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "core/file.h"
#include "core/grammar.h"
#include "core/interrupt.h"
#include "sources/source.h"

// Whether a reader that goes away ends the program silently, as it does other filters.
static int pipe_signal_is_default;

// A file opened later must never get the number of a closed standard stream. The stand-ins are open
// the wrong way round, so that using them fails.
static void occupy_standard_streams(void) {
    for (int number = 0; number <= 2; number++)
        if (fcntl(number, F_GETFD) < 0 && errno == EBADF)
            open("/dev/null", number == 0 ? O_WRONLY : O_RDONLY);
}

// A signal that is a program is written to through a pipe; its death must be an error, not ours.
static void ignore_broken_pipes(void) {
    struct sigaction action = {.sa_handler = SIG_IGN}, before;
    sigaction(SIGPIPE, &action, &before);
    pipe_signal_is_default = before.sa_handler == SIG_DFL;
}

// Whether stdout is a pipe that nobody reads any more. A write that failed long ago has left no
// errno.
static int reader_has_gone(void) {
    struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
    return poll(&out, 1, 0) == 1 && out.revents & POLLERR;
}

// Flushes stdout and learns whether all of it was written.
static bl_status finish_stdout(bl_status status, bl_message *message) {
    errno = 0;
    int failed = ferror(stdout);
    if (fflush(stdout) != 0)
        failed = 1;
    if (!failed)
        return status;
    if (pipe_signal_is_default && (errno == EPIPE || reader_has_gone())) {
        signal(SIGPIPE, SIG_DFL);
        raise(SIGPIPE);
    }
    return bl_report(message, BL_DEVICE, "cannot write to standard output: %s",
                     errno ? strerror(errno) : "a write failed");
}

// A verdict has no message; an error has.
static int is_error(const bl_call *call, bl_status status) {
    return status != BL_OK && call->message.text[0];
}

static void print_error_json(const bl_call *call, bl_status status) {
    json_t *object = bl_json_head("error", call->argument_count, call->arguments);
    json_t *error = json_object();
    bl_json_set_count(error, "status", (uint64_t)status);
    bl_json_set_text(error, "word", bl_status_word(status));
    bl_json_set_text(error, "message", call->message.text);
    json_object_set_new(object, "error", error);
    bl_json_print(object, stdout);
    json_decref(object);
}

// The message may quote any bytes that the user gave.
static void print_error(const bl_call *call) {
    fprintf(stderr, "bandlimit%s%s: ", call->verb ? " " : "", call->verb ? call->verb->name : "");
    bl_plain_text(stderr, call->message.text);
    fputc('\n', stderr);
}

// Refuses what cannot be meant, and turns words into values.
static bl_status settle_common(bl_call *call) {
    bl_common *common = &call->common;
    if (common->quick && common->full)
        return bl_report(&call->message, BL_USAGE, "--quick and --full exclude each other");
    call->size = common->quick ? BL_QUICK : common->full ? BL_FULL : BL_NORMAL;
    unsigned long long seed = 1;
    if (common->seed_word && !bl_read_unsigned(common->seed_word, &seed))
        return bl_report(&call->message, BL_USAGE,
                         "--seed %s: not a whole number from 0 to 18446744073709551615",
                         common->seed_word);
    common->seed = seed;
    call->isa = BL_ISA_BEST;
    call->every_isa = call->verb->takes_every_isa && common->isa && strcmp(common->isa, "all") == 0;
    if (call->every_isa)
        return BL_OK;
    return common->isa ? bl_isa_read(common->isa, &call->isa, &call->message) : BL_OK;
}

static bl_status check_operands(bl_call *call) {
    const bl_verb *verb = call->verb;
    if (call->operands.count < verb->least)
        return bl_report(&call->message, BL_USAGE,
                         "%s needs more words: bandlimit %s %s; --help tells what they are",
                         verb->name, verb->name, verb->operands);
    if (call->operands.count > verb->most)
        return bl_report(&call->message, BL_USAGE,
                         "'%s' is one word too many: bandlimit %s %s; --help tells what they are",
                         call->operands.words[verb->most], verb->name, verb->operands);
    return BL_OK;
}

// `-o -` is standard output, which has room for one thing.
static bl_status settle_standard_output(bl_call *call) {
    bl_common *common = &call->common;
    if (!common->output || strcmp(common->output, "-") != 0)
        return BL_OK;
    if (call->verb->output == BL_OUTPUT_FOLDER)
        return bl_report(&call->message, BL_USAGE,
                         "-o -: only reports and CSV go to standard output; name a file or a "
                         "folder (what is called '-' is written ./-)");
    if (call->verb->output == BL_OUTPUT_DATA && common->json)
        return bl_report(&call->message, BL_USAGE,
                         "-o - puts CSV and --json an object on standard output; leave one out");
    if (call->verb->output == BL_OUTPUT_DATA)
        common->quiet = 1; // the data stand where the report would
    else
        common->output = NULL;
    return BL_OK;
}

// Runs the verb with its report going to stdout or to the file of -o.
static bl_status run_verb(bl_call *call) {
    const char *path = call->common.output;
    int data = call->verb->output == BL_OUTPUT_DATA && !(path && bl_ends_with(path, ".json"));
    bl_file file = {0};
    call->out = stdout;
    if (path && (data || call->verb->output == BL_OUTPUT_FOLDER)) {
        bl_status status = data ? bl_output_check(path, &call->message) : BL_OK;
        if (status != BL_OK)
            return status;
        call->path = path;
    } else if (path) {
        bl_status status = bl_file_create(path, &file, &call->message);
        if (status != BL_OK)
            return status;
        call->out = file.stream;
        call->common.json |= bl_ends_with(path, ".json");
    }
    bl_status status = bl_call_complaints(call, call->verb->run(call));
    bl_progress(call, NULL);
    if (call->json && call->warnings)
        json_object_set(call->json, "warnings", call->warnings);
    if (!is_error(call, status) && call->common.json && !bl_json_print(call->json, call->out) &&
        !ferror(call->out))
        status = bl_report(&call->message, BL_DEVICE, "out of memory writing JSON");
    if (!file.stream)
        return status;
    if (is_error(call, status)) {
        bl_file_discard(&file);
        return status;
    }
    bl_status written = bl_file_commit(&file, &call->message);
    return written == BL_OK ? status : written;
}

// A user who types the name of a thing for a verb wants it shown. The name is written as it should
// be in `name`.
static const char *kind_of(const bl_call *call, const char *word, char *name, size_t size) {
    const bl_source *source = bl_source_of(word);
    bl_spec spec;
    const char *kind = NULL;
    snprintf(name, size, "%s", word);
    if (source)
        return source->kind;
    for (char *letter = name; *letter && *letter != ':'; letter++)
        *letter = (char)tolower((unsigned char)*letter);
    if (bl_spec_parse(name, &spec, NULL) != BL_OK)
        return NULL;
    for (const bl_registry *const *registry = call->registries; *registry; registry++)
        if (!kind && *registry != call->verbs && bl_registry_find(*registry, spec.name))
            kind = (*registry)->kind;
    bl_spec_free(&spec);
    return kind;
}

static bl_status report_unknown(bl_call *call, const char *word) {
    char name[512];
    const char *kind = kind_of(call, word, name, sizeof name);
    return kind ? bl_report(&call->message, BL_USAGE,
                            "'%s' is a %s and no verb: try `bandlimit show %s`", name, kind, name)
                : bl_registry_report(call->verbs, word, NULL, &call->message);
}

// The verb: the first word that is no option, or what --help and --version stand for.
static bl_status find_verb(bl_call *call, int count, char **words, int *position) {
    const char *name = call->common.help ? "help" : call->common.version ? "version" : NULL;
    if (!name && *position == count) {
        bl_help_print(stderr, call->verbs, NULL);
        return bl_report(&call->message, BL_USAGE, "no verb given");
    }
    if (!name)
        name = words[(*position)++];
    call->verb = bl_verb_find(name);
    return call->verb ? BL_OK : report_unknown(call, name);
}

// `VERB --help` is `help VERB`.
static bl_status turn_to_help(bl_call *call) {
    call->operands.count = 0;
    if (!bl_words_add(&call->operands, call->verb->name))
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    call->verb = bl_verb_find("help");
    return BL_OK;
}

// Reads the words after the verb, and runs it. `own` is the table of the verb.
static bl_status run_with(bl_call *call, const bl_option_table *own, int count, char **words,
                          int position) {
    const bl_option_table tables[] = {{bl_common_options, &call->common}, *own, {NULL, NULL}};
    int helped = call->common.help;
    bl_status status = bl_options_default(own, &call->message);
    if (status == BL_OK)
        status = bl_options_read(tables, count, words, &position, &call->operands, &call->message);
    if (status == BL_OK && call->common.help && !helped)
        status = turn_to_help(call);
    if (status == BL_OK)
        status = settle_common(call);
    if (status == BL_OK)
        status = check_operands(call);
    call->is_hushed = call->common.quiet;
    if (status == BL_OK)
        status = settle_standard_output(call);
    return status == BL_OK ? run_verb(call) : status;
}

static bl_status run_words(bl_call *call, int count, char **words) {
    const bl_option_table tables[] = {{bl_common_options, &call->common}, {NULL, NULL}};
    int position = 1;
    bl_status status = bl_options_read(tables, count, words, &position, NULL, &call->message);
    if (status == BL_OK)
        status = find_verb(call, count, words, &position);
    if (status != BL_OK)
        return status;
    call->settings = calloc(1, call->verb->settings_size + 1);
    if (!call->settings)
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    const bl_option_table own = {call->verb->options, call->settings};
    status = run_with(call, &own, count, words, position);
    bl_options_free(&own);
    free(call->settings);
    return status;
}

// --json counts even when the words after an error were not read.
static int asks_for_json(int count, char **words) {
    for (int i = 1; i < count && strcmp(words[i], "--") != 0; i++)
        if (strcmp(words[i], "--json") == 0)
            return 1;
    return 0;
}

int main(int count, char **words) {
    occupy_standard_streams();
    ignore_broken_pipes();
    bl_interrupt_install();
    bl_call call = {.verbs = &bl_verbs,
                    .registries = bl_registries,
                    .argument_count = count > 0 ? count - 1 : 0,
                    .arguments = words + 1};
    bl_status status = run_words(&call, count, words);
    int failed = is_error(&call, status);
    if (failed && asks_for_json(count, words))
        print_error_json(&call, status);
    bl_message message = call.message;
    bl_status last = finish_stdout(status, &message);
    if (failed)
        print_error(&call);
    if (last != status) {
        if (!failed)
            fprintf(stderr, "bandlimit: %s\n", message.text);
        status = failed ? status : last;
    }
    bl_call_unwatch(&call);
    json_decref(call.json);
    json_decref(call.warnings);
    bl_words_free(&call.operands);
    return (int)status;
}
