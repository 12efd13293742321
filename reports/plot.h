// SPDX-License-Identifier: MIT
//
// Plots: a description of panels in, a gnuplot script out. The style of every figure lives here.
// Nothing is measured or computed here: a plot shows the columns of the data files it is given.
//
// All panels of a plot share their axes, and only the outer ones carry numbers. The palette is that
// of Okabe and Ito (2008), which colour-blind readers can tell apart; measured lines are blue with
// a pale band, closed forms are vermilion, limits are thin grey lines.
#ifndef BL_REPORTS_PLOT_H
#define BL_REPORTS_PLOT_H

#include <stddef.h>

#include "core/status.h"

typedef enum bl_ink {
    BL_INK_MEASURED, // blue
    BL_INK_THEORY,   // vermilion
    BL_INK_SECOND,   // bluish green
    BL_INK_THIRD,    // reddish purple
    BL_INK_FOURTH,   // orange
    BL_INK_FIFTH,    // sky blue
    BL_INK_PLAIN,    // black
    BL_INK_COUNT
} bl_ink;

const char *bl_ink_colour(bl_ink ink); // "#0072B2"

typedef enum bl_stroke {
    BL_STROKE_LINE,
    BL_STROKE_THIN, // a thinner line, for what is drawn over another: a closed form
    BL_STROKE_DASHED,
    BL_STROKE_BAND, // filled between y and upper
    BL_STROKE_POINTS,
    BL_STROKE_WORDS // the words of the column `upper`, to the right of each point
} bl_stroke;

// Something drawn from the columns of a CSV file in the folder of the plot.
typedef struct bl_series {
    bl_stroke stroke;
    bl_ink ink;
    const char *file;  // "spectra.csv"
    const char *x, *y; // names of columns
    const char *upper; // of a band, or of words; else NULL
    const char *label; // in the legend of the plot (see bl_plot_legend); NULL: not in it
    size_t skip;       // rows at the head of the file that are not drawn
} bl_series;

// A thin marked line across the panels: a limit, a Nyquist frequency, a claimed band.
typedef struct bl_limit {
    int vertical; // at a value of x; else of y
    double at;
    const char *label; // in the first panel; NULL: none
} bl_limit;

typedef struct bl_panel {
    const char *title; // after its letter: "vnoise"; NULL: the letter alone
    const bl_series *series;
    size_t series_count;
    const char *image; // or a grey PNG file, shown with the scale black to white; its upper left
                       // corner stands at 0, 0, so y.from > y.to shows it upright
} bl_panel;

typedef struct bl_axis {
    const char *label; // the name and the unit; NULL: none
    double from, to;   // both 0: chosen by gnuplot, apart in each panel if the data differ
    double tick;       // distance of the numbers (a factor where it is logarithmic); 0: chosen
                       // by gnuplot
    int logarithmic;
} bl_axis;

typedef struct bl_plot {
    const char *title; // the question that it answers; NULL: none
    bl_axis x, y;
    const bl_panel *panels;
    size_t panel_count;
    size_t columns; // of panels; 0: one
    double aspect;  // height of a panel over its width; 0: 0.62
    const bl_limit *limits;
    size_t limit_count;
    int coloured;            // image panels are in colour, shown as they are and without a scale
    double black, white;     // of image panels: the values of PNG codes 0 and full scale
    double pixel;            // of image panels: the size of a pixel in units of the axes
    const char *scale_label; // of image panels: the name of the value
} bl_plot;

// The panel that the legend is read off: the first with the most series that have a label.
const bl_panel *bl_plot_legend(const bl_plot *plot);

// Writes the script `folder`/`name`.gp, which makes NAME.svg and NAME.png (and NAME.pdf) beside
// itself when it is run by hand, as `gnuplot NAME.gp`. Errors: BL_DEVICE.
bl_status bl_plot_write(const bl_plot *plot, const char *folder, const char *name, int with_pdf,
                        bl_message *message);

// Runs gnuplot on a script that bl_plot_write wrote, and puts the finished pictures in place.
// Errors: BL_DEVICE if gnuplot is missing or fails; the message holds what it said.
bl_status bl_plot_run(const char *folder, const char *name, int with_pdf, bl_message *message);

#endif
