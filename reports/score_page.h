// SPDX-License-Identifier: MIT
//
// The page of a scorecard: one self-contained HTML file without a script.
#ifndef BL_REPORTS_SCORE_PAGE_H
#define BL_REPORTS_SCORE_PAGE_H

#include "core/signal.h"
#include "score/score.h"

// A signal and its score; both are the caller's.
typedef struct bl_score_view {
    const bl_signal *signal;
    const bl_score *score;
} bl_score_view;

// Writes the page; `verdict` is that of the table. Errors: BL_DEVICE.
bl_status bl_score_page_write(const char *path, const bl_score_view *views, size_t count,
                              const bl_score_settings *settings, bl_verdict verdict,
                              bl_message *message);

#endif
