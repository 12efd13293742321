// SPDX-License-Identifier: MIT
//
// The grammar that names a signal everywhere: `name:key=value,key=value`.
//
// The name ends at the first colon; a value may hold further colons (kernel=table:100). A comma
// begins the next setting, except before a bare number, which continues a list (period=4,8,16). A
// signal within a signal has its settings under dotted keys: basis=gnoise,basis.fade=quintic. A
// parse error names the word, its column (from 1), and the nearest valid word.
#ifndef BL_CORE_GRAMMAR_H
#define BL_CORE_GRAMMAR_H

#include <stddef.h>

#include "core/status.h"

typedef struct bl_setting {
    char *key;
    char *value;
    size_t key_column; // from 1, in the whole text
    size_t value_column;
} bl_setting;

typedef struct bl_spec {
    char *name;
    bl_setting *settings;
    size_t count;
} bl_spec;

// Splits the text; on success the caller frees the spec with bl_spec_free.
bl_status bl_spec_parse(const char *text, bl_spec *spec, bl_message *message);
void bl_spec_free(bl_spec *spec);

// The value of a key, dotted for that of a signal within (basis.basis.fade); NULL if not set.
const char *bl_spec_get(const bl_spec *spec, const char *key);
// Sets a key to a value, in its place or at the end; the columns are then those of no text. Errors:
// BL_DEVICE out of memory.
bl_status bl_spec_set(bl_spec *spec, const char *key, const char *value, bl_message *message);
// Adds a signal within: key=NAME, and each of the settings of its text as key.KEY=VALUE, at the
// end. Errors: BL_USAGE for a text that cannot be read, BL_DEVICE out of memory; what was added
// before stays.
bl_status bl_spec_nest(bl_spec *spec, const char *key, const char *nested, bl_message *message);
// The text of a spec, which the caller frees; NULL if out of memory.
char *bl_spec_text(const bl_spec *spec);

// The text with key=value in it, which the caller frees: what all changes of settings are made by.
// The signal that is opened by it has the canonical text. Errors: BL_USAGE for a text that cannot
// be read, BL_DEVICE out of memory.
bl_status bl_text_set(const char *text, const char *key, const char *value, char **changed,
                      bl_message *message);
// The same with a signal within (bl_spec_nest), and without the key.
bl_status bl_text_nest(const char *text, const char *key, const char *nested, char **changed,
                       bl_message *message);
bl_status bl_text_drop(const char *text, const char *key, char **changed, bl_message *message);

// The kinds of value a parameter takes, and the C type that stands at its offset.
typedef enum bl_parameter_kind {
    BL_SEED,    // uint64_t, decimal or 0x hexadecimal
    BL_INTEGER, // uint32_t in [minimum, maximum]
    BL_REAL,    // double in [minimum, maximum]; a fraction as 1/16 is read too, and where the
                // maximum is INFINITY the words inf and infinity
    BL_CHOICE,  // uint32_t, the index in choices; a choice "table:N" is followed by a number
    BL_LIST,    // uint32_t[BL_LIST_SIZE] in [minimum, maximum], one an axis; a single number stands
                // for all, and numbers left out at the end are 0
    BL_TEXT,    // char[BL_TEXT_SIZE], a word of the user's: a path
    BL_NESTED   // char[BL_TEXT_SIZE], the text of another signal, made of key=NAME and all key.*
} bl_parameter_kind;

enum { BL_LIST_SIZE = 4, BL_TEXT_SIZE = 512 };

// As in {"size", BL_INTEGER, offsetof(block, size), "8", "cells", .minimum = 1, .maximum = 99,
// .help = "of a side"}.
typedef struct bl_parameter {
    const char *key; // NULL ends a list
    bl_parameter_kind kind;
    size_t offset;               // in the parameter block
    const char *fallback;        // the default, as text
    const char *unit;            // "" if none
    double minimum, maximum;     // BL_INTEGER, BL_REAL, BL_LIST, and the N of a choice; inclusive
    const char *const *choices;  // BL_CHOICE: the words, NULL at the end; BL_TEXT: some of them
    size_t number_offset;        // BL_CHOICE with ":N": where the uint32_t N stands
    const char *const *examples; // optional: values that the tests try besides; NULL at the end
    const char *help;            // one line
} bl_parameter;

// Fills a parameter block with the defaults, then with the settings of the spec. Every setting
// must be in the list, once. `text` is the whole text for messages. Errors: BL_USAGE for an unknown
// or repeated key and for a value that is not of its kind or out of range. Thread-safe.
bl_status bl_parameters_read(const bl_parameter *parameters, const bl_spec *spec, const char *text,
                             void *block, bl_message *message);

// Turns a message about a nested signal, as its opening gave it, into one about the whole text: the
// key with what stands before its dot, and the column that it has there. Other messages stay.
void bl_parameters_place(const bl_parameter *parameters, const bl_spec *spec, const char *text,
                         const void *block, bl_message *message);

// The canonical text: the name and every setting that differs from its default, in the order of
// the list. The caller frees it; NULL if out of memory.
char *bl_parameters_text(const char *name, const bl_parameter *parameters, const void *block);

// Reads a whole word as a number: false on trailing letters, on nothing, and out of range.
// bl_read_real takes 1/16 as a fraction, and neither NaN nor infinity.
int bl_read_unsigned(const char *word, unsigned long long *out);
// The same, or a whole number up to 2^53 written as 1e6.
int bl_read_count(const char *word, unsigned long long *out);
int bl_read_real(const char *word, double *out);

#endif
