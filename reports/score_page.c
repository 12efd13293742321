// SPDX-License-Identifier: MIT
//
// The page: the table, then for each signal what was found and the numbers behind it.
#include "reports/score_page.h"

#include "core/file.h"
#include "core/version.h"
#include "reports/html.h"

// The table is wider than the text of a page, and scrolls on a narrow screen.
static const char own_style[] =
    "main,header,footer{max-width:84rem}\n"
    ".score td,.score th{white-space:nowrap;padding:.3rem .55rem;border-bottom:1px solid "
    "var(--line)}\n"
    ".score thead th:first-child{width:auto}\n"
    ".score tbody th{font-weight:600}\n"
    ".score td{display:table-cell}.score td::before{content:none}\n"
    ".hidden{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%)}\n"
    ".numbers thead th:first-child{width:34%}\n"
    "details{margin:.4rem 0}summary{cursor:pointer;color:var(--link)}\n"
    "@media(max-width:44rem){.score{display:table}.score thead{display:table-header-group;"
    "position:static;clip-path:none}.score tbody{display:table-row-group}.score "
    "tr{display:table-row}.score th,.score td{display:table-cell;width:auto}}\n";

static const char *class_of(bl_verdict verdict) {
    static const char *const classes[] = {"holds", "undecided", "broken", "soft"};
    return classes[verdict];
}

static void put_verdict(FILE *out, const bl_score_property *result) {
    static const char *const signs[] = {"\u2713", "?", "\u2717", "\u2013"};
    fprintf(out, "<span class=\"%s\">%s %s</span>", class_of(result->verdict),
            signs[result->verdict], bl_verdict_word(result->verdict));
}

// An entry of the table; one that is judged against the ideal alone is set in italics.
static void put_entry(FILE *out, const bl_score_property *result) {
    static const char *const words[] = {"\u2713", "?", "\u2717", "\u2013"};
    bl_html_tagged(out, "<td title=\"", result->reason, "\">");
    fprintf(out, "<span class=\"%s\">%s</span> ", class_of(result->verdict),
            words[result->verdict]);
    int ideal = result->against == BL_AGAINST_IDEAL;
    bl_html_tagged(out, ideal ? "<i>" : "", result->cell, ideal ? "</i>" : "");
    fprintf(out, "<span class=\"hidden\"> %s</span></td>", bl_verdict_word(result->verdict));
}

