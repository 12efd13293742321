// SPDX-License-Identifier: MIT
//
// The data file of a verb.
#ifndef BL_CLI_CSV_H
#define BL_CLI_CSV_H

#include "cli/verb.h"
#include "core/csv.h"
#include "core/file.h"
#include "core/table.h"

// Opens call->path for data, which "-" makes standard output. End with bl_csv_close.
bl_status bl_csv_open(bl_call *call, bl_file *file);
// Commits the file.
bl_status bl_csv_close(bl_call *call, bl_file *file);
// All of it: as comments the version, what is measured and the record, each
// if there is one; the rows.
bl_status bl_csv_write(bl_call *call, const char *signal, const bl_table *record,
                       const bl_table *rows);

#endif
