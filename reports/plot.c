// SPDX-License-Identifier: MIT
//
// The gnuplot script of a plot. One pass of the script draws one terminal; a loop makes the SVG and
// the PNG, so that both show the same.
#include "reports/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reports/output.h"

// Okabe & Ito (2008), "Color universal design".
static const char *const inks[BL_INK_COUNT] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                               "#E69F00", "#56B4E9", "#000000"};

const char *bl_ink_colour(bl_ink ink) {
    return inks[ink];
}

// Pixels of the SVG; the page shows it at this width at most, so the text is read at FONT pixels.
enum { WIDTH = 1000, LEFT = 74, RIGHT = 18, SCALE_RIGHT = 96, GAP_X = 34, GAP_Y = 38 };
enum { HEAD = 92, FOOT = 70, FONT = 15 };
static const double PDF_INCHES = 7, POINTS_A_PIXEL = 0.75;

// Where the panels stand, in pixels.
typedef struct layout {
    size_t columns, rows;
    double panel_width, panel_height, height;
} layout;

// Grey images, with their scale beside them.
static int shows_images(const bl_plot *plot) {
    return plot->panel_count > 0 && plot->panels[0].image && !plot->coloured;
}

static layout lay_out(const bl_plot *plot) {
    layout l;
    l.columns = plot->columns ? plot->columns : 1;
    l.rows = (plot->panel_count + l.columns - 1) / l.columns;
    double right = shows_images(plot) ? SCALE_RIGHT : RIGHT;
    l.panel_width = (WIDTH - LEFT - right - (double)(l.columns - 1) * GAP_X) / (double)l.columns;
    l.panel_height = l.panel_width * (plot->aspect > 0 ? plot->aspect : 0.62);
    l.height = HEAD + FOOT + (double)l.rows * l.panel_height + (double)(l.rows - 1) * GAP_Y;
    return l;
}

// A text in gnuplot's single quotes, where only the quote itself is special.
static void put_text(FILE *out, const char *text) {
    fputc('\'', out);
    for (; text && *text; text++) {
        if (*text == '\'')
            fputc('\'', out);
        fputc(*text == '\n' ? ' ' : *text, out);
    }
    fputc('\'', out);
}

static void put_label(FILE *out, const char *text, const char *place) {
    fputs("set label ", out);
    put_text(out, text);
    fprintf(out, " at %s\n", place);
}

static void put_head(FILE *out, const bl_plot *plot, const layout *l, const char *name,
                     int with_pdf) {
    fprintf(out,
            "# %s\n"
            "# Run it in this folder: gnuplot %s.gp\n"
            "# It makes %s.svg and .png%s from the data files beside it.\n",
            plot->title ? plot->title : "", name, name, with_pdf ? " and .pdf" : "");
    fprintf(out,
            "if (!exists('prefix')) prefix = ''\n"
            "set encoding utf8\n"
            "set datafile separator ','\n"
            "set datafile missing ''\n"
            "set datafile columnheaders\n"
            "set border 3 linewidth 0.8 linecolor rgb '#555555'\n"
            "set tics nomirror out scale 0.6\n"
            "set grid xtics ytics back linetype 1 linecolor rgb '#dcdcdc' linewidth 0.7\n"
            "set palette gray\n"
            "unset colorbox\n"
            "unset key\n"
            "width = %d\n"
            "height = %.0f\n",
            WIDTH, l->height);
    fprintf(out, "do for [ending in 'svg png%s'] {\n", with_pdf ? " pdf" : "");
    fprintf(out,
            "if (ending eq 'svg') { set terminal svg size %d,%.0f noenhanced font 'Arial,%d' "
            "background rgb 'white' }\n",
            WIDTH, l->height, FONT);
    fprintf(out,
            "if (ending eq 'png') { set terminal pngcairo size %d,%.0f noenhanced font 'Sans,%.1f' "
            "background rgb 'white' }\n",
            WIDTH, l->height, FONT * POINTS_A_PIXEL);
    if (with_pdf)
        fprintf(out,
                "if (ending eq 'pdf') { set terminal pdfcairo size %.2fin,%.2fin noenhanced font "
                "'Sans,%.1f' }\n",
                PDF_INCHES, PDF_INCHES * l->height / WIDTH, FONT * 72 * PDF_INCHES / WIDTH);
    fprintf(out, "set output prefix.'%s.'.ending\nset multiplot\n", name);
}

