// SPDX-License-Identifier: MIT
#include "cli/csv.h"

#include <string.h>

bl_status bl_csv_open(bl_call *call, bl_file *file) {
    if (strcmp(call->path, "-") != 0)
        return bl_file_create(call->path, file, &call->message);
    *file = (bl_file){.stream = call->out};
    return BL_OK;
}

bl_status bl_csv_close(bl_call *call, bl_file *file) {
    return file->path ? bl_file_commit(file, &call->message) : BL_OK;
}

bl_status bl_csv_write(bl_call *call, const char *signal, const bl_table *record,
                       const bl_table *rows) {
    bl_file file;
    char title[64];
    bl_status status = bl_csv_open(call, &file);
    if (status != BL_OK)
        return status;
    snprintf(title, sizeof title, "bandlimit %s", call->verb->name);
    bl_csv_comment(file.stream, title, BL_VERSION);
    if (signal)
        bl_csv_comment(file.stream, "signal", signal);
    if (record)
        bl_record_csv(record, file.stream);
    bl_table_csv(rows, file.stream);
    return bl_csv_close(call, &file);
}