static void put_table(FILE *out, const bl_score_view *views, size_t count) {
    fputs("<div class=\"scroll\"><table class=\"score\">\n<thead><tr><th>signal</th>", out);
    for (size_t i = 0; i < bl_property_count(); i++) {
        bl_html_tagged(out, "<th title=\"", bl_property_at(i)->question, " ");
        bl_html_tagged(out, "In the column: ", bl_property_at(i)->entry, "\">");
        bl_html_tagged(out, "", bl_property_at(i)->title, "</th>");
    }
    fputs("</tr></thead>\n<tbody>\n", out);
    for (size_t s = 0; s < count; s++) {
        fprintf(out, "<tr><th scope=\"row\"><a href=\"#signal-%zu\">", s + 1);
        bl_html_tagged(out, "", views[s].signal->text, "</a></th>");
        for (size_t i = 0; i < bl_property_count(); i++)
            put_entry(out, &views[s].score->properties[i]);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table></div>\n", out);
}

static void find_interval(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_estimate *estimate = &((const bl_score_number *)table->rows)[row].estimate;
    snprintf(cell->text, sizeof cell->text, "%.6g to %.6g (%g %%)", estimate->lower,
             estimate->upper, 100 * estimate->level);
    cell->word = estimate->level >= 1  ? "exact"
                 : estimate->level > 0 ? cell->text
                                       : "not estimated";
}

#define AT(member) .offset = offsetof(bl_score_number, member)
static const bl_field number_fields[] = {
    {"name", "number", BL_CELL_WORD, AT(name)},
    {"value", "value", BL_CELL_REAL, AT(estimate.value), .digits = 6},
    {"interval", "interval", BL_CELL_WORD, .find = find_interval},
    {0}};
#undef AT

static void put_numbers(FILE *out, const bl_score_property *result) {
    if (result->count == 0)
        return;
    fprintf(out, "<details><summary>%zu number%s</summary>\n", result->count,
            result->count == 1 ? "" : "s");
    bl_table_html(&BL_TABLE(number_fields, result->numbers, result->count), "numbers", out);
    fputs("</details>\n", out);
}

static void put_signal(FILE *out, const bl_score_view *view, size_t index) {
    fprintf(out, "<section id=\"signal-%zu\">\n", index + 1);
    bl_html_tagged(out, "<h2>", view->signal->text, "</h2>\n<dl>\n");
    for (size_t i = 0; i < bl_property_count(); i++) {
        const bl_score_property *result = &view->score->properties[i];
        bl_html_tagged(out, "<dt>", bl_property_at(i)->name, "</dt><dd>");
        put_verdict(out, result);
        fprintf(out, " <span class=\"soft\">against the %s</span> ",
                bl_score_against_word(result->against));
        bl_html_tagged(out, "", result->reason, "\n");
        put_numbers(out, result);
        fputs("</dd>\n", out);
    }
    fputs("</dl>\n</section>\n", out);
}

static void put_tally(FILE *out, const bl_score_view *views, size_t count) {
    size_t tally[BL_VERDICT_NOT_RUN + 1][2] = {{0}};
    for (size_t s = 0; s < count; s++)
        for (size_t i = 0; i < bl_property_count(); i++) {
            const bl_score_property *result = &views[s].score->properties[i];
            tally[result->verdict][result->against == BL_AGAINST_IDEAL]++;
        }
    fputs("<ul class=\"tally\">\n", out);
    for (int v = 0; v < BL_VERDICT_NOT_RUN; v++)
        fprintf(out,
                "<li><b>%zu</b><span class=\"%s\">%s</span> <span class=\"soft\">against claims; "
                "%zu against the ideal</span></li>\n",
                tally[v][0], class_of((bl_verdict)v), bl_verdict_word((bl_verdict)v), tally[v][1]);
    fputs("</ul>\n", out);
}

static void put_guide(FILE *out, const bl_score_settings *settings) {
    fprintf(out,
            "<p>An ideal noise is a repeatable function of a known range, limited to a band, "
            "without periods, stationary and isotropic. A property is judged against what the "
            "signal states of itself, or, where it states nothing (<i>in italics</i>), against the "
            "ideal. All tests together show a failure by chance once in %.3g tables.</p>\n<dl>\n",
            1 / settings->alpha);
    for (size_t i = 0; i < bl_property_count(); i++) {
        bl_html_tagged(out, "<dt>", bl_property_at(i)->title, "</dt>");
        bl_html_tagged(out, "<dd>", bl_property_at(i)->question, " ");
        bl_html_tagged(out, "<span class=\"soft\">In the column: ", bl_property_at(i)->entry,
                       ".</span></dd>\n");
    }
    fputs("</dl>\n", out);
}

bl_status bl_score_page_write(const char *path, const bl_score_view *views, size_t count,
                              const bl_score_settings *settings, bl_verdict verdict,
                              bl_message *message) {
    bl_file file;
    bl_status status = bl_file_create(path, &file, message);
    if (status != BL_OK)
        return status;
    FILE *out = file.stream;
    fputs(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>bandlimit: scorecard</title>\n<style>\n",
        out);
    fputs(bl_page_style, out);
    fputs(own_style, out);
    fprintf(out, "</style>\n</head>\n<body>\n<header>\n<h1>Scorecard: %zu signal%s, %s</h1>\n",
            count, count == 1 ? "" : "s", bl_verdict_word(verdict));
    put_tally(out, views, count);
    fputs("</header>\n<main>\n", out);
    put_table(out, views, count);
    put_guide(out, settings);
    for (size_t s = 0; s < count; s++)
        put_signal(out, &views[s], s);
    fprintf(out,
            "</main>\n<footer><p>bandlimit %s, size %s, seed %llu</p></footer>\n</body>\n</html>\n",
            BL_VERSION, bl_size_word(settings->size), (unsigned long long)settings->seed);
    return bl_file_commit(&file, message);
}
