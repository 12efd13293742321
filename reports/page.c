// SPDX-License-Identifier: MIT
//
// The page: a summary, then one section a figure. The files it reads are the pictures that the run
// has just written.
#include "reports/page.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/version.h"
#include "reports/html.h"
#include "reports/output.h"

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
    bl_html_tagged(out, "<p class=\"key\"><b>", plot->title, "</b>");
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

static const char *verdict_sign(bl_verdict verdict) {
    static const char *const signs[] = {"&#10003;", "?", "&#10007;", "!", "&ndash;"};
    return signs[verdict];
}

static const char *verdict_class(bl_verdict verdict) {
    return verdict == BL_NOT_RUN ? "soft" : bl_verdict_word(verdict);
}

static void put_verdict(FILE *out, bl_verdict verdict) {
    fprintf(out, "<span class=\"%s\">%s %s</span>", verdict_class(verdict), verdict_sign(verdict),
            bl_verdict_word(verdict));
}

static void put_unit(FILE *out, const bl_claim *claim) {
    bl_html_tagged(out, claim->unit[0] ? " " : "", claim->unit, "");
}

static void put_expected(FILE *out, const bl_claim *claim) {
    if (isinf(claim->expected_lower) && isinf(claim->expected_upper))
        fputs("any", out);
    else if (isinf(claim->expected_lower))
        fprintf(out, "at most %.4g", claim->expected_upper);
    else if (isinf(claim->expected_upper))
        fprintf(out, "at least %.4g", claim->expected_lower);
    else
        fprintf(out, "%.4g to %.4g", claim->expected_lower, claim->expected_upper);
    put_unit(out, claim);
}

static void put_measured(FILE *out, const bl_claim *claim) {
    fprintf(out, "%.4g", claim->measured.value);
    put_unit(out, claim);
}

static void put_interval(FILE *out, const bl_claim *claim) {
    const bl_estimate *m = &claim->measured;
    if (m->level >= 1) {
        fputs("exact", out);
    } else if (m->level > 0) {
        fprintf(out, "%.4g to %.4g", m->lower, m->upper);
        put_unit(out, claim);
        fprintf(out, " (%g&nbsp;%%)", 100 * m->level);
    } else {
        fputs("not estimated", out);
    }
}

static int same_sentence(const bl_claim *a, const bl_claim *b) {
    return strcmp(a->sentence, b->sentence) == 0 && strcmp(a->source, b->source) == 0;
}

// A row that names the claim, then one row for each reading of it.
static void put_claim(FILE *out, const bl_claim *claim, int first) {
    if (first) {
        bl_html_tagged(out, "<tr class=\"claim\"><th colspan=\"6\" scope=\"rowgroup\">",
                       claim->sentence, "");
        bl_html_tagged(out, " <span>", claim->source, "</span></th></tr>\n");
    }
    bl_html_tagged(out, "<tr><td data-label=\"reading\"><span>", claim->reading,
                   "</span></td><td data-label=\"expected\"><span>");
    put_expected(out, claim);
    fputs("</span></td><td class=\"number\" data-label=\"measured\"><span>", out);
    put_measured(out, claim);
    fputs("</span></td><td class=\"number\" data-label=\"interval\"><span>", out);
    put_interval(out, claim);
    fprintf(out, "</span></td><td class=\"number\" data-label=\"samples\"><span>%.10g ",
            claim->measured.samples);
    bl_html_tagged(out, "", claim->counted ? claim->counted : "", "");
    fputs("</span></td><td data-label=\"verdict\">", out);
    put_verdict(out, claim->verdict);
    fputs("</td></tr>\n", out);
}

static void put_claims(FILE *out, const bl_figure_result *result) {
    if (result->claim_count == 0)
        return;
    fputs(
        "<h3>Claims</h3>\n<table><thead><tr><th>Reading</th><th>Expected</th><th>Measured</th>"
        "<th>Interval</th><th>Samples</th><th>Verdict</th></tr></thead>\n<tbody>\n",
        out);
    for (size_t i = 0; i < result->claim_count; i++)
        put_claim(out, &result->claims[i],
                  i == 0 || !same_sentence(&result->claims[i - 1], &result->claims[i]));
    fputs("</tbody></table>\n", out);
}

static void put_words(FILE *out, const bl_term *words) {
    fputs("<dl>\n", out);
    for (; words->name; words++) {
        bl_html_tagged(out, "<dt>", words->name, "</dt>");
        bl_html_tagged(out, "<dd>", words->meaning, "</dd>\n");
    }
    fputs("</dl>\n", out);
}

