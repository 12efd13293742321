// SPDX-License-Identifier: MIT
//
// The page of a reproduction: one self-contained HTML file without a script.
#ifndef BL_REPORTS_PAGE_H
#define BL_REPORTS_PAGE_H

#include "reports/record.h"

// Writes the page. Pictures are read from the figures' folders and put into the page; data files
// are linked relative to it. Errors: BL_DEVICE.
bl_status bl_page_write(const char *path, const bl_run_record *records, size_t count,
                        const bl_reproduce_settings *settings, bl_message *message);

#endif
