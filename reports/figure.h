// SPDX-License-Identifier: MIT
//
// The contract of a figure, and the registry of all figures.
//
// A figure is one file in reports/figures/, which ends with one descriptor, and one line in
// reports/figures.def. Its function measures, through spectra/, aliasing/ and score/, and hands the
// numbers to the services of the run that makes it (reports/run.h). The page, the command line and
// the tests pick the figure up from the registry. The signals of a figure are those that its paper
// shows.
#ifndef BL_REPORTS_FIGURE_H
#define BL_REPORTS_FIGURE_H

#include <stddef.h>

#include "core/registry.h"

struct bl_run;

// A word that a figure uses in a sense of its own.
typedef struct bl_term {
    const char *name, *meaning;
} bl_term;

typedef struct bl_figure {
    BL_ENTRY(title, question);
    const char *shows;    // a few sentences: what is drawn and how to read it
    const bl_term *terms; // ended by one without a name; NULL: none
    void (*run)(struct bl_run *run);
    int timed; // the data hold times, so that a second run leaves other bytes
} bl_figure;

BL_REGISTRY(bl_figure, bl_figure, bl_figures)

// Names the descriptor of a figure file: BL_FIGURE_DESCRIPTOR(peachey_2_37) = {...};
#define BL_FIGURE_DESCRIPTOR(stem)                                                                 \
    extern const bl_figure bl_figure_##stem;                                                       \
    const bl_figure bl_figure_##stem

#endif
