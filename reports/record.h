// SPDX-License-Identifier: MIT
//
// What is kept of a run when the figure is made: what the harness, the page and the JSON read.
#ifndef BL_REPORTS_RECORD_H
#define BL_REPORTS_RECORD_H

#include "reports/figure.h"
#include "reports/plot.h"
#include "reports/settings.h"

typedef struct bl_run bl_run;

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

typedef struct bl_run_record {
    const bl_figure_result *result; // changes until the run is finished
    const bl_run_note *settings;    // name and value
    size_t setting_count;
    const bl_run_picture *plots;
    size_t plot_count;
} bl_run_record;

// Makes the figure's folder and runs the figure: everything but the page. On success the caller
// frees the run with bl_run_free; on failure everything that the figure opened is released, and the
// message is that of the first failure. `done` of `total` figures are for the progress callback.
bl_status bl_run_figure(const bl_figure *figure, const bl_reproduce_settings *settings, size_t done,
                        size_t total, bl_run **run, bl_message *message);
bl_run_record bl_run_look(const bl_run *run);
void bl_run_free(bl_run *run);

// Writes NAME.json: the settings, the claims and the files of a run. Errors: BL_DEVICE.
bl_status bl_run_write_json(const bl_run_record *record, const bl_reproduce_settings *settings,
                            bl_message *message);

#endif
