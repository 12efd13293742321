// SPDX-License-Identifier: MIT
#include "cli/score_table.h"

#include <string.h>

#include "cli/plain.h"

enum { WIDTH = 120, LONGEST_NAME = 40 };

// A word as wide as a column can afford; the reasons below say it in full.
static const char *short_word(bl_score_verdict verdict) {
    static const char *const words[] = {"pass", "fail", "?", "-"};
    return words[verdict];
}

static int is_asked(const bl_scorecard *cards, size_t count, size_t property) {
    for (size_t s = 0; s < count; s++)
        if (strcmp(cards[s].score.properties[property].reason, BL_SCORE_NOT_ASKED) != 0)
            return 1;
    return 0;
}

// What stands in the table, without colour. A number that is not judged stands alone.
static void entry_text(const bl_score_property *result, char *text, size_t size) {
    int bare = result->verdict == BL_SCORE_NOT_RUN && result->cell[0];
    snprintf(text, size, "%s%s%s", bare ? "" : short_word(result->verdict),
             !bare && result->cell[0] ? " " : "", result->cell);
}

static size_t column_width(const bl_scorecard *cards, size_t count, size_t property) {
    size_t width = strlen(bl_property_at(property)->title);
    for (size_t s = 0; s < count; s++) {
        char text[64];
        entry_text(&cards[s].score.properties[property], text, sizeof text);
        width = strlen(text) > width ? strlen(text) : width;
    }
    return width;
}

static void print_entry(bl_call *call, const bl_score_property *result, size_t width) {
    char text[64];
    entry_text(result, text, sizeof text);
    const char *colour = bl_scorecard_colour(call, result->verdict);
    fprintf(call->out, "  %s%s%s%*s", colour, text, *colour ? "\033[0m" : "",
            (int)(width - strlen(text)), "");
}

static void print_name(FILE *out, const char *name, size_t width) {
    char cut[LONGEST_NAME + 4];
    size_t length = strlen(name);
    snprintf(cut, sizeof cut, "%.*s%s", (int)(length > width ? width - 3 : width), name,
             length > width ? "..." : "");
    bl_plain_text(out, cut);
    for (size_t i = strlen(cut); i < width; i++)
        fputc(' ', out);
}

// The columns [from, to) of the registry.
static void print_block(bl_call *call, const bl_scorecard *cards, size_t count,
                        const size_t *widths, size_t name_width, size_t from, size_t to) {
    fprintf(call->out, "%-*s", (int)name_width, "signal");
    for (size_t i = from; i < to; i++)
        if (widths[i])
            fprintf(call->out, "  %-*s", (int)widths[i], bl_property_at(i)->title);
    fputc('\n', call->out);
    for (size_t s = 0; s < count; s++) {
        print_name(call->out, cards[s].signal->text, name_width);
        for (size_t i = from; i < to; i++)
            if (widths[i])
                print_entry(call, &cards[s].score.properties[i], widths[i]);
        fputc('\n', call->out);
    }
    fputc('\n', call->out);
}

static void print_reasons(bl_call *call, const bl_scorecard *card) {
    int any = 0;
    for (size_t i = 0; i < bl_property_count(); i++) {
        const bl_score_property *result = &card->score.properties[i];
        int shown = result->verdict == BL_SCORE_FAIL || result->verdict == BL_SCORE_INCONCLUSIVE;
        shown |= result->verdict == BL_SCORE_NOT_RUN && !result->cell[0] &&
                 strcmp(result->reason, BL_SCORE_NOT_ASKED) != 0;
        if (!shown)
            continue;
        if (!any)
            bl_plain_text(call->out, card->signal->text);
        fprintf(call->out, "%s  %s: %s against %s: ", any ? "" : "\n", bl_property_at(i)->name,
                bl_scorecard_word(call, result->verdict),
                result->against == BL_AGAINST_CLAIM ? "its claim" : "the ideal");
        bl_plain_text(call->out, result->reason);
        fputc('\n', call->out);
        any = 1;
    }
    if (any)
        fputc('\n', call->out);
}

void bl_score_table_print(bl_call *call, const bl_scorecard *cards, size_t count,
                          const bl_score_settings *settings) {
    size_t widths[BL_SCORE_PROPERTIES] = {0}, name_width = strlen("signal"), from = 0;
    for (size_t s = 0; s < count; s++)
        if (strlen(cards[s].signal->text) > name_width)
            name_width = strlen(cards[s].signal->text);
    name_width = name_width > LONGEST_NAME ? LONGEST_NAME : name_width;
    for (size_t i = 0; i < bl_property_count(); i++)
        widths[i] = is_asked(cards, count, i) ? column_width(cards, count, i) : 0;
    while (from < bl_property_count()) {
        size_t to = from, used = name_width;
        while (to < bl_property_count() && (to == from || used + 2 + widths[to] <= WIDTH))
            used += widths[to] ? 2 + widths[to] : 0, to++;
        print_block(call, cards, count, widths, name_width, from, to);
        from = to;
    }
    for (size_t s = 0; s < count; s++)
        print_reasons(call, &cards[s]);
    fprintf(call->out,
            "range: share of the stated range that was found (without one the largest size); band: "
            "leak, dB of the\nvariance; ? inconclusive, - nothing to measure. A table of signals "
            "that keep what they claim shows a\nfailure by chance once in %.3g.\n",
            1 / settings->alpha);
}
