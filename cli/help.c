// SPDX-License-Identifier: MIT
//
// The verb `help`: what the tables of verbs and options say, as text or as JSON.
#include <ctype.h>
#include <string.h>

#include "cli/json.h"
#include "cli/verb.h"

enum { LINE_WIDTH = 80, HELP_COLUMN = 22 };

// Prints words from `column` on, filled to the width, the first line starting at `at`.
static void print_filled(FILE *out, const char *text, size_t at, size_t column) {
    while (*text) {
        size_t length = strcspn(text, " \n");
        if (at > column && at + 1 + length > LINE_WIDTH) {
            fprintf(out, "\n%*s", (int)column, "");
            at = column;
        } else if (at > column) {
            fputc(' ', out);
            at++;
        }
        fwrite(text, 1, length, out);
        at += length;
        text += length;
        if (*text == '\n') { // a line feed in a help text is kept
            fprintf(out, "\n%*s", text[1] && text[1] != '\n' ? (int)column : 0, "");
            at = column;
        }
        text += *text != '\0';
    }
    fputc('\n', out);
}

// The help of an option with its range, choices, default and second name.
static void describe(const bl_option *option, const char *help, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "%s", help);
    if (option->kind == BL_OPTION_CHOICE) {
        for (size_t i = 0; option->choices[i] && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : ": ",
                                     option->choices[i]);
    }
    int ranged = option->kind == BL_OPTION_UNSIGNED || option->kind == BL_OPTION_REAL;
    if (ranged && used < size)
        used += (size_t)snprintf(text + used, size - used, "; from %.10g to %.10g", option->minimum,
                                 option->maximum);
    if (option->fallback && used < size)
        used += (size_t)snprintf(text + used, size - used, " (default: %s)", option->fallback);
    if (option->also && used < size)
        snprintf(text + used, size - used, "; --%s is the same", option->also);
}

static void print_option(FILE *out, const bl_option *option, const char *help) {
    char name[64], text[1024];
    int length =
        snprintf(name, sizeof name, "  %c%c%s--%s%s%s", option->letter ? '-' : ' ',
                 option->letter ? option->letter : ' ', option->letter ? ", " : "  ", option->name,
                 option->value ? " " : "", option->value ? option->value : "");
    describe(option, help, text, sizeof text);
    fputs(name, out);
    size_t at = (size_t)length;
    if (at + 2 > HELP_COLUMN) {
        fputc('\n', out);
        at = 0;
    }
    fprintf(out, "%*s", (int)(HELP_COLUMN - at), "");
    print_filled(out, text, HELP_COLUMN, HELP_COLUMN);
}

static const char *help_of(const bl_option *option, const bl_verb *verb) {
    return verb && verb->output_help && strcmp(option->name, "output") == 0 ? verb->output_help
                                                                            : option->help;
}

static void print_verb(FILE *out, const bl_verb *verb) {
    fprintf(out, "usage: bandlimit %s%s%s [options]\n\n", verb->name, *verb->operands ? " " : "",
            verb->operands);
    fprintf(out, "%c%s.\n", toupper((unsigned char)verb->summary[0]), verb->summary + 1);
    if (verb->text) {
        fputc('\n', out);
        print_filled(out, verb->text, 0, 0);
    }
    if (verb->options->name)
        fputs("\noptions:\n", out);
    for (const bl_option *option = verb->options; option->name; option++)
        print_option(out, option, option->help);
    fputs("\ncommon options:\n", out);
    for (const bl_option *option = bl_common_options; option->name; option++)
        print_option(out, option, help_of(option, verb));
}

static void print_program(FILE *out, const bl_registry *verbs) {
    fputs(
        "usage: bandlimit VERB [words] [options]\n\n"
        "Measures procedural noise: spectra, histograms, band limits, cost.\n\nverbs:\n",
        out);
    for (size_t i = 0; i < verbs->count; i++) {
        const bl_verb *verb = bl_registry_at(verbs, i);
        fprintf(out, "  %-11s", verb->name);
        print_filled(out, verb->summary, 13, 13);
    }
    fputs("\ncommon options:\n", out);
    for (const bl_option *option = bl_common_options; option->name; option++)
        print_option(out, option, option->help);
    fputs(
        "\n"
        "A SIGNAL is a noise and its settings, as gnoise:seed=7; an image or volume, as\n"
        "grain.exr:spacing=0.0625; or your own noise, a function as ./mine.so:noise or a\n"
        "program as 'cmd:./noise.py {seed}'. `bandlimit list` shows what there is and\n"
        "`bandlimit show NAME` what a noise is and takes. Coordinates are in lattice\n"
        "cells, frequencies in cycles per cell.\n\n"
        "Exit status: 0 pass, 1 inconclusive, 2 fail, 3 inputs that do not fit together,\n"
        "4 file or device error, 64 bad usage.\n\n"
        "`bandlimit VERB --help` tells all about a verb.\n",
        out);
}

void bl_help_print(FILE *out, const bl_registry *verbs, const bl_verb *verb) {
    if (verb)
        print_verb(out, verb);
    else
        print_program(out, verbs);
}

static json_t *options_json(const bl_option *options, const bl_verb *verb) {
    json_t *list = json_array();
    for (const bl_option *option = options; option->name; option++) {
        json_t *entry = json_object();
        char letter[2] = {option->letter, '\0'};
        bl_json_set_text(entry, "name", option->name);
        bl_json_set_text(entry, "also", option->also);
        bl_json_set_text(entry, "letter", option->letter ? letter : NULL);
        bl_json_set_text(entry, "value", option->value);
        bl_json_set_text(entry, "default", option->fallback);
        if (option->choices)
            json_object_set_new(entry, "choices", bl_json_texts(option->choices, SIZE_MAX));
        bl_json_set_text(entry, "help", help_of(option, verb));
        json_array_append_new(list, entry);
    }
    return list;
}

static json_t *verb_json(const bl_verb *verb) {
    json_t *entry = json_object();
    bl_json_set_text(entry, "name", verb->name);
    bl_json_set_text(entry, "operands", verb->operands);
    bl_json_set_text(entry, "summary", verb->summary);
    bl_json_set_text(entry, "text", verb->text);
    json_object_set_new(entry, "options", options_json(verb->options, verb));
    return entry;
}

static bl_status run_help(bl_call *call) {
    const char *word = call->operands.count ? call->operands.words[0] : NULL;
    const bl_verb *verb = word ? bl_registry_find(call->verbs, word) : NULL;
    if (word && !verb)
        return bl_registry_report(call->verbs, word, NULL, &call->message);
    json_t *object = bl_json_start(call);
    if (!object) {
        bl_help_print(call->out, call->verbs, verb);
        return BL_OK;
    }
    json_t *verbs = json_array();
    for (size_t i = 0; i < call->verbs->count; i++)
        if (!verb || verb == bl_registry_at(call->verbs, i))
            json_array_append_new(verbs, verb_json(bl_registry_at(call->verbs, i)));
    json_object_set_new(object, "verbs", verbs);
    json_object_set_new(object, "common_options", options_json(bl_common_options, verb));
    return BL_OK;
}

const bl_verb bl_verb_help = {
    .name = "help",
    .operands = "[VERB]",
    .summary = "what the program or a verb does, and its options",
    .most = 1,
    .options = bl_no_options,
    .run = run_help,
};
