// SPDX-License-Identifier: MIT
//
// The settings of a run of figures, and the result of each figure.
#ifndef BL_REPORTS_SETTINGS_H
#define BL_REPORTS_SETTINGS_H

#include <stddef.h>
#include <stdint.h>

#include "core/size.h"
#include "noises/noise.h"
#include "reports/claim.h"

typedef struct bl_reproduce_settings {
    const char *folder;    // of the output, made if missing
    const char *format;    // "svg", or "pdf" to leave a PDF of every plot as well
    const char *arguments; // the words the user gave, for the page and JSON; NULL: none
    bl_size size;
    uint64_t seed;
    int threads; // 0: as many as OpenMP gives
    bl_isa isa;
    // Other figures than those of the registry; NULL: the registry.
    const struct bl_figure *const *figures;
    size_t figure_count;
    const char *const *signals; // of figures that show the user's own
    size_t signal_count;
    // Optional: called from the calling thread before each step, with the figures done so far.
    void (*progress)(void *user, size_t done, size_t total, const char *figure, const char *step);
    void *user;
} bl_reproduce_settings;

// What became of one figure.
typedef struct bl_figure_result {
    const struct bl_figure *figure; // reports/figure.h; static
    const char *folder;             // of its files
    const char **files;             // names in that folder, in the order they were written
    size_t file_count;
    const char **warnings; // of what the figure shows worse than it is
    size_t warning_count;
    bl_claim *claims; // judged
    size_t claim_count;
    size_t outcomes[BL_NOT_RUN + 1]; // how many claims hold, are undecided, ...
    double seconds;
} bl_figure_result;

#endif
