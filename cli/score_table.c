// SPDX-License-Identifier: MIT
#include "cli/score_table.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/plain.h"

enum { WIDTH = 120, TERMINAL_WIDTH = 80, LEAST_WIDTH = 40, LONGEST_NAME = 40 };

// What COLUMNS says, or the terminal; WIDTH of a file or a pipe.
static size_t find_width(void) {
    const char *columns = getenv("COLUMNS");
    long width = columns ? strtol(columns, NULL, 10) : 0;
    struct winsize size;
    if (width <= 0 && !isatty(STDOUT_FILENO))
        width = WIDTH;
    if (width <= 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0)
        width = size.ws_col;
    if (width <= 0)
        width = TERMINAL_WIDTH;
    return width < LEAST_WIDTH ? LEAST_WIDTH : width > 10000 ? 10000 : (size_t)width;
}

// Words that flow into lines; the lines after the first are indented.
typedef struct paragraph {
    FILE *out;
    size_t width, indent, column;
} paragraph;

// Puts the words of a text in the colour, if that is not "".
static void put_words(paragraph *p, const char *colour, const char *text) {
    fputs(colour, p->out);
    p->column = bl_plain_wrap(p->out, text, p->column, p->indent, p->width);
    fputs(bl_plain_end(*colour), p->out);
}

// A word as wide as a column can afford; the reasons below say it in full.
static const char *short_word(bl_verdict verdict) {
    static const char *const words[] = {"pass", "?", "fail", "-"};
    return words[verdict];
}

static int is_shown(const bl_score_property *result) {
    return strcmp(result->reason, BL_SCORE_NOT_ASKED) != 0 &&
           strcmp(result->reason, BL_SCORE_NO_PICTURE) != 0;
}

static int is_asked(const bl_scorecard *cards, size_t count, size_t property) {
    for (size_t s = 0; s < count; s++)
        if (is_shown(&cards[s].score.properties[property]))
            return 1;
    return 0;
}

static int is_starred(const bl_score_property *result) {
    return result->verdict != BL_VERDICT_NOT_RUN && result->against == BL_AGAINST_IDEAL;
}

