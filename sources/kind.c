// SPDX-License-Identifier: MIT
//
// What the sources read texts with.
#include "sources/kind.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int bl_source_ends_with(const char *text, size_t length, const char *ending) {
    size_t tail = strlen(ending);
    return length > tail && strncmp(text + length - tail, ending, tail) == 0;
}

// lib.so, and lib.so.1.2
int bl_source_is_shared_object(const char *text, size_t length) {
    while (length > 0 && (isdigit((unsigned char)text[length - 1]) ||
                          (text[length - 1] == '.' && isdigit((unsigned char)text[length]))))
        length--;
    return bl_source_ends_with(text, length, ".so") || bl_source_ends_with(text, length, ".so.");
}

int bl_source_is_whole_file(const char *text) {
    size_t length = strlen(text);
    return length > 0 && access(text, F_OK) == 0 && !bl_source_is_shared_object(text, length) &&
           !bl_source_ends_with(text, length, ".raw");
}

int bl_source_in_range(const double *at, unsigned dims) {
    for (unsigned a = 0; a < dims; a++)
        if (!(fabs(at[a]) <= 0x1p62))
            return 0;
    return 1;
}

// The grammar wants a name and a colon: what stands before the settings becomes one, of the same
// length.
bl_status bl_source_settings(const bl_parameter *parameters, const char *text, const char *settings,
                             size_t length, void *block, bl_message *message) {
    size_t before = settings ? (size_t)(settings - text) : strcspn(text, ":");
    char *plain = strndup(text, settings ? before + length : before), *quoted;
    bl_spec spec;
    if (!plain)
        return bl_report(message, BL_DEVICE, "out of memory reading '%s'", text);
    for (size_t i = 0; i < before; i++)
        plain[i] = plain[i] == ':' ? '_' : plain[i];
    if (settings)
        plain[before - 1] = ':';
    bl_status status = bl_spec_parse(plain, &spec, message);
    if (status != BL_OK && message && (quoted = strstr(message->text, plain)))
        memcpy(quoted, text, strlen(plain)); // the words of the user
    free(plain);
    if (status != BL_OK)
        return status;
    status = bl_parameters_read(parameters, &spec, text, block, message);
    bl_spec_free(&spec);
    return status;
}
