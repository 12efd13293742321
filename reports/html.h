// SPDX-License-Identifier: MIT
//
// Pieces of the HTML pages: text made safe, tables, and the style sheet that they share.
#ifndef BL_REPORTS_HTML_H
#define BL_REPORTS_HTML_H

#include <stdio.h>

#include "core/table.h"

extern const char *const bl_page_style; // the style sheet

// Text for an element or for an attribute in double quotes.
void bl_html_text(FILE *out, const char *text);
// `open` and `close` unchanged, the text between them made safe.
void bl_html_tagged(FILE *out, const char *open, const char *text, const char *close);

// A table with the words that a terminal shows; `class` names its style.
void bl_table_html(const bl_table *table, const char *class, FILE *out);

#endif