// What stands in the table, without colour. A number that is not judged stands alone; a star marks
// what is judged against the ideal.
static void entry_text(const bl_score_property *result, char *text, size_t size) {
    int bare = result->verdict == BL_VERDICT_NOT_RUN && result->cell[0];
    snprintf(text, size, "%s%s%s%s", bare ? "" : short_word(result->verdict),
             is_starred(result) ? "*" : "", !bare && result->cell[0] ? " " : "", result->cell);
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

// Returns the blanks that fill the column, which nothing ends a line with.
static size_t print_entry(bl_call *call, const bl_score_property *result, size_t width) {
    char text[64];
    entry_text(result, text, sizeof text);
    const char *colour = bl_scorecard_colour(call, result->verdict);
    fprintf(call->out, "  %s%s%s", colour, text, *colour ? "\033[0m" : "");
    return width - strlen(text);
}

// Returns the blanks that fill the column, as above.
static size_t print_name(FILE *out, const char *name, size_t width) {
    char cut[LONGEST_NAME + 4];
    size_t length = strlen(name);
    snprintf(cut, sizeof cut, "%.*s%s", (int)(length > width ? width - 3 : width), name,
             length > width ? "..." : "");
    bl_plain_text(out, cut);
    return strlen(cut) < width ? width - strlen(cut) : 0;
}

// The columns [from, to) of the registry.
static void print_block(bl_call *call, const bl_scorecard *cards, size_t count,
                        const size_t *widths, size_t name_width, size_t from, size_t to) {
    size_t blanks = print_name(call->out, "signal", name_width);
    for (size_t i = from; i < to; i++)
        if (widths[i]) {
            fprintf(call->out, "%*s  %s", (int)blanks, "", bl_property_at(i)->title);
            blanks = widths[i] - strlen(bl_property_at(i)->title);
        }
    fputc('\n', call->out);
    for (size_t s = 0; s < count; s++) {
        blanks = print_name(call->out, cards[s].signal->text, name_width);
        for (size_t i = from; i < to; i++)
            if (widths[i]) {
                fprintf(call->out, "%*s", (int)blanks, "");
                blanks = print_entry(call, &cards[s].score.properties[i], widths[i]);
            }
        fputc('\n', call->out);
    }
    fputc('\n', call->out);
}

// What stands first in a paragraph: "  range:".
static paragraph start_paragraph(FILE *out, size_t width, const char *name) {
    fprintf(out, "  %s:", name);
    return (paragraph){out, width, 4, 3 + strlen(name)};
}

static void print_reasons(bl_call *call, const bl_scorecard *card, size_t width) {
    int any = 0;
    for (size_t i = 0; i < bl_property_count(); i++) {
        const bl_score_property *result = &card->score.properties[i];
        int shown =
            result->verdict == BL_VERDICT_FAIL || result->verdict == BL_VERDICT_INCONCLUSIVE;
        shown |= result->verdict == BL_VERDICT_NOT_RUN && !result->cell[0] && is_shown(result);
        if (!shown)
            continue;
        if (!any) {
            bl_plain_text(call->out, card->signal->text);
            fputc('\n', call->out);
        }
        paragraph p = start_paragraph(call->out, width, bl_property_at(i)->name);
        put_words(&p, bl_scorecard_colour(call, result->verdict), bl_verdict_word(result->verdict));
        put_words(&p, "",
                  result->against == BL_AGAINST_CLAIM ? "against its claim:"
                                                      : "against the ideal:");
        put_words(&p, "", result->reason);
        fputc('\n', call->out);
        any = 1;
    }
    if (any)
        fputc('\n', call->out);
}

// What the columns show that there are, and what the signs mean that there are.
static void print_legend(bl_call *call, const bl_scorecard *cards, size_t count,
                         const size_t *widths, size_t width, double alpha) {
    int starred = 0, unsure = 0, idle = 0;
    char chance[160];
    fputs("the columns\n", call->out);
    for (size_t i = 0; i < bl_property_count(); i++) {
        if (!widths[i])
            continue;
        for (size_t s = 0; s < count; s++) {
            const bl_score_property *result = &cards[s].score.properties[i];
            starred |= is_starred(result);
            unsure |= result->verdict == BL_VERDICT_INCONCLUSIVE;
            idle |= result->verdict == BL_VERDICT_NOT_RUN && !result->cell[0];
        }
        paragraph p = start_paragraph(call->out, width, bl_property_at(i)->title);
        put_words(&p, "", bl_property_at(i)->entry);
        fputc('\n', call->out);
    }
    paragraph p = {call->out, width, 0, 0};
    if (starred)
        put_words(&p, "",
                  "* against the ideal, for the signal states nothing; does not count for the exit "
                  "status "
                  "without --strict.");
    if (unsure)
        put_words(&p, "", "? inconclusive.");
    if (idle)
        put_words(&p, "", "- nothing to measure.");
    snprintf(chance, sizeof chance,
             "A table of signals whose facts are true shows a failure by chance once in %.3g.",
             1 / alpha);
    put_words(&p, "", chance);
    fputc('\n', call->out);
}

void bl_score_table_print(bl_call *call, const bl_scorecard *cards, size_t count,
                          const bl_score_settings *settings) {
    size_t widths[BL_SCORE_PROPERTIES] = {0}, name_width = strlen("signal"), from = 0;
    size_t width = find_width(), longest = width / 2 < LONGEST_NAME ? width / 2 : LONGEST_NAME;
    for (size_t s = 0; s < count; s++)
        if (strlen(cards[s].signal->text) > name_width)
            name_width = strlen(cards[s].signal->text);
    name_width = name_width > longest ? longest : name_width;
    for (size_t i = 0; i < bl_property_count(); i++)
        widths[i] = is_asked(cards, count, i) ? column_width(cards, count, i) : 0;
    while (from < bl_property_count()) {
        size_t to = from, used = name_width;
        while (to < bl_property_count() && (used == name_width || used + 2 + widths[to] <= width))
            used += widths[to] ? 2 + widths[to] : 0, to++;
        if (used > name_width)
            print_block(call, cards, count, widths, name_width, from, to);
        from = to;
    }
    for (size_t s = 0; s < count; s++)
        print_reasons(call, &cards[s], width);
    print_legend(call, cards, count, widths, width, settings->alpha);
}
