// SPDX-License-Identifier: MIT
//
// The contract of a figure, the registry of all figures, and what a running figure may use.
//
// A figure is one file in reports/figures/, which ends with one descriptor, and one line in
// reports/figures.def. Its run function measures, through spectra/, and hands the numbers to the
// services below, which draw, write and judge what they are given and measure nothing. The page,
// the CLI and the tests pick the figure up from the registry. The signals of a figure are those
// that its paper shows.
//
// All services report into the run's message and return a status; a figure returns the first that
// is not BL_OK. Texts given to the services are copied, except where it says otherwise.
#ifndef BL_REPORTS_RUN_H
#define BL_REPORTS_RUN_H

#include <stdarg.h>
#include <stddef.h>

#include "core/status.h"
#include "reports/claim.h"
#include "core/image.h"
#include "reports/plot.h"
#include "reports/reproduce.h"

typedef struct bl_run bl_run;

// A word that a figure uses in a sense of its own.
typedef struct bl_term {
    const char *name, *meaning;
} bl_term;

typedef struct bl_figure {
    const char *name;     // "peachey-2.37"
    const char *title;    // "Power spectra of six noises"
    const char *question; // the one question it answers
    const char *paper;    // key and place: "peachey2003, fig. 2.37"
    const char *shows;    // a few sentences: what is drawn and how to read it
    const bl_term *terms; // ended by one without a name; NULL: none
    bl_status (*run)(bl_run *run, bl_message *message);
    int timed; // the data hold times, so that a second run leaves other bytes
} bl_figure;

size_t bl_figure_count(void);
const bl_figure *bl_figure_at(size_t index);       // NULL past the end
const bl_figure *bl_figure_find(const char *name); // NULL for an unknown name

// Names the descriptor of a figure file: BL_FIGURE_DESCRIPTOR(peachey_2_37) = {...};
#define BL_FIGURE_DESCRIPTOR(stem)                                                                 \
    extern const bl_figure bl_figure_##stem;                                                       \
    const bl_figure bl_figure_##stem

// The settings of the whole reproduction, constant during a run.
const bl_reproduce_settings *bl_run_settings(const bl_run *run);

// The number for the run's size.
double bl_run_pick(const bl_run *run, double quick, double normal, double full);

// Tells the progress callback what is being done.
void bl_run_step(bl_run *run, const char *step);

// A text made by printf that lives as long as the run and its result; "" if out of memory.
const char *bl_run_text(bl_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));
const char *bl_run_vtext(bl_run *run, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));

// A named setting of the figure, for the page, JSON, the head of every CSV file written later, and
// the attributes of images. `value` may be made by bl_run_text.
void bl_run_setting(bl_run *run, const char *name, const char *value);

// A column of a data file: numbers, or words if `words` is set.
typedef struct bl_column {
    const char *name; // with the unit: "frequency_cycles_per_cell"
    const double *values;
    const char *const *words;
} bl_column;

// Writes NAME.csv: comment lines (what it is, the settings), one header line, the rows. Numbers
// have 9 significant digits; NaN is an empty field.
bl_status bl_run_csv(bl_run *run, const char *name, const char *what, const bl_column *columns,
                     size_t column_count, size_t rows, bl_message *message);

// Writes NAME.gp and lets gnuplot make NAME.svg and NAME.png of it (and NAME.pdf on request).
// `alternative` says in words what the plot shows, for those who cannot see it.
bl_status bl_run_plot(bl_run *run, const char *name, const bl_plot *plot, const char *alternative,
                      bl_message *message);

// Writes NAME.exr with the values and NAME.png for the eye. The settings become attributes.
bl_status bl_run_image(bl_run *run, const char *name, const bl_image *image, bl_message *message);

// Judges a claim and keeps it. Its texts are not copied: literals, or made by bl_run_text.
void bl_run_claim(bl_run *run, const bl_claim *claim);

// What the harness, the page and the JSON writer read of a finished run.
typedef struct bl_run_note {
    const char *name, *text;
} bl_run_note;

enum { BL_KEYS = 8 }; // entries of a legend

typedef struct bl_run_key {
    const char *label;
    bl_stroke stroke;
    bl_ink ink;
} bl_run_key;

typedef struct bl_run_picture {
    const char *name; // without ending
    const char *text; // the alternative text
    const char *title;
    bl_run_key keys[BL_KEYS];
    size_t key_count;
} bl_run_picture;

typedef struct bl_run_view {
    const bl_figure_result *result; // changes until the run is finished
    const bl_run_note *settings;    // name and value
    size_t setting_count;
    const bl_run_picture *plots;
    size_t plot_count;
} bl_run_view;

// Makes the figure's folder and runs the figure: everything but the page. On success the caller
// frees the run with bl_run_free. `done` of `total` figures are for the progress callback.
bl_status bl_run_figure(const bl_figure *figure, const bl_reproduce_settings *settings, size_t done,
                        size_t total, bl_run **run, bl_message *message);
bl_run_view bl_run_look(const bl_run *run);
void bl_run_free(bl_run *run);

// Writes NAME.json: the settings, the claims and the files of a run. Errors: BL_DEVICE.
bl_status bl_run_write_json(const bl_run_view *view, const bl_reproduce_settings *settings,
                            bl_message *message);

#endif
