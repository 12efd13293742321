// SPDX-License-Identifier: MIT
//
// Regenerates figures: data, plots, images, claims, and the page that shows them.
//
// Every figure gets a folder of its own name below the output folder; the page is index.html in
// the output folder, and shows the figures of this run.
#ifndef BL_REPORTS_REPRODUCE_H
#define BL_REPORTS_REPRODUCE_H

#include <stddef.h>
#include <stdint.h>

#include "core/size.h"
#include "core/status.h"
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

// Folder "out", SVG, normal size, seed 1, all threads, the best instruction set, no progress.
bl_reproduce_settings bl_reproduce_default_settings(void);

// What became of one figure.
typedef struct bl_figure_result {
    const struct bl_figure *figure; // reports/figure.h; static
    const char *folder;             // of its files
    const char **files;             // names in that folder, in the order they were written
    size_t file_count;
    bl_claim *claims; // judged
    size_t claim_count;
    size_t outcomes[BL_NOT_RUN + 1]; // how many claims hold, are undecided, ...
    double seconds;
} bl_figure_result;

typedef struct bl_reproduction {
    bl_figure_result *figures;
    size_t count;
    size_t outcomes[BL_NOT_RUN + 1]; // over all figures
    bl_verdict verdict;              // the worst of our own claims; those of papers fail nothing
    char *page;                      // path of index.html
    double seconds;
    void *owned; // what the results refer to
} bl_reproduction;

// Runs the figures named (count 0: all, in their order) and writes the page. The
// status says whether they ran; whether the claims held stands in result->verdict. On success the
// caller frees the result with bl_reproduction_free. Errors: BL_USAGE for an unknown name or
// format, BL_DEVICE for files and for gnuplot missing or failing, and what the measurements report.
bl_status bl_reproduce(const char *const *names, size_t count,
                       const bl_reproduce_settings *settings, bl_reproduction *result,
                       bl_message *message);
void bl_reproduction_free(bl_reproduction *result);

#endif
