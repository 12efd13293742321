// SPDX-License-Identifier: MIT
//
// What a terminal is shown: text of the user's without control bytes, numbers that may be missing,
// amounts of memory.
#ifndef BL_CORE_PLAIN_H
#define BL_CORE_PLAIN_H

#include <stddef.h>
#include <stdio.h>

#include "core/verdict.h"

// Prints text with every byte that a terminal would obey, or that is not UTF-8, as \xNN.
void bl_plain_text(FILE *out, const char *text);
// The columns that it takes: a letter of UTF-8 takes one.
size_t bl_plain_width(const char *text);

// Prints text in lines of at most `width` columns, broken at blanks; the first begins at `column`,
// the others behind `indent` blanks. Returns the column after the last letter.
size_t bl_plain_wrap(FILE *out, const char *text, size_t column, size_t indent, size_t width);

// What colours the words after it by a verdict, and what ends that; "" without colours.
const char *bl_plain_colour(bl_verdict verdict, int coloured);
const char *bl_plain_end(int coloured);

// Prints a number with so many digits; "not known" if it is not finite. -0 is 0.
void bl_plain_number(FILE *out, double number, int digits);

// "8.0 GB", "512 bytes": memory in powers of ten.
typedef struct bl_plain_size {
    char text[32];
} bl_plain_size;
bl_plain_size bl_plain_bytes(double bytes);

// "1 sample", "2 samples": the ending of a plural.
const char *bl_plural(size_t count);

#endif
