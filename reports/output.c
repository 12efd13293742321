// SPDX-License-Identifier: MIT
#include "reports/output.h"

#include <stdio.h>
#include <stdlib.h>

char *bl_output_path(const char *folder, const char *name, const char *ending) {
    char *path = NULL;
    return asprintf(&path, "%s/%s.%s", folder, name, ending) < 0 ? NULL : path;
}

bl_status bl_output_create(const char *folder, const char *name, const char *ending, bl_file *file,
                           bl_message *message) {
    char *path = bl_output_path(folder, name, ending);
    if (!path)
        return bl_report(message, BL_DEVICE, "out of memory");
    bl_status status = bl_file_create(path, file, message);
    free(path);
    return status;
}