static void put_settings(FILE *out, const bl_run_view *view) {
    fputs("<h3>Settings</h3>\n<dl>\n", out);
    for (size_t i = 0; i < view->setting_count; i++) {
        bl_html_tagged(out, "<dt>", view->settings[i].name, "</dt>");
        bl_html_tagged(out, "<dd>", view->settings[i].text, "</dd>\n");
    }
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

static bl_status put_figure(FILE *out, const bl_run_view *view, bl_message *message) {
    const bl_figure_result *result = view->result;
    const bl_figure *figure = result->figure;
    bl_html_tagged(out, "<section id=\"", figure->name, "\">\n<p class=\"soft\">");
    bl_html_tagged(out, "", figure->name, " &middot; ");
    bl_html_tagged(out, "", figure->title, " &middot; after ");
    bl_html_tagged(out, "", figure->paper, "</p>\n");
    bl_html_tagged(out, "<h2>", figure->question, "</h2>\n");
    bl_html_tagged(out, "<p>", figure->shows, "</p>\n");
    for (size_t i = 0; i < view->plot_count; i++) {
        bl_status status = put_picture(out, result->folder, &view->plots[i], message);
        if (status != BL_OK)
            return status;
    }
    if (figure->terms) {
        fputs("<h3>Terms</h3>\n", out);
        put_words(out, figure->terms);
    }
    put_claims(out, result);
    put_settings(out, view);
    put_files(out, result);
    fputs("</section>\n", out);
    return BL_OK;
}

static int fails(const bl_claim *claim) {
    return claim->verdict == BL_REFUTED || claim->verdict == BL_BROKEN;
}

// One sentence, claims `from` to `to` - 1, with the readings in which it fails.
static void put_finding(FILE *out, const bl_figure_result *result, size_t from, size_t to) {
    size_t failing = 0;
    for (size_t i = from; i < to; i++)
        failing += (size_t)fails(&result->claims[i]);
    bl_html_tagged(out, "<li>", result->claims[from].sentence, " <span class=\"soft\">");
    bl_html_tagged(out, "", result->claims[from].source, "</span>\n<ul>\n");
    for (size_t i = from; i < to; i++) {
        const bl_claim *claim = &result->claims[i];
        if (!fails(claim))
            continue;
        fputs("<li>", out);
        put_verdict(out, claim->verdict);
        bl_html_tagged(out, " ", claim->reading, ": ");
        put_measured(out, claim);
        fputs(", interval ", out);
        put_interval(out, claim);
        fputs("; expected ", out);
        put_expected(out, claim);
        fputs("</li>\n", out);
    }
    fputs("</ul>\n", out);
    if (failing < to - from)
        fprintf(out, "<span class=\"soft\">%zu of %zu readings</span> ", failing, to - from);
    bl_html_tagged(out, "<a href=\"#", result->figure->name, "\">");
    bl_html_tagged(out, "", result->figure->name, "</a></li>\n");
}

// The claims that somebody should read first, each with a link to its figure.
static void put_findings(FILE *out, const bl_run_view *views, size_t count) {
    int any = 0;
    for (size_t f = 0; f < count; f++) {
        const bl_figure_result *result = views[f].result;
        for (size_t from = 0, to; from < result->claim_count; from = to) {
            int failing = 0;
            for (to = from; to < result->claim_count &&
                            same_sentence(&result->claims[from], &result->claims[to]);
                 to++)
                failing |= fails(&result->claims[to]);
            if (!failing)
                continue;
            fputs(any ? "" : "<section>\n<h2>What does not hold</h2>\n<ol class=\"findings\">\n",
                  out);
            any = 1;
            put_finding(out, result, from, to);
        }
    }
    fputs(any ? "</ol>\n</section>\n" : "", out);
}

static size_t count_claims(const bl_run_view *views, size_t count) {
    size_t total = 0;
    for (size_t f = 0; f < count; f++)
        total += views[f].result->claim_count;
    return total;
}

static void put_tally(FILE *out, const bl_run_view *views, size_t count) {
    size_t verdicts[BL_NOT_RUN + 1] = {0};
    for (size_t f = 0; f < count; f++)
        for (int v = 0; v <= BL_NOT_RUN; v++)
            verdicts[v] += views[f].result->verdicts[v];
    fprintf(out,
            "<p>%zu figure%s, %zu claims measured. A claim of a paper that is refuted is a "
            "finding; a claim of our own that is broken is a fault.</p>\n"
            "<ul class=\"tally\">\n",
            count, count == 1 ? "" : "s", count_claims(views, count));
    for (int v = 0; v <= BL_NOT_RUN; v++) {
        if (verdicts[v] == 0 && (v == BL_NOT_RUN || v == BL_UNDECIDED))
            continue;
        fprintf(out, "<li><b>%zu</b>", verdicts[v]);
        put_verdict(out, (bl_verdict)v);
        fputs("</li>\n", out);
    }
    fputs("</ul>\n", out);
}

static void put_contents(FILE *out, const bl_run_view *views, size_t count) {
    fputs("<nav aria-label=\"Figures\"><ol>\n", out);
    for (size_t f = 0; f < count; f++) {
        bl_html_tagged(out, "<li><a href=\"#", views[f].result->figure->name, "\">");
        bl_html_tagged(out, "", views[f].result->figure->question, "</a> ");
        bl_html_tagged(out, "<span class=\"soft\">", views[f].result->figure->name,
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

bl_status bl_page_write(const char *path, const bl_run_view *views, size_t count,
                        const bl_reproduce_settings *settings, bl_message *message) {
    bl_file file;
    bl_status status = bl_file_create(path, &file, message);
    if (status != BL_OK)
        return status;
    FILE *out = file.stream;
    size_t claims = count_claims(views, count);
    put_head(out, claims ? "bandlimit: figures and claims" : "bandlimit: figures");
    if (claims)
        put_tally(out, views, count);
    put_contents(out, views, count);
    fputs("</header>\n<main>\n", out);
    put_findings(out, views, count);
    if (claims)
        put_guide(out);
    for (size_t i = 0; i < count && status == BL_OK; i++)
        status = put_figure(out, &views[i], message);
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
