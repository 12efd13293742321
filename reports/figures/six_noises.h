// SPDX-License-Identifier: MIT
//
// The six noises that figures 2.35 to 2.37 of peachey2003 show in panels (a) to (f), and the
// arithmetic of estimates that their claims share.
#ifndef BL_REPORTS_FIGURES_SIX_NOISES_H
#define BL_REPORTS_FIGURES_SIX_NOISES_H

#include "core/signal.h"
#include "core/statistics.h"
#include "reports/experiment.h"
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

// A number that is computed, not sampled: it has no interval because it needs none.
bl_estimate bl_exactly(double value, double samples);
// The extreme of all that was looked at, or the largest of several deviations: a number whose
// interval is not estimated, and that more samples may pass.
bl_estimate bl_observed(double value, double samples);
// a - b of independent estimates: half widths add in squares. `samples` is that of the poorer one.
bl_estimate bl_difference(bl_estimate a, bl_estimate b);
// 10 log10(a / b) of independent positive estimates, to first order; the level is that of a.
bl_estimate bl_ratio_db(bl_estimate a, bl_estimate b);

// Makes and keeps a claim; the texts are literals or made by bl_run_text. `counted` says
// what the samples of the estimate are.
void bl_six_claim(bl_run *run, const char *source, const char *sentence, const char *reading,
                  const char *unit, double lower, double upper, bl_estimate measured,
                  const char *counted);

#endif
