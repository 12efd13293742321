// SPDX-License-Identifier: MIT
//
// Tables for a page. A narrow screen shows each cell on a line of its own behind its label.
#include "reports/html.h"

static void put_heading(FILE *out, const char *heading, const char *unit) {
    bl_html_tagged(out, "<th>", heading, unit ? ", " : "");
    bl_html_tagged(out, "", unit ? unit : "", "</th>");
}

static void put_entry(FILE *out, const char *heading, const char *text) {
    bl_html_tagged(out, "<td data-label=\"", heading, "\">");
    bl_html_tagged(out, "", text, "</td>");
}

static void put_head(FILE *out, const bl_table *table) {
    fputs("<thead><tr>", out);
    for (const bl_field *field = table->fields; field->key; field++) {
        char text[64];
        if (!bl_field_is_told(table, field, BL_IN_TEXT))
            continue;
        put_heading(out, field->heading, field->unit);
        const char *limits = bl_field_limits_heading(table, field, text);
        if (limits)
            put_heading(out, limits, NULL);
    }
    fputs("</tr></thead>\n<tbody>\n", out);
}

void bl_table_html(const bl_table *table, const char *class, FILE *out) {
    bl_html_tagged(out, "<table class=\"", class, "\">");
    put_head(out, table);
    for (size_t row = 0; row < table->count; row++) {
        fputs("<tr>", out);
        for (const bl_field *field = table->fields; field->key; field++) {
            char text[64];
            bl_cell cell;
            bl_cell_find(table, field, row, &cell);
            if (!bl_field_is_told(table, field, BL_IN_TEXT))
                continue;
            put_entry(out, field->heading, bl_cell_text(field, &cell));
            const char *limits = bl_field_limits_heading(table, field, text);
            if (limits)
                put_entry(out, limits, bl_cell_limits_text(field, &cell));
        }
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table>\n", out);
}
