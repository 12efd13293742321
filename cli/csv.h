// SPDX-License-Identifier: MIT
//
// Pieces of a data file: comments on lines of their own, numbers with empty fields for what is not
// finite, words quoted where RFC 4180 asks for it.
#ifndef BL_CLI_CSV_H
#define BL_CLI_CSV_H

#include <stdio.h>

#include "cli/verb.h"
#include "core/file.h"

// Opens call->path for data, which "-" makes standard output. End with bl_csv_close.
bl_status bl_csv_open(bl_call *call, bl_file *file);
// Commits the file.
bl_status bl_csv_close(bl_call *call, bl_file *file);

// "# name: value", with control characters replaced so that it stays one line.
void bl_csv_comment(FILE *out, const char *name, const char *value);
// A number with 9 significant digits, or nothing; then `end`, a comma or a line feed.
void bl_csv_number(FILE *out, double number, char end);
void bl_csv_word(FILE *out, const char *word, char end);

#endif
