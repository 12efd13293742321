// SPDX-License-Identifier: MIT
#include "sources/command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char mark[] = "{seed}";
static const char blanks[] = " \t\r\n";

void bl_command_free(char **words) {
    for (char **word = words; word && *word; word++)
        free(*word);
    free(words);
}

// Copies one word without its quotes and moves *at behind it. False if a quote has no end. A word
// is never longer than what it is made of.
static int take_word(const char **at, char *out) {
    const char *c = *at;
    char quote = '\0';
    for (; *c && (quote || !strchr(blanks, *c)); c++) {
        if (quote == '\0' && (*c == '\'' || *c == '"')) {
            quote = *c;
        } else if (quote && *c == quote) {
            quote = '\0';
        } else if (*c == '\\' && c[1] && quote != '\'' &&
                   (quote == '\0' || c[1] == '"' || c[1] == '\\')) {
            *out++ = *++c;
        } else {
            *out++ = *c;
        }
    }
    *out = '\0';
    *at = c;
    return quote == '\0';
}

bl_status bl_command_read(const char *text, const char *command, char ***words,
                          bl_message *message) {
    size_t length = strlen(command), count = 0;
    char **list = calloc(length / 2 + 2, sizeof *list), *room = malloc(length + 1);
    bl_status status = list && room ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    const char *at = command + strspn(command, blanks);
    while (status == BL_OK && *at) {
        const char *start = at;
        if (!take_word(&at, room))
            status = bl_report(message, BL_USAGE, "column %zu of '%s': a quote without its end",
                               (size_t)(start - text) + 1, text);
        else if (!(list[count++] = strdup(room)))
            status = bl_report(message, BL_DEVICE, "out of memory");
        at += strspn(at, blanks);
    }
    if (status == BL_OK && (count == 0 || !*list[0]))
        status = bl_report(message, BL_USAGE,
                           "'%s' names no program; it reads cmd:PROGRAM WORDS or "
                           "cmd,key=value:PROGRAM WORDS",
                           text);
    free(room);
    if (status == BL_OK)
        *words = list;
    else
        bl_command_free(list);
    return status;
}

int bl_command_has_seed(char *const *words) {
    for (; *words; words++)
        if (strstr(*words, mark))
            return 1;
    return 0;
}

static char *word_with_seed(const char *word, const char *seed) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    for (const char *found; (found = strstr(word, mark)); word = found + strlen(mark))
        fprintf(stream, "%.*s%s", (int)(found - word), word, seed);
    fputs(word, stream);
    if (fclose(stream) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

char **bl_command_with_seed(char *const *words, uint64_t seed) {
    char number[24];
    size_t count = 0;
    snprintf(number, sizeof number, "%" PRIu64, seed);
    while (words[count])
        count++;
    char **list = calloc(count + 1, sizeof *list);
    for (size_t i = 0; list && i < count; i++)
        if (!(list[i] = word_with_seed(words[i], number))) {
            bl_command_free(list);
            return NULL;
        }
    return list;
}
