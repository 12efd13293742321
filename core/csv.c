// SPDX-License-Identifier: MIT
#include "core/csv.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

void bl_csv_comment(FILE *out, const char *name, const char *value) {
    fprintf(out, "# %s: ", name);
    for (; *value; value++)
        fputc(iscntrl((unsigned char)*value) ? '?' : *value, out);
    fputc('\n', out);
}

void bl_csv_number(FILE *out, double number) {
    if (isfinite(number))
        fprintf(out, "%.9g", number);
}

void bl_csv_word(FILE *out, const char *word) {
    int quoted = word[strcspn(word, "\",\r\n")] != '\0';
    if (quoted)
        fputc('"', out);
    for (; *word; word++) {
        if (*word == '"')
            fputc('"', out);
        fputc(*word, out);
    }
    if (quoted)
        fputc('"', out);
}
