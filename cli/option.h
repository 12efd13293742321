// SPDX-License-Identifier: MIT
//
// Options of the command line: one table drives the parser, the help and the tests.
//
// An option is `--name VALUE`, `--name=VALUE`, `-l VALUE` or `-lVALUE`; a flag has no value.
// Options and operands mix freely, `--` ends the options, and a word that is a number (-1.5, -inf)
// is an operand. The last of two equal options wins; a BL_OPTION_WORDS option gathers all.
#ifndef BL_CLI_OPTION_H
#define BL_CLI_OPTION_H

#include <stddef.h>
#include <stdint.h>

#include "core/status.h"

typedef enum bl_option_kind {
    BL_OPTION_FLAG,     // int
    BL_OPTION_WORD,     // const char *, read by the verb
    BL_OPTION_WORDS,    // bl_words
    BL_OPTION_UNSIGNED, // uint64_t in [minimum, maximum]
    BL_OPTION_REAL,     // double in [minimum, maximum]
    BL_OPTION_CHOICE    // const char *, one of the choices
} bl_option_kind;

// A growing list of words; the words are not owned.
typedef struct bl_words {
    const char **words;
    size_t count;
} bl_words;

// As in {"size", BL_OPTION_UNSIGNED, AT(size), "N", .minimum = 2, .maximum = 99, .help = "pixels"}.
typedef struct bl_option {
    const char *name; // without dashes; NULL ends a table
    bl_option_kind kind;
    size_t offset;        // in the block of settings
    const char *value;    // what the help calls the value: "N", "PATH"
    const char *also;     // a second name; NULL: none
    char letter;          // 0: none
    const char *fallback; // the default as text, read like a user's; NULL: zero
    double minimum, maximum;
    const char *const *choices;
    const char *help;
} bl_option;

// A table and the block it fills.
typedef struct bl_option_table {
    const bl_option *options;
    void *block;
} bl_option_table;

// Writes the defaults of a table into its block.
bl_status bl_options_default(const bl_option_table *table, bl_message *message);

// Reads words from *position on into the blocks of `tables` (ended by one without options).
// Operands are appended to `operands`; with `operands` NULL reading stops at the first one.
bl_status bl_options_read(const bl_option_table *tables, int count, char **words, int *position,
                          bl_words *operands, bl_message *message);

// Releases the lists of words in the block.
void bl_options_free(const bl_option_table *table);

// False if out of memory.
int bl_words_add(bl_words *words, const char *word);
void bl_words_free(bl_words *words);

#endif