static void put_axis(FILE *out, char letter, const bl_axis *axis, int outer) {
    if (axis->from != axis->to)
        fprintf(out, "set %crange [%.9g:%.9g]\n", letter, axis->from, axis->to);
    else
        fprintf(out, "set autoscale %c\n", letter);
    if (axis->tick > 0)
        fprintf(out, "set %ctics %.9g\n", letter, axis->tick);
    fprintf(out, axis->logarithmic ? "set logscale %c\n" : "unset logscale %c\n", letter);
    fprintf(out, "set format %c %s\n", letter, outer ? "'%g'" : "''");
}

static void put_limit(FILE *out, const bl_limit *limit, int labelled) {
    char place[160];
    if (limit->vertical) {
        fprintf(out, "set arrow from first %.9g, graph 0 to first %.9g, graph 1", limit->at,
                limit->at);
        snprintf(place, sizeof place, "first %.9g, graph 1 left offset character 0.4, -0.7",
                 limit->at);
    } else {
        fprintf(out, "set arrow from graph 0, first %.9g to graph 1, first %.9g", limit->at,
                limit->at);
        snprintf(place, sizeof place, "graph 1, first %.9g right offset character -0.4, 0.6",
                 limit->at);
    }
    fputs(" nohead back dashtype 2 linewidth 1 linecolor rgb '#666666'\n", out);
    if (labelled && limit->label)
        put_label(out, limit->label, place);
}

static const double BAND_OPACITY = 0.28;

// How a line of this stroke is drawn, in the words that `plot` and `set arrow` share.
static void put_line_style(FILE *out, const bl_series *series) {
    const char *width = series->stroke == BL_STROKE_LINE ? "2.2" : "1.4";
    fprintf(out, "%slinewidth %s linecolor rgb '%s'",
            series->stroke == BL_STROKE_DASHED ? "dashtype (14,14) " : "", width,
            inks[series->ink]);
}

static void put_column(FILE *out, const char *name) {
    fputs("(column(", out);
    put_text(out, name);
    fputs("))", out);
}

static void put_series(FILE *out, const bl_series *series) {
    put_text(out, series->file);
    if (series->skip)
        fprintf(out, " every ::%zu", series->skip);
    fputs(" using ", out);
    put_column(out, series->x);
    fputc(':', out);
    put_column(out, series->y);
    if (series->stroke == BL_STROKE_BAND) {
        fputc(':', out);
        put_column(out, series->upper);
        fprintf(out,
                " with filledcurves linecolor rgb '%s' fillstyle transparent solid %.2f noborder",
                inks[series->ink], BAND_OPACITY);
    } else if (series->stroke == BL_STROKE_WORDS) {
        fputs(":(stringcolumn(", out);
        put_text(out, series->upper);
        fprintf(out, ")) with labels left offset character 0.7, 0.4 textcolor rgb '%s'",
                inks[series->ink]);
    } else if (series->stroke == BL_STROKE_POINTS) {
        fprintf(out, " with points pointtype 7 pointsize 0.45 linecolor rgb '%s'",
                inks[series->ink]);
    } else {
        fputs(" with lines ", out);
        put_line_style(out, series);
    }
}

// --- the legend, in one row under the title: gnuplot's own keeps to the width of one panel
// --------

enum { TITLE_LETTER = 9 }; // pixels, of a title that must not run into the next
enum { SAMPLE = 32, LETTER = 8, LEGEND_GAP = 22, LEGEND_TOP = 48 }; // pixels; LETTER on average

