// SPDX-License-Identifier: MIT
//
// The page: a summary, then one section a figure. The files it reads are the pictures that the run
// has just written.
#include "reports/page.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/version.h"
#include "reports/html.h"
#include "reports/output.h"
#include "reports/page_claims.h"

static void put_base64(FILE *out, FILE *in) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char bytes[3];
    size_t got;
    while ((got = fread(bytes, 1, 3, in)) > 0) {
        unsigned long bits = (unsigned long)bytes[0] << 16 |
                             (got > 1 ? (unsigned long)bytes[1] << 8 : 0) |
                             (got > 2 ? (unsigned long)bytes[2] : 0);
        fputc(digits[bits >> 18], out);
        fputc(digits[bits >> 12 & 63], out);
        fputc(got > 1 ? digits[bits >> 6 & 63] : '=', out);
        fputc(got > 2 ? digits[bits & 63] : '=', out);
    }
}

// Title and legend as text, for narrow screens, on which the picture scrolls.
static void put_key(FILE *out, const bl_run_picture *plot) {
    static const char *const shapes[] = {
        [BL_STROKE_LINE] = "line", [BL_STROKE_THIN] = "line",     [BL_STROKE_DASHED] = "dash",
        [BL_STROKE_BAND] = "band", [BL_STROKE_POINTS] = "points",
    };
    fputs("<p class=\"key\">", out);
    if (plot->title[0])
        bl_html_tagged(out, "<b>", plot->title, "</b>");
    for (size_t i = 0; i < plot->key_count; i++) {
        const bl_run_key *key = &plot->keys[i];
        fprintf(out, " <span><i class=\"%s\" style=\"color:%s\"></i>", shapes[key->stroke],
                bl_ink_colour(key->ink));
        bl_html_tagged(out, "", key->label, "</span>");
    }
    fputs("</p>", out);
}

// A picture as data: several SVG texts in one page would share their internal names.
static bl_status put_picture(FILE *out, const char *folder, const bl_run_picture *plot,
                             bl_message *message) {
    char *path = bl_output_path(folder, plot->name, "svg");
    if (!path)
        return bl_report(message, BL_DEVICE, "out of memory");
    FILE *in = fopen(path, "r");
    bl_status status =
        in ? BL_OK : bl_report(message, BL_DEVICE, "cannot read '%s': %s", path, strerror(errno));
    if (in) {
        fputs("<figure class=\"plot\"><div class=\"sheet\">", out);
        put_key(out, plot);
        bl_html_tagged(out, "<div class=\"scroll\" tabindex=\"0\"><img alt=\"", plot->text,
                       "\" src=\"data:image/svg+xml;base64,");
        put_base64(out, in);
        bl_html_tagged(out, "\"></div></div><figcaption>", plot->text, "</figcaption></figure>\n");
        fclose(in);
    }
    free(path);
    return status;
}

static void put_pair(FILE *out, const char *name, const char *text) {
    bl_html_tagged(out, "<dt>", name, "</dt>");
    bl_html_tagged(out, "<dd>", text, "</dd>\n");
}

static void put_words(FILE *out, const bl_term *words) {
    fputs("<dl>\n", out);
    for (; words->name; words++)
        put_pair(out, words->name, words->meaning);
    fputs("</dl>\n", out);
}

static void put_settings(FILE *out, const bl_run_record *record) {
    fputs("<h3>Settings</h3>\n<dl>\n", out);
    for (size_t i = 0; i < record->setting_count; i++)
        put_pair(out, record->settings[i].name, record->settings[i].text);
    fputs("</dl>\n", out);
}

static void put_files(FILE *out, const bl_figure_result *result) {
    fputs("<h3>Files</h3>\n<ul class=\"files\">\n", out);
    for (size_t i = 0; i < result->file_count; i++) {
        bl_html_tagged(out, "<li><a href=\"", result->figure->name, "/");
        bl_html_tagged(out, "", result->files[i], "\">");
        bl_html_tagged(out, "", result->files[i], "</a></li>\n");
    }
    fputs("</ul>\n", out);
}

static bl_status put_figure(FILE *out, const bl_run_record *record, bl_message *message) {
    const bl_figure_result *result = record->result;
    const bl_figure *figure = result->figure;
    bl_html_tagged(out, "<section id=\"", figure->name, "\">\n<p class=\"soft\">");
    bl_html_tagged(out, "", figure->name, " &middot; ");
    bl_html_tagged(out, "", figure->title, " &middot; after ");
    bl_html_tagged(out, "", figure->paper, "</p>\n");
    bl_html_tagged(out, "<h2>", figure->question, "</h2>\n");
    bl_html_tagged(out, "<p>", figure->shows, "</p>\n");
    for (size_t i = 0; i < result->warning_count; i++)
        bl_html_tagged(out, "<p><strong>Warning:</strong> ", result->warnings[i], "</p>\n");
    for (size_t i = 0; i < record->plot_count; i++) {
        bl_status status = put_picture(out, result->folder, &record->plots[i], message);
        if (status != BL_OK)
            return status;
    }
    if (figure->terms) {
        fputs("<h3>Terms</h3>\n", out);
        put_words(out, figure->terms);
    }
    bl_page_claims(out, result);
    put_settings(out, record);
    put_files(out, result);
    fputs("</section>\n", out);
    return BL_OK;
}

