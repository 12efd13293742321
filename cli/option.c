// SPDX-License-Identifier: MIT
#include "cli/option.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grammar.h"
#include "core/registry.h"

int bl_words_add(bl_words *words, const char *word) {
    const char **more = realloc(words->words, (words->count + 1) * sizeof *more);
    if (!more)
        return 0;
    words->words = more;
    words->words[words->count++] = word;
    return 1;
}

void bl_words_free(bl_words *words) {
    free(words->words);
    *words = (bl_words){0};
}

// Whole numbers in messages look as they are typed; large limits are powers of two.
static bl_status report_range(const bl_option *option, const char *word, bl_message *message) {
    int whole = option->kind == BL_OPTION_UNSIGNED;
    return bl_report(message, BL_USAGE,
                     whole ? "--%s %s: out of range; use a number from %.0f to %.0f"
                           : "--%s %s: out of range; use a number from %.10g to %.10g",
                     option->name, word, option->minimum, option->maximum);
}

static bl_status read_unsigned(const bl_option *option, const char *word, uint64_t *out,
                               bl_message *message) {
    unsigned long long number;
    if (!bl_read_count(word, &number))
        return bl_report(message, BL_USAGE,
                         "--%s %s: not a whole number from %.0f to %.0f; write it as 4096 or 1e6",
                         option->name, word, option->minimum, option->maximum);
    if ((double)number < option->minimum ||
        ((double)number > option->maximum && option->maximum > 0))
        return report_range(option, word, message);
    *out = number;
    return BL_OK;
}

static bl_status read_real(const bl_option *option, const char *word, double *out,
                           bl_message *message) {
    double number;
    if (!bl_read_real(word, &number))
        return bl_report(message, BL_USAGE,
                         "--%s %s: not a finite number; write it as 0.25, 1e-3 or 1/16",
                         option->name, word);
    if (!(number >= option->minimum && number <= option->maximum))
        return report_range(option, word, message);
    *out = number;
    return BL_OK;
}

static bl_status read_choice(const bl_option *option, const char *word, const char **out,
                             bl_message *message) {
    for (size_t i = 0; option->choices[i]; i++)
        if (strcmp(option->choices[i], word) == 0) {
            *out = option->choices[i];
            return BL_OK;
        }
    char key[64];
    snprintf(key, sizeof key, "--%s", option->name);
    const bl_unknown unknown = {
        .what = "value", .word = word, .key = key, .words = option->choices};
    return bl_report_unknown(&unknown, message);
}

static bl_status set_option(const bl_option *option, void *block, const char *word,
                            bl_message *message) {
    void *at = (char *)block + option->offset;
    switch (option->kind) {
    case BL_OPTION_FLAG:
        *(int *)at = 1;
        return BL_OK;
    case BL_OPTION_WORD:
        *(const char **)at = word;
        return BL_OK;
    case BL_OPTION_WORDS:
        return bl_words_add(at, word) ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    case BL_OPTION_UNSIGNED:
        return read_unsigned(option, word, at, message);
    case BL_OPTION_REAL:
        return read_real(option, word, at, message);
    case BL_OPTION_CHOICE:
        return read_choice(option, word, at, message);
    }
    return BL_OK;
}

bl_status bl_options_default(const bl_option_table *table, bl_message *message) {
    for (const bl_option *option = table->options; option->name; option++) {
        if (!option->fallback || option->kind == BL_OPTION_WORDS)
            continue;
        bl_status status = set_option(option, table->block, option->fallback, message);
        if (status != BL_OK)
            return status;
    }
    return BL_OK;
}

void bl_options_free(const bl_option_table *table) {
    for (const bl_option *option = table->options; option->name; option++)
        if (option->kind == BL_OPTION_WORDS)
            bl_words_free((bl_words *)((char *)table->block + option->offset));
}

// A negative number is an operand, not an option; so are the words that strtod takes for one.
static int is_option(const char *word) {
    if (word[0] != '-' || word[1] == '\0')
        return 0;
    char *end;
    strtod(word, &end);
    return end == word;
}

static int is_named(const char *own, const char *name, size_t length) {
    return own && strlen(own) == length && strncmp(own, name, length) == 0;
}

static const bl_option *find(const bl_option_table *tables, const char *name, size_t length,
                             char letter, void **block) {
    for (; tables->options; tables++)
        for (const bl_option *option = tables->options; option->name; option++)
            if (letter ? option->letter == letter
                       : is_named(option->name, name, length) ||
                             is_named(option->also, name, length)) {
                *block = tables->block;
                return option;
            }
    return NULL;
}

static bl_status report_unknown(const bl_option_table *tables, const char *word,
                                bl_message *message) {
    enum { OPTIONS_MOST = 64 };
    char dashed[OPTIONS_MOST][32], name[64];
    const char *words[OPTIONS_MOST + 1] = {NULL};
    size_t count = 0;
    for (; tables->options; tables++)
        for (const bl_option *option = tables->options; option->name; option++)
            for (int also = 0; also < 2 && count < OPTIONS_MOST; also++) {
                const char *one = also ? option->also : option->name;
                if (!one)
                    continue;
                snprintf(dashed[count], sizeof dashed[count], "--%s", one);
                words[count] = dashed[count];
                count++;
            }
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
    const bl_unknown unknown = {
        .what = "option", .word = name, .words = words, .all = "--help lists all"};
    return bl_report_unknown(&unknown, message);
}

// Reads one option, and its value from the same word or from the next.
static bl_status read_option(const bl_option_table *tables, int count, char **words, int *position,
                             bl_message *message) {
    const char *word = words[(*position)++];
    int is_long = word[1] == '-';
    const char *name = word + (is_long ? 2 : 1);
    size_t length = is_long ? strcspn(name, "=") : 1;
    void *block;
    const bl_option *option = find(tables, name, length, is_long ? '\0' : name[0], &block);
    if (!option || (!is_long && option->kind == BL_OPTION_FLAG && name[1]))
        return report_unknown(tables, word, message);
    const char *value = name[length] ? name + length + (is_long ? 1 : 0) : NULL;
    if (option->kind == BL_OPTION_FLAG && value)
        return bl_report(message, BL_USAGE, "%s: --%s takes no value; leave '=%s' out", word,
                         option->name, value);
    if (option->kind == BL_OPTION_FLAG)
        return set_option(option, block, NULL, message);
    if (!value && *position < count && strncmp(words[*position], "--", 2) != 0)
        value = words[(*position)++];
    if (!value)
        return bl_report(message, BL_USAGE, "%s needs a value: %s %s", word, word, option->value);
    if (*value == '\0')
        return bl_report(message, BL_USAGE, "%s: the value is empty; write %s %s", word, word,
                         option->value);
    return set_option(option, block, value, message);
}

bl_status bl_options_read(const bl_option_table *tables, int count, char **words, int *position,
                          bl_words *operands, bl_message *message) {
    int ended = 0;
    while (*position < count) {
        const char *word = words[*position];
        if (!ended && strcmp(word, "--") == 0) {
            ended = 1;
            ++*position;
        } else if (!ended && is_option(word)) {
            bl_status status = read_option(tables, count, words, position, message);
            if (status != BL_OK)
                return status;
        } else if (!operands) {
            return BL_OK;
        } else {
            if (!bl_words_add(operands, word))
                return bl_report(message, BL_DEVICE, "out of memory");
            ++*position;
        }
    }
    return BL_OK;
}
