// SPDX-License-Identifier: MIT
//
// What the page says of claims. All write to `out`; errors show when the file is committed.
#ifndef BL_REPORTS_PAGE_CLAIMS_H
#define BL_REPORTS_PAGE_CLAIMS_H

#include <stdio.h>

#include "reports/record.h"

// An outcome with its sign, in its colour.
void bl_page_outcome(FILE *out, bl_outcome outcome);

// The table of a figure's claims, a row for each reading; nothing for a figure without claims.
void bl_page_claims(FILE *out, const bl_figure_result *result);

// The claims that somebody should read first, each with a link to its figure: those that are
// refuted or broken. Nothing if there are none.
void bl_page_findings(FILE *out, const bl_run_record *records, size_t count);

#endif
