// SPDX-License-Identifier: MIT
//
// The six noises that figures 2.35 to 2.37 of peachey2003 show in panels (a) to (f).
#ifndef BL_REPORTS_FIGURES_SIX_NOISES_H
#define BL_REPORTS_FIGURES_SIX_NOISES_H

#include "core/signal.h"
#include "reports/run.h"
#include "reports/figures/estimates.h"
#include "reports/figures/gallery.h"

enum { BL_SIX = 6 };
enum { BL_VNOISE, BL_GNOISE, BL_VGNOISE, BL_HERMITE, BL_VCNOISE, BL_SCNOISE };

extern const char *const bl_six_names[BL_SIX];

typedef struct bl_six {
    bl_signal *signal[BL_SIX];
} bl_six;

// Opens the six with the seed of the run and notes their texts as a setting. On success the caller
// ends with bl_six_close.
bl_status bl_six_open(bl_run *run, bl_six *six, bl_message *message);
void bl_six_close(bl_six *six);

// The six as a gallery, which refers to them and is not closed.
bl_gallery bl_six_gallery(bl_six *six);

// Opens one signal by a printf text, with the instruction set of the run.
bl_status bl_six_open_one(bl_run *run, bl_signal **signal, bl_message *message, const char *format,
                          ...) __attribute__((format(printf, 4, 5)));

#endif
