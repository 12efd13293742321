// SPDX-License-Identifier: MIT
//
// The claims of the page: a table of those of a figure, and a list of those that do not hold.
#include "reports/page_claims.h"

#include <math.h>
#include <string.h>

#include "reports/html.h"

static const char *outcome_sign(bl_outcome outcome) {
    static const char *const signs[] = {"&#10003;", "?", "&#10007;", "!", "&ndash;"};
    return signs[outcome];
}

static const char *outcome_class(bl_outcome outcome) {
    return outcome == BL_NOT_RUN ? "soft" : bl_outcome_word(outcome);
}

void bl_page_outcome(FILE *out, bl_outcome outcome) {
    fprintf(out, "<span class=\"%s\">%s %s</span>", outcome_class(outcome), outcome_sign(outcome),
            bl_outcome_word(outcome));
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
    bl_page_outcome(out, bl_claim_outcome(claim));
    fputs("</td></tr>\n", out);
}

void bl_page_claims(FILE *out, const bl_figure_result *result) {
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

static int fails(const bl_claim *claim) {
    return claim->verdict == BL_VERDICT_FAIL;
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
        bl_page_outcome(out, bl_claim_outcome(claim));
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
void bl_page_findings(FILE *out, const bl_run_record *records, size_t count) {
    int any = 0;
    for (size_t f = 0; f < count; f++) {
        const bl_figure_result *result = records[f].result;
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
