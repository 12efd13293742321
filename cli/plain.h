// SPDX-License-Identifier: MIT
//
// What a terminal is shown: text of the user's without control bytes, numbers that may be missing,
// amounts of memory.
#ifndef BL_CLI_PLAIN_H
#define BL_CLI_PLAIN_H

#include <stdio.h>

#include "core/statistics.h"

// Prints text with every byte that a terminal would obey, or that is not UTF-8, as \xNN.
void bl_plain_text(FILE *out, const char *text);

// Prints a number with so many digits; "not known" if it is not finite. -0 is 0.
void bl_plain_number(FILE *out, double number, int digits);

// Prints the value and, where both are known, the limits: "0.1   95 % interval 0.09 to 0.11".
void bl_plain_estimate(FILE *out, const bl_estimate *estimate, double level, int digits);

// "8.0 GB", "512 bytes": memory in powers of ten.
typedef struct bl_plain_size {
    char text[32];
} bl_plain_size;
bl_plain_size bl_plain_bytes(double bytes);

// "1 sample", "2 samples": the ending of a plural.
const char *bl_plural(size_t count);

#endif