// Title and legend begin at the left, where a narrow screen that scrolls begins to show.
static double legend_width(const bl_series *series) {
    return series->label ? SAMPLE + 8 + LETTER * (double)strlen(series->label) + LEGEND_GAP : 0;
}

static void put_legend_entry(FILE *out, const bl_series *series, const layout *l, double left) {
    double from = left / WIDTH, to = (left + SAMPLE) / WIDTH, y = 1 - LEGEND_TOP / l->height;
    double half = series->stroke == BL_STROKE_BAND ? 5 / l->height : 2.5 / l->height;
    if (series->stroke == BL_STROKE_BAND || series->stroke == BL_STROKE_POINTS) {
        double inset = series->stroke == BL_STROKE_POINTS ? (SAMPLE - 5.0) / 2 / WIDTH : 0;
        fprintf(out,
                "set object rectangle from screen %.5f, screen %.5f to screen %.5f, screen %.5f "
                "fillcolor rgb '%s' fillstyle transparent solid %.2f noborder\n",
                from + inset, y - half, to - inset, y + half, inks[series->ink],
                series->stroke == BL_STROKE_BAND ? BAND_OPACITY : 1);
    } else {
        fprintf(out, "set arrow from screen %.5f, screen %.5f to screen %.5f, screen %.5f nohead ",
                from, y, to, y);
        put_line_style(out, series);
        fputc('\n', out);
    }
    char place[80];
    snprintf(place, sizeof place, "screen %.5f, screen %.5f left", (left + SAMPLE + 8) / WIDTH, y);
    put_label(out, series->label, place);
}

static size_t labelled(const bl_panel *panel) {
    size_t count = 0;
    for (size_t i = 0; i < panel->series_count; i++)
        count += panel->series[i].label != NULL;
    return count;
}

const bl_panel *bl_plot_legend(const bl_plot *plot) {
    const bl_panel *most = &plot->panels[0];
    for (size_t i = 1; i < plot->panel_count; i++)
        if (labelled(&plot->panels[i]) > labelled(most))
            most = &plot->panels[i];
    return most;
}

static void put_legend(FILE *out, const bl_panel *panel, const layout *l) {
    double left = LEFT;
    for (size_t i = 0; i < panel->series_count; i++) {
        if (panel->series[i].label)
            put_legend_entry(out, &panel->series[i], l, left);
        left += legend_width(&panel->series[i]);
    }
}

// --- panels -------------------------------------------------------------------------------------

static void put_margins(FILE *out, const layout *l, size_t index) {
    double left = LEFT + (double)(index % l->columns) * (l->panel_width + GAP_X);
    double top = HEAD + (double)(index / l->columns) * (l->panel_height + GAP_Y);
    fprintf(out,
            "set lmargin at screen %.5f; set rmargin at screen %.5f\n"
            "set tmargin at screen %.5f; set bmargin at screen %.5f\n",
            left / WIDTH, (left + l->panel_width) / WIDTH, 1 - top / l->height,
            1 - (top + l->panel_height) / l->height);
}

// The texts of the whole page, which stand in the first panel because gnuplot keeps no page.
static void put_page_texts(FILE *out, const bl_plot *plot, const layout *l) {
    char corner[80];
    snprintf(corner, sizeof corner, "screen %.5f, screen 1 left offset 0, character -1.2",
             (double)LEFT / WIDTH);
    put_label(out, plot->title, corner);
    if (shows_images(plot) && plot->scale_label) {
        char place[80];
        snprintf(place, sizeof place, "screen %.5f, screen %.5f left offset 0, character 1.3",
                 1 - (SCALE_RIGHT - 18.0) / WIDTH, 1 - HEAD / l->height);
        put_label(out, plot->scale_label, place);
    }
    put_label(out, plot->x.label, "screen 0.5, screen 0 center offset 0, character 0.9");
    put_label(out, plot->y.label,
              "screen 0, screen 0.5 center rotate by 90 offset character 1.4, 0");
    put_legend(out, bl_plot_legend(plot), l);
}

