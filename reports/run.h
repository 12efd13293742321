// SPDX-License-Identifier: MIT
//
// What a running figure may use. The services draw, write and judge what they are given and measure
// nothing; reports/measure.h beside this opens and measures.
//
// A run ends at its first failure. No service returns a status: one that cannot do its work keeps
// the message, leaves the figure's function for good, and the harness reports it. So nothing is
// drawn, written or claimed after a failure, what a service hands out is always good, and a figure
// never asks. Two things follow for those who write one:
//
//   - what must be released is taken from the run (bl_run_signal, bl_run_psd, bl_run_memory, ...;
//     bl_run_keep for all else), which releases it when the figure has ended, well or not. What is
//     released by hand must not be held across a call of a service;
//   - services are called by the thread that runs the figure, not within a parallel loop.
//
// Texts given to the services are copied, except where it says otherwise.
#ifndef BL_REPORTS_RUN_H
#define BL_REPORTS_RUN_H

#include <stdarg.h>
#include <stddef.h>

#include "core/image.h"
#include "core/random.h"
#include "core/status.h"
#include "core/table.h"
#include "reports/claim.h"
#include "reports/figure.h"
#include "reports/plot.h"
#include "reports/settings.h"

typedef struct bl_run bl_run;

// The settings of the whole reproduction, constant during a run.
const bl_reproduce_settings *bl_run_settings(const bl_run *run);

// The number for the run's size, and the same of things that are counted.
double bl_run_pick(const bl_run *run, double quick, double normal, double full);
size_t bl_run_count(const bl_run *run, double quick, double normal, double full);

// A stream of random numbers from the seed of the run; each use has a stream of its own.
bl_random bl_run_random(const bl_run *run, uint64_t stream);

// Tells the progress callback what is being done.
void bl_run_step(bl_run *run, const char *step);

// A text made by printf that lives as long as the run and its result.
const char *bl_run_text(bl_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));

// A named setting of the figure, for the page, JSON, the head of every CSV file written later, and
// the attributes of images. `value` may be made by bl_run_text.
void bl_run_setting(bl_run *run, const char *name, const char *value);

// --- what can fail ------------------------------------------------------------------------------

// For a function that returns a status: bl_run_must(run, bl_view_open(..., bl_run_message(run)))
// ends the run with its message unless the status is BL_OK.
bl_message *bl_run_message(bl_run *run);
void bl_run_must(bl_run *run, bl_status status);

// Zeroed memory for `count` things of a size, until the figure ends.
void *bl_run_memory(bl_run *run, size_t count, size_t size);

// Hands a thing over, and back: `release` is called with it when the figure ends, the last one
// first. NULL means that it could not be had for want of memory.
void *bl_run_keep(bl_run *run, void *thing, void (*release)(void *thing));

// Releases it at once: for what is large, and made again and again.
void bl_run_release(bl_run *run, const void *thing);

// --- files and claims ---------------------------------------------------------------------------

// A column of a data file: numbers, or words if `words` is set.
typedef struct bl_column {
    const char *name; // with the unit: "frequency_cycles_per_cell"
    const double *values;
    const char *const *words;
} bl_column;

// Writes NAME.csv: comment lines (what it is, the settings), one header line, the rows. Numbers
// have 9 significant digits; NaN is an empty field.
void bl_run_csv(bl_run *run, const char *name, const char *what, const bl_column *columns,
                size_t column_count, size_t rows);

// The same of a table of structs, whose fields say where its numbers and words stand, and which of
// them have limits (core/table.h).
void bl_run_table(bl_run *run, const char *name, const char *what, const bl_table *table);

// Writes NAME.gp and lets gnuplot make NAME.svg and NAME.png of it (and NAME.pdf on request). A
// plot without a title answers the question of the figure. `alternative` says in words what it
// shows, for those who cannot see it.
void bl_run_plot(bl_run *run, const char *name, const bl_plot *plot, const char *alternative);

// Writes NAME.exr with the values and NAME.png for the eye, whose file it returns, for a panel. The
// settings become attributes.
const char *bl_run_image(bl_run *run, const char *name, const bl_image *image);

// Keeps a warning for the page, JSON and whoever runs the figure. `text` may be made by
// bl_run_text.
void bl_run_warn(bl_run *run, const char *text);

// Judges a claim and keeps it. Its texts are not copied: literals, or made by bl_run_text.
void bl_run_claim(bl_run *run, const bl_claim *claim);

#endif
