// SPDX-License-Identifier: MIT
#include "core/plain.h"

#include <math.h>
#include <string.h>

// Bytes of the UTF-8 letter at `at` if a terminal only shows it; 0 for a control character (C0,
// delete, C1) and for what is not UTF-8.
static size_t letter_length(const unsigned char *at) {
    if (at[0] < 0x80)
        return at[0] >= 0x20 && at[0] != 0x7f;
    size_t length = at[0] < 0xc2 ? 0 : at[0] < 0xe0 ? 2 : at[0] < 0xf0 ? 3 : at[0] < 0xf5 ? 4 : 0;
    for (size_t i = 1; i < length; i++)
        if ((at[i] & 0xc0) != 0x80) // the zero at the end of the text too, so nothing is overrun
            return 0;
    return at[0] == 0xc2 && at[1] < 0xa0 ? 0 : length;
}

static void put_letters(FILE *out, const char *text, const char *end) {
    for (const unsigned char *at = (const unsigned char *)text; at < (const unsigned char *)end;) {
        size_t length = letter_length(at);
        if (length)
            fwrite(at, 1, length, out);
        else
            fprintf(out, "\\x%02x", *at);
        at += length ? length : 1;
    }
}

static size_t count_columns(const char *text, const char *end) {
    size_t columns = 0;
    for (const unsigned char *at = (const unsigned char *)text; at < (const unsigned char *)end;) {
        size_t length = letter_length(at);
        columns += length ? 1 : 4; // \xNN
        at += length ? length : 1;
    }
    return columns;
}

void bl_plain_text(FILE *out, const char *text) {
    put_letters(out, text, text + strlen(text));
}

size_t bl_plain_width(const char *text) {
    return count_columns(text, text + strlen(text));
}

size_t bl_plain_wrap(FILE *out, const char *text, size_t column, size_t indent, size_t width) {
    for (size_t length; text += strspn(text, " "), length = strcspn(text, " "), length;
         text += length) {
        size_t columns = count_columns(text, text + length);
        if (column > indent && column + 1 + columns > width) {
            fprintf(out, "\n%*s", (int)indent, "");
            column = indent;
        } else if (column > indent) {
            fputc(' ', out);
            column++;
        }
        put_letters(out, text, text + length);
        column += columns;
    }
    return column;
}

const char *bl_plain_colour(bl_verdict verdict, int coloured) {
    static const char *const colours[] = {[BL_VERDICT_PASS] = "\033[32m",
                                          [BL_VERDICT_INCONCLUSIVE] = "\033[33m",
                                          [BL_VERDICT_FAIL] = "\033[31m",
                                          [BL_VERDICT_NOT_RUN] = ""};
    return coloured ? colours[verdict] : "";
}

const char *bl_plain_end(int coloured) {
    return coloured ? "\033[0m" : "";
}

void bl_plain_number(FILE *out, double number, int digits) {
    if (isfinite(number))
        fprintf(out, "%.*g", digits, number + 0.0); // -0 + 0 is 0
    else
        fputs("not known", out);
}

bl_plain_size bl_plain_bytes(double bytes) {
    static const char *const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    size_t last = sizeof units / sizeof *units - 1, unit = 0;
    bl_plain_size size;
    for (; bytes >= 1000 && unit < last; unit++)
        bytes /= 1000;
    snprintf(size.text, sizeof size.text, "%.*f %s", unit > 0, bytes, units[unit]);
    return size;
}

const char *bl_plural(size_t count) {
    return count == 1 ? "" : "s";
}
