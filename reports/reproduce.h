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

#include "core/status.h"
#include "reports/settings.h"

// Folder "out", SVG, normal size, seed 1, all threads, the best instruction set, no progress.
bl_reproduce_settings bl_reproduce_default_settings(void);

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
