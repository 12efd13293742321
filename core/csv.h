// SPDX-License-Identifier: MIT
//
// Pieces of a data file: comments on lines of their own, numbers with empty fields for what is not
// finite, words quoted where RFC 4180 asks for it. Tables are written by core/table.h.
#ifndef BL_CORE_CSV_H
#define BL_CORE_CSV_H

#include <stdio.h>

// "# name: value", with control characters replaced so that it stays one line.
void bl_csv_comment(FILE *out, const char *name, const char *value);
// A number with 9 significant digits, or nothing.
void bl_csv_number(FILE *out, double number);
void bl_csv_word(FILE *out, const char *word);

#endif