static size_t count_claims(const bl_run_record *records, size_t count) {
    size_t total = 0;
    for (size_t f = 0; f < count; f++)
        total += records[f].result->claim_count;
    return total;
}

static void put_tally(FILE *out, const bl_run_record *records, size_t count) {
    size_t outcomes[BL_NOT_RUN + 1] = {0};
    for (size_t f = 0; f < count; f++)
        for (int v = 0; v <= BL_NOT_RUN; v++)
            outcomes[v] += records[f].result->outcomes[v];
    fprintf(out,
            "<p>%zu figure%s, %zu claims measured. A claim of a paper that is refuted is a "
            "finding; a claim of our own that is broken is a fault.</p>\n"
            "<ul class=\"tally\">\n",
            count, count == 1 ? "" : "s", count_claims(records, count));
    for (int v = 0; v <= BL_NOT_RUN; v++) {
        if (outcomes[v] == 0 && (v == BL_NOT_RUN || v == BL_UNDECIDED))
            continue;
        fprintf(out, "<li><b>%zu</b>", outcomes[v]);
        bl_page_outcome(out, (bl_outcome)v);
        fputs("</li>\n", out);
    }
    fputs("</ul>\n", out);
}

static void put_contents(FILE *out, const bl_run_record *records, size_t count) {
    fputs("<nav aria-label=\"Figures\"><ol>\n", out);
    for (size_t f = 0; f < count; f++) {
        bl_html_tagged(out, "<li><a href=\"#", records[f].result->figure->name, "\">");
        bl_html_tagged(out, "", records[f].result->figure->question, "</a> ");
        bl_html_tagged(out, "<span class=\"soft\">", records[f].result->figure->name,
                       "</span></li>\n");
    }
    fputs("</ol></nav>\n", out);
}

static void put_guide(FILE *out) {
    static const bl_term words[] = {
        {"expected",
         "the range that the sentence leads us to expect; in our own claims it follows "
         "from theory and the number of samples"},
        {"interval",
         "where the true value lies, at the level beside it, by the scatter of the "
         "samples. Not estimated: the number is an extreme of what was looked at, or "
         "the largest of several deviations, and more samples may pass it. Exact: "
         "computed, not sampled"},
        {"samples",
         "how many independent things the interval rests on, and of what kind. An "
         "average of a spectrum is one stretch, slice or volume at a fresh place with a "
         "fresh seed"},
        {"verdict",
         "holds: the whole interval lies in the expected range; undecided: it straddles "
         "a limit; refuted or broken: it lies outside. Without an interval the value "
         "alone is judged"},
        {0}};
    fputs("<section>\n<h2>How to read the claims</h2>\n", out);
    put_words(out, words);
    fputs("</section>\n", out);
}

static void put_head(FILE *out, const char *title) {
    fputs(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
        out);
    bl_html_tagged(out, "<title>", title, "</title>\n<style>\n");
    fputs(bl_page_style, out);
    bl_html_tagged(out, "</style>\n</head>\n<body>\n<header>\n<h1>", title, "</h1>\n");
}

bl_status bl_page_write(const char *path, const bl_run_record *records, size_t count,
                        const bl_reproduce_settings *settings, bl_message *message) {
    bl_file file;
    bl_status status = bl_file_create(path, &file, message);
    if (status != BL_OK)
        return status;
    FILE *out = file.stream;
    size_t claims = count_claims(records, count);
    put_head(out, claims ? "bandlimit: figures and claims" : "bandlimit: figures");
    if (claims)
        put_tally(out, records, count);
    put_contents(out, records, count);
    fputs("</header>\n<main>\n", out);
    bl_page_findings(out, records, count);
    if (claims)
        put_guide(out);
    for (size_t i = 0; i < count && status == BL_OK; i++)
        status = put_figure(out, &records[i], message);
    fprintf(out, "</main>\n<footer><p>bandlimit %s, size %s, seed %llu", BL_VERSION,
            bl_size_word(settings->size), (unsigned long long)settings->seed);
    if (settings->arguments && *settings->arguments)
        bl_html_tagged(out, ": <code>", settings->arguments, "</code>");
    fputs("</p></footer>\n</body>\n</html>\n", out);
    if (status == BL_OK)
        return bl_file_commit(&file, message);
    bl_file_discard(&file);
    return status;
}
