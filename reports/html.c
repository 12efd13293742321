// SPDX-License-Identifier: MIT
#include "reports/html.h"

void bl_html_text(FILE *out, const char *text) {
    for (; *text; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(*text, out);
        }
    }
}

void bl_html_tagged(FILE *out, const char *open, const char *text, const char *close) {
    fputs(open, out);
    bl_html_text(out, text);
    fputs(close, out);
}