// The codes 0..255 of the picture become values again, for the numbers of the scale.
static void put_image(FILE *out, const bl_plot *plot, const layout *l, size_t index) {
    fprintf(out, "set cbrange [%.9g:%.9g]\n", plot->black, plot->white);
    if (index + 1 == plot->panel_count)
        fprintf(out,
                "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n",
                1 - (SCALE_RIGHT - 18.0) / WIDTH, FOOT / l->height, 16.0 / WIDTH,
                1 - (HEAD + FOOT) / l->height);
    fputs("plot ", out);
    put_text(out, plot->panels[index].image);
    fprintf(out,
            " binary filetype=png flipy origin=(%.9g,%.9g) dx=%.9g dy=%.9g using (%.9g + $1 * "
            "%.9g) with image\n",
            plot->pixel / 2, plot->pixel / 2, plot->pixel, plot->pixel, plot->black,
            (plot->white - plot->black) / 255);
}

static void put_coloured_image(FILE *out, const bl_plot *plot, size_t index) {
    fputs("unset colorbox\nplot ", out);
    put_text(out, plot->panels[index].image);
    fprintf(out,
            " binary filetype=png flipy origin=(%.9g,%.9g) dx=%.9g dy=%.9g using 1:2:3 with "
            "rgbimage\n",
            plot->pixel / 2, plot->pixel / 2, plot->pixel, plot->pixel);
}

// What fits over the panel: the beginning of the title, with dots for the rest.
static void shorten(char *out, size_t size, const char *title, size_t letters) {
    if (strlen(title) <= letters)
        snprintf(out, size, "%s", title);
    else
        snprintf(out, size, "%.*s...", (int)(letters > 3 ? letters - 3 : 0), title);
}

static void put_panel(FILE *out, const bl_plot *plot, const layout *l, size_t index) {
    const bl_panel *panel = &plot->panels[index];
    int own_y = plot->y.from == plot->y.to;
    fputs("unset label; unset arrow; unset object\n", out);
    put_margins(out, l, index);
    put_axis(out, 'x', &plot->x, index + l->columns >= plot->panel_count);
    put_axis(out, 'y', &plot->y, index % l->columns == 0 || own_y);
    for (size_t i = 0; i < plot->limit_count; i++)
        put_limit(out, &plot->limits[i], index == 0);
    char letter[32];
    snprintf(letter, sizeof letter, "(%c%.0zu) ", (int)('a' + index % 26), index / 26);
    char title[160];
    shorten(title, sizeof title, panel->title ? panel->title : "",
            (size_t)(l->panel_width / TITLE_LETTER) - strlen(letter));
    fputs("set label ", out);
    put_text(out, letter);
    fputc('.', out);
    put_text(out, title);
    fputs(" at graph 0, graph 1 left offset 0, character 0.75\n", out);
    if (index == 0)
        put_page_texts(out, plot, l);
    if (panel->image) {
        if (plot->coloured)
            put_coloured_image(out, plot, index);
        else
            put_image(out, plot, l, index);
        return;
    }
    fputs("plot ", out);
    for (size_t i = 0; i < panel->series_count; i++) {
        fputs(i ? ", \\\n     " : "", out);
        put_series(out, &panel->series[i]);
    }
    fputc('\n', out);
}

bl_status bl_plot_write(const bl_plot *plot, const char *folder, const char *name, int with_pdf,
                        bl_message *message) {
    bl_file file;
    bl_status status = bl_output_create(folder, name, "gp", &file, message);
    if (status != BL_OK)
        return status;
    layout l = lay_out(plot);
    put_head(file.stream, plot, &l, name, with_pdf);
    for (size_t i = 0; i < plot->panel_count; i++)
        put_panel(file.stream, plot, &l, i);
    fputs("unset multiplot\nset output\n}\n", file.stream);
    return bl_file_commit(&file, message);
}
