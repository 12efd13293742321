// SPDX-License-Identifier: MIT
#include "cli/csv.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

bl_status bl_csv_open(bl_call *call, bl_file *file) {
    if (strcmp(call->path, "-") != 0)
        return bl_file_create(call->path, file, &call->message);
    *file = (bl_file){.stream = call->out};
    return BL_OK;
}

bl_status bl_csv_close(bl_call *call, bl_file *file) {
    return file->path ? bl_file_commit(file, &call->message) : BL_OK;
}

void bl_csv_comment(FILE *out, const char *name, const char *value) {
    fprintf(out, "# %s: ", name);
    for (; *value; value++)
        fputc(iscntrl((unsigned char)*value) ? '?' : *value, out);
    fputc('\n', out);
}

void bl_csv_number(FILE *out, double number, char end) {
    if (isfinite(number))
        fprintf(out, "%.9g", number);
    fputc(end, out);
}

void bl_csv_word(FILE *out, const char *word, char end) {
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
    fputc(end, out);
}
